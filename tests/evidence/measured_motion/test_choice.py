"""The rule that recommends a row: by Reynolds number, reduced frequency, wing and speed, never by the force."""

import dataclasses

import numpy as np
import pytest

from tests.helpers.strip_cases import flapping_case
from wingbeat._base import InvalidInputError
from wingbeat.aero import LIBRARY, BladeElement, Feathered, FeatheredRevolving, SuFan
from wingbeat_evidence.measured_motion import validate
from wingbeat_evidence.measured_motion.choice import (
    attached_share,
    preference,
    regime_of,
    significant,
    wanted_model,
    wanted_unsteady,
)
from wingbeat_evidence.measured_motion.ladder import Rung
from wingbeat_evidence.measured_motion.strip_motion import strip_motion

INSECT = {"mass": 1e-3, "semi_span": 0.05, "chord": 0.012, "frequency": 30.0, "speed": 0.5}
BIRD = {"mass": 0.3, "semi_span": 0.3, "chord": 0.11, "frequency": 8.0}


def regime(**about):
    case = flapping_case(**about)
    return regime_of(case, strip_motion(case))


def chosen(found):
    aero = found.recommended.aero
    return aero.coefficients.name, found.recommended.unsteady, aero.inflow


def test_numbers_of_the_regime():
    found = regime(**BIRD, speed=12.0, wing="rigid")
    assert found.chord == pytest.approx(0.11)
    assert found.reynolds == pytest.approx(1.2 * found.speed * 0.11 / 1.8e-5)
    assert found.reduced_frequency == pytest.approx(np.pi * 8 * 0.11 / found.speed)
    assert found.speed > 12.0


def test_small_slow_wings_get_the_revolving_polar_whatever_their_kind():
    for wing in ("rigid", "feathered", None):
        assert wanted_model(regime(**INSECT, wing=wing), ["feathered", "su-fan"]) == "dickinson"


@pytest.mark.parametrize("wing", ["feathered", "membrane"])
def test_larger_wings_get_the_model_of_their_kind_where_there_is_one(wing):
    found = regime(**BIRD, speed=12.0, wing=wing)
    assert wanted_model(found, ["su-fan", wing]) == wing
    assert wanted_model(found, ["su-fan"]) == "su-fan"


def test_slow_wings_get_the_revolving_model_of_their_kind():
    slow, fast = (regime(**BIRD, speed=speed, wing="feathered") for speed in (1.0, 12.0))
    names = ["su-fan", "feathered", "feathered-revolving"]
    assert (wanted_model(slow, names), wanted_model(fast, names)) == ("feathered-revolving", "feathered")
    assert wanted_model(regime(**BIRD, speed=1.0, wing="membrane"), names) == "su-fan"


def test_a_kind_that_is_not_said_is_guessed_and_said_so():
    insect, bird = regime(**INSECT), regime(**BIRD, speed=12.0)
    assert (insect.wing, insect.guessed, bird.wing, bird.guessed) == ("rigid", True, "feathered", True)
    assert "guessed" in validate(flapping_case(**INSECT), ["dickinson"]).reason
    assert "guessed" not in validate(flapping_case(**INSECT, wing="rigid"), ["dickinson"]).reason


def test_inflow_in_slow_flight_and_none_in_cruise():
    slow, fast = (validate(flapping_case(**BIRD, speed=speed, wing="rigid")) for speed in (1.0, 14.0))
    assert chosen(slow) == ("su-fan", "none", "momentum")
    assert chosen(fast) == ("su-fan", "none", "none")
    assert (slow.regime.slowness < 2, fast.regime.slowness > 2) == (True, True)


def test_no_unsteady_terms_at_a_low_reduced_frequency():
    assert chosen(validate(flapping_case(**BIRD | {"frequency": 1.0}, speed=14.0)))[1] == "none"


@pytest.mark.parametrize(
    "asked",
    [{}, {"unsteady": "none"}, {"inflow": "momentum"}, {"aero": ["byl"]}, {"aero": ["wang", "su-fan", "byl"]}],
)
def test_exactly_one_row_is_recommended_among_those_asked_for(asked):
    found = validate(flapping_case(), **asked)
    assert [row.recommended for row in found.rows].count(True) == 1
    assert [row["recommended"] for row in found.to_dict()["results"]].count(True) == 1


def test_the_nearest_row_by_reynolds_number_stands_in_for_the_one_that_is_not_there():
    found = validate(flapping_case(**BIRD, speed=12.0, wing="rigid"), ["byl", "wang", "dickinson"])
    assert found.recommended.aero.coefficients.name == "wang"
    assert "not among the rows" in found.reason


def test_a_model_of_no_known_reynolds_number_comes_last():
    found = regime(**BIRD, speed=12.0, wing="rigid")
    byl, wang = (preference(found, Rung(BladeElement(name)), "su-fan", 1.0) for name in ("byl", "wang"))
    assert byl > wang


def test_unsteady_terms_need_attached_flow_and_the_lag_straight_fast_flow_too():
    fast = regime(**BIRD, speed=14.0, wing="feathered")
    wake, thin = "thin-aerofoil-wake", "thin-aerofoil"
    feathered, revolving = Feathered(), FeatheredRevolving()
    assert wanted_unsteady(fast, feathered, 0.9) == wake
    assert wanted_unsteady(fast, feathered, 0.89) == wanted_unsteady(fast, revolving, 0.89) == "none"
    assert wanted_unsteady(fast, revolving, 1.0) == thin
    assert wanted_unsteady(dataclasses.replace(fast, slowness=1.9), feathered, 1.0) == thin
    assert wanted_unsteady(dataclasses.replace(fast, reduced_frequency=0.1), feathered, 1.0) == "none"


def test_attached_is_the_share_of_the_motion_below_the_largest_lift():
    """The beat's angles of attack are counted by a loop over times and strips."""
    case = flapping_case(**BIRD, speed=5.0)
    motion = strip_motion(case)
    stall, within = np.radians(40.25), 0.0
    for along, across in zip(motion.chord_speed, motion.normal_speed, strict=True):
        within += np.mean([abs(np.arctan2(-n, c)) < stall for c, n in zip(along, across, strict=True)])
    share = attached_share(case, motion, SuFan())
    assert share == pytest.approx(within / len(case.times), abs=2e-3)
    assert 0.1 < share < 0.95


def test_a_stalled_beat_gets_no_terms_of_attached_flow_and_an_attached_one_says_so():
    stalled = validate(flapping_case(**BIRD | {"frequency": 16.0}, speed=8.0, wing="rigid"), ["su-fan"])
    attached = validate(flapping_case(**BIRD | {"frequency": 5.0}, speed=14.0, wing="rigid"), ["su-fan"])
    assert chosen(attached) == ("su-fan", "thin-aerofoil-wake", "none")
    assert (stalled.recommended.unsteady, stalled.regime.slowness > 2) == ("none", True)
    assert "less than the 90 % that terms of attached flow need" in stalled.reason
    because = "because the reduced frequency is above 0.1 and the flow is attached for"
    assert f"the lag of the wake, {because}" in attached.reason


def test_the_recommended_row_does_not_see_the_force():
    case = flapping_case(**BIRD, speed=5.0)
    random = np.random.default_rng(1)
    forces = [{"fz": random.normal(size=len(case.times))} for _ in range(3)]
    choices = {chosen(validate(dataclasses.replace(case, forces=one, mean_force=None))) for one in forces}
    choices |= {chosen(validate(dataclasses.replace(case, mean_force=mean))) for mean in ((0, 9), (1, -3))}
    assert len(choices) == 1


def test_the_ladder_has_every_model_and_each_step_that_it_can_take():
    rows = validate(flapping_case()).rows
    for name in LIBRARY:
        steps = {(row.unsteady, row.aero.inflow) for row in rows if row.aero.coefficients.name == name}
        holds_its_own = LIBRARY[name]().aspect_ratio is None
        assert len(steps) == (2 if holds_its_own else 6)


def test_inflow_without_an_aspect_ratio_is_refused_where_it_was_asked_for():
    with pytest.raises(InvalidInputError, match="dickinson states none"):
        validate(flapping_case(), ["su-fan", "dickinson"], inflow="momentum")
    assert {row.aero.inflow for row in validate(flapping_case(), ["dickinson"]).rows} == {"none"}


def test_what_is_asked_is_checked_at_once():
    with pytest.raises(InvalidInputError) as caught:
        validate(flapping_case(), ["hummingbird"], unsteady="much", inflow="some", induced_factor=-1.0)
    assert len(caught.value.faults) == 4
    with pytest.raises(InvalidInputError, match="names no coefficient model"):
        validate(flapping_case(), [])


def test_numbers_for_people():
    assert [significant(value) for value in (0.0, 123456.0, 0.0346, 9.96)] == ["0", "120000", "0.035", "10"]
