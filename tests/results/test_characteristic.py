"""Characteristic speeds of curves with known minima: enclosed, with error bars; none is given beside a jump."""

import numpy as np
import pytest

from wingbeat._base import text_of
from wingbeat.records.characteristic import BestLine, characteristic_speeds, next_speeds, speeds_of
from wingbeat.words.curve_words import curve_report, speed_in_words
from wingbeat.words.orbit_words import DEFAULT_AIR

SPEEDS = np.arange(3.0, 21.0)
TOLERANCE = 0.1


def line_of(speed, value, quantity="mean_power", torn=(), limits=None, others=()):
    """Return a line of best orbits that jumps after the points `torn`."""
    joined = np.array([i not in torn for i in range(len(speed) - 1)], dtype=bool)
    limits = [frozenset()] * len(speed) if limits is None else limits
    others = np.array(others, dtype=float).reshape(-1, len(speed))
    return BestLine(
        quantity, quantity.endswith("power"), np.asarray(speed), np.asarray(value), joined, limits, others
    )


def solved(function, speed=SPEEDS, quantity="mean_power", limits=lambda u: frozenset(), power_limit=None, most=8):
    """Refine a curve with a function in place of a solver; return the answers and the number of solutions added."""
    speed, known, added = np.asarray(speed, dtype=float), {}, 0
    while True:
        value = np.array([known.setdefault(u, function(u)) for u in speed])
        line = line_of(speed, value, quantity, limits=[limits(u) for u in speed])
        asked = next_speeds(line, TOLERANCE, power_limit)[: most - added]
        if not asked:
            return characteristic_speeds(line, power_limit), added
        assert len({*asked, *speed}) == len(asked) + len(speed)
        assert min(speed) < min(asked) <= max(asked) < max(speed)
        added += len(asked)
        speed = np.sort([*speed, *asked])


@pytest.mark.parametrize("step", [0.5, 1.0, 2.0, 3.0])
@pytest.mark.parametrize(("a", "b"), [(60.0, 0.01), (5.0, 0.004), (200.0, 0.02)])
def test_the_minima_of_a_known_curve_are_enclosed_by_few_more_orbits(step, a, b):
    found, added = solved(lambda u: a / u + b * u**3, np.arange(3.0, 20.1, step))
    assert added <= 8
    for name, true in (("minimum_power", (a / (3 * b)) ** 0.25), ("maximum_range", (a / b) ** 0.25)):
        low, high = found[name]["interval"]
        assert found[name]["status"] == "found"
        assert low <= true <= high
        assert high - low < 0.65
        assert abs(found[name]["speed"] - true) < 0.13
        assert abs(found[name]["lowest"] - found[name]["speed"]) <= 0.15
        assert found[name]["value"] == pytest.approx(a / true + b * true**3, rel=2e-2)


def test_what_a_limit_of_orbits_leaves_open_is_in_the_error_bar():
    """Without more orbits the error bar is that of the points there are; the parabola alone gave none."""
    rough, added = solved(lambda u: 60 / u + 0.01 * u**3, most=0)
    assert added == 0
    assert rough["minimum_power"]["interval"] == [6.0, 8.0]
    fine, added = solved(lambda u: 60 / u + 0.01 * u**3)
    assert added == 6
    assert fine["minimum_power"]["interval"][1] - fine["minimum_power"]["interval"][0] < 0.25


def test_the_scatter_of_optima_becomes_an_interval_of_speeds():
    """Optima scatter if searches end in one or another of several: the error bar holds the true speed in 95 %."""
    random, missed, widths = np.random.default_rng(0), 0, {1e-6: [], 1e-3: [], 5e-3: []}
    for scatter, width in widths.items():
        for _ in range(60):
            true, curve = random.uniform(6, 14), random.uniform(0.003, 0.03)

            def value(u, true=true, curve=curve, scatter=scatter):
                return (1 + curve * (u - true) ** 2) * (1 + scatter * random.standard_normal())

            found, _ = solved(value, quantity="frequency")
            if found["minimum_frequency"]["status"] == "found":
                low, high = found["minimum_frequency"]["interval"]
                missed += not low <= true <= high
                width.append(high - low)
    assert missed <= 9
    narrow, middle, wide = map(np.median, widths.values())
    assert narrow < 0.25 < 0.5 < middle < 1.5 * middle < wide


def test_only_what_was_minimised_has_characteristic_speeds():
    value = 60 / SPEEDS + 0.01 * SPEEDS**3
    names = {
        "mean_positive_power": {"minimum_power", "maximum_range"},
        "frequency": {"minimum_frequency"},
        "peak_flap_torque": {"minimum_peak_flap_torque"},
        "cost_of_transport": {"maximum_range"},
    }
    for quantity, wanted in names.items():
        line = line_of(SPEEDS, value, quantity)
        assert characteristic_speeds(line).keys() == wanted
        sustained = {"fastest_sustained", "slowest_sustained"} if line.is_power else set()
        assert characteristic_speeds(line, 20.0).keys() == wanted | sustained


def test_no_speed_is_given_beside_a_jump_or_a_gap():
    valley = np.array([9.0, 5.0, 4.0, 8.0, 9.0])
    speed = np.array([3.0, 4.0, 5.0, 6.0, 7.0])
    for torn in ((1,), (2,), (1, 2)):
        line = line_of(speed, valley, "frequency", torn)
        found = characteristic_speeds(line)["minimum_frequency"]
        assert (found["status"], found["speed"], found["interval"]) == ("beside_jump", None, None)
        assert found["lowest"] == 5.0
        assert next_speeds(line, TOLERANCE) == []
        assert "none is given, because the best wingbeat changes branch there" in speed_in_words(found)
    farther = line_of(speed, valley, "frequency", (0, 3))
    assert characteristic_speeds(farther)["minimum_frequency"]["status"] == "found"
    gap = line_of(speed, np.where(speed == 6.0, np.nan, valley), "frequency")
    assert characteristic_speeds(gap)["minimum_frequency"]["status"] == "beside_gap"
    assert next_speeds(gap, TOLERANCE) == []
    assert characteristic_speeds(line_of(speed, np.full(5, np.nan)))["minimum_power"] is None


def test_at_the_ends_of_a_curve_it_is_said_on_which_side_the_speed_is():
    speed, falling = np.array([0.0, 3.0, 4.0, 5.0]), np.array([9.0, 7.0, 5.0, 4.0])
    found = characteristic_speeds(line_of(speed, falling), 6.0)
    assert found["minimum_power"]["interval"] == [5.0, None]
    assert speed_in_words(found["minimum_power"]) == "at or above 5 m/s, where the curve ends"
    assert found["fastest_sustained"]["status"] == "at_or_above"
    assert found["slowest_sustained"]["speed"] == pytest.approx(3.5)
    assert found["slowest_sustained"]["interval"] == [3.0, 4.0]
    assert characteristic_speeds(line_of(speed, falling), 3.0)["fastest_sustained"] is None
    rising = characteristic_speeds(line_of(speed[1:], falling[:0:-1]), 6.0)
    assert speed_in_words(rising["minimum_power"]) == "at or below 3 m/s, where the curve ends"
    assert rising["slowest_sustained"]["interval"] == [None, 3.0]
    assert rising["slowest_sustained"]["status"] == "at_or_below"
    hover = characteristic_speeds(line_of(speed, falling[::-1]))
    assert speed_in_words(hover["minimum_power"]) == "in hover, where the curve begins"
    # Power over speed has no value in hover, which is the end of that curve, not a gap.
    assert hover["maximum_range"]["status"] in ("found", "at_or_below")
    torn = characteristic_speeds(line_of(speed, falling[::-1], torn=(1,)), 6.0)
    assert (torn["fastest_sustained"]["status"], torn["fastest_sustained"]["speed"]) == ("beside_jump", None)


def test_a_minimum_that_a_limit_chose_says_so():
    """Below 7.3 m/s one thing is free, above it is at its limit: the value has a kink there, and its minimum."""
    found, added = solved(
        lambda u: 1 + (0.02 * (7.3 - u) if u < 7.3 else 0.3 * (u - 7.3)),
        quantity="frequency",
        limits=lambda u: frozenset({"flap_amplitude"} if u >= 7.3 else {}) | {"pitch_mean"},
    )
    least = found["minimum_frequency"]
    assert added <= 8
    assert least["changed_limits"] == ["flap_amplitude"]
    assert "pitch_mean" in least["limits"]
    assert least["interval"][0] <= 7.3 <= least["interval"][1]
    value = np.maximum(1.0, 1 + 0.1 * (SPEEDS - 9.0) ** 2 - 0.1)
    held = [frozenset({"frequency"}) if v == 1.0 else frozenset() for v in value]
    flat = line_of(SPEEDS, value, "frequency", limits=held)
    assert characteristic_speeds(flat)["minimum_frequency"]["status"] == "set_by_limit"
    assert characteristic_speeds(flat)["minimum_frequency"]["speed"] is None
    assert next_speeds(flat, TOLERANCE) == []


def test_other_minima_that_are_as_good_widen_the_error_bar():
    value = 1 + 0.01 * (SPEEDS - 8.0) ** 2
    for above, rivals in ((0.005, [14.0]), (0.02, [])):
        other = np.where(SPEEDS > 9, 1 + above + 0.01 * (SPEEDS - 14.0) ** 2, np.nan)
        found = characteristic_speeds(line_of(SPEEDS, value, "frequency", others=[other]))["minimum_frequency"]
        assert found["rivals"] == rivals
        assert found["interval"][1] == (14.0 if rivals else 9.0)


def test_what_a_power_limit_allows_is_enclosed_too():
    found, added = solved(lambda u: 60 / u + 0.01 * u**3, power_limit=20.0, most=20)
    fastest = max(root.real for root in np.roots([0.01, 0, 0, -20.0, 60.0]) if abs(root.imag) < 1e-9)
    low, high = found["fastest_sustained"]["interval"]
    assert low <= fastest <= high <= low + 2 * TOLERANCE
    assert found["fastest_sustained"]["speed"] == pytest.approx(fastest, abs=1e-3)
    assert speed_in_words(found["fastest_sustained"]).startswith("11.3")
    assert added <= 12


def test_the_report_gives_the_value_of_an_orbit_that_was_computed():
    """Without added speeds the parabola's minimum may lie far from every orbit."""
    told = []
    for most in (0, 8):
        found, _ = solved(lambda u: 60 / u + 0.01 * u**3, [2.0, 5.5, 9.0, 12.5], most=most)
        record = {"objective": "mean_power", "characteristic_speeds": found, "points": [], "gaps": [], "marks": []}
        record |= {"species": "pigeon", "climb": 0.0, "air": DEFAULT_AIR, "warnings": []}
        told.append(" ".join(text_of(curve_report(record)).split()))
    assert "m/s (2 to 10); the least computed is 12.57 W at 5.5 m/s; mean power is" in told[0]
    assert "minimum power: 6.6" in told[1]
    assert "), 11.96 W; mean power is within 2 %" in told[1]


def dataset_of(columns):
    """A curve's data set with these columns over speed; least hinge power at 5 m/s."""
    import xarray as xr

    power = 20.0 + (SPEEDS - 5.0) ** 2
    values = {"objective_value": power, **columns}
    made = {name: (("speed", "optimum"), v[:, None], {"units": "W"}) for name, v in values.items()}
    made["family"] = ("speed", "optimum"), np.zeros((len(SPEEDS), 1), dtype=int)
    made["active_bounds"] = ("speed", "optimum"), np.full((len(SPEEDS), 1), "", dtype=object)
    attributes = {"objective": "mean_positive_power", "marks": "[]"}
    return xr.Dataset(made, {"speed": SPEEDS}, attributes)


def test_a_battery_lasts_longest_where_its_own_discharge_says():
    """Parabolas with tops at 6.3 and 7.4 m/s; where the battery cannot feed the beat, nothing is said."""
    lasts = {"endurance": 900.0 - 20.0 * (SPEEDS - 6.3) ** 2, "flight_range": 6000.0 - 100.0 * (SPEEDS - 7.4) ** 2}
    found = speeds_of(dataset_of(lasts), None)
    assert found["minimum_power"]["speed"] == pytest.approx(5.0, abs=1e-6)
    for name, speed, value in (("best_endurance", 6.3, 900.0), ("best_range", 7.4, 6000.0)):
        assert found[name]["speed"] == pytest.approx(speed, abs=0.1), name
        assert found[name]["value"] == pytest.approx(value, rel=0.01)
    none = speeds_of(dataset_of({name: 0.0 * SPEEDS for name in lasts}), None)
    assert (none["best_endurance"], none["best_range"]) == (None, None)


def test_without_a_battery_a_motors_power_says_which_speeds_are_best():
    electrical = 30.0 + 2.0 * (SPEEDS - 6.0) ** 2
    found = speeds_of(dataset_of({"electrical_power": electrical}), None)
    assert found["best_endurance"]["speed"] == pytest.approx(6.0, abs=1e-6)
    # d(P/U)/dU = 0 at U^2 = (30 + 2 * 36) / 2
    assert found["best_range"]["speed"] == pytest.approx(np.sqrt(51.0), abs=0.1)
    assert "best_endurance" not in speeds_of(dataset_of({}), None)
