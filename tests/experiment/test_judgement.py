"""What is said of residuals: Re, branches and wrong rows are reported, and good scatter is not."""

import numpy as np
import pytest

from wingbeat._base import InvalidInputError
from wingbeat.experiment import CoefficientTable, fit_wing
from wingbeat.experiment.judgement import group_difference, two_branches

STREAMS = (2e4, 6e4, 1e5)


class Wing:
    """A random thin wing, with a stall that is soft or sharp and that the form cambered does not hold exactly."""

    def __init__(self, random: np.random.Generator):
        self.random, (self.zero, self.slope, self.top) = random, random.uniform((-4, 0.075, 0.8), (-1, 0.105, 1.3))
        self.drop, self.width = random.choice([0.0, random.uniform(0.1, 0.3)]), random.uniform(0.3, 2.0)
        self.least, self.bow, self.rise = random.uniform((0.02, 2e-4, 0.01), (0.05, 6e-4, 0.02))
        step = random.choice([0.5, 1.0, 1.0, 2.0])
        self.alpha = np.arange(-12.0, random.choice([16.0, 20.0]) + 0.1, step)
        self.stall = self.zero + self.top / self.slope + random.uniform(1.0, 4.0)

    def rows(self, alpha, scatter=0.0, top=1.0):
        """Return angles, C_L and C_D."""
        lift = np.clip(self.slope * (alpha - self.zero), -0.45, self.top * top)
        lift = lift - self.drop / (1 + np.exp((self.stall - alpha) / self.width))
        drag = (
            self.least + self.bow * (alpha - self.zero - 3) ** 2 + self.rise * np.maximum(alpha + 1 - self.stall, 0)
        )
        noise = self.random.normal(size=(2, len(alpha))) * scatter
        return np.array([alpha, lift + noise[0] * self.top, drag * (2 - top) * (1 + noise[1])])


def warned(rows, streams=None, shuffle: np.random.Generator | None = None) -> tuple[str, ...]:
    order = np.arange(rows.shape[1]) if shuffle is None else shuffle.permutation(rows.shape[1])
    alpha, lift, drag = rows[:, order]
    table = CoefficientTable(
        alpha, {"C_L": lift, "C_D": drag}, reynolds=None if streams is None else streams[order]
    )
    found = fit_wing(table, "cambered")
    return (*found.warnings, *found.failures)


def good(seed):
    """A table of one or several Re with the same curves, with repeats, in any order."""
    random = np.random.default_rng([1, seed])
    wing, parts, streams = Wing(random), [], []
    scatter, repeats = random.uniform(0.01, 0.03), random.integers(1, 4)
    for stream in STREAMS[: random.integers(1, 4)]:
        for _ in range(repeats):
            jitter = 0.1 * random.normal(size=len(wing.alpha)) * (random.random() < 0.3)
            parts.append(wing.rows(wing.alpha[:: random.choice([-1, 1])] + jitter, scatter))
            streams.append(np.full(len(wing.alpha), stream))
    return np.hstack(parts), np.concatenate(streams), random.choice([random, None])


def faulty(seed):
    """A table of several Re that differ, of two branches, or with one decimal point in the wrong place."""
    random = np.random.default_rng([2, seed])
    wing, scatter = Wing(random), random.choice([0.0, 0.005, 0.02])
    if seed % 3 == 0:
        tops = np.linspace(random.uniform(0.55, 0.8), 1.0, 3)
        rows = np.hstack([wing.rows(wing.alpha, scatter, top) for top in tops])
        return rows, np.repeat(STREAMS, len(wing.alpha)), random.choice([random, None])
    rows = wing.rows(wing.alpha, scatter)
    if seed % 3 == 1:
        down = wing.rows((wing.alpha + random.choice([0.0, 0.0, 0.3]))[::-1], scatter)
        low = random.uniform(5.0, 9.0)
        inside = (down[0] > low) & (down[0] < low + random.uniform(5.0, 8.0))
        down[1:, inside] += np.array([[-random.uniform(0.25, 0.4)], [random.uniform(0.08, 0.15)]])
        return np.hstack([rows, down]), None, random.choice([random, None])
    row = random.choice(np.flatnonzero(np.abs(rows[1]) > 0.4))
    rows[1, row] /= 10
    return rows, None, random.choice([random, None])


@pytest.mark.slow
def test_of_good_tables_one_of_fifty_at_most_is_warned_of():
    said = {seed: words for seed in range(50) if (words := warned(*good(seed)))}
    assert len(said) <= 1, said


@pytest.mark.slow
def test_of_faulty_tables_nineteen_of_twenty_are_reported():
    silent = [seed for seed in range(51) if not warned(*faulty(seed))]
    assert len(silent) <= 2, silent


def test_a_slipped_decimal_point_is_reported_with_its_row():
    rows = Wing(np.random.default_rng(4)).rows(np.arange(-10.0, 17.0), 0.005)
    wanted = rows[1, 22]
    rows[1, 22] /= 10
    (said,) = warned(rows)
    assert f"C_L: row 23 of the table (12 deg) is {rows[1, 22]:.4g}" in said
    assert float(said.split("gives ")[1].split()[0]) == pytest.approx(wanted, abs=0.06)
    assert said.endswith("a slipped decimal point?")


@pytest.mark.parametrize("repeats", [1, 3])
def test_a_sharp_stall_is_no_branch_and_no_mistake(repeats):
    alpha = np.repeat(np.arange(-10.0, 17.0, 2.0), repeats)
    lift = np.where(alpha < 11, 0.09 * alpha + 0.2, 0.6) + 0.002 * np.sin(99 * np.arange(len(alpha)))
    drag = np.where(alpha < 11, 0.03 + 2e-4 * alpha**2, 0.2)
    assert warned(np.array([alpha, lift, drag])) == ()


def test_branches_of_shuffled_sweeps_at_other_angles_are_found():
    random = np.random.default_rng(0)
    up = np.arange(0.0, 20.0)
    a = np.concatenate([up, up + 0.5])
    y = np.concatenate([np.zeros(20), np.where((up > 6.5) & (up < 14.5), -0.3, 0.0)]) + 0.01 * random.normal(
        size=40
    )
    order = random.permutation(40)
    found = two_branches(a[order], y[order], 0.1)
    assert found is not None
    assert (6.0 <= found.from_deg <= 7.5, 14.5 <= found.to_deg <= 16.0) == (True, True)
    assert (found.upper, found.lower) == (pytest.approx(0.0, abs=0.03), pytest.approx(-0.3, abs=0.03))
    assert two_branches(a[order], 0.01 * random.normal(size=40), 0.01) is None


def test_the_f_test_keeps_its_chance():
    """Of tables without a difference, one in twenty lies below a chance of 5 %."""
    random = np.random.default_rng(0)
    a = np.tile(np.arange(-10.0, 17.0), 3)
    inside = np.arange(len(a)) < 27
    chances = np.array([group_difference(a, random.normal(size=len(a)), inside).chance for _ in range(400)])
    assert 0.03 < (chances < 0.05).mean() < 0.075


def test_a_fit_that_failed_cannot_be_saved(tmp_path):
    random = np.random.default_rng(3)
    alpha = np.arange(-20.0, 21.0, 2.0)
    table = CoefficientTable(alpha, {"C_L": 0.02 * alpha + random.normal(size=21), "C_D": np.full(21, 0.1)})
    found = fit_wing(table, "cambered")
    assert found.failures
    with pytest.raises(InvalidInputError, match="the fit failed: C_L: the curve does not fit"):
        found.save(tmp_path / "wing.toml")


def test_what_no_wing_has_beyond_the_data_is_a_failure():
    """A mirrored form of a table to 16 degrees has a drag coefficient above 5 across the stream."""
    rows = Wing(np.random.default_rng(8)).rows(np.arange(0.0, 16.5, 0.5))
    found = fit_wing(CoefficientTable(rows[0], {"C_L": rows[1], "C_D": rows[2]}), "dickinson")
    assert any("which no wing has, beyond the measured 0 to 16 deg" in one for one in found.failures), (
        found.failures
    )


def test_reynolds_numbers_that_rise_without_gaps_are_compared_in_parts():
    wing = Wing(np.random.default_rng(5))
    streams = np.repeat(np.geomspace(2e4, 1e5, 20), len(wing.alpha))
    rows = [wing.rows(wing.alpha, 0.01, top) for top in np.linspace(0.6, 1.0, 20)]
    assert any("C_L: the residuals depend on Re: at Re 20000 to" in one for one in warned(np.hstack(rows), streams))
    assert warned(np.hstack([wing.rows(wing.alpha, 0.01) for _ in rows]), streams) == ()


def test_drag_below_the_friction_of_a_plate_is_doubted():
    rows = Wing(np.random.default_rng(6)).rows(np.arange(-10.0, 17.0), 0.01)
    assert warned(rows, np.full(27, 50e3)) == ()
    assert any(
        "are the Reynolds numbers in thousands or millions" in one for one in warned(rows, np.full(27, 50.0))
    )
