"""What the pitch hinges do in a beat: hinges that give way, or those that could give a prescribed pitch."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat.aero import BladeElement
from wingbeat.animal.kinematics import Wingbeat, held_at
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.wing_shape import giving_share, mass_behind, mass_gyration, strips_of
from wingbeat.orbits.flight.beat import Beat, mean_positive
from wingbeat.records.numbers import beat_mean

# Numbers of an orbit whose hinges give way, and of a robot whose pitch is prescribed.
GIVEN_WAY = (
    *("least_hinge_angle", "largest_hinge_angle", "hinge_amplitude", "hinge_lead", "hinge_frequency_ratio"),
    *("damper_power", "peak_hinge_torque", "share_at_stops"),
)
PRESCRIBED = (
    *("peak_pitch_torque", "mean_pitch_power", "pitching_power", "fitted_stiffness", "fitted_damping"),
    *("fitted_rest_angle", "fitted_share", "fitted_share_undamped"),
)
# A pitch that moves less has no hinge that could give it [rad].
_STILL = 1e-6
# How far a wing may press into its stops, or turn without any, before there is a warning [rad].
_PRESSED, _TURNED = math.radians(5.0), 0.5 * math.pi
_MENTION = 0.01  # share of strips and instants


def hinge_names(kind: str, vehicle: Vehicle, wingbeat: Wingbeat) -> tuple[str, ...]:
    """Return the names of what `hinge_numbers` gives: nothing for an animal, whose muscles pitch its wings."""
    if wingbeat.pitch_hinge is not None:
        return GIVEN_WAY if wingbeat.pitch_hinge.moves_root else (*GIVEN_WAY, "pitching_power")
    return PRESCRIBED if kind == "robot" or vehicle.motor is not None else ()


def hinge_numbers(
    kind: str, vehicle: Vehicle, wingbeat: Wingbeat, strips: int, beat: Beat, motion: np.ndarray | None
) -> dict[str, float | None]:
    """Return the numbers of the pitch hinges, both wings together, by the names of `hinge_names`.

    Theory: equation ``hinge-frequency``.
    """
    names = hinge_names(kind, vehicle, wingbeat)
    if names == PRESCRIBED:
        return prescribed_numbers(beat)
    if not names or motion is None:
        return {}
    found = prescribed_numbers(beat) | _given_way(vehicle, wingbeat, strips, beat, motion)
    return {name: found[name] for name in names}


def _given_way(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: int, beat: Beat, motion: np.ndarray
) -> dict[str, float | None]:
    hinge: Any = wingbeat.pitch_hinge
    angle, rate = np.asarray(motion, dtype=float).T
    own, flap = (np.fft.rfft(np.asarray(series)[:-1])[1] for series in (angle, beat.flap))
    natural = math.sqrt(hinge.stiffness / hinge_inertia(vehicle, wingbeat, strips)) / (2.0 * math.pi)
    at_stop = np.abs(angle) >= hinge.stop_angle if hinge.stop_stiffness else np.zeros(angle.size)
    return {
        "least_hinge_angle": float(angle.min()),
        "largest_hinge_angle": float(angle.max()),
        "hinge_amplitude": float(2.0 * np.abs(own) / (angle.size - 1)),
        "hinge_lead": float(np.angle(own * np.conj(flap))),
        "hinge_frequency_ratio": natural / wingbeat.frequency,
        "damper_power": beat_mean(hinge.damping * rate * rate),
        "peak_hinge_torque": float(np.abs(hinge.torque(angle, rate)).max()),
        "share_at_stops": beat_mean(np.asarray(at_stop, dtype=float)),
    }


def hinge_inertia(vehicle: Vehicle, wingbeat: Wingbeat, strips: int) -> float:
    """Return the inertia of both wings, without air, that a hinge at rest turns [kg m2]."""
    wing, of_wing = vehicle.wing, strips_of(vehicle.wing, strips)
    share = np.asarray(giving_share(held_at(wingbeat, 0.0, 0.0, 0.0, 0.0), of_wing.span_fraction))
    behind = mass_behind(wing, of_wing) + (0.25 - wing.pitch_axis) * of_wing.chord
    return float(np.sum(2.0 * of_wing.mass * share**2 * (behind**2 + mass_gyration(wing, of_wing))))


def prescribed_numbers(beat: Beat) -> dict[str, float | None]:
    """Return what a prescribed pitch needs, and the hinge whose torque is nearest to that, by least squares.

    Theory: equation ``hinge-fit``.
    """
    found: dict[str, float | None] = dict.fromkeys(PRESCRIBED)
    pitch, rate, torque = (np.asarray(a) for a in (beat.wing_pitch, beat.wing_pitch_rate, beat.pitch_torque))
    if not np.isfinite(torque).all():  # a diverged flight
        return found
    found["peak_pitch_torque"] = float(np.abs(torque).max())
    found["mean_pitch_power"] = beat_mean(torque * rate)
    found["pitching_power"] = float(mean_positive(torque * rate, np))
    pitch, rate, torque = pitch[:-1], rate[:-1], torque[:-1]  # each phase once
    spread = float(np.sum((torque - torque.mean()) ** 2))
    if np.ptp(pitch) < _STILL or spread == 0.0:
        return found
    columns = np.stack([-pitch, np.ones_like(pitch), -rate], axis=1)

    def fit(count: int) -> tuple[np.ndarray, float]:
        best = np.linalg.lstsq(columns[:, :count], torque, rcond=None)[0]
        return best, 1.0 - float(np.sum((torque - columns[:, :count] @ best) ** 2)) / spread

    (stiffness, preload, damping), found["fitted_share"] = fit(3)
    found["fitted_share_undamped"] = fit(2)[1]
    found |= {"fitted_stiffness": float(stiffness), "fitted_damping": float(damping)}
    found["fitted_rest_angle"] = float(preload / stiffness)
    return found


def hinge_warnings(
    vehicle: Vehicle, aero: BladeElement, wingbeat: Wingbeat, beat: Beat, motion: np.ndarray
) -> list[str]:
    """Warn of hinges that turn too far, and of moments of the air that nobody measured or that are left out."""
    hinge, notes = wingbeat.pitch_hinge, []
    assert hinge is not None
    far = float(np.abs(motion[:, 0]).max())
    if hinge.stop_stiffness and far - hinge.stop_angle > _PRESSED:
        beyond, stop = math.degrees(far - hinge.stop_angle), math.degrees(hinge.stop_angle)
        notes.append(f"the pitch hinge turns {beyond:.0f} degrees beyond its stops at {stop:.0f} degrees")
    elif not hinge.stop_stiffness and far > _TURNED:
        notes.append(f"the pitch hinge turns by up to {math.degrees(far):.0f} degrees, and has no stops")
    alpha = np.asarray(beat.alpha)
    if aero.force_point == "quarter-chord":
        lost = "the air's force acts at the quarter chord, as you chose"
        if vehicle.wing.pitch_axis == 0.25:
            lost += ": it does not turn the hinge"
        if all(part.coefficients.has_centre_of_pressure for part in aero.parts):
            centres = [part.coefficients.centre_of_pressure(alpha[:, part.strips]) for part in aero.parts]
            lever = strips_of(vehicle.wing, aero.strips).chord * (np.hstack(centres) - vehicle.wing.pitch_axis)
            normal = np.cos(alpha) * np.asarray(beat.lift) + np.sin(alpha) * np.asarray(beat.drag)
            held = held_at(wingbeat, 0.0, 0.0, 0.0, 0.0)
            lever = lever * np.asarray(giving_share(held, strips_of(vehicle.wing, aero.strips).span_fraction))
            most = float(np.abs(2.0 * np.sum(lever * normal, axis=1)).max())
            peak = float(np.abs(hinge.torque(*motion.T)).max())
            lost += (
                f"; at the centre of pressure, the same forces would turn it with up to {most:.2g} N m (largest "
                f"torque of the hinge here: {peak:.2g} N m)"
            )
        return [*notes, lost]
    # A plate's centre of pressure is the same on both sides.
    for part in aero.parts:
        low, high = part.coefficients.alpha_range_deg
        degrees = np.degrees(alpha[:, part.strips])
        degrees = np.abs(degrees) if low >= 0 else degrees
        share = float(np.mean((degrees < low) | (degrees > high))) if degrees.size else 0.0
        if share > _MENTION:
            notes.append(
                "the air turns the hinge about a centre of pressure that nobody measured at the angle of attack of "
                f"{share:.0%} of strips and instants of {part.name}: pitch and power depend on it"
            )
    return notes
