"""Laws that hold whatever the coefficients: momentum, energy, and what a change of frame or scale leaves alone."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.differences import flow_of, rates_along
from tests.helpers.models import changed
from tests.helpers.programs import compiled
from tests.helpers.reflight import refly, refly_many
from wingbeat._jax.arrays import jax, jnp
from wingbeat.mechanics.equations_of_motion import generalised_torques

EXACT = 1e-11
ODD_WING = wb.Wing(0.30, 0.12, 0.0048, 0.94, (0.03, 0.02, 0.01), math.radians(75))
ODD = wb.Vehicle(wb.Body(0.0584, 2.4e-5, 1e-3), ODD_WING)
ODD_BEAT = wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, 0.3, 1.6, 0.4, 0.45)
PHASES = np.linspace(0.0, 1.0, 257)  # as many as the certifier samples, so that JAX compiles once


def odd_model(vehicle=ODD, air=None, airspeed="planar"):
    return wb.FlightModel(vehicle, wb.aero.BladeElement(wb.aero.SuFan(), airspeed=airspeed), air or wb.Air())


def odd_states(seed=0):
    """Return random states, one for each of `PHASES`."""
    low, high = [-1, -1, -1, -2, -3, -8], [1, 1, 1, 12, 3, 8]
    return wb.State(*np.random.default_rng(seed).uniform(low, high, (PHASES.size, 6)).T)


def loads(model, wingbeat, state, phase=PHASES):
    return jax.tree.map(np.asarray, wb.flight_loads(model, wingbeat, state, phase))


def momenta_at_both_ends(model, wingbeat, *states):
    """Return the momenta (2, 2) at phases 0 and 1; the other phases are there to be as many as ever."""
    between = np.linspace(*states, PHASES.size)
    return loads(model, wingbeat, wb.State(*between.T)).momentum[[0, -1]]


def held_by(flight):
    """Return what a flight holds: energy, momentum (x, z), angular momentum, centre of mass (x, z)."""
    energy = flight.kinetic_energy + flight.potential_energy
    return jnp.stack([energy, *flight.momentum.T, flight.angular_momentum, *flight.centre_of_mass.T])


@compiled
def exact_rates(model, wingbeat, state, phase, flow):
    """Return the rates of `held_by` along a flight, as JAX differentiates the loads."""
    per_second = wingbeat.frequency * jnp.ones_like(phase)
    return jax.jvp(lambda *at: held_by(wb.flight_loads(model, wingbeat, *at)), (state, phase), (flow, per_second))[
        1
    ]


def along_orbit(solved):
    return solved.model, solved.wingbeat, *solved.samples


def along_nothing(airspeed="planar"):
    """States that no orbit ever has, with body drag, an offset shoulder and a tilted stroke plane."""
    return odd_model(airspeed=airspeed), ODD_BEAT, odd_states(), PHASES


@pytest.fixture(scope="module", params=["pigeon", "bat", "random states", "full airspeed"])
def flown(request):
    """Model, loads, and rates of change along both orbits and at random states."""
    if request.param in ("random states", "full airspeed"):
        model, *flight = along_nothing("full" if request.param == "full airspeed" else "planar")
    else:
        model, *flight = along_orbit(request.getfixturevalue(f"{request.param}_orbit"))
    now = loads(model, *flight)
    energy, x, z, angular, *centre = rates_along(loads, held_by, model, *flight, now.acceleration)
    return model, flight[1], now, (energy, np.stack([x, z], axis=-1), angular, np.stack(centre, axis=-1))


def test_energy_changes_by_the_actuators_and_the_air(flown):
    _, _, now, (energy, *_) = flown
    peak = np.abs(now.actuator_power).max()
    assert np.abs(energy - now.actuator_power - now.air_power).max() <= 1e-6 * peak
    # Hinge power alone misses what retraction and fold deliver.
    assert np.abs(energy - now.hinge_power - now.air_power).max() > 1e-3 * peak


def test_momentum_changes_by_air_loads_and_weight(flown):
    model, _, now, (_, momentum, _, centre) = flown
    weight = model.vehicle.mass * model.air.gravity
    pushed = now.air_force[:, :2] - [0.0, weight]
    assert np.abs(momentum - pushed).max() <= EXACT * np.abs(pushed).max()
    assert np.abs(model.vehicle.mass * centre - now.momentum).max() <= EXACT * np.abs(now.momentum).max()


def test_angular_momentum_changes_by_the_moment_about_the_centre_of_mass(flown):
    _, state, now, (_, _, angular, _) = flown
    x, z = now.centre_of_mass.T - np.stack([state.x, state.z])
    moment = now.air_force[:, 2] - (x * now.air_force[:, 1] - z * now.air_force[:, 0])
    assert np.abs(angular - moment).max() <= EXACT * np.abs(moment).max()
    # About the body it is another moment.
    assert np.abs(angular - now.air_force[:, 2]).max() > 1e-3 * np.abs(moment).max()


def test_loads_can_be_differentiated_by_state_and_phase():
    model, beat, state, phase = along_nothing()
    acceleration = loads(model, beat, state).acceleration
    wanted = rates_along(loads, held_by, model, beat, state, phase, acceleration)
    found = np.asarray(exact_rates(model, beat, state, phase, flow_of(state, acceleration)))
    assert (np.abs(found - wanted).max(axis=1) <= EXACT * np.abs(wanted).max(axis=1)).all()


def test_impulse_of_a_beat_is_the_change_of_momentum(solved, reflight):
    """Mean air load - weight - change of momentum over T = 0, the time integral by SciPy."""
    momentum = momenta_at_both_ends(solved.model, solved.wingbeat, solved.start, reflight.end)
    weight = solved.model.vehicle.mass * solved.model.air.gravity
    frequency = solved.wingbeat.frequency
    mean = frequency * np.array([reflight.integrals["force_x"], reflight.integrals["force_z"]])
    left = mean - [0.0, weight] - frequency * np.diff(momentum, axis=0)[0]
    assert np.abs(left).max() <= 1e-8 * weight
    # The orbit is closed: the mean air load is the weight, to the closure of the certificate.
    assert np.abs(mean - [0.0, weight]).max() <= 1e-6 * weight


def test_another_gravity_leaves_an_impulse_over(bat_orbit):
    """The test above can fail: flown in one gravity, weighed in another."""
    air = dataclasses.replace(bat_orbit.model.air, gravity=9.81 * (1 + 1e-6))
    model = changed(bat_orbit.model, air=air)
    flown = refly(model, bat_orbit.wingbeat, bat_orbit.start)
    momentum = momenta_at_both_ends(model, bat_orbit.wingbeat, bat_orbit.start, flown.end)[:, 1]
    lift = bat_orbit.wingbeat.frequency * (flown.integrals["force_z"] - np.diff(momentum)[0])
    mass = model.vehicle.mass
    assert abs(lift - mass * air.gravity) <= 1e-8 * mass * air.gravity
    assert abs(lift - mass * 9.81) > 1e-8 * mass * 9.81


def test_energy_of_a_beat(solved, reflight):
    """On a closed orbit what the actuators put in, the air takes out."""
    put_in, taken = (reflight.integrals[name] for name in ("actuator_power", "air_power"))
    assert abs(put_in + taken) <= 1e-6 * put_in
    mean = solved.orbit.record()["mean_actuator_power"]
    assert mean == pytest.approx(put_in * solved.wingbeat.frequency, rel=1e-5)
    hinge = solved.wingbeat.frequency * reflight.integrals["hinge_power"]
    assert solved.orbit.record()["mean_power"] == pytest.approx(hinge, rel=1e-5)


def test_hinges_do_all_the_work_unless_span_or_fold_are_actuated():
    """Twist follows the root: its torque is conjugate to the root pitch and its power is the hinge's."""
    model, states = odd_model(), odd_states()

    def powers(**changed):
        now = loads(model, dataclasses.replace(ODD_BEAT, **changed), states)
        return np.abs(now.actuator_power - now.hinge_power).max() / np.abs(now.hinge_power).max()

    assert powers(span_retraction=0.0, fold_amplitude=0.0) <= EXACT
    assert powers(span_retraction=0.0, fold_amplitude=0.0, twist_ratio=1.0) <= EXACT
    assert powers(span_retraction=0.01, fold_amplitude=0.0) > 1e-4
    assert powers(span_retraction=0.0, fold_amplitude=0.01) > 1e-4


SEEN_ALIKE = (
    *("acceleration", "alpha", "lift", "drag", "strip_force", "air_force", "flap_torque", "pitch_torque"),
    *("hinge_power", "actuator_power", "air_power", "momentum", "angular_momentum", "kinetic_energy"),
)


def alike(one, other, names=SEEN_ALIKE):
    """Return the largest difference of two loads, each quantity over its largest value."""
    pairs = [(getattr(one, name), getattr(other, name)) for name in names]
    return max(np.abs(a - b).max() / np.abs(a).max() for a, b in pairs)


def test_the_whole_airspeed_multiplies_the_loads_of_a_strip_and_turns_none():
    planar, full = (loads(odd_model(airspeed=one), ODD_BEAT, odd_states()) for one in wb.aero.AIRSPEEDS)
    whole = np.linalg.norm(full.strip_velocity, axis=-1)
    np.testing.assert_allclose(full.strip_speed, whole, rtol=1e-12)
    np.testing.assert_allclose(full.strip_reynolds / planar.strip_reynolds, whole / planar.strip_speed, rtol=1e-12)
    np.testing.assert_allclose(full.alpha, planar.alpha, rtol=1e-12)
    more = (whole / planar.strip_speed) ** 2
    assert more.min() >= 1.0
    assert more.max() > 1.5
    for name in ("lift", "drag"):
        np.testing.assert_allclose(getattr(full, name), more * getattr(planar, name), rtol=1e-11, atol=1e-15)
    np.testing.assert_allclose(full.strip_force, more[..., None] * planar.strip_force, rtol=1e-9, atol=1e-13)


def test_an_orbit_of_the_planar_airspeed_does_not_close_with_the_whole(bat_orbit):
    whole = changed(bat_orbit.model, full_airspeed=True)
    (end,) = refly_many(whole, bat_orbit.wingbeat, bat_orbit.start[None])
    miss = np.abs(end[4] - bat_orbit.start[4])
    assert 0.01 < miss < 1.0
    same = np.abs(refly(bat_orbit.model, bat_orbit.wingbeat, bat_orbit.start).end[4] - bat_orbit.start[4])
    assert same < 1e-6


def test_a_wing_with_no_speed_along_its_span_feels_no_difference():
    """Wings held out level in symmetric flight: the velocity has no part along them."""
    beat = wb.Wingbeat(5.0, 0.0, 0.0, 0.1, 0.4)
    wing = dataclasses.replace(ODD_WING, shoulder=(0.0, 0.0, 0.0))
    both = [
        loads(odd_model(wb.Vehicle(ODD.body, wing), airspeed=one), beat, odd_states()) for one in wb.aero.AIRSPEEDS
    ]
    assert alike(*both) <= EXACT


def test_a_strip_that_moves_along_its_span_alone_has_no_load():
    from wingbeat.aero.strip_forces import strip_forces

    kernel = wb.aero.SuFan().kernel()

    def force(chord_speed):
        none = jnp.zeros(())
        return strip_forces(kernel, 1.2, jnp.asarray(0.01), chord_speed, none, none + 0.3, none + 4.0).normal

    value, slope = jax.value_and_grad(force)(jnp.zeros(()))
    assert (float(value), float(slope)) == (0.0, 0.0)


def test_place_does_not_matter():
    model, states = odd_model(), odd_states()
    moved = states._replace(x=states.x + 3.0, z=states.z - 7.0)
    here, there = loads(model, ODD_BEAT, states), loads(model, ODD_BEAT, moved)
    assert alike(here, there) <= EXACT
    weight = model.vehicle.mass * model.air.gravity
    np.testing.assert_allclose(here.potential_energy - there.potential_energy, 7.0 * weight, rtol=1e-12)


def rotated(states, angle):
    c, s = math.cos(angle), math.sin(angle)
    return wb.State(
        c * states.x - s * states.z,
        s * states.x + c * states.z,
        states.body_pitch + angle,
        c * states.u - s * states.w,
        s * states.u + c * states.w,
        states.pitch_rate,
    )


@pytest.mark.parametrize(("gravity", "invariant"), [(0.0, True), (9.81, False)])
def test_without_gravity_there_is_no_up(gravity, invariant):
    model, states, angle = odd_model(air=wb.Air(gravity=gravity)), odd_states(), 0.7
    here, there = loads(model, ODD_BEAT, states), loads(model, ODD_BEAT, rotated(states, angle))
    scalars = ["alpha", "lift", "drag", "hinge_power", "actuator_power", "air_power", "kinetic_energy"]
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    turned = here.acceleration[:, :2] @ turn.T
    miss = max(
        alike(here, there, [*scalars, "flap_torque", "pitch_torque", "angular_momentum"]),
        np.abs(turned - there.acceleration[:, :2]).max() / np.abs(turned).max(),
        np.abs(here.acceleration[:, 2] - there.acceleration[:, 2]).max() / np.abs(here.acceleration[:, 2]).max(),
    )
    assert (miss <= EXACT) == invariant
    assert np.abs(here.air_force[:, :2] @ turn.T - there.air_force[:, :2]).max() <= EXACT * 10


def test_the_stroke_plane_angle_is_a_gauge_while_the_shoulder_is_at_the_centre_of_mass():
    delta, states = 0.3, odd_states()
    pitched = states._replace(body_pitch=states.body_pitch + delta)

    def pair(shoulder):
        wing = dataclasses.replace(ODD_WING, shoulder=shoulder)
        tilted = dataclasses.replace(wing, stroke_plane_angle=wing.stroke_plane_angle + delta)
        models = [odd_model(wb.Vehicle(ODD.body, w)) for w in (wing, tilted)]
        return alike(loads(models[0], ODD_BEAT, states), loads(models[1], ODD_BEAT, pitched))

    assert pair((0.0, 0.0, 0.0)) <= EXACT
    assert pair((0.0, 0.02, 0.0)) <= EXACT  # sideways it may sit where it likes
    assert pair((0.01, 0.0, 0.0)) > 1e-3


def mirrored_wing(wing, way):
    x, y, z = wing.shoulder
    if way == "fore-aft":
        return dataclasses.replace(wing, shoulder=(-x, y, z), stroke_plane_angle=-wing.stroke_plane_angle)
    return dataclasses.replace(wing, shoulder=(x, y, -z), stroke_plane_angle=math.pi - wing.stroke_plane_angle)


@pytest.mark.parametrize(("way", "signs"), [("fore-aft", [-1, 1, -1, -1, -1]), ("up-down", [1, -1, -1, -1, -1])])
def test_a_mirror_image_flies_the_mirror_image(way, signs):
    """Backward flight, and flight upside down without gravity: alpha takes every value."""
    air = wb.Air(gravity=9.81 if way == "fore-aft" else 0.0)
    here, there = odd_model(ODD, air), odd_model(wb.Vehicle(ODD.body, mirrored_wing(ODD_WING, way)), air)
    random = np.random.default_rng(1)
    motion = random.uniform(-1, 1, (3, 40, 5)) * [
        [[1, 1, 1, 1, 1]],
        [[10, 3, 8, 30, 30]],
        [[50, 50, 900, 900, 900]],
    ]
    time = random.uniform(0, 0.2, 40)

    def miss(fold):
        beat = dataclasses.replace(ODD_BEAT, fold_amplitude=fold)
        one = signs * np.asarray(generalised_torques(here, ODD_BEAT, *motion, time))
        other = np.asarray(generalised_torques(there, beat, *(signs * motion), time))
        return (np.abs(one - other).max(axis=0) / np.abs(one).max(axis=0)).max()

    assert miss(-ODD_BEAT.fold_amplitude) <= EXACT
    assert miss(ODD_BEAT.fold_amplitude) > 1e-3  # the hand of the mirror image folds the other way


def test_units_of_length_mass_and_time_are_free():
    length, mass, time = 3.0, 0.2, 1.7
    wing = ODD_WING
    scaled_wing = dataclasses.replace(
        wing,
        semi_span=wing.semi_span * length,
        chord=wing.chord * length,
        mass=wing.mass * mass,
        shoulder=tuple(s * length for s in wing.shoulder),
    )
    body = wb.Body(ODD.body.mass * mass, ODD.body.pitch_inertia * mass * length**2, 1e-3 * length**2)
    air = wb.Air(density=1.225 * mass / length**3, gravity=9.81 * length / time**2)
    beat = dataclasses.replace(ODD_BEAT, frequency=ODD_BEAT.frequency / time)
    states = odd_states()
    scale = np.array([length, length, 1.0, length / time, length / time, 1 / time])
    here = loads(odd_model(), ODD_BEAT, states)
    there = loads(
        odd_model(wb.Vehicle(body, scaled_wing), air), beat, wb.State(*np.transpose(scale * np.transpose(states)))
    )
    force, torque = mass * length / time**2, mass * length**2 / time**2
    units = {
        "alpha": 1.0,
        "acceleration": np.array([length, length, 1.0]) / time**2,
        "strip_force": force,
        "air_force": np.array([force, force, torque, torque, torque]),
        "flap_torque": torque,
        "pitch_torque": torque,
        "hinge_power": torque / time,
        "actuator_power": torque / time,
        "air_power": torque / time,
        "momentum": mass * length / time,
        "angular_momentum": mass * length**2 / time,
        "kinetic_energy": torque,
        "potential_energy": torque,
    }
    for name, unit in units.items():
        wanted = getattr(here, name) * unit
        np.testing.assert_allclose(getattr(there, name), wanted, rtol=0, atol=EXACT * np.abs(wanted).max())
