"""Inputs from beat to beat leave the wing where it is at the top of the stroke, and as fast."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import (
    flap_angle,
    parameter,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
    with_parameters,
)
from wingbeat.stability.gust_flights import fly_gust, fly_pushes
from wingbeat.stability.inputs import compensation, smooth_ones

STOCK = ("frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")
BEATS = {
    "plain": {},
    "uneven": {"downstroke_fraction": 0.4},
    "leading": {"pitch_phase": 0.3},
    "retracting": {"span_retraction": 0.3},
    "twisted": {"twist_ratio": 1.4, "twist_mean": 0.1},
}
# Further inputs, of laws that are on and off.
MORE = {
    "plain": ("twist_ratio", "sweep_amplitude"),
    "uneven": ("downstroke_fraction",),
    "leading": ("pitch_phase",),
    "retracting": ("span_retraction", "span_sin_2"),
    "twisted": ("twist_mean", "pitch_cos_2"),
}


def tip(beat, phase):
    """Return the pitch at the tip."""
    return beat.twist_ratio * pitch_angle(beat, phase) + (tip_twist(beat, phase) or 0.0)


def at_top(beat):
    """Return the laws at the top of the stroke, and their rates by differences over time."""
    step = 1e-6
    laws = (flap_angle, pitch_angle, span_ratio, tip, lambda wingbeat, at: sweep_angle(wingbeat, at) or 0.0)
    place = [float(law(beat, 0.0)) for law in laws]
    rate = [beat.frequency * float(law(beat, step) - law(beat, -step)) / (2 * step) for law in laws]
    return np.array([*place, *rate])


@pytest.mark.parametrize("kind", BEATS)
def test_changed_inputs_keep_the_wing_where_it_is(kind):
    beat = with_parameters(wb.load_species("pigeon").wingbeat, BEATS[kind])
    inputs = (*STOCK, *MORE.get(kind, ()))
    found = compensation(beat, inputs)
    names = (*inputs, *found.names)
    numbers = np.array([parameter(beat, name) for name in names])
    for column, name in enumerate(inputs):
        step = 1e-4
        change = step * np.concatenate([np.eye(len(inputs))[column], found.shares[:, column]])
        changed = with_parameters(beat, dict(zip(names, (numbers + change).tolist(), strict=True)))
        assert np.abs(at_top(changed) - at_top(beat)).max() < 2e-6, name  # to first order in 1e-4
        alone = with_parameters(beat, {name: float(numbers[column] + step)})
        assert np.abs(at_top(alone) - at_top(beat)).max() > 2e-5, name


def test_each_stock_input_has_few_harmonics():
    beat = wb.Wingbeat(9.0, 0.1, 0.8, 0.1, 0.3)
    found = compensation(beat, STOCK)
    assert found.names == ("flap_cos_2", "pitch_cos_2", "pitch_sin_2")
    shares = dict(zip(STOCK, found.shares.T, strict=True))
    assert np.allclose(shares["flap_mean"], [-1, 0, 0], atol=1e-12)
    assert np.allclose(shares["flap_amplitude"], [-1, 0, 0], atol=1e-12)
    assert np.allclose(shares["pitch_mean"], [0, -1, 0], atol=1e-12)
    assert np.allclose(shares["pitch_amplitude"], [0, 0, 0.5], atol=1e-12)
    assert np.allclose(shares["frequency"], [0, 0, beat.pitch_amplitude / (2 * beat.frequency)], atol=1e-12)


def test_an_input_that_is_a_harmonic_takes_the_next_order():
    beat = wb.load_species("pigeon").wingbeat
    assert compensation(beat, ("pitch_cos_2", "flap_mean")).names == ("flap_cos_2", "pitch_cos_3")
    every = [f"pitch_cos_{order}" for order in range(2, 9)]
    with pytest.raises(wb.InvalidInputError, match="contain all orders of the pitch harmonics"):
        compensation(beat, every)


def test_what_no_harmonic_can_undo_is_refused():
    beat = with_parameters(wb.load_species("pigeon").wingbeat, {"fold_amplitude": 0.3})
    assert smooth_ones(beat, ("frequency", "flap_mean", "stroke_plane_tilt")) == ("flap_mean",)
    assert smooth_ones(beat, ()) == ()
    assert compensation(beat, ()).shares.shape == (0, 0)
    with pytest.raises(wb.InvalidInputError, match="makes the fold jump"):
        compensation(beat, ("frequency",))
    with pytest.raises(wb.InvalidInputError, match="makes the stroke plane jump"):
        compensation(beat, ("stroke_plane_tilt",))


def test_a_law_without_mass_or_motion_at_the_top_needs_nothing():
    beat = with_parameters(wb.load_species("pigeon").wingbeat, {"chord_retraction": 0.2})
    found = compensation(beat, ("chord_retraction",))
    assert found.names == ()
    assert found.shares.shape == (0, 1)


def test_what_knows_four_states_refuses_an_orbit_with_the_lag_of_the_wake(pigeon_orbit):
    """The door asks for the air loads alone, so any record that says converged will do."""
    problem = dataclasses.replace(
        pigeon_orbit.problem, aero=wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil", wake="jones-section")
    )
    lagged = wb.Orbit.of_record(pigeon_orbit.orbit.record(), problem, starts=1)
    doors = [
        lambda: wb.linearise(lagged),
        lambda: wb.feedback(lagged),
        lambda: wb.feedback_in_beat(lagged),
        lambda: wb.manoeuvre(lagged, [11.0]),
        lambda: wb.simulate_many(lagged, [(0.0, 0.0)]),
        lambda: wb.survey_gusts(lagged, flights=2),
        lambda: fly_pushes(lagged),
    ]
    for door in doors:
        with pytest.raises(wb.InvalidInputError, match=r"aero.wake.*stability does not know; solve"):
            door()
    with pytest.raises(wb.InvalidInputError, match="leave the wake out here"):
        fly_gust(lagged, (0.0, 0.0), beats=1)
