"""Orbits with the lag of the wake: an oracle that integrates each strip's wake anew, derivatives, and doors."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

import wingbeat as wb
from wingbeat.mechanics.flights import fly_beats
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.solution import correct_guess
from wingbeat.orbits.starts import start_point

LOADS = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil", wake="jones-section")
JONES = {"jones-section": ((0.165, 0.0455), (0.335, 0.3))}


def problem_of(name="pigeon", **changes):
    aero = dataclasses.replace(LOADS, **changes)
    return wb.OrbitProblem(wb.load_species(name), speed=12.0, minimise="mean_positive_power", aero=aero)


@pytest.fixture(scope="module")
def orbit():
    found = wb.solve_orbit(problem_of(), starts=2)
    assert found.status.value == "converged"
    return found


# --- An independent oracle


def periodic(phase, values):
    return CubicSpline(phase, np.concatenate([values[:-1], values[:1]]), bc_type="periodic")


@pytest.mark.slow
def test_the_wake_of_each_strip_is_that_of_an_integrator(orbit):
    """Speeds, chords and turning follow from the strips' corners and velocities in the data set alone."""
    data, phase = orbit.dataset, orbit.dataset["phase"].values
    period = 1.0 / orbit.wingbeat.frequency
    corner, velocity = data["strip_corner"].values, data["strip_velocity"].values
    fore = 0.5 * (corner[:, :, 0] + corner[:, :, 1] - corner[:, :, 2] - corner[:, :, 3])
    out = corner[:, :, 1] - corner[:, :, 0]
    chord = np.linalg.norm(fore, axis=-1)
    along = fore / chord[..., None]
    normal = np.cross(along, out)
    normal /= np.linalg.norm(normal, axis=-1)[..., None]
    along_speed, normal_speed = (velocity * along).sum(-1), (velocity * normal).sum(-1)
    turning = (normal * periodic(phase, along).derivative()(phase) / period).sum(-1)
    model = orbit.problem.aero.coefficients
    angles = np.linspace(0.0, 0.5 * math.pi, 901)
    stall = angles[model.lift(angles).argmax()]
    alpha, speed = np.arctan2(-normal_speed, along_speed), np.hypot(along_speed, normal_speed)
    held = speed * math.sin(stall) * model.lift(alpha) / model.lift(stall)
    shed = np.where(np.abs(alpha) > stall, held, -normal_speed) + 0.5 * chord * turning
    pace, source = periodic(phase, 2 * speed / chord * period), periodic(phase, shed)
    wanted = np.zeros_like(shed)
    for share, rate in JONES["jones-section"]:

        def slope(at, z, rate=rate):
            return rate * pace(at % 1.0) * (source(at % 1.0) - z)

        # What the wake was at first is forgotten after 20 beats.
        end = solve_ivp(slope, (0.0, 20.0), shed[0], rtol=1e-9, atol=1e-10).y[:, -1]
        state = solve_ivp(slope, (0.0, 1.0), end, t_eval=phase, rtol=1e-9, atol=1e-10).y.T
        wanted += share * (shed - state)
    found = data["wake_downwash"].values
    assert np.abs(found).max() > 0.3
    np.testing.assert_allclose(found, wanted, atol=3e-3 * np.abs(wanted).max())
    # The polar is read in the moved air, and the strip's lift and drag turn with it.
    moved = np.arctan2(-(normal_speed + wanted), along_speed)
    np.testing.assert_allclose(data["alpha"].values, moved, atol=3e-3)


@pytest.mark.slow
def test_the_record_says_that_the_wake_closes_and_how_much_of_the_beat_is_detached(orbit):
    record, data = orbit.record(), orbit.dataset
    assert 0 <= record["wake_closure"] < 1e-7
    assert record["aero"]["wake"] == "jones-section"
    areas = np.ones(10) / 10
    beyond = np.abs(data["alpha"].values) > math.radians(40.2)
    share = np.trapezoid(beyond @ areas, data["phase"].values)
    assert record["detached_share"] == pytest.approx(share, abs=0.01)
    # The power of the air and of the actuators changes the energy.
    energy = periodic(data["phase"].values, (data["kinetic_energy"] + data["potential_energy"]).values)
    rate = energy.derivative()(data["phase"].values) * orbit.wingbeat.frequency
    np.testing.assert_allclose(
        rate, (data["actuator_power"] + data["air_power"]).values, atol=2e-3 * np.abs(data["actuator_power"]).max()
    )
    spent = sum(data[f"{name}_power"].values for name in ("profile", "induced", "parasite", "unsteady"))
    np.testing.assert_allclose(spent, -data["air_power"].values, atol=1e-9 * np.abs(spent).max())
    multipliers = np.hypot(*np.transpose(record["floquet_multipliers"]))
    assert multipliers.size == 4
    assert (np.diff(multipliers) <= 1e-9).all()


@pytest.mark.slow
def test_a_kept_orbit_is_read_back(orbit, tmp_path):
    orbit.save(tmp_path / "orbit.nc")
    again = wb.load_orbit(tmp_path / "orbit.nc")
    assert again.record() == orbit.record()
    assert again.problem.aero == orbit.problem.aero
    flown = certify(again.problem.model, again.wingbeat, again.initial_state[2:])
    assert flown.wake_miss < 1e-9


# --- Derivatives


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("pigeon", {}),
        ("bat", {"wake": "jones-finite", "unsteady": "none"}),
        ("pigeon", {"inflow": "momentum", "hand": "feathered", "share": 0.7}),
    ],
)
@pytest.mark.parametrize("blocks", [1, 2])
def test_derivatives_are_those_of_finer_differences(name, changes, blocks):
    problem = problem_of(name, **changes)
    fly = flier(problem.model, problem.species.wingbeat, problem.free, whole_path=True)
    point = start_point(problem, 1, 0)
    fly(point[4:], point[:4], blocks)  # finds the wake
    here = fly(point[4:], point[:4], blocks)
    for i, size in enumerate(problem.unknowns().scale):
        step = 1e-5 * size * np.eye(len(point))[i]

        def ends(times, step=step):
            flown = fly((point + times * step)[4:], (point + times * step)[:4], blocks)
            return np.concatenate([flown.end, flown.path.ravel()])

        slope = (8 * (ends(1) - ends(-1)) - (ends(2) - ends(-2))) / (12 * 1e-5 * size)
        exact = np.concatenate([here.end_jacobian[:, i], here.path_jacobian[..., i].ravel()])
        np.testing.assert_allclose(exact, slope, atol=1e-7 * max(1.0, np.abs(exact).max()))


@pytest.mark.slow
def test_the_sensitivities_and_error_bars_of_an_orbit_know_the_lag(orbit):
    found = wb.sensitivities(orbit)
    slopes = {slope.parameter.path: slope.objective for slope in found.slopes}
    mass = orbit.problem.vehicle.body.mass
    powers = []
    for factor in (0.999, 1.001):
        moved = dataclasses.replace(
            orbit.problem, species=orbit.problem.species.with_values({"body.mass": factor * mass})
        )
        powers.append(wb.solve_orbit(moved, start=orbit, starts=1).record()["objective_value"])
    assert slopes["body.mass"] == pytest.approx((powers[1] - powers[0]) / (0.002 * mass), rel=1e-3)
    bar = found.error_bar("mean_positive_power")
    assert bar.deviation > 0


@pytest.mark.slow
def test_the_multipliers_move_as_those_of_orbits_with_the_lag_solved_again(orbit):
    """The monodromy matrix of the certifier has the states of the wake; so must the derivatives."""
    causes = wb.stability_sensitivities(orbit)
    certified = wb.floquet_multipliers(
        orbit.problem.model,
        orbit.wingbeat,
        wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:]).steps,
    )
    np.testing.assert_allclose(causes.multipliers, certified, rtol=0, atol=2e-4)
    checked = 0
    for slope in causes.sensitivities.slopes:
        parameter, step = slope.parameter, {"wing.shoulder.x": 2e-4, "body.mass": 1e-3}.get(slope.parameter.path)
        if step is None:
            continue
        moved = np.array([*slope.initial_state.values(), *slope.wingbeat.values()])
        below, above = (
            correct_guess(parameter.changed(orbit.problem, parameter.value + by), orbit.unknowns + by * moved)
            for by in (-step, step)
        )
        anew = (above.multipliers - below.multipliers) / (2 * step)
        found = causes.by_parameter[parameter.path]
        np.testing.assert_allclose(found, anew, rtol=0, atol=0.02 * np.abs(anew).max())
        checked += 1
    assert checked == 2


def test_a_wake_that_does_not_repeat_is_known():
    """A beat after which the wake is another one counts as not closed, and flights that are enough find one."""
    problem = problem_of()
    point = start_point(problem, 1, 0)
    few, enough = (
        Transcription(problem, wb.SolverOptions(wake=wb.WakeOptions(most_flights=most))) for most in (1, 20)
    )
    assert not few.inner_start(few.scaled(point)).repeats
    assert enough.inner_start(enough.scaled(point)).repeats
    assert not few.is_closed(few.scaled(point), np.inf)
    assert enough.is_closed(enough.scaled(point), np.inf)
    once = certify(problem.model, problem.wingbeat(point), point[:4], lag=wb.WakeOptions(certifying_flights=1))
    assert once.wake_miss > 1e-3


def test_parallel_searches_do_not_share_the_wake_they_remember():
    """A flight of one copy leaves no trace in the flights of another."""
    problem = problem_of()
    points = [start_point(problem, i, 0) for i in (1, 2)]
    alone, parent = Transcription(problem), Transcription(problem)
    first, second = parent.uncorrected(), parent.uncorrected()
    second.point(second.scaled(points[1]))
    one, other = (each.point(each.scaled(points[0])) for each in (alone, first))
    for wanted, found in zip(one, other, strict=True):
        np.testing.assert_array_equal(wanted, found)


# --- Doors


def test_what_knows_no_wake_refuses_it():
    problem = problem_of()
    with pytest.raises(wb.InvalidInputError, match="leave the wake out"):
        wb.flight_loads(problem.model, problem.species.wingbeat, wb.State(u=12.0), np.zeros(3))
    with pytest.raises(wb.InvalidInputError, match="leave the wake out"):
        fly_beats(problem.model, problem.species.wingbeat, wb.State(u=12.0), 1, 8)
    with pytest.raises(wb.InvalidInputError, match="straight flow"):
        wb.aero.BladeElement("dickinson", wake="jones-section")
    with pytest.raises(wb.InvalidInputError, match="leave the wake out"):
        wb.OrbitProblem(problem.species, speed=12.0, aero=LOADS, subject_to=["spectral_radius<=0.9"])
    stubby = problem.species.with_values({"wing.chord": 0.4})
    with pytest.raises(wb.InvalidInputError, match="aspect ratio"):
        wb.OrbitProblem(stubby, speed=12.0, aero=dataclasses.replace(LOADS, wake="jones-finite"))


@pytest.mark.slow
def test_what_reads_a_map_of_four_states_refuses_the_lag(orbit):
    with pytest.raises(wb.InvalidInputError, match="gust_response does not know"):
        wb.sensitivities(orbit, ["gust_response"])
