"""Orbits: the record and its definitions, what a seed fixes, the stroke-plane gauge, searches that must fail."""

import dataclasses
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.flight.time_series import flown_beat
from wingbeat.orbits.nlp.newton_kkt import correct
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.starts import start_point, structured_starts
from wingbeat.records.numbers import beat_mean
from wingbeat.records.tables import finite_or_none

# The orbit record of the specification: names, and those of its parts.
RECORD = {
    *("status", "message", "species", "vehicle", "aero", "air", "speed", "climb", "objective", "wingbeat"),
    "frequency_basis",
    *("objective_value", "constraints"),
    *("initial_state", "active_bounds", "closure", "optimality", "starts", "distinct_optima", "mean_power"),
    "starts_at_best",
    "plausibility",
    *("failed_balance", "relaxations"),
    *("peak_power", "mean_positive_power", "mean_actuator_power", "peak_actuator_power", "cost_of_transport"),
    *("body_pitch_range", "strouhal", "reduced_frequency", "reynolds", "alpha_quarter_span"),
    *(
        "alpha_three_quarter_span",
        "detached_share",
        "floquet_multipliers",
        "stable",
        "warnings",
        "solve_seconds",
        "version",
    ),
}
PARTS = {
    "vehicle": {"body", "wing"},
    "aero": {"coefficients", "extension", "blend_width_deg", "strips", "force_point", "airspeed"},
    "air": {"density", "viscosity", "gravity"},
    "wingbeat": {
        *("frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude", "span_retraction"),
        *("twist_ratio", "fold_amplitude", "wrist", "pitch_phase", "downstroke_fraction", "stroke_plane_tilt"),
        *("sweep_mean", "sweep_amplitude", "sweep_phase", "flap_harmonics", "pitch_harmonics", "span_harmonics"),
    },
    "initial_state": {"x", "z", "body_pitch", "u", "w", "pitch_rate"},
    "closure": {"x", "z", "body_pitch", "u", "w", "pitch_rate"},
}
WING = {"semi_span", "chord", "mass", "mass_exponent", "shoulder", "stroke_plane_angle"}


def leaves(value):
    if isinstance(value, dict):
        return [leaf for item in value.values() for leaf in leaves(item)]
    return [leaf for item in value for leaf in leaves(item)] if isinstance(value, list) else [value]


def test_the_record_has_the_names_of_the_specification(solved):
    record = solved.orbit.record()
    assert record.keys() == RECORD
    assert {name: record[name].keys() for name in PARTS} == PARTS
    assert record["vehicle"]["body"].keys() == {"mass", "pitch_inertia", "drag_area", "crossflow_area"}
    assert record["vehicle"]["wing"].keys() == WING


def test_the_record_is_json_without_nan(solved):
    record = solved.orbit.record()
    text = json.dumps(record, allow_nan=False)
    assert json.loads(text) == record
    open_ends = record.pop("plausibility")  # a range may have one end alone
    assert {type(leaf) for leaf in leaves(record)} <= {str, float, int, bool}
    assert {type(leaf) for leaf in leaves(open_ends)} <= {str, float, int, bool, type(None)}
    with pytest.raises(ValueError, match="not JSON compliant"):
        json.dumps(record | {"reynolds": math.nan}, allow_nan=False)


def test_the_record_is_a_copy(bat_orbit):
    record = bat_orbit.orbit.record()
    record["wingbeat"]["frequency"] = -1.0
    record["warnings"].append("mine")
    assert bat_orbit.orbit.record()["wingbeat"]["frequency"] > 0
    assert "mine" not in bat_orbit.orbit.record()["warnings"]


def test_numbers_of_the_record_by_their_definitions(solved):
    r, series = solved.orbit.record(), solved.orbit.dataset
    wing, beat, speed = r["vehicle"]["wing"], r["wingbeat"], r["speed"]
    mass = r["vehicle"]["body"]["mass"] + 2 * wing["mass"]
    hinge, actuator = series["hinge_power"].values, series["actuator_power"].values

    def mean(values):
        return np.mean(values[:-1])  # equal samples, both ends of the beat the same

    # The positive part of straight lines between the samples, each cut in 500.
    fine = np.interp(np.linspace(0, 1, 256 * 500 + 1), series["phase"].values, hinge)
    positive = mean(np.maximum(fine, 0))

    found = {
        "strouhal": 2 * beat["frequency"] * wing["semi_span"] * math.sin(beat["flap_amplitude"]) / speed,
        "reduced_frequency": math.pi * beat["frequency"] * wing["chord"] / speed,
        "reynolds": speed * wing["chord"] / r["air"]["viscosity"],
        "mean_power": mean(hinge),
        "peak_power": hinge.max(),
        "mean_positive_power": positive,
        "mean_actuator_power": mean(actuator),
        "peak_actuator_power": actuator.max(),
        "cost_of_transport": positive / (mass * r["air"]["gravity"] * speed),
        "body_pitch_range": np.ptp(series["body_pitch"].values),
    }
    assert {name: r[name] for name in found} == pytest.approx(found, rel=1e-6)
    # The torques times the rates of the angles are the hinge power.
    torques = series["flap_torque"] * series["flap_rate"] + series["pitch_torque"] * series["wing_pitch_rate"]
    np.testing.assert_allclose(torques, hinge, rtol=0, atol=1e-12 * hinge.max())
    assert mass == pytest.approx(solved.problem.species.vehicle.mass)
    for name, at in (("alpha_quarter_span", 0.25), ("alpha_three_quarter_span", 0.75)):
        alpha = series["alpha"].interp(station=at)
        assert r[name] == pytest.approx([float(alpha.min()), float(alpha.max())], rel=1e-12)


def test_the_record_says_how_the_orbit_was_certified(solved):
    r = solved.orbit.record()
    assert r["status"] == "converged"
    assert max(abs(miss) for miss in r["closure"].values()) <= 1e-6
    assert 0 <= r["optimality"] <= 1e-5
    assert 1 <= r["distinct_optima"] <= r["starts"] == 2
    assert 1 <= r["starts_at_best"] <= r["starts"] + 1 - r["distinct_optima"]
    assert np.shape(r["floquet_multipliers"]) == (4, 2)
    modulus = np.hypot(*np.transpose(r["floquet_multipliers"]))
    assert r["stable"] is bool(modulus.max() < 1)
    assert (np.diff(modulus) <= 1e-8).all()  # largest first
    # Every bound is kept, and those that are met are named.
    for name, (low, high) in solved.problem.bounds.items():
        if name in solved.problem.free:
            value = r["wingbeat"][name]
            assert low <= value <= high
            assert (name in r["active_bounds"]) is (min(value - low, high - value) <= 1e-6 * (high - low))
    low, high = solved.problem.bounds["body_pitch"]
    assert (
        low - 1e-6 <= solved.certificate.states[:, 2].min() <= solved.certificate.states[:, 2].max() <= high + 1e-6
    )
    assert solved.orbit.initial_state == wb.State(**r["initial_state"])
    assert solved.orbit.wingbeat == wb.Wingbeat(**r["wingbeat"])


def test_hover_has_no_cost_of_transport_but_null():
    """What is divided by the speed has no value in hover; nor has anything of a flight that ran off."""
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=0.0, aero=wb.aero.Dickinson())
    orbit = wb.solve_orbit(problem, starts=1)
    record = orbit.record()
    for name in ("cost_of_transport", "strouhal", "reduced_frequency", "reynolds"):
        assert record[name] is None
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    assert any("understates power" in warning for warning in record["warnings"])


def test_finite_or_none_and_mean():
    ragged = {"a": [1.0, math.nan, (math.inf, 2)], "b": {"c": -math.inf}, "d": True, "e": "nan"}
    assert finite_or_none(ragged) == {"a": [1.0, None, [None, 2]], "b": {"c": None}, "d": True, "e": "nan"}
    assert beat_mean(np.array([0.0, 1.0, 0.0])) == 0.5


def test_the_same_seed_starts_at_the_same_points_and_another_does_not():
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    given = structured_starts(problem)
    random = len(given)
    first, again, other = (start_point(problem, random, seed) for seed in (0, 0, 1))
    np.testing.assert_array_equal(first, again)
    assert not np.isclose(first, other).any()
    for index, start in enumerate(given):
        np.testing.assert_array_equal(start, start_point(problem, index, 1))
    unknowns = problem.unknowns()
    for index in range(50):
        point = start_point(problem, index, 3)
        assert (point >= unknowns.lower).all()
        assert (point <= unknowns.upper).all()


def test_another_seed_is_another_search(bat_orbit):
    """It may end elsewhere; whatever it finds is certified as well."""
    orbit = wb.solve_orbit(bat_orbit.problem, starts=2, seed=7)
    assert orbit.status is wb.Status.CONVERGED
    assert max(abs(miss) for miss in orbit.record()["closure"].values()) <= 1e-6
    assert orbit.inputs["seed"] == 7


def tilt(species, angle):
    wing = dataclasses.replace(species.vehicle.wing, stroke_plane_angle=math.pi / 2 + angle)
    return dataclasses.replace(species, vehicle=dataclasses.replace(species.vehicle, wing=wing))


def test_a_tilted_stroke_plane_has_the_same_orbit(solved):
    """Solved again from where the gauge says it is, the frequency stays and the body pitch follows."""
    delta = math.radians(-5.0)
    problem = dataclasses.replace(solved.problem, species=tilt(solved.problem.species, delta))
    programme = Transcription(problem)
    unknowns = np.array([*solved.start[2:], *(getattr(solved.wingbeat, name) for name in problem.free)])
    unknowns[0] += delta
    scaled, _ = programme.optimise(programme.scaled(unknowns), 60, 1e-6)
    found = correct(programme, scaled)
    assert np.abs(found.residual).max() <= 1e-6
    assert found.wingbeat.frequency == pytest.approx(solved.wingbeat.frequency, rel=1e-8)
    assert found.certificate.states[0, 2] == pytest.approx(solved.start[2] + delta, abs=1e-4)


def test_solve_orbit_finds_the_same_frequency_in_a_tilted_stroke_plane(pigeon_orbit):
    problem = dataclasses.replace(pigeon_orbit.problem, species=tilt(pigeon_orbit.problem.species, -0.09))
    orbit = wb.solve_orbit(problem, starts=2)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    assert orbit.wingbeat.frequency == pytest.approx(pigeon_orbit.wingbeat.frequency, rel=1e-8)


def test_an_orbit_that_cannot_be_is_infeasible_and_says_what_fails():
    """A bat that flaps by no more than 6 degrees falls: data, not an exception."""
    # It is told that some change flies; how small that may be is asked in test_infeasible.py.
    few = wb.SolverOptions(
        search=wb.SearchOptions(most_starts=2),
        diagnosis=wb.DiagnosisOptions(far_iterations=15, back_iterations=10, back_times=1, reported=1),
    )
    bounds = {"flap_amplitude": (math.radians(5), math.radians(6))}
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=8.0, aero=wb.aero.Dickinson(), bounds=bounds)
    orbit = wb.solve_orbit(problem, starts=1, options=few)
    record = orbit.record()
    assert orbit.status is wb.Status.INFEASIBLE
    assert record["status"] == "infeasible"
    assert record["starts"] == 2
    assert record["distinct_optima"] == 0
    assert record["stable"] is None
    assert "flap_amplitude" in record["active_bounds"]
    assert "thrust is short of drag by" in orbit.message
    assert record["failed_balance"][0]["law"] == "thrust"
    assert orbit.relaxations[0].text in orbit.message
    assert max(abs(miss) for miss in record["closure"].values()) > 1e-3
    assert json.loads(json.dumps(record, allow_nan=False)) == record


def test_a_beat_is_what_the_data_set_says_and_the_record_is_read_off_it(solved):
    """Beat and data set are made of different sums: tables by phase here, the points of the wing there."""
    states, phase = solved.certificate.states, solved.certificate.phase
    beat = flown_beat(solved.model, solved.wingbeat, phase, states[:, 2:], (solved.problem.speed, 0.0))
    series, record = solved.orbit.dataset, solved.orbit.record()
    names = [name for name in beat._fields if name in series]
    numbers = {"frequency", "speed", "climb", "weight", "semi_span", "mass", "flap_amplitude", "drive"}
    assert set(beat._fields) - set(names) == numbers
    for name in names:
        wanted = series[name].values
        assert np.abs(getattr(beat, name) - wanted).max() <= 1e-9 * np.abs(wanted).max(), name
    for middle, name in (("", "hinge_power"), ("actuator_", "actuator_power")):
        power = series[name].values
        assert record[f"mean_{middle}power"] == pytest.approx(np.trapezoid(power, phase), rel=1e-9)
        assert record[f"peak_{middle}power"] == pytest.approx(power.max(), rel=1e-9)
    for name, strip in (("alpha_quarter_span", 2), ("alpha_three_quarter_span", 7)):
        alpha = series["alpha"].values[:, strip]
        assert record[name] == pytest.approx([alpha.min(), alpha.max()], rel=1e-9)
    reynolds = series["strip_reynolds"].values
    told = f"it runs from {reynolds.min():.0f} to {reynolds.max():.0f}"
    assert any(told in note for note in record["warnings"])
