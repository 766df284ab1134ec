"""One table of names: what every quantity is called, its symbol, its unit and its dimensions in a dataset."""

from __future__ import annotations

from typing import NamedTuple


class Term(NamedTuple):
    """A quantity: symbol, unit (CF style), long name, and dimensions in a dataset."""

    symbol: str
    unit: str
    long_name: str
    dims: tuple[str, ...] = ("phase",)


_STRIP = ("phase", "station")
_VECTOR = ("phase", "station", "axis")
_CORNERS = ("phase", "station", "corner", "axis")

NOMENCLATURE: dict[str, Term] = {
    "phase": Term("t/T", "1", "phase of the wingbeat, 0 at the top of the stroke"),
    "station": Term("s/L", "1", "span fraction of the strip's centre", ("station",)),
    "axis": Term("", "", "world axis: x forward, y left, z up", ("axis",)),
    "corner": Term("", "", "corner of a strip, by edge and end", ("corner",)),
    "time": Term("t", "s", "time since phase 0"),
    "x": Term("x", "m", "forward position of the body"),
    "z": Term("z", "m", "height of the body"),
    "body_pitch": Term("ψ", "rad", "body pitch, nose up positive"),
    "u": Term("u", "m s-1", "forward velocity of the body"),
    "w": Term("w", "m s-1", "upward velocity of the body"),
    "pitch_rate": Term("q", "rad s-1", "pitch rate of the body"),
    "u_rate": Term("u'", "m s-2", "forward acceleration of the body"),
    "w_rate": Term("w'", "m s-2", "upward acceleration of the body"),
    "pitch_acceleration": Term("q'", "rad s-2", "pitch acceleration of the body"),
    "flap": Term("φ", "rad", "flap angle, wing up positive"),
    "flap_rate": Term("φ'", "rad s-1", "flap rate"),
    "wing_pitch": Term("θ", "rad", "wing pitch at the root, leading edge up positive"),
    "wing_pitch_rate": Term("θ'", "rad s-1", "wing pitch rate at the root"),
    "span_ratio": Term("L/L₀", "1", "span over full span"),
    "fold": Term("", "rad", "fold angle of the hand below the arm"),
    "sweep": Term("", "rad", "angle of the span ahead of the stroke plane"),
    "strip_position": Term("r", "m", "quarter-chord point of the left wing's strip, world", _VECTOR),
    "strip_corner": Term("r", "m", "corner of the left wing's strip, world", _CORNERS),
    "strip_velocity": Term("v", "m s-1", "velocity of the strip's quarter-chord point, world", _VECTOR),
    "strip_speed": Term("V", "m s-1", "airspeed of the strip that makes its loads", _STRIP),
    "strip_reynolds": Term("Re", "1", "Reynolds number of the strip, from its speed and chord", _STRIP),
    "alpha": Term("α", "rad", "effective angle of attack", _STRIP),
    "lift": Term("dL", "N", "lift of one strip of one wing", _STRIP),
    "drag": Term("dD", "N", "drag of one strip of one wing", _STRIP),
    "strip_force": Term("dF", "N", "air load of one strip of the left wing, world", _VECTOR),
    "force_x": Term("F_x", "N", "forward air load on the whole vehicle"),
    "force_z": Term("F_z", "N", "upward air load on the whole vehicle"),
    "pitching_moment": Term("M", "N m", "pitching moment of the air loads about the body, nose up positive"),
    "flap_torque": Term("τ_φ", "N m", "flap torque at the hinges, both wings"),
    "pitch_torque": Term("τ_θ", "N m", "wing pitch torque at the hinges, both wings"),
    "hinge_power": Term("P", "W", "hinge power, both wings"),
    "actuator_power": Term("P_act", "W", "actuator power, both wings: hinges, span, fold and sweep"),
    "aerodynamic_power": Term("P_aero", "W", "hinge power against the air loads, both wings"),
    "inertial_power": Term("P_in", "W", "hinge power that speeds up the wings in the body, both wings"),
    "body_power": Term("P_body", "W", "hinge power due to the body's motion and to weight, both wings"),
    "air_power": Term("P_air", "W", "power of the air loads on the vehicle"),
    "centre_of_mass_x": Term("x_G", "m", "forward position of the system's centre of mass"),
    "centre_of_mass_z": Term("z_G", "m", "height of the system's centre of mass"),
    "momentum_x": Term("p_x", "kg m s-1", "forward momentum of body and wings"),
    "momentum_z": Term("p_z", "kg m s-1", "upward momentum of body and wings"),
    "angular_momentum": Term("H", "kg m2 s-1", "angular momentum about the system's centre of mass"),
    "kinetic_energy": Term("E_kin", "J", "kinetic energy of body and wings"),
    "potential_energy": Term("E_pot", "J", "potential energy of body and wings"),
}


def axis_label(name: str, unit: str | None = None) -> str:
    """Return a figure's axis label for a quantity, in another unit if one is given.

    >>> axis_label("hinge_power")
    'hinge power, both wings P [W]'
    """
    term = NOMENCLATURE[name]
    shown = term.unit if unit is None else unit
    return " ".join(part for part in (term.long_name, term.symbol, f"[{shown}]") if part)
