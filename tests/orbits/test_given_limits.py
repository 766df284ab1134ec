"""What users give in radians: angles that can only be degrees are refused, and limits count once."""

import math

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.species_texts import MINIMAL
from wingbeat.cli import main
from wingbeat.orbits.problem.quantities import WingbeatLimit

PIGEON = wb.load_species("pigeon")
MODEL = wb.FlightModel(PIGEON.vehicle, "su-fan")


def problem(**asked):
    return wb.OrbitProblem(PIGEON, 10.0, **asked)


def start(pitch):
    return wb.simulate(MODEL, PIGEON.wingbeat, wb.State(u=10.0, body_pitch=pitch), 1, 8)


ANGLES = {
    "wingbeat.flap_amplitude": lambda v: wb.Wingbeat(6.0, 0.0, v, 0.1, 0.3),
    "wingbeat.flap_harmonics[1]": lambda v: wb.Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3, flap_harmonics=(0.1, v)),
    "wing.stroke_plane_angle": lambda v: wb.Wing(0.3, 0.1, 0.02, stroke_plane_angle=v),
    "tail.incidence": lambda v: wb.Tail(0.01, 0.1, 2.0, incidence=v),
    "springs.rest_angle": lambda v: wb.Springs(1.0, rest_angle=v),
    "wingbeat.pitch_mean": lambda v: PIGEON.with_values({"wingbeat.pitch_mean": v}),
    "bounds.flap_amplitude": lambda v: problem(bounds={"flap_amplitude": (0.1, v)}),
    "bounds.flap": lambda v: problem(bounds={"flap": (-1.0, v)}),
    "bounds.body_pitch": lambda v: problem(bounds={"body_pitch": (-1.0, v)}),
    "flap_amplitude": lambda v: problem(subject_to=[f"flap_amplitude<={v!r}"]),
    "constraint.limit": lambda v: problem(subject_to=[f"body_pitch_range<={v!r}"]),
    "initial_state.body_pitch": start,
    "flap": lambda v: wb.glide_polar(PIGEON, angles_of_attack=[0.1], flap=v),
    "coordinates[3]": lambda v: wb.simulate_torque_driven(
        MODEL, PIGEON.wingbeat, [0.0, 0.0, 0.1, v, 0.2], [10.0, 0, 0, 0, 0], lambda *_: np.zeros(2), [0.0, 0.01]
    ),
}


@pytest.mark.parametrize("where", ANGLES)
def test_an_angle_above_pi_is_taken_for_degrees(where):
    with pytest.raises(wb.InvalidInputError) as refused:
        ANGLES[where](70.0)
    (fault,) = refused.value.faults
    assert fault.where == where
    assert fault.rule == "must be an angle in radians, from -pi to pi"
    assert "70 seems to be in degrees: write " in fault.fix


def test_what_is_no_angle_and_whole_turns_of_a_phase_are_good():
    assert problem(bounds={"frequency": (2.0, 70.0)}).bounds["frequency"] == (2.0, 70.0)
    assert wb.Wingbeat(6.0, 0.0, math.pi, 0.1, 0.3, pitch_phase=1.5 * math.pi).pitch_phase > math.pi
    assert wb.Constraint("peak_power", 300.0).limit == 300.0
    turns = wb.Quantity("turns", lambda beat: beat.flap, unit="rad")  # a user's own may be a sum of angles
    assert wb.Constraint(turns, 20.0).limit == 20.0
    with pytest.raises(wb.InvalidInputError, match="must be a phase in radians, from -2 pi to 2 pi; 90 seems"):
        wb.Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3, pitch_phase=90.0)


@pytest.mark.parametrize("text", ["flap_amplitude<=70", "body_pitch_range<=10"])
def test_the_advice_on_a_limit_can_be_followed(text, capsys):
    assert main(["orbit", "pigeon", "--speed", "10", "--subject-to", text]) == 2
    assert f"write '{text} deg'" in capsys.readouterr().err
    assert problem(subject_to=[f"{text} deg"]).free


def test_a_species_file_says_how_to_write_degrees(tmp_path, capsys):
    file = tmp_path / "mine.toml"
    file.write_text(MINIMAL.replace("flap_mean = 0", "flap_mean = 40"))
    assert main(["species", str(file)]) == 2
    assert "40 seems to be in degrees: write np.radians(40), or flap_mean_deg" in capsys.readouterr().err
    with pytest.raises(
        wb.InvalidInputError, match=r"flap_mean_deg = 400.*must be an angle from -180 to 180 degrees"
    ):
        PIGEON.with_values({"wingbeat.flap_mean_deg": 400.0})


@pytest.mark.parametrize(
    "limits",
    [
        ["peak_power<=30", "peak_power<=30"],
        ["peak_power<=30", "peak_power<=30.0"],
        ["peak_power<=40", wb.Constraint("peak_power", 30.0), "peak_power<=31"],
    ],
)
def test_of_two_limits_on_one_side_the_tighter_counts_once(limits):
    assert [str(one) for one in problem(subject_to=limits).subject_to] == ["peak_power<=30"]


def test_limits_of_parameters_count_once_in_any_order():
    for limits in (["flap_amplitude<=1", "flap_amplitude<=1.1"], ["flap_amplitude<=1.1", "flap_amplitude<=1.0"]):
        assert problem(subject_to=limits).bounds["flap_amplitude"][1] == 1.0
    assert "flap_mean" not in problem(subject_to=["flap_mean=0.1", "flap_mean=0.10"]).free


@pytest.mark.parametrize(
    ("limits", "words"),
    [
        (["peak_power<=30", "peak_power>=40"], "subject_to = 'peak_power>=40': contradicts peak_power<=30"),
        (["flap_amplitude>=0.5", "flap_amplitude<=0.4"], "contradicts flap_amplitude>=0.5"),
        (["flap_mean=0.1", "flap_mean=0.2"], "subject_to = 'flap_mean=0.2': is fixed at 0.1 too"),
    ],
)
def test_limits_that_contradict_each_other_are_refused(limits, words):
    with pytest.raises(wb.InvalidInputError, match=words):
        problem(subject_to=limits)
    both = [str(one) for one in problem(subject_to=["peak_power>=30", "peak_power<=30"]).subject_to]
    assert both == ["peak_power>=30", "peak_power<=30"]


GIVEN = (0.0, 1.0, 0.1, 10.0, 0.5, -0.2)


def test_a_state_may_be_six_numbers_in_order():
    expected = wb.simulate(MODEL, PIGEON.wingbeat, wb.State(*GIVEN), 1, 8).states
    kinds = [list(GIVEN), GIVEN, np.array(GIVEN), xr.DataArray(list(GIVEN), dims="state")]
    for state in kinds:
        np.testing.assert_array_equal(wb.simulate(MODEL, PIGEON.wingbeat, state, 1, 8).states, expected)
    onward = wb.simulate(MODEL, PIGEON.wingbeat, expected[-1], 1, 8)
    np.testing.assert_array_equal(onward.states[0], expected[-1])


@pytest.mark.parametrize("state", [GIVEN[:5], np.zeros((6, 1)), np.zeros(7), "123456", 10.0, None, {"u": 10.0}])
def test_what_is_no_state_is_refused_in_words(state):
    with pytest.raises(
        wb.InvalidInputError, match=r"must be a State or six numbers: x, z \[m\], body_pitch \[rad\]"
    ):
        wb.simulate(MODEL, PIGEON.wingbeat, state)


def test_a_limit_of_a_parameter_is_a_text_or_a_value():
    value = problem(subject_to=[WingbeatLimit("flap_amplitude", "<=", math.radians(50.0))])
    assert value == problem(subject_to=["flap_amplitude<=50 deg"])
