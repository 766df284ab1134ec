"""Sectional coefficients from those of a finite wing, and how a table states its aspect ratio."""

import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.coefficients import by_the_lifting_line
from wingbeat.aero.derived_kernels import SectionalKernel, sectional_kernel

DEGREES = np.arange(0.0, 91.0, 2.5)
ALL_ROUND = np.radians(np.linspace(-180.0, 180.0, 1801))


def plate(alpha):
    return 1.2 * np.sin(2 * alpha), 1.4 - np.cos(2 * alpha)


def text_of(*comments):
    lift, drag = plate(np.radians(DEGREES))
    rows = (f"{a},{b!r},{c!r}" for a, b, c in zip(DEGREES, lift.tolist(), drag.tolist(), strict=True))
    return "\n".join([*comments, "alpha_deg,c_l,c_d", *rows]) + "\n"


def written(tmp_path, *comments):
    path = tmp_path / "wing.csv"
    path.write_text(text_of(*comments), encoding="utf-8")
    return path


@pytest.mark.parametrize("name", ["su-fan", "table"])
def test_the_lifting_line_takes_a_section_back_to_its_wing(name, tmp_path):
    path = written(tmp_path, "# aspect_ratio = 4.5")
    model = wb.aero.coefficients_of(path if name == "table" else name)
    kernel = sectional_kernel(model)
    assert isinstance(kernel, SectionalKernel)
    alpha, lift, drag = by_the_lifting_line(kernel, model.aspect_ratio, ALL_ROUND)
    apart = np.maximum(np.abs(lift - model.lift(alpha)), np.abs(drag - model.drag(alpha)))
    from_blend = np.abs((np.degrees(alpha) + 45.0) % 90.0 - 45.0)
    assert apart[from_blend > 1.5].max() <= 1e-5
    assert apart.max() <= 2e-4
    # The section has another curve: more lift at the same angle, and less drag.
    at = math.radians(8.0)
    c_l, c_d = (float(part) for part in kernel.lift_drag(np.array(at)))
    assert c_l > 1.03 * model.lift(at)
    assert c_d < model.drag(at + float(model.lift(at)) / (math.pi * model.aspect_ratio))


def test_the_sections_of_a_symmetric_wing_are_symmetric_and_periodic():
    kernel = sectional_kernel(wb.aero.SuFan())
    angles = np.radians(np.linspace(0.0, 180.0, 721))
    (lift, drag), (other, same) = (kernel.lift_drag(sign * angles) for sign in (1.0, -1.0))
    np.testing.assert_allclose(lift, -other, rtol=0, atol=1e-9)
    np.testing.assert_allclose(drag, same, rtol=0, atol=1e-9)
    ends = kernel.lift_drag(np.array([-math.pi, math.pi]))
    np.testing.assert_allclose(np.diff(ends), 0.0, atol=1e-12)


def test_the_centre_of_pressure_goes_with_the_angle_of_the_wing():
    model = wb.aero.SuFan()
    kernel = sectional_kernel(model)
    section = np.radians(np.array([-40.0, -15.0, 5.0, 10.0, 25.0, 60.0, 120.0]))
    alpha, *_ = by_the_lifting_line(kernel, 6.0, section)
    np.testing.assert_allclose(kernel.centre_of_pressure(section), model.centre_of_pressure(alpha), atol=1e-5)
    rows = tuple(DEGREES), *(tuple(part) for part in plate(np.radians(DEGREES)))
    without = wb.aero.TableCoefficients("plate", *rows, aspect_ratio=6.0)
    assert np.isnan(sectional_kernel(without).centre_of_pressure(section)).all()


@pytest.mark.parametrize("extension", ["mirrored", "clipped-drag"])
def test_a_section_is_unchanged(extension):
    model = wb.aero.Wang2004(extension)
    assert model.aspect_ratio == math.inf
    for one, other in zip(
        sectional_kernel(model).lift_drag(ALL_ROUND), model.kernel().lift_drag(ALL_ROUND), strict=True
    ):
        np.testing.assert_array_equal(one, other)


def test_a_slender_wing_is_almost_its_section():
    rows = tuple(DEGREES), *(tuple(part) for part in plate(np.radians(DEGREES)))
    model = wb.aero.TableCoefficients("slender", *rows, aspect_ratio=1e9)
    for found, wanted in zip(
        sectional_kernel(model).lift_drag(ALL_ROUND), (model.lift(ALL_ROUND), model.drag(ALL_ROUND)), strict=True
    ):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=2e-4)


@pytest.mark.parametrize(
    ("comment", "stated"),
    [
        ("# aspect_ratio = 6", 6.0),
        ("#aspect_ratio=4.5", 4.5),
        ("# aspect_ratio = inf", math.inf),
        ("# of a dove, its aspect_ratio unknown", None),
    ],
)
def test_a_table_states_the_aspect_ratio_of_its_wing(tmp_path, comment, stated):
    assert wb.aero.load_table(written(tmp_path, "# a wing", comment)).aspect_ratio == stated


@pytest.mark.parametrize("wrong", ["six", "", "nan", "0", "-3"])
def test_a_bad_aspect_ratio_is_refused_with_file_and_row(tmp_path, wrong):
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.aero.load_table(written(tmp_path, "# a wing", f"# aspect_ratio = {wrong}"))
    (fault,) = refused.value.faults
    assert fault.where == "wing.csv row 2, aspect_ratio"


@pytest.mark.parametrize("wrong", [0.0, -6.0, math.nan, -math.inf, "six", True])
def test_a_bad_aspect_ratio_of_a_model_is_refused(wrong):
    rows = tuple(DEGREES), *(tuple(part) for part in plate(np.radians(DEGREES)))
    with pytest.raises(wb.InvalidInputError, match="aspect_ratio"):
        wb.aero.TableCoefficients("plate", *rows, aspect_ratio=wrong)


def test_an_aspect_ratio_that_is_too_small_is_refused(tmp_path):
    short = wb.aero.load_table(written(tmp_path, "# aspect_ratio = 0.5"))
    with pytest.raises(wb.InvalidInputError, match=r"its lift rises too fast for an aspect ratio of 0\.5"):
        sectional_kernel(short)
    with pytest.raises(wb.InvalidInputError, match="check aspect_ratio"):
        wb.aero.BladeElement(short, inflow="momentum")
    assert wb.aero.BladeElement(short).coefficients is short
