"""A flight of ours, flown on by PteraSoftware: its lattice moves one rigid body in MuJoCo, from our state.

That body turns about one point and has one inertia. We take the centre of mass and the inertia of body and wings,
averaged over a beat. What a lattice lacks is given to it as loads: body drag and tail, which see the state that it
flies, and the reaction of the moving wings, which is that of our flight at the same phase.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._jax.arrays import in_own_settings, jax, jnp
from wingbeat.aero.blade_element import BladeElement
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle
from wingbeat.mechanics.flight_loads import carried_loads
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.state_rates import refuse_without_motion
from wingbeat.mechanics.strip_air import body_air
from wingbeat.mechanics.wing_points import wing_points
from wingbeat.mechanics.wing_shape import from_world, strips_of, tail_tilt, to_world
from wingbeat_evidence.second_opinion.lattice import LatticeOptions, lattice_of
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.vortex_lattice import FreeFlight, fly_free

WINGS, BODY, TAIL, REACTION = "wings", "body drag", "tail", "wings' inertia"


@dataclass(frozen=True)
class Flown:
    """A periodic flight of ours as that of one rigid body, at K phases of a beat.

    Attributes
    ----------
    model, aero, motion : of the flight.
    place : of the rigid body's point in body axes, from the body's centre of mass forward and up [m].
    inertia : about that point [kg m2].
    states : of that point, as `FreeFlight.state`, shape (K + 1, 6).
    loads : by cause, force forward and up in the world [N] and moment about the point [N m], shape (K, 3) each.
    """

    model: FlightModel
    aero: BladeElement
    motion: Motion
    place: np.ndarray
    inertia: float
    states: np.ndarray
    loads: dict[str, np.ndarray]

    @property
    def mass(self) -> float:
        """Mass of body and wings [kg]."""
        return float(self.model.vehicle.mass)


def _turned(angle: Any, vector: Any) -> np.ndarray:
    return np.stack([np.asarray(one) for one in to_world(angle, vector[..., 0], vector[..., 1])], axis=-1)


def _moment(arm: np.ndarray, force: np.ndarray) -> np.ndarray:
    return arm[..., 0] * force[..., 1] - arm[..., 1] * force[..., 0]


@in_own_settings
def as_rigid_body(model: FlightModel, aero: BladeElement, motion: Motion, steps: int) -> Flown:
    """Return a periodic flight as that of one rigid body, with the loads that move it so.

    Parameters
    ----------
    model, aero : without the lag of the wake.
    motion : of the flight; its wing's pitch is prescribed.
    steps : number of phases of a beat.
    """
    phase = np.arange(steps + 1) / steps
    wingbeat, vehicle = motion.wingbeat, model.vehicle
    refuse_without_motion(wingbeat)
    state, rates = motion.state(phase), motion.acceleration(phase)
    loads, _ = carried_loads(
        model, wingbeat, State(*map(jnp.asarray, state)), jnp.asarray(phase), jnp.asarray(rates)
    )
    pitch, turning, at = state.body_pitch, state.pitch_rate, np.stack([state.x, state.z], axis=-1)
    centre = _turned(-pitch, np.asarray(loads.centre_of_mass) - at)
    place = centre[:-1].mean(axis=0)
    inertia = np.mean(_inertia(model, wingbeat, state, phase, place)[:-1])
    arm = _turned(pitch, np.broadcast_to(place, at.shape))
    across = np.stack([-arm[:, 1], arm[:, 0]], axis=-1)  # of a turn from x to z
    velocity = np.stack([state.u, state.w], axis=-1) + turning[:, None] * across
    acceleration = rates[:, :2] + rates[:, 2:] * across - turning[:, None] ** 2 * arm
    states = np.column_stack([at + arm, pitch, velocity, turning])
    body, tail = (
        np.array([own_air(model, wingbeat, place, one, parts) for one in states]) for parts in ("body", "tail")
    )
    air = np.asarray(loads.air_force)[:, :3].copy()
    air[:, 2] -= _moment(arm, air[:, :2])
    wings = air - body - tail
    weight = np.array([0.0, -vehicle.mass * model.air.gravity, 0.0])
    moved = np.column_stack([vehicle.mass * acceleration, inertia * rates[:, 2]])
    found = {WINGS: wings, BODY: body, TAIL: tail, REACTION: moved - air - weight}
    return Flown(
        model, aero, motion, place, float(inertia), states, {name: one[:-1] for name, one in found.items()}
    )


def _inertia(
    model: FlightModel, wingbeat: Wingbeat, state: State, phase: np.ndarray, place: np.ndarray
) -> np.ndarray:
    """Return the pitch inertia of body and wings about a place in the body [kg m2], shape (K,)."""
    body = model.vehicle.body
    mass = strips_of(model.vehicle.wing, model.strips).mass

    def at(when: Any) -> Any:
        none = jnp.zeros(())
        q = jnp.stack([none, none, none, flap_angle(wingbeat, when), pitch_angle(wingbeat, when)])
        points = wing_points(model, wingbeat, q, when / wingbeat.frequency).mass[..., jnp.array([0, 2])]
        return jnp.einsum("n,kna->", mass, (points - place) ** 2)

    return np.asarray(jax.vmap(at)(jnp.asarray(phase))) + body.pitch_inertia + body.mass * float(place @ place)


def own_air(
    model: FlightModel, wingbeat: Wingbeat, place: np.ndarray, state: np.ndarray, parts: str = "both"
) -> np.ndarray:
    """Return the loads of the air on body, tail or both: force in the world [N], moment about `place` [N m].

    Parameters
    ----------
    model, wingbeat : of the flight; the wingbeat tilts the tail.
    place : as in `Flown`.
    state : as `FreeFlight.state`, shape (6,).
    parts : ``"body"``, ``"tail"`` or ``"both"``.
    """
    _, _, pitch, forward, up, turning = state
    vehicle = model.vehicle
    arm = _turned(pitch, place)
    travel = from_world(pitch, forward + turning * arm[1], up - turning * arm[0])

    def of(body_and_tail: Any) -> np.ndarray:
        force, moment = body_air(
            body_and_tail, model.air.density, travel, turning, tilt=tail_tilt(body_and_tail, wingbeat)
        )
        turned = _turned(pitch, np.array([float(part) for part in force]))
        return np.array([*turned, (0.0 if moment is None else float(moment)) - _moment(arm, turned)])

    bare = dataclasses.replace(vehicle, tail=None)
    if parts == "body" or vehicle.tail is None:
        return np.zeros(3) if parts == "tail" else of(bare)
    return of(vehicle) - (of(bare) if parts == "tail" else 0.0)


def own_less_lattice(flown: Flown, flight: FreeFlight, options: LatticeOptions) -> np.ndarray:
    """Return the loads of our wings less those of the lattice, on our path, in the last led beat, shape (K, 3).

    Parameters
    ----------
    flown, options : as in `fly_on`.
    flight : from `fly_on`.
    """
    last = slice((options.beats - 1) * options.steps, options.beats * options.steps)
    return flown.loads[WINGS] - np.column_stack([flight.force[last], flight.moment[last]])


def fly_on(
    flown: Flown,
    options: LatticeOptions,
    beats: int,
    complete: bool = True,
    wake_rows: int | None = None,
    instead: np.ndarray | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> FreeFlight:
    """Fly on from our flight for some beats, after `options.beats` beats along our flight.

    Parameters
    ----------
    flown : from `as_rigid_body`, with `options.steps` phases.
    options : of the lattice.
    beats : of free flight.
    complete : whether body drag, tail and the reaction of the wings are given to it; its weight always is.
    wake_rows, progress : as in `fly_free`.
    instead : loads that are added at each phase of a beat, shape (K, 3), as in `Flown.loads`.

    Raises
    ------
    FileError : PteraSoftware is not installed.
    """
    steps, motion, model = options.steps, flown.motion, flown.model
    phase = np.arange((options.beats + beats) * steps + 1) / steps
    still = dataclasses.replace(
        motion, velocity=(0.0, 0.0), _splines={name: np.zeros_like for name in motion._splines}
    )
    one_beat = lattice_of(still, options, phase[:steps], flown.aero)
    one_beat = one_beat - np.array([flown.place[0], 0.0, flown.place[1]])
    flights = np.arange(options.beats * steps + 1)
    led = flown.states[flights % steps]
    led[:, :2] += (flights // steps)[:, None] * (flown.states[-1] - flown.states[0])[:2]
    reaction = flown.loads[REACTION].copy()
    if instead is not None:
        reaction += instead
    reaction[:, :2] = _turned(-flown.states[:-1, 2], reaction[:, :2])

    def others(step: int, state: np.ndarray) -> np.ndarray:
        push = reaction[step % steps]
        return own_air(model, motion.wingbeat, flown.place, state) + np.append(_turned(state[2], push[:2]), push[2])

    body = flown.mass, flown.inertia, float(model.air.gravity), float(model.air.density)
    corners = one_beat[np.arange(len(phase)) % steps]
    return fly_free(corners, motion.period / steps, led, body, others if complete else None, wake_rows, progress)
