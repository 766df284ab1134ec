"""Wingbeats richer than the paper's: what is off changes nothing, what is on can be free with exact derivatives."""

import dataclasses
import json
import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers.differences import differences, miss
from tests.helpers.models import changed
from tests.helpers.programs import compiled
from wingbeat._base import HARMONIC_NAMES
from wingbeat._jax.arrays import jax
from wingbeat.animal.kinematics import (
    FREE_NAMES,
    chord_ratio,
    flap_angle,
    parameter,
    pitch_angle,
    span_ratio,
    stroke_phase,
    sweep_angle,
    tip_twist,
    unpack,
    with_parameters,
)
from wingbeat.animal.species.reading import template
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.wing_points import strip_corners
from wingbeat.mechanics.wing_shape import lateral_corners
from wingbeat.orbits.flight.period import flier
from wingbeat.records.flight_dataset import evaluate

PLAIN = wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, 0.3, 1.6, 0.4, 0.45)
OFF = {
    **dict.fromkeys(("pitch_phase", "sweep_mean", "sweep_amplitude", "sweep_phase", "stroke_plane_tilt"), 0.0),
    **dict.fromkeys(("chord_retraction", "twist_mean"), 0.0),
    "downstroke_fraction": 0.5,
}
NEW = {
    "pitch_phase": 0.3,
    "downstroke_fraction": 0.42,
    "sweep_mean": 0.1,
    "sweep_amplitude": 0.2,
    "sweep_phase": -0.4,
    "stroke_plane_tilt": 0.2,
    "flap_cos_2": 0.05,
    "flap_sin_3": -0.03,
    "pitch_cos_3": 0.04,
    "pitch_sin_2": -0.06,
    "span_cos_1": 0.02,
    "span_sin_2": -0.03,
    "chord_retraction": 0.2,
    "chord_cos_1": 0.05,
    "chord_sin_2": -0.08,
    "twist_mean": -0.1,
    "twist_sin_1": -0.2,
    "twist_cos_2": 0.05,
    "sweep_sin_2": 0.04,
}
RICH = with_parameters(PLAIN, NEW)
PHASES = np.linspace(-0.5, 2.0, 41)
table = compiled(motion_table)


def model_of(name, **settings):
    animal = wb.load_species(name).with_values({"wing.shoulder": [0.02, 0.01, 0.01], **settings})
    return wb.FlightModel(animal.vehicle, wb.aero.BladeElement(wb.aero.SuFan(), 4))


def test_what_is_off_is_no_part_of_a_program():
    leaves, tree = jax.tree.flatten(PLAIN)
    assert len(leaves) == 9
    assert jax.tree.unflatten(tree, leaves) == PLAIN
    assert len(jax.tree.leaves(RICH)) == 9 + 8 + 4 + 4 + 4 + 2 + 4 + 4


@pytest.mark.slow
def test_laws_that_are_on_but_add_nothing_leave_the_wing_where_it_was():
    """The programs differ, so their answers may differ by rounding."""
    waves = "flap_cos_2", "flap_sin_3", "pitch_sin_2", "span_cos_1", "sweep_cos_2", "chord_sin_1", "twist_cos_1"
    free, values = (*OFF, *waves), np.array([*OFF.values(), *[0.0] * len(waves)])
    model = model_of("bat")
    on = compiled(lambda values: motion_table(model, unpack(free, PLAIN, values), PHASES))(values)
    off = table(model, PLAIN, PHASES)
    assert off.unpitched is off.sweeping_speed is off.tilt is None
    assert np.all(on.unpitched[0] == 1.0)
    for name in (field for field in off._fields if getattr(off, field) is not None):
        for one, other in zip(jax.tree.leaves(getattr(on, name)), jax.tree.leaves(getattr(off, name)), strict=True):
            one = one[:1] if name == "ahead" else one
            np.testing.assert_allclose(
                one, np.broadcast_to(other, np.shape(one)), rtol=1e-11, atol=1e-10, err_msg=name
            )


ANGLE = st.floats(-1.0, 1.0)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(
    ANGLE,
    st.floats(0.0, 1.2),
    ANGLE,
    st.floats(0.0, 1.0),
    st.floats(0.0, 0.6),
    st.floats(-2.0, 2.0),
    st.integers(1, 7),
)
def test_harmonics_of_nothing_change_no_digit(flap_mean, flap, pitch_mean, pitch, retraction, phase, orders):
    plain = wb.Wingbeat(8.0, flap_mean, flap, pitch_mean, pitch, retraction)
    nothing = {f"{law}_harmonics": (0.0, 0.0) * orders for law in ("flap", "pitch", "span")}
    for law in (flap_angle, pitch_angle, span_ratio):
        assert float(law(dataclasses.replace(plain, **nothing), phase)) == float(law(plain, phase))


@settings(max_examples=40, deadline=None)
@given(st.floats(0.05, 0.95), st.floats(-2.0, 2.0))
@example(0.5, 0.3)
def test_a_downstroke_of_any_length_ends_at_the_bottom(fraction, phase):
    beat = dataclasses.replace(PLAIN, downstroke_fraction=fraction)

    def at(where):
        return float(stroke_phase(beat, where))

    assert at(0.0) == pytest.approx(0.0, abs=1e-14)
    assert at(fraction) == pytest.approx(0.5, abs=1e-14)
    assert at(phase + 1.0) == pytest.approx(at(phase) + 1.0, abs=1e-12)
    assert at(phase + 1e-3) > at(phase)
    assert float(flap_angle(beat, fraction)) == pytest.approx(beat.flap_mean - beat.flap_amplitude, abs=1e-13)


def test_harmonics_and_phases_are_those_of_their_names():
    turn = 2 * math.pi * PHASES
    beat = dataclasses.replace(RICH, downstroke_fraction=0.5)
    flap = 0.15 + 0.85 * np.cos(turn) + 0.05 * np.cos(2 * turn) - 0.03 * np.sin(3 * turn)
    pitch = 0.2 - 0.5 * np.sin(turn + 0.3) - 0.06 * np.sin(2 * turn) + 0.04 * np.cos(3 * turn)
    span = 1 - 0.15 * (1 - np.sin(turn)) + 0.02 * np.cos(turn) - 0.03 * np.sin(2 * turn)
    for law, wanted in ((flap_angle, flap), (pitch_angle, pitch), (span_ratio, span)):
        np.testing.assert_allclose(law(beat, PHASES), wanted, atol=1e-14)
    sweep = 0.1 + 0.2 * np.sin(turn - 0.4) + 0.04 * np.sin(2 * turn)
    chord = 1 - 0.1 * (1 - np.sin(turn)) + 0.05 * np.cos(turn) - 0.08 * np.sin(2 * turn)
    twist = -0.1 - 0.2 * np.sin(turn) + 0.05 * np.cos(2 * turn)
    for law, wanted in ((sweep_angle, sweep), (chord_ratio, chord), (tip_twist, twist)):
        np.testing.assert_allclose(law(beat, PHASES), wanted, atol=1e-14)
    assert chord_ratio(PLAIN, PHASES) is tip_twist(PLAIN, PHASES) is sweep_angle(PLAIN, PHASES) is None


def test_a_chord_law_moves_the_trailing_and_the_leading_edge_and_no_mass():
    """Area, corners and pressure offset take the chord of the moment; quarter chords and masses stay."""
    model, chord = model_of("bat"), {"chord_retraction": 0.4, "chord_harmonics": (0.1, -0.05)}
    lost = dataclasses.replace(PLAIN, **chord)
    states = wb.State(*np.zeros((6, PHASES.size)))
    found, plain = table(model, lost, PHASES), table(model, PLAIN, PHASES)
    ratio = np.asarray(chord_ratio(lost, PHASES))
    np.testing.assert_allclose(found.area, plain.area * ratio, rtol=1e-13)
    for name in ("ahead", "above", "first_moment", "inertia", "acceleration_moment", "flapping_speed"):
        np.testing.assert_allclose(getattr(found, name), getattr(plain, name), rtol=1e-9, atol=1e-11)
    here, there = (np.asarray(strip_corners(model, beat, states, PHASES)) for beat in (lost, PLAIN))
    leading, trailing = here[:, :, 0], here[:, :, 3]
    np.testing.assert_allclose(
        np.linalg.norm(leading - trailing, axis=-1),
        np.linalg.norm(there[:, :, 0] - there[:, :, 3], axis=-1) * ratio[:, None],
        rtol=1e-12,
    )
    np.testing.assert_allclose(
        0.75 * leading + 0.25 * trailing, 0.75 * there[:, :, 0] + 0.25 * there[:, :, 3], atol=1e-14
    )
    sides = np.concatenate(lateral_corners(model.vehicle, lost, PHASES, count=4))
    wanted = np.concatenate([here[:, :, corner, 1] for corner in (0, 1, 3, 2)], axis=1).T
    np.testing.assert_allclose(sides, wanted, atol=1e-14)


@pytest.mark.slow
def test_end_of_a_period_by_every_new_parameter():
    model = model_of("bat", **{"wing.stroke_plane_angle_deg": 75.0})
    fly, start = flier(model, PLAIN, tuple(NEW)), np.array([0.3, 6.0, 0.5, 1.0])
    values = np.array(list(NEW.values()))
    found = fly(values, start)
    # So small a step that few strips cross the joins of a blend, where only two derivatives go on.
    wanted = differences(lambda at: np.asarray(fly(at, start).end), values, 2e-6)
    assert found.end_jacobian.shape == (6, 4 + values.size)
    assert np.all(np.abs(wanted).max(axis=0) > 1e-5)
    assert miss(np.asarray(found.end_jacobian)[:, 4:], wanted) <= 1e-7


@pytest.mark.slow
def test_the_richer_the_wingbeat_may_be_the_less_its_optimum(pigeon_orbit):
    """From the same start, what is free in addition can only lower the least frequency."""
    pigeon = wb.load_species("pigeon")
    bounds = {"downstroke_fraction": (0.35, 0.65), "pitch_phase": (-0.6, 0.6)}
    rich = wb.OrbitProblem(pigeon, speed=10.0, free=(*pigeon.free, *bounds), bounds=bounds)
    orbit = wb.solve_orbit(rich, starts=1)
    assert orbit.status is wb.Status.CONVERGED
    assert orbit.wingbeat.frequency < pigeon_orbit.wingbeat.frequency
    record = json.loads(json.dumps(orbit.record(), allow_nan=False))
    assert wb.Wingbeat(**record["wingbeat"]) == orbit.wingbeat
    assert orbit.problem.free == rich.free


def test_a_stroke_plane_is_free_only_where_it_matters():
    pigeon = wb.load_species("pigeon")
    asked = {
        "speed": 10.0,
        "free": (*pigeon.free, "stroke_plane_tilt"),
        "bounds": {"stroke_plane_tilt": (-0.5, 0.5)},
    }
    with pytest.raises(wb.InvalidInputError, match="changes only the body's pitch"):
        wb.OrbitProblem(pigeon, **asked)
    slender = pigeon.with_values({"body.crossflow_area": 0.008})  # its drag depends on the body's attitude
    for counts in (pigeon.with_alternative("shoulder"), slender):
        assert "stroke_plane_tilt" in wb.OrbitProblem(counts, **asked).free


def test_tilting_the_stroke_plane_is_turning_the_wing():
    model = changed(model_of("bat"), strips=10)  # as orbits have, whose program is there
    wing = dataclasses.replace(model.vehicle.wing, stroke_plane_angle=model.vehicle.wing.stroke_plane_angle + 0.3)
    turned = changed(model, vehicle=dataclasses.replace(model.vehicle, wing=wing))
    tilted = dataclasses.replace(PLAIN, stroke_plane_tilt=0.3)
    state = wb.State(0.0, 0.0, 0.2, 8.0, 0.5, 1.0)
    phases = np.array([0.1, 0.6])
    states = np.tile(state, (2, 1))
    found, wanted = evaluate(model, tilted, phases, states), evaluate(turned, PLAIN, phases, states)
    for name in ("acceleration", "strip_position", "hinge_power", "air_force"):
        np.testing.assert_allclose(getattr(found, name), getattr(wanted, name), rtol=1e-11, atol=1e-11)


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"downstroke_fraction": 1.0}, "must be > 0 and < 1"),
        ({"downstroke_fraction": float("nan")}, "finite"),
        ({"sweep_mean": 1.0, "sweep_amplitude": 0.6}, "right angle"),
        ({"sweep_amplitude": -0.1}, "must be >= 0"),
        ({"flap_harmonics": (0.1,)}, "pairs"),
        ({"flap_harmonics": 0.1}, "a list of numbers"),
        ({"pitch_harmonics": (0.01,) * 16}, "up to order 8"),
        ({"pitch_harmonics": (0.01, "x")}, "must be a number"),
        ({"span_harmonics": (0.0, 0.9)}, "makes the span vanish"),
        ({"chord_harmonics": (0.0, 1.1)}, "makes the chord vanish"),
        ({"chord_retraction": 1.0}, "must be >= 0 and < 1"),
        ({"twist_mean": float("inf")}, "finite"),
        ({"sweep_mean": 1.0, "sweep_harmonics": (0.6, 0.0)}, "right angle"),
    ],
)
def test_what_no_wing_can_do_is_refused(change, rule):
    with pytest.raises(wb.InvalidInputError, match=rule):
        dataclasses.replace(PLAIN, **change)


def test_every_parameter_has_a_name_to_be_free_by():
    assert len(set(FREE_NAMES)) == len(FREE_NAMES)
    for i, name in enumerate(HARMONIC_NAMES):
        beat = with_parameters(wb.Wingbeat(8.0, 0.0, 0.8, 0.2, 0.5), {name: 0.01 * (i + 1)})
        assert parameter(beat, name) == 0.01 * (i + 1)
        assert [n for n in HARMONIC_NAMES if parameter(beat, n)] == [name]


def test_a_species_file_sets_and_frees_them(tmp_path):
    text = template().replace("# flap_harmonics_deg = { value = []", "flap_harmonics_deg = { value = [3.0, -1.0]")
    text = text.replace("# downstroke_fraction", "downstroke_fraction")
    text = text.replace("[free]\n", "[free]\ndownstroke_fraction = [0.4, 0.6]\nflap_cos_2_deg = [-5.0, 5.0]\n")
    path = tmp_path / "own.toml"
    path.write_text(text)
    own = wb.load_species(path)
    assert own.wingbeat.flap_harmonics == pytest.approx(np.radians([3.0, -1.0]))
    assert own.bounds["flap_cos_2"] == pytest.approx(np.radians([-5.0, 5.0]))
    assert own.warnings == ()
    changed = own.with_values({"wingbeat.downstroke_fraction": 0.45, "wingbeat.pitch_harmonics_deg": [1, 2]})
    assert (changed.wingbeat.downstroke_fraction, len(changed.wingbeat.pitch_harmonics)) == (0.45, 2)
    narrow = dataclasses.replace(own, bounds=own.bounds | {"flap_cos_2": (0.1, 0.2)})
    assert any("flap_cos_2 = 3 deg is outside its bounds" in w for w in narrow.with_values({}).warnings)
