"""Air loads wherever they are asked for: an object, a name, a path or a function; anything else is refused."""

import dataclasses
import math
import multiprocessing
import os
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.driven import BETWEEN, KNOTS, spline_torques
from wingbeat.cli import main
from wingbeat.experiment import fit_film, synthetic_film
from wingbeat.records.forms import inputs_hash
from wingbeat.records.inputs import problem_from

PIGEON = wb.load_species("pigeon")
SAMPLES = 128  # as in the tests of flights: models of one form then share what is traced
ANGLES = np.linspace(-math.pi, math.pi, 37)


def plate(alpha):
    """Return the formulas of `Wang2004`."""
    return 1.2 * jnp.sin(2 * alpha), 1.4 - jnp.cos(2 * alpha)


def draggy(alpha):
    return 1.2 * jnp.sin(2 * alpha), 2.4 - jnp.cos(2 * alpha)


draggy.__name__ = draggy.__qualname__ = "plate"
OWN = wb.OrbitProblem(PIGEON, speed=10.0, aero=plate)


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """The path of a table of Dickinson's coefficients."""
    path = tmp_path_factory.mktemp("aero") / "wing.csv"
    alpha, model = np.arange(0.0, 91.0, 2.5), wb.aero.Dickinson()
    rows = zip(alpha, model.lift(np.radians(alpha)), model.drag(np.radians(alpha)), strict=True)
    path.write_text("alpha_deg,c_l,c_d\n" + "".join(f"{','.join(map(str, row))}\n" for row in rows))
    return path


def spoken_of(model):
    """Return the numbers of a flight: what every function of a flight model sees of the air loads."""
    q, rates = np.array([0.0, 0.0, 0.1, 0.4, 0.2]), np.array([10.0, 0.5, 0.1, -20.0, 3.0])
    flight = wb.simulate(model, PIGEON.wingbeat, wb.State(u=10.0), beats=1, samples=SAMPLES)
    times, no_torques = np.linspace(0.0, 0.01, KNOTS // BETWEEN + 1), np.zeros((4, KNOTS, 2))
    knots = np.linspace(0.0, 0.01, KNOTS + 1)
    driven = wb.simulate_torque_driven(model, PIGEON.wingbeat, q, rates, spline_torques, times, (knots, no_torques))
    loads = wb.flight_loads(model, PIGEON.wingbeat, wb.State(u=10.0), np.linspace(0, 1, 2 * SAMPLES + 1))
    air = wb.air_forces(model, PIGEON.wingbeat, q, rates, 0.0)
    terms = wb.equations_of_motion(model, PIGEON.wingbeat, q, rates, 0.0)
    return [
        flight.states,
        driven.coordinates[::4],  # those that the integrator steps onto: between them errors are larger
        driven.rates[::4],
        np.asarray(loads.lift),
        np.asarray(air.generalised),
        np.asarray(terms.mass_matrix),
    ]


@pytest.mark.parametrize("name", ["su-fan", "dickinson", "whitney-wood"])
def test_a_name_is_its_model_to_the_last_bit(name):
    model = wb.aero.LIBRARY[name]()
    for given in (name, wb.aero.BladeElement(name)):
        one, other = (wb.FlightModel(PIGEON.vehicle, aero) for aero in (given, model))
        assert all(
            np.array_equal(a, b, equal_nan=True)
            for a, b in zip(jax.tree.leaves(one), jax.tree.leaves(other), strict=True)
        )
        assert wb.OrbitProblem(PIGEON, 10.0, aero=given) == wb.OrbitProblem(PIGEON, 10.0, aero=model)
    angles = np.radians([4.0, 6.0])
    assert wb.glide_polar(PIGEON, name, angles).record() == wb.glide_polar(PIGEON, model, angles).record()


def test_a_path_is_its_table(table):
    for given in (table, str(table), wb.aero.BladeElement(table)):
        assert wb.OrbitProblem(PIGEON, 10.0, aero=given).aero.coefficients == wb.aero.load_table(table)
    polar = wb.glide_polar(PIGEON, table, np.radians([5.0, 10.0]))
    assert polar.record()["aero"]["coefficients"] == "wing"


@pytest.mark.slow
def test_a_function_flies_as_the_model_of_the_same_formulas():
    own = wb.FlightModel(PIGEON.vehicle, plate)
    for found, expected in zip(spoken_of(own), spoken_of(wb.FlightModel(PIGEON.vehicle, "wang")), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-10)
    angles = np.radians([10.0, 20.0])
    glides = [wb.glide_polar(PIGEON, aero, angles).glides for aero in (plate, wb.aero.Wang2004())]
    np.testing.assert_allclose(*[[g[:-1] for g in polar] for polar in glides], rtol=1e-6, atol=1e-9)
    coefficients = wb.aero.coefficients_of(plate)
    np.testing.assert_allclose(coefficients.lift(ANGLES), wb.aero.Wang2004().lift(ANGLES), atol=1e-12)


@pytest.mark.slow
def test_an_orbit_of_a_function_says_so_and_keeps_it(tmp_path, capsys):
    orbit = wb.solve_orbit(OWN, starts=1)
    library = wb.solve_orbit(wb.OrbitProblem(PIGEON, speed=10.0, aero="wang"), starts=1)
    assert orbit.status is wb.Status.CONVERGED
    assert orbit.wingbeat.frequency == pytest.approx(library.wingbeat.frequency, rel=1e-6)
    said = orbit.record()["aero"]
    assert (said["coefficients"], said["function"][:14]) == ("plate", "the user's own")
    again = pickle.loads(pickle.dumps(orbit))
    assert (again.record(), again.problem) == (orbit.record(), orbit.problem)
    assert wb.sensitivities(again).table() == wb.sensitivities(orbit).table()
    beats = [dataclasses.replace(PIGEON.wingbeat, pitch_mean=mean) for mean in (0.13, 0.14)]
    assert wb.orbit_spread(again, beats).asked == 2
    path = tmp_path / "own.nc"
    orbit.save(path)
    loaded = wb.load_orbit(path)
    assert loaded.record() == orbit.record()
    with pytest.raises(ValueError, match=r"own function 'plate' is not in the file; set up the problem with"):
        _ = loaded.problem
    with pytest.raises(ValueError, match="is not in the file"):
        problem_from(orbit.inputs)
    capsys.readouterr()
    assert main(["show", str(path)]) == 0
    assert "plate, as given" in capsys.readouterr().out
    assert main(["orbit", "--from", str(path)]) == 2
    assert "the user's own function 'plate' is not in the file" in capsys.readouterr().err


@pytest.mark.slow
def test_two_functions_of_one_name_are_two():
    """In memory, on disk, in records, and where problems of a batch that are alike help one another."""
    other = wb.OrbitProblem(PIGEON, speed=10.0, aero=draggy)
    assert draggy.__name__ == plate.__name__
    assert OWN.aero.coefficients.name == other.aero.coefficients.name
    assert OWN.aero != other.aero
    for _ in range(2):  # the second time from memory
        flown = [
            wb.simulate(p.model, PIGEON.wingbeat, wb.State(u=10.0), 1, SAMPLES).states[-1] for p in (OWN, other)
        ]
        assert abs(flown[0] - flown[1]).max() > 0.01
    one, two = wb.solve_orbits([OWN, other], starts=1)
    assert one.wingbeat.frequency == pytest.approx(wb.solve_orbit(OWN, starts=1).wingbeat.frequency, rel=1e-6)
    assert abs(one.wingbeat.frequency - two.wingbeat.frequency) > 0.1
    assert one.record()["aero"]["function"] != two.record()["aero"]["function"]
    assert inputs_hash(one.inputs) != inputs_hash(two.inputs)  # as data sets keep it; theirs would be flown again


PROGRAM = """
import sys, numpy as np, jax.numpy as jnp, wingbeat as wb
from wingbeat._jax.exported import exported
from wingbeat._jax.config import cache_folder
@exported
def lift(kernel, alpha):
    return kernel.lift_drag(alpha)[0]
def lifts(gain):
    rows = jnp.asarray(np.linspace(0.0, 1.0, 3000)).at[1500].add(gain)
    def own(alpha):
        return jnp.interp(alpha, jnp.linspace(-4.0, 4.0, 3000), rows), 0.5
    return lift(wb.aero.coefficients_of(own).kernel(), np.linspace(-1.0, 1.0, 2001)).tobytes().hex()
for gain in sys.argv[1:]:
    print(lifts(float(gain)), len([path for path in cache_folder().rglob("traced-*")]))
"""


@pytest.mark.slow
def test_programs_on_disk_know_functions_of_one_name_apart(tmp_path):
    """The functions differ in one number out of 3000; the first to come leaves its program in an empty cache."""

    def ran(cache, *gains):
        environment = os.environ | {"WINGBEAT_CACHE": str(tmp_path / cache)}
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM, *gains], env=environment, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr
        return [line.split() for line in done.stdout.splitlines()]

    ((first, kept),) = ran("one", "0")
    found, other = ran("one", "0", "0.7")
    assert found == [first, kept]  # found again, not traced anew
    assert other[0] != first
    assert int(other[1]) > int(kept)
    ((alone, _),) = ran("other", "0.7")
    assert other[0] == alone


@pytest.mark.slow
def test_a_function_goes_to_other_processes_if_it_has_a_place_in_a_module():
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        there = pool.submit(wb.solve_orbit, OWN, 1).result(timeout=300)
    assert there.record()["aero"] == wb.solve_orbit(OWN, starts=1).record()["aero"]
    local = wb.OrbitProblem(PIGEON, speed=10.0, aero=lambda a: plate(a))
    with pytest.raises(wb.InvalidInputError, match=r"'<lambda>': is a function that cannot be pickled.*with def"):
        pickle.dumps(local)
    with pytest.raises(wb.InvalidInputError, match="cannot be pickled"):
        wb.solve_orbits([local, OWN], starts=1, processes=2)


def test_a_pickle_of_another_function_under_the_name_is_refused(monkeypatch):
    kept = pickle.dumps(wb.aero.coefficients_of(plate))
    monkeypatch.setattr(sys.modules[__name__], "plate", draggy)
    with pytest.raises(wb.InvalidInputError, match="differs from the function that was pickled"):
        pickle.loads(kept)


def jumpy(alpha):
    return (jnp.sin(alpha), 1.0) if alpha > 0 else (0.0, 1.0)


REFUSED = {
    "numpy in it": (lambda a: (np.sin(a), 1.0), "is not a function that JAX can trace .*in place of numpy"),
    "math in it": (lambda a: (math.sin(a), 1.0), "is not a function that JAX can trace"),
    "an if": (jumpy, r"'jumpy': is not a function that JAX can trace .*jnp\.where"),
    "an error of its own": (lambda a: a.nothing, "is not a function that JAX can trace .AttributeError"),
    "two angles": (lambda a, b: (a, b), "is not a function that JAX can trace .TypeError"),
    "one number": (jnp.sin, r"does not return two real numbers.*return \(C_L, C_D\)"),
    "three numbers": (lambda a: (a, a, a), "does not return two real numbers"),
    "arrays": (lambda a: (a * jnp.ones(3), a), "does not return two real numbers"),
    "complex": (lambda a: (a * 1j, a), "does not return two real numbers"),
    "texts": (lambda a: ("lift", "drag"), "is not a function that JAX can trace|does not return"),
    "not finite": (lambda a: (jnp.log(a), 1.0), "has C_L of nan at -180 degrees"),
    "infinite drag": (lambda a: (a, 1 / jnp.cos(a) ** 2 / (jnp.abs(a) > 0)), "has C_D of inf at 0 degrees"),
    "a kink without slope": (lambda a: (jnp.sqrt(jnp.abs(a)), 1.0), "a slope of C_L of"),
    "calls the host": (
        lambda a: (jax.pure_callback(np.sin, jax.ShapeDtypeStruct((), jnp.float64), a), 1.0),
        "has no derivative in JAX",
    ),
    "a model not called": (
        wb.aero.SuFan,
        r"'SuFan': is a class of coefficient models, not a model; call it: SuFan\(\)",
    ),
    "a number": (3, "is not a coefficient model; give SuFan"),
    "an unknown name": ("sufan", r"'sufan': is not a known coefficient model; did you mean su-fan\?"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_none_is_refused_at_every_door(what):
    given, words = REFUSED[what]
    film = fit_film(synthetic_film(PIGEON.wingbeat, 40, 0.5, seed=1))
    for door in (
        lambda: wb.OrbitProblem(PIGEON, 10.0, aero=given),
        lambda: wb.FlightModel(PIGEON.vehicle, given),
        lambda: wb.glide_polar(PIGEON, given),
        lambda: wb.aero.BladeElement(given),
        lambda: wb.filmed_problem(film, PIGEON, 10.0, aero=given),
    ):
        with pytest.raises(wb.InvalidInputError, match=words):
            door()


def test_a_missing_file_is_named():
    for door in (
        lambda: wb.OrbitProblem(PIGEON, 10.0, aero="none.csv"),
        lambda: wb.glide_polar(PIGEON, "none.toml"),
    ):
        with pytest.raises(wb.FileError, match=r"cannot read 'none\.\w+': no such file"):
            door()


def test_a_study_takes_names_and_paths_and_says_so(table, tmp_path):
    asked = {"species": "pigeon", "vary": {"speed": {"grid": [9.0, 10.0]}}, "store": tmp_path / "s.study.sqlite"}
    assert len(wb.plan_study(**asked, aero=["wang", str(table), "su-fan"])) == 6
    with pytest.raises(wb.InvalidInputError, match=r"did you mean wang\?"):
        wb.plan_study(**asked, aero="wnag")
    with pytest.raises(wb.InvalidInputError, match=r"cannot read .*none\.csv"):
        wb.plan_study(**asked, aero="none.csv")
    assert len(wb.plan_study(**asked, aero=table)) == 2
    for given in (plate, wb.aero.SuFan()):
        with pytest.raises(wb.InvalidInputError, match="aero"):
            wb.plan_study(**asked, aero=given)
