"""Air by altitude and temperature, against the published table; density and viscosity change together."""

import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.cli.problem_options import ModelOptions
from wingbeat.studies.form import check_form

# U.S. Standard Atmosphere 1976 (NASA-TM-X-74335), table I, by geometric altitude [m]: density [kg/m3], dynamic
# viscosity [Pa s], kinematic viscosity [m2/s].
TABLE = {
    0: (1.2250, 1.7894e-5, 1.4607e-5),
    2000: (1.0066, 1.7260e-5, 1.7147e-5),
    5000: (0.73643, 1.6282e-5, 2.2110e-5),
}


@pytest.mark.parametrize("altitude", TABLE)
def test_air_is_that_of_the_published_table(altitude):
    density, dynamic, kinematic = TABLE[altitude]
    air = wb.Air.at_altitude(altitude)
    assert air.density == pytest.approx(density, rel=5e-5)
    assert air.viscosity == pytest.approx(kinematic, rel=5e-5)  # not the dynamic one, which is printed beside it
    assert air.density * air.viscosity == pytest.approx(dynamic, rel=5e-5)
    assert air.gravity == 9.81


def hydrostatic(altitude, temperature=None):
    """Return density and kinematic viscosity from the constants of ICAO Doc 7488, integrated in small steps."""
    radius, lapse, gas, gravity = 6_356_766.0, 6.5e-3, 287.05287, 9.80665
    heights = np.linspace(0.0, altitude, 20_001)
    at = 288.15 - lapse * radius * heights / (radius + heights)
    # Weight falls with the square of the distance from the centre, and temperature with geopotential height.
    slope = -gravity * (radius / (radius + heights)) ** 2 / (gas * at)
    pressure = 101_325.0 * math.exp(np.sum(0.5 * (slope[1:] + slope[:-1]) * np.diff(heights)))
    kelvins = at[-1] if temperature is None else 273.15 + temperature
    density = pressure / (gas * kelvins)
    return density, 1.458e-6 * kelvins**1.5 / (kelvins + 110.4) / density


@pytest.mark.parametrize(("altitude", "temperature"), [(-500, None), (0, 35), (2000, -20), (9000, None), (9000, 5)])
def test_air_agrees_with_the_hydrostatic_equation(altitude, temperature):
    air = wb.Air.at_altitude(altitude, temperature)
    assert (air.density, air.viscosity) == pytest.approx(hydrostatic(altitude, temperature), rel=1e-5)


def test_altitude_is_geometric():
    """The table by geopotential altitude has 0.73612 at 5000 m: 0.04 % less."""
    assert wb.Air.at_altitude(5000.0).density / 0.73612 - 1 == pytest.approx(4.2e-4, abs=2e-5)


def test_a_temperature_keeps_the_pressure_of_the_altitude():
    cold, hot = (wb.Air.at_altitude(3000.0, warmth) for warmth in (-15.0, 30.0))
    assert cold.density * 258.15 == pytest.approx(hot.density * 303.15)
    assert hot.viscosity / cold.viscosity > 303.15 / 258.15  # thinner, and more viscous besides


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ((12_000.0,), "altitude = 12000.0: must be >= -500 and <= 9000 m; give metres above sea level"),
        ((-600.0,), "altitude = -600.0: must be >= -500"),
        (
            (0.0, 288.15),
            "temperature = 288.15: must be >= -60 and <= 60 deg C; this seems to be in kelvin: give 15",
        ),
        ((0.0, 77.0), "temperature = 77.0: must be >= -60 and <= 60 deg C; give degrees Celsius"),
        ((math.nan, math.inf), "altitude = nan: must be finite"),
        ((math.nan, math.inf), "temperature = inf: must be finite"),
        (("2 km",), "altitude = '2 km': must be a number"),
        ((0.0, 15.0, -1.0), "air.gravity = -1.0: must be >= 0"),
    ],
)
def test_what_no_animal_flies_in_is_refused(given, words):
    with pytest.raises(wb.InvalidInputError) as caught:
        wb.Air.at_altitude(*given)
    assert words in str(caught.value)


def test_a_species_says_where_its_air_comes_from():
    high = wb.load_species("pigeon").at_altitude(2000.0, 25.0)
    assert high.air == wb.Air.at_altitude(2000.0, 25.0)
    assert high.numbers["air.viscosity"].source.startswith("dry air at 2000 m, 25 deg C (ICAO")
    assert not [warning for warning in high.warnings if "air" in warning]
    assert wb.load_species("pigeon").at_altitude().air.density == pytest.approx(1.225, abs=1e-6)


def test_density_alone_warns_that_viscosity_did_not_follow():
    pigeon = wb.load_species("pigeon")
    (warning,) = pigeon.with_values({"air.density": 1.0}).warnings
    assert warning.startswith(
        "air.density is set and air.viscosity is not, so Reynolds numbers are those of other air"
    )
    assert not pigeon.with_values({"air.density": 1.0, "air.viscosity": 1.7e-5}).warnings
    assert not pigeon.with_values({"air.viscosity": 1.7e-5}).warnings


def test_options_set_both_and_the_answer_says_so(capsys):
    animal, _ = ModelOptions(altitude=2000.0, temperature=-5.0).flown("pigeon", ["wing.mass=0.02"])
    assert animal.air == wb.Air.at_altitude(2000.0, -5.0)
    said = capsys.readouterr().err
    assert said.startswith(
        "note: dry air at 2000 m, -5 deg C (ICAO standard atmosphere, Doc 7488): density 1.033 kg/m3"
    )
    assert "kinematic viscosity 1.637e-05 m2/s" in said
    ModelOptions().flown("pigeon", ["air.density=1.0"])
    assert capsys.readouterr().err.startswith("warning: air.density is set and air.viscosity is not")
    ModelOptions().flown("pigeon", None)
    assert capsys.readouterr().err == ""


def test_options_that_contradict_are_refused_together():
    with pytest.raises(wb.InvalidInputError) as caught:
        ModelOptions(altitude=20_000.0).flown("pigeon", ["air.density=1.0", "air.viscosity=2e-5"])
    first, second, third = str(caught.value).splitlines()
    assert first == "--set = 'air.density=1.0': is what --altitude sets; keep one of them"
    assert second.startswith("--set = 'air.viscosity=2e-5'")
    assert third.startswith("--altitude = 20000.0: must be >= -500 and <= 9000 m")


def test_a_study_has_an_altitude(tmp_path):
    study = {"species": "pigeon", "speed": 10.0, "altitude": 2000, "temperature": 5.0}
    problem = wb.plan_study(study, store=tmp_path / "high.study.sqlite").plan.bases[0].recipe.example
    assert problem.air == wb.Air.at_altitude(2000.0, 5.0)
    study |= {"set": {"air.density": 1.0}, "vary": {"air.viscosity": {"grid": [1e-5, 2e-5]}}}
    _, faults = check_form(study)
    assert [fault.where for fault in faults.faults] == ["set.air.density", "vary.air.viscosity"]
