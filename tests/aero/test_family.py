"""Polars at several Reynolds numbers become one model: exact at each polar, smooth between, constant beyond."""

import dataclasses
import json
import math
import shlex
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from wingbeat._jax.config import jax, jnp
from wingbeat.aero import FamilyCoefficients, TableCoefficients, load_coefficients
from wingbeat.aero.family import at_reynolds, depends_on_reynolds
from wingbeat.aero.strip_forces import strip_forces
from wingbeat.cli.app import main
from wingbeat.orbits.problem.origin import loads_in_words
from wingbeat.records.inputs import aero_from, aero_inputs

OWN = Path(__file__).parent / "polars"
XFOIL = [str(OWN / f"xfoil_naca4412_re{re}.pol") for re in (50000, 100000, 200000)]
PIGEON = wb.load_species("pigeon")
ALPHA = np.arange(0.0, 91.0, 5.0)


def plate(drag, lift=1.0):
    return TableCoefficients(
        "plate", ALPHA, lift * np.sin(2 * np.radians(ALPHA)), drag * (1 + 20 * (ALPHA / 90) ** 2)
    )


def plates(*reynolds):
    return FamilyCoefficients(
        "plates", reynolds, tuple(plate(4.0 / math.sqrt(re), 0.8 + 0.1 * k) for k, re in enumerate(reynolds))
    )


def family():
    return load_coefficients(XFOIL, "viterna")


def test_a_family_is_each_polar_at_its_reynolds_number_and_the_nearest_beyond():
    found, alpha = family(), np.radians(np.linspace(-180, 180, 721))
    assert found.reynolds == (5e4, 1e5, 2e5)
    assert found.name == "xfoil_naca4412"
    for reynolds, path in zip((5e4, 1e5, 2e5), XFOIL, strict=True):
        alone = load_coefficients(path, "viterna")
        for what in ("lift", "drag", "centre_of_pressure"):
            expected = getattr(alone, what)(alpha)
            np.testing.assert_allclose(getattr(found.at(reynolds), what)(alpha), expected, rtol=1e-12, atol=1e-13)
    for inside, outside in ((5e4, 1.0), (5e4, 4.9e4), (2e5, 2.1e5), (2e5, 1e9)):
        np.testing.assert_array_equal(found.at(inside).drag(alpha), found.at(outside).drag(alpha))
    assert load_coefficients(XFOIL[:1], "viterna") == load_coefficients(XFOIL[0], "viterna")


def test_between_the_polars_a_power_law_of_drag_is_exact_and_lift_is_a_line_where_the_polars_are_on_one():
    found = plates(1e4, 2e4, 4e4, 8e4)
    for reynolds in (1.1e4, 1.7e4, 2e4, 3.3e4, 7.5e4):
        assert found.at(reynolds).drag(0.0) == pytest.approx(4.0 / math.sqrt(reynolds), rel=1e-9)
        line = 0.8 + 0.1 * math.log2(reynolds / 1e4)
        assert found.at(reynolds).lift(math.radians(45)) == pytest.approx(line, rel=1e-12)


def test_two_derivatives_over_reynolds_are_continuous_at_polars_and_at_both_ends():
    # Polars that are on no line, so that pieces differ.
    uneven = FamilyCoefficients(
        "wing", (1e4, 1.5e4, 6e4, 9e4), (plate(0.09, 0.7), plate(0.03, 1.1), plate(0.05, 0.8), plate(0.02, 1.0))
    )
    kernel = uneven.kernel()

    @jax.jit
    def at(u):
        lift, drag = kernel.at(jnp.exp(u)).lift_drag(jnp.asarray(0.3))
        return lift + drag

    ends = [
        math.log(1e4),
        math.log(1e4) + 0.05,
        math.log(1.5e4),
        math.log(6e4),
        math.log(9e4) - 0.05,
        math.log(9e4),
    ]
    slope, curvature = jax.jit(jax.grad(at)), jax.jit(jax.grad(jax.grad(at)))
    for u in ends:
        for curve in (at, slope, curvature):
            before, after = float(curve(u - 1e-9)), float(curve(u + 1e-9))
            assert before == pytest.approx(after, abs=1e-5)
    assert float(slope(ends[0] - 1e-3)) == float(slope(ends[-1] + 1e-3)) == 0.0
    assert abs(float(curvature(ends[0] + 0.025))) > 1  # it is not flat inside


def test_the_polar_in_the_middle_of_three_is_found_from_the_other_two():
    outer, left_out = load_coefficients([XFOIL[0], XFOIL[2]], "viterna"), load_coefficients(XFOIL[1], "viterna")
    alpha = np.radians(np.array([a for a in left_out.alpha_deg if -5 <= a <= 10]))
    lift = outer.at(1e5).lift(alpha) - left_out.lift(alpha)
    drag = np.log(outer.at(1e5).drag(alpha) / left_out.drag(alpha))
    nearer = [float(np.sqrt(np.mean((m.lift(alpha) - left_out.lift(alpha)) ** 2))) for m in outer.members]
    told = [float(np.sqrt(np.mean(one**2))) for one in (lift, drag)]
    # Between 5e4 and 1e5 XFOIL's bubble closes; two polars cannot know where, and the upper one is nearer.
    assert told[0] < 0.14 < max(nearer)
    assert told[1] < 0.25


@pytest.mark.slow
def test_each_strip_flies_at_its_own_reynolds_number_in_both_formulations():
    found = family()
    model = wb.FlightModel(PIGEON.vehicle, wb.aero.BladeElement(found), PIGEON.air)
    loads = wb.flight_loads(model, PIGEON.wingbeat, wb.State(u=9.0), np.linspace(0, 1, 5))
    reynolds, alpha, speed = (np.asarray(getattr(loads, n)) for n in ("strip_reynolds", "alpha", "strip_speed"))
    assert np.ptp(reynolds) > 1e4
    chord = reynolds * model.air.viscosity / speed
    pressure = 0.5 * model.air.density * speed**2 * chord * PIGEON.vehicle.wing.semi_span / 10
    spread = pressure * np.asarray(loads.span_ratio)[:, None]
    for i, k in ((0, 0), (1, 9), (2, 4), (3, 7)):
        there = found.at(float(reynolds[i, k]))
        assert float(loads.lift[i, k]) == pytest.approx(spread[i, k] * there.lift(alpha[i, k]), rel=1e-9)
        assert float(loads.drag[i, k]) == pytest.approx(spread[i, k] * there.drag(alpha[i, k]), rel=1e-9)
    # The body's accelerations come from the other formulation of the loads; the energy says whether both agree.
    power = np.asarray(loads.actuator_power + loads.air_power)
    phase, step = np.linspace(0, 1, 5), 1e-5

    def energy(shift):
        time = shift / PIGEON.wingbeat.frequency
        state = wb.State(
            x=9.0 * time,
            z=0.5 * np.asarray(loads.acceleration)[:, 1] * time**2,
            body_pitch=0.5 * np.asarray(loads.acceleration)[:, 2] * time**2,
            u=9.0 + np.asarray(loads.acceleration)[:, 0] * time,
            w=np.asarray(loads.acceleration)[:, 1] * time,
            pitch_rate=np.asarray(loads.acceleration)[:, 2] * time,
        )
        there = wb.flight_loads(model, PIGEON.wingbeat, state, phase + shift)
        return np.asarray(there.kinetic_energy + there.potential_energy)

    rate = (energy(step) - energy(-step)) / (2 * step) * PIGEON.wingbeat.frequency
    np.testing.assert_allclose(rate, power, rtol=1e-5, atol=1e-4)


def test_derivatives_by_chord_viscosity_and_speeds_are_those_of_differences():
    kernel = family().kernel()

    @jax.jit
    def force(numbers):
        chord, viscosity, along, across, span = (numbers[i : i + 1] for i in range(5))
        found = strip_forces(kernel, 1.2, 0.1 * chord, along, across, 0.2 + 0 * along, span, chord / viscosity)
        centre = at_reynolds(kernel, found.speed * chord / viscosity).centre_of_pressure(found.alpha)
        return (found.chordwise + 2 * found.normal + 0.1 * centre)[0]

    numbers = np.array([0.1, 1.5e-5, 10.0, 1.1, 0.7])
    slopes = np.asarray(jax.jit(jax.jacfwd(force))(numbers))
    for i, (number, slope) in enumerate(zip(numbers, slopes, strict=True)):
        step = 1e-4 * number * np.eye(5)[i]
        wide, near = ((force(numbers + k * step) - force(numbers - k * step)) / k for k in (2, 1))
        assert slope == pytest.approx(float(4 * near - wide) / 3 / (2e-4 * number), rel=1e-7)


@pytest.mark.slow
def test_the_parts_of_a_wing_and_the_upstroke_can_be_families():
    found = family()
    alpha, reynolds = np.radians(np.linspace(-20, 20, 10)), np.linspace(6e4, 1.8e5, 10)
    kernel = wb.aero.BladeElement("su-fan", hand=found, upstroke_factor=0.5).kernel()
    assert depends_on_reynolds(kernel)
    lift = np.asarray(at_reynolds(kernel, jnp.asarray(reynolds)).lift_drag(jnp.asarray(alpha))[0])
    assert lift[8] == pytest.approx(found.at(reynolds[8]).lift(alpha[8]))
    assert lift[0] == pytest.approx(0.5 * wb.aero.SuFan().lift(alpha[0]))
    assert not depends_on_reynolds(wb.aero.BladeElement("su-fan", upstroke_factor=0.5).kernel())


@pytest.mark.slow
def test_with_inflow_a_family_of_finite_wings_is_one_of_sections():
    wings = tuple(dataclasses.replace(plate(d), aspect_ratio=6.0) for d in (0.08, 0.05))
    found = FamilyCoefficients("wings", (1e4, 4e4), wings)
    both = wb.aero.BladeElement(found, inflow="momentum").kernel()
    alone = wb.aero.BladeElement(wings[1], inflow="momentum").kernel()
    alpha = jnp.linspace(-0.5, 0.5, 11)
    for one, other in zip(both.at(4e4 + 0 * alpha).lift_drag(alpha), alone.lift_drag(alpha), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12)


def test_a_family_at_one_reynolds_number_is_one_model_with_inflow_and_in_records():
    """Its sections are those of the wing at this number, whatever the strips' own numbers are."""
    wings = tuple(dataclasses.replace(plate(d), aspect_ratio=6.0) for d in (0.08, 0.05))
    found = FamilyCoefficients("wings", (1e4, 4e4), wings).at(4e4)
    assert (found.extension, found.blend_width_deg, found.aspect_ratio) == ("mirrored", 1.0, 6.0)
    assert (found.reynolds_range, found.alpha_range_deg) == ((1e4, 4e4), (0.0, 90.0))
    with pytest.raises(AttributeError):
        _ = found.members
    aero = wb.aero.BladeElement(found, inflow="momentum")
    assert not depends_on_reynolds(aero.kernel())
    alone = wb.aero.BladeElement(wings[1], inflow="momentum").kernel()
    alpha = jnp.linspace(-0.5, 0.5, 11)
    for one, other in zip(aero.kernel().lift_drag(alpha), alone.lift_drag(alpha), strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12)
    inputs = aero_inputs(aero)
    assert aero_from(json.loads(json.dumps(inputs))) == aero
    assert loads_in_words(inputs).startswith("wings (2 polars, Re 10000 to 40000, at Re 40000)")


def test_the_members_of_a_family_are_tables():
    good = plate(0.05)
    for member in (wb.aero.SuFan(), plates(1e4, 2e4), plates(1e4, 2e4).at(1e4), 3.0):
        with pytest.raises(
            wb.InvalidInputError, match=r"members\[1\] = .*is no polar as a table; give a TableCoeff"
        ):
            FamilyCoefficients("mixed", (1e4, 4e4), (good, member))


HEAD = "alpha_deg,C_L,C_D,reynolds"
ROWS = {
    re: [f"{a},{0.02 * a if a < 45 else 1.8 - 0.02 * a},{0.05 + 0.0002 * a * a},{re}" for a in range(0, 91, 15)]
    for re in (2e4, 4e4)
}


def test_one_file_with_several_polars_is_a_family(tmp_path):
    path = tmp_path / "both.csv"
    path.write_text("\n".join([HEAD, *ROWS[4e4], *ROWS[2e4]]) + "\n")
    found = load_coefficients(path)
    assert isinstance(found, FamilyCoefficients)
    assert found.reynolds == (2e4, 4e4)
    assert found.notes == ("2 polars make one model from Re 20000 to 40000; beyond, the nearest holds",)
    two = load_coefficients(OWN / "xfoil_naca4412_two_re.pol", "viterna")
    assert two.reynolds == (1e5, 2e5)


def written(folder, name, *rows):
    (folder / name).write_text("\n".join(rows) + "\n")
    return str(folder / name)


def test_what_is_no_family_is_refused_with_what_to_do(tmp_path):
    low = written(tmp_path, "low.csv", HEAD, *ROWS[2e4])
    plain = written(tmp_path, "plain.csv", "alpha_deg,C_L,C_D", *(r.rpartition(",")[0] for r in ROWS[4e4]))
    twisted = written(
        tmp_path, "twisted.csv", HEAD, *(r.replace("20000.0", f"{2 + i}e4") for i, r in enumerate(ROWS[2e4]))
    )
    ends = written(tmp_path, "ends.csv", HEAD, *ROWS[4e4][:5])
    short = written(tmp_path, "short.csv", HEAD, *ROWS[2e4][:5])
    wing = written(tmp_path, "wing.csv", "# aspect_ratio = 6", HEAD, *ROWS[4e4])
    cases = {
        (low, plain): "states no Reynolds number; state it in a column reynolds",
        (low, twisted): "is the Reynolds number along one polar; a family is made of polars at fixed Reynolds",
        (low, low): "must be above the 20000 before it by 2 per cent or more; keep one polar of each",
        (low, ends): "must reach at least 90 degrees; complete each polar by Viterna's rule: --extension viterna",
        (
            short,
            ends,
        ): "must reach at least 90 degrees (2 polars do not: short.csv, ends.csv); complete each polar by",
        (low, wing): "differ in aspect_ratio; all polars of a family are of one wing",
        (low, "su-fan"): "is not a polar; several files must be polars of one wing",
        (XFOIL[0], str(OWN / "xfoil_naca0012_re50k.pol")): "are names of several sections",
        (): "names no file",
    }
    for paths, part in cases.items():
        with pytest.raises(wb.InvalidInputError) as refused:
            load_coefficients(list(paths), "viterna" if "several sections" in part else "mirrored")
        assert part in str(refused.value)


@pytest.mark.slow
def test_the_commands_take_the_words_that_a_shell_makes_of_a_pattern(capsys):
    files = " ".join(shlex.quote(path) for path in XFOIL)
    assert main(shlex.split(f"polar {files} --extension viterna --alpha 0:8:4 --re 7e4 3e5 --csv")) == 0
    out, err = capsys.readouterr()
    assert out.splitlines()[0] == "reynolds,alpha_deg,c_l,c_d,c_n,c_m,x_cp"
    assert len(out.splitlines()) == 7
    assert "3 polars make one model from Re 50000 to 200000" in err
    assert "warning: xfoil_naca4412: Re 300000 is outside 50000 to 200000: the nearest polar holds" in err
    assert main(["polar", "su-fan", "--re", "3e4"]) == 2
    assert "does not depend on Re" in capsys.readouterr().err
    line = f"glide --aero {files} pigeon --extension viterna --alpha 4:8:2 --json"
    assert main(shlex.split(line)) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["aero"]["reynolds_of_polars"] == [5e4, 1e5, 2e5]
    assert main(["validate", str(ROOT / "nothing.toml"), "--aero", *XFOIL]) == 2


@pytest.mark.slow
def test_an_orbit_with_a_family_is_certified_and_flies_again_from_its_file(tmp_path):
    problem = wb.OrbitProblem(PIGEON, 7.0, aero=family())
    orbit = wb.solve_orbit(problem)
    record = orbit.record()
    assert record["status"] == "converged"
    assert max(abs(miss) for miss in record["closure"].values()) < 1e-7
    assert record["aero"]["reynolds_of_polars"] == [5e4, 1e5, 2e5]
    assert "xfoil_naca4412 (3 polars, Re 50000 to 200000)" in " ".join(orbit.summary().split())
    (outside,) = [w for w in record["warnings"] if w.startswith("Reynolds number")]
    assert outside.endswith("there the nearest polar holds")
    orbit.save(tmp_path / "orbit.nc")
    again = wb.load_orbit(tmp_path / "orbit.nc")
    assert again.problem.aero == problem.aero
    assert again.record()["aero"] == record["aero"]
