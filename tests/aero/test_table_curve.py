"""The curve through a table: it keeps within its rows, and drag on it is positive, however coarse the table is."""

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, seed, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from tests.helpers.coefficients import TOGETHER, value_slope_curvature
from wingbeat._base import InvalidInputError
from wingbeat.aero import TableCoefficients, load_table
from wingbeat.cli import main

CASES = Path(__file__).parents[1] / "cases" / "polars"
GRID = np.linspace(-180.0, 180.0, TOGETHER)
# Each step occurs equally often, in an order that is drawn, so that the tables of a kind have one number of rows.
STEPS = (2, 3, 4, 5, 6)
KINDS = {"mirrored": (0, 5), "clipped-drag": (0, 5), "signed": (-100, 10), "whole turn": (-180, 18)}


@st.composite
def coarse_tables(draw, kind):
    """Return a table with a stall and jumps of drag by up to 20 times between its rows."""
    start, times = KINDS[kind]
    angles = np.concatenate([[start], start + np.cumsum(draw(st.permutations(STEPS * times)))]).astype(float)
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    jumps = np.where(random.random(angles.size) < 0.4, random.uniform(-1, 1, angles.size) * math.log(20), 0.0)
    drag = np.clip(random.uniform(0.005, 0.1) * np.exp(np.cumsum(jumps)), 0.003, 5.0)
    lift = 1.4 * np.sin(np.deg2rad(2 * angles)) + np.where(random.random(angles.size) < 0.3, -0.6, 0.1)
    columns = [lift, drag, random.uniform(0, 1, angles.size)]
    if kind == "whole turn":
        for column in columns:
            column[-1] = column[0]
    with_centre = draw(st.booleans())
    extension = "mirrored" if kind == "whole turn" else kind
    return TableCoefficients("coarse", angles, *columns[: 2 + with_centre], extension=extension)


@pytest.mark.parametrize("kind", list(KINDS))
@seed(0)
@settings(deadline=None, max_examples=40)
@given(data=st.data())
def test_the_curve_keeps_within_its_rows_and_drag_is_positive_at_all_angles(kind, data):
    table = data.draw(coarse_tables(kind))
    values, slopes, curvatures = value_slope_curvature(table, np.deg2rad(GRID))
    assert values[:, 1].min() > 0
    for order in (values, slopes, curvatures):
        assert np.isfinite(order).all()
    # Where no other piece joins it, the curve is the table's.
    low, high = (-180, 180) if kind == "whole turn" else (-89 if kind == "signed" else 1, 89)
    inside = (low <= GRID) & (high >= GRID)
    angles, given_rows = np.array(table.alpha_deg), [np.array(row) for row in (table.c_l, table.c_d)]
    given_rows += [] if table.x_cp is None else [np.array(table.x_cp)]
    before = np.clip(np.searchsorted(angles, GRID[inside], side="right") - 1, 0, angles.size - 2)
    for found, row in zip(values[inside].T, given_rows, strict=True):
        least, most = np.minimum(row[before], row[before + 1]), np.maximum(row[before], row[before + 1])
        assert (found >= least - 1e-12).all()
        assert (found <= most + 1e-12).all()


def test_where_the_rows_are_smooth_the_curve_is_the_cubic_spline():
    angles = np.arange(0.0, 91.0, 5.0)
    lift, drag = 1.2 * np.sin(np.deg2rad(1.7 * angles)), 1.4 - np.cos(np.deg2rad(1.9 * angles))
    table, alpha = TableCoefficients("smooth", angles, lift, drag), np.deg2rad(np.linspace(10.0, 40.0, 301))
    for found, row in ((table.lift(alpha), lift), (table.drag(alpha), drag)):
        np.testing.assert_allclose(found, CubicSpline(np.deg2rad(angles), row)(alpha), rtol=0, atol=1e-13)


def test_angles_in_any_cell_of_the_look_up_find_their_piece():
    """Rows of 0.01 degrees next to rows of 10 degrees need more cells than usual."""
    angles = np.concatenate([np.arange(0.0, 20.0, 10.0), 20.0 + 0.01 * np.arange(5), np.arange(30.0, 91.0, 10.0)])
    table = TableCoefficients("uneven", angles, 0 * angles, 0.1 + angles / 100, blend_width_deg=0.1)
    alpha = np.linspace(1.0, 89.0, 20_001)
    np.testing.assert_allclose(table.drag(np.deg2rad(alpha)), 0.1 + alpha / 100, rtol=1e-12)
    with pytest.raises(InvalidInputError, match=r"must be at least 0\.001 degrees above the 20 before it"):
        TableCoefficients("twice", (0, 20, 20.0001, 90), (0, 0, 0, 0), (1, 1, 1, 1))


@pytest.mark.parametrize("name", ["coarse_stall", "negative_drag"])
def test_drag_between_the_rows_at_a_sharp_stall(name):
    assert load_table(CASES / f"{name}.csv").drag(math.radians(10.5)) == pytest.approx(0.0226, abs=5e-5)


@pytest.mark.parametrize("name", ["coarse_stall", "negative_drag"])
def test_no_glide_without_power_climbs_or_is_flatter_than_its_rows_allow(name, capsys):
    """The cubic spline gave ratios of 1759 and 1e9, and a climb of 0.06 m/s; pchip alone gives 45.9 and 0.193."""
    assert main(["glide", "pigeon", "--aero", str(CASES / f"{name}.csv"), "--json"]) == 0
    polar = json.loads(capsys.readouterr().out)
    assert polar["best_ratio"]["glide_ratio"] == pytest.approx(45.9, rel=0.01)
    assert polar["least_sink"]["sink"] == pytest.approx(0.193, rel=0.01)


# At 3 degrees drag rises so steeply that a blend of that half width would fall below 0.
STEEP = (0.0, 2.0, 4.0, 90.0), (0.0, 0.3, 0.6, 0.0), (0.01, 0.01, 1.5, 2.0)


@pytest.mark.parametrize(("extension", "places"), [("mirrored", [0]), ("clipped-drag", [0, 180])])
def test_a_blend_in_which_drag_is_not_positive_is_refused(extension, places):
    with pytest.raises(InvalidInputError) as caught:
        TableCoefficients("steep", *STEEP, extension=extension, blend_width_deg=3.0)
    where = [fault.where for fault in caught.value.faults]
    assert where == [f"steep, c_d in the blend at {at} degrees (half width 3)" for at in places]
    assert all("smaller blend_width_deg" in fault.fix for fault in caught.value.faults)
    assert TableCoefficients("steep", *STEEP, extension=extension).drag(0.0) > 0


IMPOSSIBLE = {
    "drag counts": ("c_d", (150, 200, 8000, 14000), "looks like drag counts: divide it by 10000"),
    "no drag": ("c_d", (0.0, 0.2, 1.0, 1.4), "must be > 0: every wing has drag"),
    "drag reversed": ("c_d", (-0.1, -0.2, -1.0, -1.4), "reverse its sign"),
    "lift in newtons": ("c_l", (0.0, 12.0, 30.0, 0.0), "c_l[2] = 30.0: must lie between -5 and 5"),
    "per cent of the chord": ("x_cp", (25, 30, 40, 50), "divide it by 100"),
    "a centre far away": ("x_cp", (-30.0, 0.3, 0.4, 0.5), "must lie between -1 and 2 chords"),
}


@pytest.mark.parametrize("case", list(IMPOSSIBLE))
def test_what_no_wing_has_is_refused_once_a_column(case):
    name, column, words = IMPOSSIBLE[case]
    rows = {"c_l": (0.0, 0.5, 1.0, 0.0), "c_d": (0.1, 0.2, 1.0, 1.4), name: column}
    with pytest.raises(InvalidInputError, match=re.escape(words)) as caught:
        TableCoefficients("bad", (0.0, 20.0, 45.0, 90.0), **rows)
    assert len(caught.value.faults) == 1
