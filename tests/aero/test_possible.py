"""Formulas and functions that no wing has are refused at the door, and the range of a fit is stated truly."""

import math
import re

import jax.numpy as jnp
import numpy as np
import pytest

import wingbeat as wb
from wingbeat.aero import LIBRARY, BladeElement, FormulaCoefficients, FormulaTerms, SuFan, TableCoefficients
from wingbeat.records.orbit_record import _outside_fit

LIFT, DRAG = FormulaTerms(0.0, 1.2, 2.0, 0.0), FormulaTerms(1.4, 1.0, 2.0, -90.0)


def driven(alpha):
    return jnp.sin(2 * alpha), 0.9 - jnp.cos(2 * alpha)


def unstalled(alpha):
    return 2 * jnp.pi * alpha, 0.02 + alpha**2 / 10


def thin_aerofoil(alpha):
    return 2 * jnp.pi * jnp.sin(alpha), 0.0 * alpha


REFUSED = {
    "a function with negative drag": (driven, "degrees, which would drive the wing forward"),
    "a function without stall": (unstalled, "has a C_L of -19.7 at -180 degrees, which no wing has"),
    "a formula with negative drag": (
        FormulaCoefficients("driven", LIFT, FormulaTerms(0.9, 1.0, 2.0, -90.0)),
        "'driven': has a C_D of -0.1 at",
    ),
    "a formula of drag counts": (
        FormulaCoefficients("counts", LIFT, FormulaTerms(1.4e4, 1e4, 2.0, -90.0)),
        "has a C_D of 2.4e+04 at",
    ),
}


@pytest.mark.parametrize("case", list(REFUSED))
def test_what_no_wing_has_is_refused(case):
    given, words = REFUSED[case]
    with pytest.raises(wb.InvalidInputError, match=re.escape(words)):
        BladeElement(given)


def test_so_it_is_in_a_model_file(tmp_path):
    path = tmp_path / "driven.toml"
    lift, drag = (
        "\n".join(f"{k} = {v}" for k, v in terms.items())
        for terms in (
            {"constant": 0.0, "amplitude": 1.2, "rate": 2.0, "phase_deg": 0.0},
            {"constant": 0.9, "amplitude": 1.0, "rate": 2.0, "phase_deg": -90.0},
        )
    )
    head = 'kind = "wing coefficients"\nname = "driven"\nalpha_range_deg = [0.0, 90.0]'
    path.write_text(f"{head}\n[lift]\n{lift}\n[drag]\n{drag}\n")
    with pytest.raises(wb.InvalidInputError, match="drag is never negative"):
        wb.aero.load_coefficients(path)


@pytest.mark.parametrize("given", [thin_aerofoil, FormulaCoefficients("plate", LIFT, DRAG), *LIBRARY])
def test_ideal_fluids_and_the_library_are_accepted(given):
    assert BladeElement(given).coefficients.drag(0.3) >= 0


def test_a_wing_with_less_drag_than_its_induced_drag_has_no_section():
    rows = (0.0, 10.0, 20.0, 90.0), (0.0, 1.1, 0.8, 0.0), (0.02, 0.03, 0.4, 1.8)
    with pytest.raises(wb.InvalidInputError, match="less drag than the ideal induced drag of aspect ratio 6"):
        BladeElement(TableCoefficients("slick", *rows, aspect_ratio=6.0), inflow="momentum").kernel()
    assert BladeElement(TableCoefficients("slick", *rows, aspect_ratio=math.inf), inflow="momentum").kernel()


def test_the_range_of_a_fit_ends_where_its_extension_begins():
    """Su et al. measured to 110 degrees; the mirrored plate begins at 90."""
    model = SuFan()
    assert (model.alpha_range_deg, model.used_range_deg) == ((0.0, 110.0), (0.0, 90.0))
    assert LIBRARY["dickinson"]().used_range_deg == (0.0, 90.0)
    assert LIBRARY["dickinson"]("signed").used_range_deg == (-9.0, 90.0)
    assert LIBRARY["feathered"]().used_range_deg == LIBRARY["feathered"]().alpha_range_deg
    (said,) = _outside_fit(model, np.full(100, 3e4), np.radians(np.linspace(41.0, 100.0, 100)), "")
    assert said == (
        "angle of attack outside the fitted 0 to 90 degrees for 17% of strips and instants: there the extension "
        "'mirrored' applies, also from 90 to 110 degrees, which were measured (17.0%)"
    )
    assert not _outside_fit(model, np.full(100, 3e4), np.radians(np.linspace(10.0, 90.0, 100)), "")


def test_beyond_a_right_angle_the_plate_differs_from_the_formula_as_the_theory_page_says():
    page = {95: (-0.110, -0.249, 2.038, 2.011, 0.014, -0.046), 100: (-0.288, -0.423, 2.018, 1.965, -0.001, -0.062)}
    page |= {
        105: (-0.459, -0.586, 1.976, 1.897, -0.017, -0.078),
        110: (-0.620, -0.736, 1.913, 1.811, -0.031, -0.093),
    }
    model = SuFan()
    for degrees, numbers in page.items():
        alpha = math.radians(degrees)
        lift, drag = float(model.lift_terms.at(degrees)), float(model.drag_terms.at(degrees))
        normal = lift * math.cos(alpha) + drag * math.sin(alpha)
        moment = normal * (0.5 - float(model.centre_terms.at(degrees)))
        found = (lift, model.lift(alpha), drag, model.drag(alpha), moment, model.moment(alpha))
        np.testing.assert_allclose(found, numbers, rtol=0, atol=6e-4)
    assert model.moment(math.radians(90.0)) == pytest.approx(0.0, abs=1e-12)
