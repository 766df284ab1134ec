"""Certified orbits of wings whose pitch gives way: closure, energy, derivatives, and what is done with orbits."""

import dataclasses
import functools
import itertools

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import wingbeat as wb
from tests.helpers.differences import differences, miss
from tests.helpers.engines import Here
from wingbeat._jax.exported import StoredFunction
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import fly_through
from wingbeat.orbits.flight.period import STEPS, flier
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.studies.stopping import Stop

pytestmark = pytest.mark.slow

TOLERANCE = 1e-7
AIR = {
    "steady": wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure"),
    "unsteady": wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure", unsteady="thin-aerofoil"),
}
# Best fits of spring and damper to the pitch torque of the same robot's optimum with a prescribed pitch.
SPRING = {"pitch_hinge.stiffness": 1.395, "pitch_hinge.damping": 0.0166, "pitch_hinge.rest_angle": -0.314}
BOUNDS = {"hinge_rest_angle": (-1.0, 1.0), "hinge_stiffness": (0.1, 10.0), "hinge_damping": (0.0, 0.1)}
OWN = ("hinge_stiffness", "hinge_damping")


def problem(air="steady", free=(), numbers=None, **asked):
    species = wb.load_species("robofalcon2").with_values(SPRING | (numbers or {}))
    free = ("frequency", "flap_mean", "flap_amplitude", "hinge_rest_angle", *free)
    asked = {"speed": 8.0, "minimise": "mean_positive_power", "aero": AIR[air], "free": free} | asked
    asked["bounds"] = {name: BOUNDS[name] for name in free if name in BOUNDS}
    return wb.OrbitProblem(species, **asked)


@functools.cache
def orbit_of(air="steady"):
    orbit = wb.solve_orbit(problem(air), starts=1)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    return orbit


@pytest.mark.parametrize("air", AIR)
def test_body_and_hinge_return_after_a_beat(air):
    orbit = orbit_of(air)
    record, free = orbit.record(), orbit.wingbeat
    flown = wb.certify(orbit.problem.model, free, orbit.initial_state[2:])
    assert max(map(abs, record["closure"].values())) <= 1e-6
    assert flown.hinge_miss <= 1e-8
    assert np.abs(flown.states[-1, 2:] - flown.states[0, 2:]).max() <= 1e-6
    assert flown.hinge[0, 0] == pytest.approx(float(orbit.dataset["hinge_angle"][0]), abs=1e-6)
    # A hinge that starts elsewhere does not return.
    moved = np.append(orbit.initial_state, flown.hinge[0] + [1e-3, 0.0])
    end, _ = fly_through(orbit.problem.model, free, State(*moved[:6]), np.array([0.0, 1.0]), wake=(moved[6:],))
    assert np.abs(end[-1, 6:] - moved[6:]).max() > 1e-4


@pytest.mark.parametrize("air", AIR)
def test_what_the_actuators_put_in_air_and_damper_take_out(air):
    """Means over a beat by splines through separate evaluations; the spring gives back what it takes."""
    orbit = orbit_of(air)
    model, beat, hinge = orbit.problem.model, orbit.wingbeat, orbit.wingbeat.pitch_hinge
    phase = np.linspace(0.0, 1.0, 2049)
    start = wb.certify(model, beat, orbit.initial_state[2:]).hinge[0]
    states, _ = fly_through(model, beat, orbit.initial_state, phase, wake=(start,))
    now = wb.flight_loads(model, beat, State(*states[:, :6].T), phase, hinge=states[:, 6:])
    rate, angle = states[:, 7], states[:, 6]
    lost, spring = hinge.damping * rate**2, -hinge.stiffness * (angle - hinge.rest_angle) * rate
    powers = np.stack([now.actuator_power, now.air_power, lost, spring, now.hinge_power], axis=-1)
    put_in, air_power, lost, spring, hinges = CubicSpline(phase, powers).integrate(0.0, 1.0)
    assert abs(put_in + air_power - lost) <= 1e-6 * put_in
    assert abs(spring) <= 1e-6 * put_in
    assert lost > 1e-2 * put_in
    assert hinges == pytest.approx(put_in, rel=1e-9)  # the flap hinges alone: nothing drives the pitch
    assert np.abs(now.pitch_torque).max() == 0.0
    assert orbit.record()["mean_actuator_power"] == pytest.approx(put_in, rel=1e-5)


# --- Derivatives by all unknowns, the hinge's own among them


def near(asked, orbit):
    """Return unknowns near the orbit's, off the optimum and its bounds."""
    unknowns = asked.unknowns_of(orbit.initial_state, orbit.wingbeat)
    return unknowns * np.random.default_rng(4).uniform(0.95, 0.99, unknowns.size)


@pytest.mark.parametrize("air", AIR)
@pytest.mark.parametrize("blocks", [1, 3])
def test_end_and_path_of_a_period(air, blocks):
    orbit = orbit_of(air)
    asked = problem(air, free=OWN)
    fly = flier(orbit.problem.model, asked.species.wingbeat, asked.free, whole_path=True)
    point = near(asked, orbit)

    def flown(values):
        period = fly(values[4:], values[:4], blocks)
        assert period.inner.repeats
        return np.concatenate([period.end, period.path.ravel(), period.inner.states])

    found, scale = fly(point[4:], point[:4], blocks), np.abs(point) + 0.1
    wanted = differences(flown, point, 2e-6 * scale) * scale
    assert miss(found.end_jacobian * scale, wanted[:6]) <= 2e-7
    states = found.path.shape[1]
    assert found.path_jacobian.shape == (blocks * STEPS + 1, states, point.size)
    components = wanted[6:-2].reshape(-1, states, point.size).swapaxes(0, 1)
    for one, other in zip((found.path_jacobian * scale).swapaxes(0, 1), components, strict=True):
        assert np.abs(one - other).max() <= 2e-7 * np.abs(one).max()
    assert np.abs(wanted[:6, -2:]).max() > 1e-4  # stiffness and damping do change the flight


@pytest.mark.parametrize("minimise", ["mean_positive_power", "peak_power"])
def test_closure_margins_and_objective_of_the_programme(minimise):
    orbit = orbit_of()
    asked = problem(free=OWN, minimise=minimise)
    programme = Transcription(asked)
    point = programme.scaled(near(asked, orbit))

    def compare(exact, function, tolerance=TOLERANCE):
        assert miss(exact, differences(function, point, 1e-5)) <= tolerance

    compare(programme.closure_jacobian(point), programme.closure, 4e-7)
    compare(programme.inequalities_jacobian(point), programme.inequalities, 1e-6)
    compare(programme.objective_gradient(point)[None], lambda x: np.array([programme.objective(x)]), 1e-6)


# --- A rigid hinge


def test_an_orbit_of_a_stiff_hinge_tends_to_that_of_a_prescribed_pitch():
    """From the same state, the end of a beat differs from that of a constant pitch by a part that goes as 1/k."""
    orbit = orbit_of()
    model, start, rest = orbit.problem.model, orbit.initial_state, orbit.wingbeat.pitch_hinge.rest_angle
    constant = dataclasses.replace(orbit.wingbeat, pitch_hinge=None, pitch_mean=rest, pitch_amplitude=0.0)
    rigid, gaps = wb.certify(model, constant, start[2:]), []
    for factor in (30.0, 90.0, 270.0):
        hinge = wb.PitchHinge(1.4 * factor, 0.0166 * factor**0.5, rest)
        flown = wb.certify(model, dataclasses.replace(orbit.wingbeat, pitch_hinge=hinge), start[2:])
        assert flown.hinge_miss <= 1e-8
        gaps.append(np.abs(flown.end - rigid.end).max())
    assert gaps[0] < 1.0
    for stiff, stiffer in itertools.pairwise(gaps):
        assert stiffer == pytest.approx(stiff / 3.0, rel=0.25)


# --- What is done with orbits


def test_a_saved_orbit_is_read_back_whole(tmp_path):
    orbit = orbit_of()
    orbit.save(tmp_path / "hinge.nc")
    again = wb.load_orbit(tmp_path / "hinge.nc")
    without = {"pitch_mean": 0.0, "pitch_amplitude": 0.0}  # which the hinge replaces
    assert again.wingbeat == dataclasses.replace(orbit.wingbeat, **without)
    assert again.record()["hinge_start"] == orbit.record()["hinge_start"]
    series = ("hinge_angle", "hinge_rate", "hinge_torque")
    for name in series:
        np.testing.assert_array_equal(again.dataset[name].values, orbit.dataset[name].values)
    solved = wb.solve_orbit(again.problem, starts=1, start=again)
    assert solved.record()["mean_positive_power"] == pytest.approx(orbit.record()["mean_positive_power"], rel=1e-6)


def test_sensitivities_to_spring_and_damper_are_those_of_orbits_solved_anew():
    orbit = orbit_of()
    slopes = {one.parameter.path: one for one in wb.sensitivities(orbit).slopes}
    for path, step in (("pitch_hinge.stiffness", 0.02), ("pitch_hinge.damping", 4e-4)):
        value, powers = SPRING[path], []
        for side in (1, -1):
            near = problem(numbers={path: value + side * step})
            solved = wb.solve_orbit(near, starts=1, start=orbit)
            powers.append(solved.record()["mean_positive_power"])
        wanted = (powers[0] - powers[1]) / (2 * step)
        assert slopes[path].objective == pytest.approx(wanted, rel=0.02)


def test_axis_and_mass_centre_are_uncertain_also_where_the_species_file_is_silent():
    orbit = orbit_of()
    found, step = wb.sensitivities(orbit), 0.01
    slopes = {one.parameter.path: one for one in found.slopes}
    for path, value, ends in (("wing.pitch_axis", 0.25, (0.15, 0.35)), ("wing.mass_axis", 0.5, (0.4, 0.6))):
        own, powers = slopes[path].parameter, []
        assert own.guessed
        assert own.plausible == pytest.approx(ends)
        assert sum(path in line and "a guess" in line for line in found.guesses) == 1
        for side in (1, -1):
            solved = wb.solve_orbit(problem(numbers={path: value + side * step}), starts=1, start=orbit)
            powers.append(solved.record()["mean_positive_power"])
        wanted = (powers[0] - powers[1]) / (2 * step)
        assert slopes[path].objective == pytest.approx(wanted, rel=0.05)
        assert found.error_bar("mean_positive_power").due_to[path] > 0


def test_a_wing_that_does_not_give_way_or_whose_axis_is_given_has_no_guessed_range():
    pigeon = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    given = problem(numbers={"wing.pitch_axis": 0.3})
    assert not any(one.guessed or one.path == "wing.pitch_axis" for one in parameters_of(pigeon))
    assert [one.path for one in parameters_of(given) if one.guessed] == ["wing.mass_axis"]


def test_error_bars_of_first_order_are_those_of_orbits_drawn():
    slopes, power = wb.sensitivities(orbit_of()), "mean_positive_power"
    drawn = wb.uncertainty_by_samples(slopes, [power], samples=12, share=0.05)[power]
    assert drawn.certified == 12
    assert drawn.deviation == pytest.approx(slopes.error_bar(power, share=0.05).deviation, rel=0.25)


def test_a_hinge_as_built_does_not_fly_every_wing_that_the_ranges_allow():
    """A wing of twice the mass has no orbit on the best spring of the nominal one, also from many starts."""
    built = {"pitch_hinge.stiffness": 1.49, "pitch_hinge.damping": 0.0163}
    orbit = wb.solve_orbit(problem(numbers=built), starts=2)
    one = wb.uncertainty_by_samples(wb.sensitivities(orbit), ["frequency"], samples=16)["frequency"]
    assert one.unsolved is not None
    assert one.certified + one.unsolved.draws == one.drawn == 16
    assert 4 <= one.certified <= 8
    assert sum(one.unsolved.short.values()) == one.unsolved.draws
    # The range of the wing's mass is 0.4 to 2.5 times its value.
    (path, (flown, without)), *_ = one.unsolved.differ.items()
    assert path == "wing.mass"
    assert without > 1.5 * flown
    assert one.guessed == ("wing.pitch_axis", "wing.mass_axis")
    heavy = problem(numbers=built | {"wing.mass": 2.1 * problem().vehicle.wing.mass})
    assert wb.solve_orbits([heavy], starts=12)[0].status is wb.Status.INFEASIBLE


def test_the_best_spring_beats_the_one_that_was_given():
    orbit = orbit_of()
    best = wb.solve_orbit(problem(free=OWN), starts=1, start=orbit)
    assert best.status is wb.Status.CONVERGED, best.message
    powers = [one.record()["mean_positive_power"] for one in (best, orbit)]
    assert powers[0] < 0.998 * powers[1]
    assert best.wingbeat.pitch_hinge.stiffness == pytest.approx(1.49, abs=0.01)  # within its bounds


def test_curves_over_speed_have_a_hinge_at_every_speed():
    curve = wb.solve_curve(problem(), [7.5, 8.0, 8.5], starts=1)
    assert [point["status"] for point in curve.record()["points"]] == ["converged"] * 3


def test_a_study_varies_the_stiffness(tmp_path):
    form = {
        "species": "robofalcon2",
        "force_point": "centre-of-pressure",
        "set": {"pitch_hinge.stiffness": 1.4, "pitch_hinge.damping": 0.0166},
        "speed": 8.0,
        "minimise": "mean_positive_power",
        "starts": 1,
        "vary": {"pitch_hinge.stiffness": {"grid": [1.2, 1.4, 1.8]}},
    }
    study = wb.plan_study(form, store=tmp_path / "hinge.study.sqlite")
    study.run_on(Here(), Stop())
    done = study.to_dataframe()
    assert done["status"].tolist() == ["converged"] * 3
    powers = done["mean_positive_power"].to_numpy()
    assert np.ptp(powers) > 0.1


@pytest.mark.parametrize(
    ("stiffness", "damping", "told"),
    [(0.02, 0.0, "spring and damper of the hinge are too weak"), (0.2, 0.004, "thrust is short of drag by")],
)
def test_what_a_soft_hinge_cannot_do_is_told_in_words(stiffness, damping, told):
    few = wb.SolverOptions(search=wb.SearchOptions(most_starts=4))
    soft = problem(numbers={"pitch_hinge.stiffness": stiffness, "pitch_hinge.damping": damping})
    orbit = wb.solve_orbit(soft, starts=1, options=few)
    assert orbit.status is wb.Status.INFEASIBLE
    assert told in orbit.message


def test_loading_programs_leaves_nothing_behind(monkeypatch):
    """The states of the hinge with which a search began were once those of the flight that loaded the programs."""
    soft = problem(numbers={"pitch_hinge.stiffness": 0.1, "pitch_hinge.damping": 0.002})
    settings = Settings(3, most_starts=3, explain=False)
    find_orbit(soft, settings, threads=1)  # loads them
    found = find_orbit(soft, settings, threads=1)
    monkeypatch.setattr(StoredFunction, "loaded", False)
    again = find_orbit(soft, settings, threads=1)
    assert again.unknowns.tolist() == found.unknowns.tolist()


# --- Robots. Wanted numbers are those of a prototype apart from the package, with its own shooting and optimiser


ROBOTS = {
    # frequency [Hz], flap amplitude [deg], mean power [W], largest multiplier
    "robofalcon2": ((1.40, 0.0166, -18.0), 8.0, "steady", (6.89, 34.1, 72.6, 1.16)),
    "purdue-hummingbird": ((0.0144, 8.4e-6, 0.0), 0.0, "unsteady", (48.6, 29.7, 0.73, 1.04)),
}


@pytest.mark.parametrize("name", ROBOTS)
def test_published_robots_fly_as_in_a_prototype(name):
    (stiffness, damping, rest), speed, air, wanted = ROBOTS[name]
    numbers = {"stiffness": stiffness, "damping": damping, "rest_angle": np.radians(rest).item()}
    species = wb.load_species(name).with_values({f"pitch_hinge.{key}": value for key, value in numbers.items()})
    asked = {"minimise": "mean_positive_power", "aero": AIR[air], "bounds": {"hinge_rest_angle": (-1.0, 1.0)}}
    orbit = wb.solve_orbit(wb.OrbitProblem(species, speed=speed, **asked), starts=2)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    record, beat = orbit.record(), orbit.wingbeat
    largest = np.abs([complex(*one) for one in record["floquet_multipliers"]]).max()
    found = beat.frequency, np.degrees(beat.flap_amplitude), record["mean_power"], largest
    np.testing.assert_allclose(found, wanted, rtol=0.05)


@pytest.mark.parametrize("speed", [6.0, 8.0, 10.0])
def test_a_robot_of_half_a_kilogram_flies_at_three_speeds(speed):
    tail = {"tail_area": 0.03, "tail_arm": 0.3, "tail_lift_slope": 3.0}
    robot = wb.robot(mass=0.45, wing_span=1.0, wing_area=0.18, frequency_range=(2, 10), **tail)
    hinge = {"pitch_hinge.stiffness": 1.1, "pitch_hinge.damping": 0.007, "pitch_hinge.rest_angle": -0.4}
    free = ("frequency", "flap_mean", "flap_amplitude", "hinge_rest_angle", "tail_tilt")
    bounds = {"hinge_rest_angle": (-1.0, 1.0), "tail_tilt": (-0.6, 0.6)}
    asked = {"minimise": "mean_positive_power", "aero": AIR["steady"], "free": free, "bounds": bounds}
    orbit = wb.solve_orbit(wb.OrbitProblem(robot.with_values(hinge), speed=speed, **asked), starts=1)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    assert orbit.record()["hinge_closure"] <= 1e-6
