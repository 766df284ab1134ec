"""The flight model of model.md, written once for all peers and for any array library.

Everything in the plane is in stroke axes: along `e_c0` (c) and `d_up` (d), which are the body axes pitched up by
90 degrees less the stroke-plane angle; y points to the left. NumPy takes all strips at once as arrays; CasADi and
what is built on it take them one by one, each a handful of plain numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import numpy as np
from coefficients import Coefficients

import wingbeat as wb

NUMPY = SimpleNamespace(
    sin=np.sin,
    cos=np.cos,
    sqrt=np.sqrt,
    exp=np.exp,
    floor=np.floor,
    arctan2=np.arctan2,
    where=np.where,
    total=np.sum,
)


def casadi_ops() -> SimpleNamespace:
    """Return what `accelerations` needs of CasADi; conditions become if_else."""
    import casadi as cs

    names = {"arctan2": "atan2", "where": "if_else"}
    functions = {name: getattr(cs, names.get(name, name)) for name in vars(NUMPY) if name != "total"}
    return SimpleNamespace(**functions, total=lambda strip: strip)


@dataclass(frozen=True)
class Strips:
    """Numbers of one strip, or arrays of all: span fractions inside and beyond the wrist, and so on."""

    inner: Any
    outer: Any
    hand: Any  # 1 beyond the wrist, 0 inside
    twist: Any
    mass: Any


@dataclass
class Flier:
    """Vehicle, air and coefficients of a problem as plain numbers."""

    problem: wb.OrbitProblem
    one_by_one: bool
    lanes: list[Strips] = field(init=False)

    def __post_init__(self) -> None:
        vehicle, beat = self.problem.vehicle, self.problem.species.wingbeat
        self.wing, self.air, self.mass = vehicle.wing, self.problem.air, vehicle.mass
        self.body_inertia, self.count = vehicle.body.pitch_inertia, self.problem.aero.strips
        self.coefficients = Coefficients(self.problem.aero.coefficients)
        assert vehicle.body.drag_area == 0
        assert self.problem.aero.force_point == "quarter-chord"
        self.pitched = math.pi / 2 - self.wing.stroke_plane_angle
        x, _, z = self.wing.shoulder
        s, c = math.sin(self.pitched), math.cos(self.pitched)
        self.shoulder = c * x + s * z, c * z - s * x
        self.chord = float(self.wing.chord)
        eta = (np.arange(self.count) + 0.5) / self.count
        share = (1 - eta) ** self.wing.mass_exponent
        columns = (
            np.minimum(eta, beat.wrist),
            np.maximum(eta - beat.wrist, 0.0),
            (eta > beat.wrist).astype(float),
            1 + (beat.twist_ratio - 1) * eta,
            self.wing.mass * share / share.sum(),
        )
        strips = np.array(columns).T.tolist()
        self.lanes = [Strips(*strip) for strip in strips] if self.one_by_one else [Strips(*columns)]

    def beat(self, free_values: Any) -> dict[str, Any]:
        """Return all wingbeat parameters by name, the free ones replaced by numbers or symbols."""
        stock = dict(vars(self.problem.species.wingbeat))
        return stock | {name: free_values[i] for i, name in enumerate(self.problem.free)}


def _limb(ops: Any, span: tuple[Any, ...], angle: tuple[Any, ...]) -> dict[str, Any]:
    """Return a limb of length `span` at a flap angle, both with two rates: y, y', d, d', d'' and the angle."""
    (length, length1, length2), (turn, turn1, turn2) = span, angle
    s, c = ops.sin(turn), ops.cos(turn)
    return {
        "s": s,
        "c": c,
        "turn1": turn1,
        "turn2": turn2,
        "y1": length1 * c - length * turn1 * s,
        "d": length * s,
        "d1": length1 * s + length * turn1 * c,
        "d2": (length2 - length * turn1 * turn1) * s + (2 * length1 * turn1 + length * turn2) * c,
    }


@dataclass(frozen=True)
class Wing:
    """The wing's motion: flap, root pitch and span, each with two rates; its limbs inside and beyond the wrist."""

    flap: tuple[Any, ...]
    tilt: tuple[Any, ...]
    span: tuple[Any, ...]
    arm: dict[str, Any]
    hand: dict[str, Any]


def wing_at(ops: Any, flier: Flier, beat: dict[str, Any], phase: Any) -> Wing:
    """Return the wing's motion at phases of the beat."""
    omega = 2 * math.pi * beat["frequency"]
    s, c = ops.sin(2 * math.pi * phase), ops.cos(2 * math.pi * phase)
    law, law1, law2 = (1 - s) / 2, -omega * c / 2, omega * omega * s / 2
    swing, turn, fold = beat["flap_amplitude"], beat["pitch_amplitude"], beat["fold_amplitude"]
    flap = beat["flap_mean"] + swing * c, -swing * omega * s, -swing * omega * omega * c
    hand = flap[0] - fold * law, flap[1] - fold * law1, flap[2] - fold * law2
    tilt = beat["pitch_mean"] - turn * s, -turn * omega * c, turn * omega * omega * s
    drawn_in = flier.wing.semi_span * beat["span_retraction"]
    span = flier.wing.semi_span - drawn_in * law, -drawn_in * law1, -drawn_in * law2
    return Wing(flap, tilt, span, _limb(ops, span, flap), _limb(ops, span, hand))


@dataclass(frozen=True)
class Strip:
    """A strip seen from the shoulder: its quarter chord, and its chord's direction in the plane, with two rates."""

    place: dict[str, Any]
    flap: tuple[Any, ...]  # its limb's sine, cosine and two rates
    pitch: tuple[Any, ...]  # its own sine, cosine and two rates
    chord_c: tuple[Any, ...]
    chord_d: tuple[Any, ...]


def strip_at(ops: Any, lane: Strips, wing: Wing) -> Strip:
    """Return where a strip is and how it lies."""
    arm, hand, tilt = wing.arm, wing.hand, wing.tilt
    place = {key: lane.inner * arm[key] + lane.outer * hand[key] for key in ("y1", "d", "d1", "d2")}
    own = {key: (1 - lane.hand) * arm[key] + lane.hand * hand[key] for key in ("s", "c", "turn1", "turn2")}
    so, co, p1, p2 = own["s"], own["c"], own["turn1"], own["turn2"]
    st, ct = ops.sin(lane.twist * tilt[0]), ops.cos(lane.twist * tilt[0])
    t1, t2 = lane.twist * tilt[1], lane.twist * tilt[2]
    ec, ed = ct, st * co
    ec1, ed1 = -t1 * st, t1 * ct * co - p1 * st * so
    ec2 = -t2 * st - t1 * t1 * ct
    ed2 = (t2 * ct - (t1 * t1 + p1 * p1) * st) * co - (2 * t1 * p1 * ct + p2 * st) * so
    return Strip(place, (so, co, p1, p2), (st, ct, t1, t2), (ec, ec1, ec2), (ed, ed1, ed2))


def air_load(
    ops: Any, flier: Flier, wing: Wing, strip: Strip, body_c: Any, body_d: Any, rate: Any
) -> tuple[Any, Any]:
    """Return the air's force on a strip along its chord and along its normal."""
    (so, co, *_), (st, ct, *_), place = strip.flap, strip.pitch, strip.place
    ahead, above = flier.shoulder
    pressure_area = 0.5 * flier.air.density * flier.chord * wing.span[0] / flier.count
    vc_, vy, vd = body_c - rate * (above + place["d"]), place["y1"], body_d + rate * ahead + place["d1"]
    vc = vc_ * strip.chord_c[0] - vy * st * so + vd * strip.chord_d[0]
    vn = -vc_ * st - vy * ct * so + vd * ct * co
    speed = ops.sqrt(vc * vc + vn * vn)
    lift, drag = flier.coefficients(ops, ops.arctan2(-vn, vc))
    return -speed * (lift * vn + drag * vc) * pressure_area, speed * (lift * vc - drag * vn) * pressure_area


def accelerations(
    ops: Any, flier: Flier, beat: dict[str, Any], phase: Any, psi: Any, u: Any, w: Any, rate: Any
) -> tuple[Any, Any, Any]:
    """Return (x'', z'', body_pitch'') with the wing motion prescribed."""
    wing = wing_at(ops, flier, beat, phase)
    sin_psi, cos_psi = ops.sin(psi + flier.pitched), ops.cos(psi + flier.pitched)
    body_c, body_d = u * cos_psi + w * sin_psi, w * cos_psi - u * sin_psi
    chord, (ahead, above) = flier.chord, flier.shoulder
    second = chord * chord / 12

    sums = [0.0] * 12
    for lane in flier.lanes:
        strip = strip_at(ops, lane, wing)
        (ec, ec1, ec2), (ed, ed1, ed2), place = strip.chord_c, strip.chord_d, strip.place
        along, across = air_load(ops, flier, wing, strip, body_c, body_d, rate)
        (_, co, *_), (st, ct, *_) = strip.flap, strip.pitch
        fc, fd = along * ec - across * st, along * ed + across * ct * co

        # Mass, at mid-chord with its second moment along the chord.
        bd = above + place["d"]
        mc, mc1, mc2 = ahead - chord / 4 * ec, -chord / 4 * ec1, -chord / 4 * ec2
        md, md1, md2 = bd - chord / 4 * ed, place["d1"] - chord / 4 * ed1, place["d2"] - chord / 4 * ed2
        terms = (
            fc,
            fd,
            fd * ahead - fc * bd,
            lane.mass * mc,
            lane.mass * md,
            lane.mass * mc1,
            lane.mass * md1,
            lane.mass * mc2,
            lane.mass * md2,
            lane.mass * (mc * mc + md * md + second * (ec * ec + ed * ed)),
            2 * lane.mass * (mc * mc1 + md * md1 + second * (ec * ec1 + ed * ed1)),
            lane.mass * (mc * md2 - md * mc2 + second * (ec * ed2 - ed * ec2)),
        )
        sums = [total + ops.total(term) for total, term in zip(sums, terms, strict=True)]

    # Both wings; then three rows, solved for the accelerations.
    fc, fd, moment, mc, md, mc1, md1, mc2, md2, inertia, inertia1, swirl = (2 * total for total in sums)
    whole, gc, gd = flier.mass, -flier.air.gravity * sin_psi, -flier.air.gravity * cos_psi
    push_c = fc + whole * gc + rate * (rate * mc + 2 * md1) - mc2
    push_d = fd + whole * gd + rate * (rate * md - 2 * mc1) - md2
    torque = moment - md * gc + mc * gd - rate * inertia1 - swirl
    spin = torque + (md * push_c - mc * push_d) / whole
    spin = spin / (flier.body_inertia + inertia - (mc * mc + md * md) / whole)
    ac, ad = (push_c + spin * md) / whole, (push_d - spin * mc) / whole
    return ac * cos_psi - ad * sin_psi, ac * sin_psi + ad * cos_psi, spin
