"""A number that a limit has set is no prediction: it is found in the record and marked wherever it is printed."""

from __future__ import annotations

import dataclasses
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.records.judgements import is_judgement, set_by_limit, statements
from wingbeat.records.orbit_record import plausibility
from wingbeat.words.curve_words import pareto_report
from wingbeat.words.orbit_words import limits_in_words, orbit_groups

BEAT = {"frequency": 10.4, "flap_amplitude": math.radians(24.49), "tail_tilt": math.radians(30)}


def _record(*active: str, **changes: Any) -> dict[str, Any]:
    return {
        "status": "converged",
        "active_bounds": list(active),
        "objective": "metabolic_power",
        "objective_value": 0.79,
        "wingbeat": BEAT,
        "initial_state": {"body_pitch": -0.5, "u": 8.0},
        "strouhal": 0.2,
        "reduced_frequency": 0.17,
    } | changes


@pytest.mark.parametrize(
    ("active", "objective", "own", "follows"),
    [
        ((), "frequency", set(), {}),
        (("tail_tilt",), "metabolic_power", {"tail_tilt"}, {}),
        (("frequency",), "frequency", {"frequency"}, {"reduced_frequency": ("frequency",)}),
        (("peak_power<=30",), "frequency", {"peak_power"}, {}),
        (
            ("flap_amplitude",),
            "frequency",
            {"flap_amplitude"},
            dict.fromkeys(("frequency", "strouhal", "reduced_frequency"), ("flap_amplitude",)),
        ),
        (("flap_amplitude",), "mean_power", {"flap_amplitude"}, {}),
        (
            ("flap",),
            "frequency",
            {"flap"},
            dict.fromkeys(("frequency", "flap_amplitude", "strouhal", "reduced_frequency"), ("flap",)),
        ),
        (
            ("frequency", "strouhal>=0.20004"),
            "metabolic_power",
            {"frequency", "strouhal"},
            {"flap_amplitude": ("frequency", "strouhal"), "reduced_frequency": ("frequency",)},
        ),
        (
            ("positive_power_per_mass<=114.977",),
            "frequency",
            {"positive_power_per_mass"},
            dict.fromkeys(("mean_positive_power", "cost_of_transport"), ("positive_power_per_mass",)),
        ),
    ],
)
def test_what_a_limit_sets_and_what_follows_from_it(
    active: tuple[str, ...], objective: str, own: set[str], follows: dict[str, tuple[str, ...]]
) -> None:
    found = set_by_limit(_record(*active, objective=objective))
    assert {name for name, what in found.items() if name in what.by} == own
    assert {name: what.by for name, what in found.items() if name not in what.by} == follows


def test_a_limit_has_the_value_that_the_reader_gave_it() -> None:
    """A limit that stands for a plausible range is a little inside it; its end is what the reader knows."""
    ends = [{"name": "strouhal", "low": 0.2, "high": 0.4, "unit": "1", "value": 0.20004, "within": True}]
    found = set_by_limit(_record("strouhal>=0.20004", "tail_tilt", "body_pitch", "u", plausibility=ends))
    limits = {name: what.limit for name, what in found.items()}
    assert limits == {"strouhal": 0.2, "tail_tilt": math.radians(30), "body_pitch": None, "u": 8.0}
    assert set_by_limit(_record("frequency", status="not_converged")) == {}


def test_headline_and_rows_say_what_is_set_by_a_limit() -> None:
    ends = {
        "unit": "Hz",
        "low": 5.6,
        "high": 10.4,
        "within": True,
        "source": "",
        "name": "frequency",
        "value": 10.4,
    }
    record = _record("frequency", "tail_tilt", "strouhal>=0.2", plausibility=[ends])
    assert limits_in_words(record) == (
        "frequency 10.4 Hz, tail tilt 30 deg, Strouhal number 0.2, and with them flap amplitude 24.49 deg"
    )
    groups = orbit_groups(record | {"speed": 8.0})
    rows = dict(groups["wingbeat"]) | dict(groups["flight"])
    assert rows["frequency"] == "10.4 Hz (set by the limit)"
    assert rows["flap amplitude"] == "24.49 deg (follows from the limits of frequency and Strouhal number)"
    assert rows["Strouhal number"] == "0.2 (set by the limit)"
    assert dict(groups["plausible ranges"])["frequency"] == "10.4 Hz (5.6 to 10.4 Hz, set by the limit)"
    least = _record("flap_amplitude", objective="frequency", objective_value=10.4)
    assert limits_in_words(least) == "flap amplitude 24.49 deg, and with it frequency 10.4 Hz"
    minimised = dict(orbit_groups(least)["certificate"])["minimised"]
    assert minimised == "frequency, 10.4 (follows from the limit of flap amplitude)"
    assert limits_in_words(_record()) == ""
    # Rounding of a parameter that is at a limit of zero is no number.
    still = _record("pitch_amplitude", "plane_of_symmetry")
    still["wingbeat"]["pitch_amplitude"] = 5.6e-18
    assert limits_in_words(still) == "wing pitch amplitude 0 deg, the wing's distance from the plane of symmetry"


def test_a_front_says_what_limits_have_set() -> None:
    numbers = {"objective_value": 6.8, "quantity_value": 20.0, "frequency": 6.8, "flap_amplitude": 1.2}
    more = {"limit": 20.0, "rise": 0.1, "mean_positive_power": 20.0, "dominated": False, "stable": True}
    point = {"active_bounds": ["mean_positive_power<=20.0", "flap_amplitude"], **numbers, **more}
    record = {"species": "pigeon", "speed": 8.0, "climb": 0.0, "objective": "frequency", "points": [point]}
    units = {"quantity": "mean_positive_power", "quantity_unit": "W", "objective_unit": "Hz"}
    (_, table) = pareto_report(record | units)
    (row,) = table.rows
    assert row.cells[-1].startswith("stable; set by limits: flap amplitude, frequency")


def _judged(problem: OrbitProblem, pitch_deg: float, **changes: Any) -> dict[str, dict[str, Any]]:
    """Return the judgement of a made-up beat, by name."""
    series = np.full(4, math.radians(pitch_deg))
    beat: Any = SimpleNamespace(force_x=series, force_z=series, weight=1.0, body_pitch=series, mean=np.mean)
    numbers = dict.fromkeys(("mean_positive_power", "body_pitch_range", "reynolds"), 0.01)
    record = _record() | numbers | {"peak_activation": 0.5} | changes
    return {one["name"]: one for one in plausibility(problem, beat, record)}


def test_activation_body_pitch_and_tail_tilt_are_judged() -> None:
    swift = wb.load_species("common-swift")
    problem = wb.models.animal(swift).problem(swift, 8.0)
    good = _judged(problem, -9.0)
    bad = _judged(problem, -30.0, peak_activation=1.2, wingbeat=BEAT | {"tail_tilt": 0.6})
    for name, high in (("peak_activation", 1.0), ("mean_body_pitch", math.radians(40)), ("tail_tilt", math.pi / 6)):
        assert good[name]["within"] is True, name
        assert bad[name]["within"] is False, name
        assert good[name]["high"] == pytest.approx(high)
        assert good[name]["source"]
    said = statements({"status": "converged", "closure": {"x": 0.0}, "plausibility": list(bad.values())}).plausible
    assert "peak activation 1.2 above 1;" in said
    assert "tail tilt 34.4 above 30 deg" in said
    assert "mean body pitch -30 below -10 deg" in said
    # Slow flight is steeper, and how much is not known; it does not count as within.
    assert _judged(problem.at_speed(4.0), -9.0)["mean_body_pitch"]["within"] is None
    # A rigid tail and a wing without muscle have nothing to judge.
    assert not {"peak_activation", "tail_tilt"} & _judged(wb.OrbitProblem(swift, 8.0), 0.0).keys()


def test_a_judgement_of_an_earlier_version_is_understood() -> None:
    """It lacks the activation, the mean body pitch and the tilt."""
    swift = wb.load_species("common-swift")
    judged = list(_judged(wb.models.animal(swift).problem(swift, 8.0), 0.0).values())
    new = ("peak_activation", "mean_body_pitch", "tail_tilt")
    old = [one for one in judged if one["name"] not in new]
    assert len(old) == len(judged) - len(new)
    assert is_judgement(old)
    assert is_judgement(judged)
    assert not is_judgement([judged[0] | {"name": "beauty"}])


def test_the_range_of_a_tilt_is_what_the_incidence_leaves() -> None:
    swift = wb.models.animal(wb.load_species("common-swift")).species(wb.load_species("common-swift"))
    turned = swift.with_values({"tail.incidence_deg": 10.0})
    for flown, ends in ((swift, [-30.0, 30.0]), (turned, [-40.0, 20.0])):
        known = flown.plausible_range("tail_tilt", 8.0)
        assert [math.degrees(end) for end in known[:2] if end is not None] == pytest.approx(ends)
    # The tail of a species file may have no range.
    bare = {name: number for name, number in swift.numbers.items() if name != "vehicle.tail.incidence"}
    assert dataclasses.replace(swift, numbers=bare).plausible_range("tail_tilt", 8.0)[:2] == (None, None)


def test_within_plausible_limits_activation_body_pitch_and_tilt() -> None:
    swift = wb.load_species("common-swift")
    problem = wb.models.animal(swift).problem(swift, 8.0, bounds="plausible")
    limits = {(c.quantity.name, c.at_most): c.limit for c in problem.subject_to}
    assert limits["peak_activation", True] == pytest.approx(1.0, rel=1e-3)
    assert math.degrees(limits["mean_body_pitch", False]) == pytest.approx(-10.0, rel=1e-3)
    assert math.degrees(limits["mean_body_pitch", True]) == pytest.approx(40.0, rel=1e-3)
    assert problem.bounds["tail_tilt"] == pytest.approx((-math.pi / 6, math.pi / 6))
    assert "peak_activation" not in {
        c.quantity.name for c in wb.OrbitProblem(swift, 8.0, bounds="plausible").subject_to
    }


def test_more_open_than_judged_is_not_known() -> None:
    robot = wb.load_species("robofalcon2")
    judged = list(
        _judged(
            wb.OrbitProblem(robot, 9.0), 50.0, wingbeat=BEAT | {"frequency": 4.0, "flap_amplitude": 0.8}
        ).values()
    )
    record = {"status": "converged", "closure": {"x": 0.0}, "plausibility": judged}
    assert [one["name"] for one in judged if one["within"]] == ["frequency", "flap_amplitude"]
    said = statements(record)
    assert said.plausible.startswith("plausible: not known: no range is known for power per mass, peak force")
    assert said.plausible.endswith("range of body pitch, Strouhal number and Reynolds number")
    assert not said.good
    # One number outside is enough for a no; as many known numbers as open ones are enough for a yes.
    fast = [one | {"value": 9.0, "within": False} if one["name"] == "frequency" else one for one in judged]
    assert statements(record | {"plausibility": fast}).plausible == "plausible: no: frequency 9 above 7.5 Hz"
    known = [one for one in judged if one["within"]]
    open_ = [one for one in judged if one["within"] is None]
    assert statements(record | {"plausibility": known + open_[:2]}).plausible.startswith("plausible: yes; no range")
    assert statements(record | {"plausibility": known + open_[:3]}).plausible.startswith("plausible: not known")
