"""How the animal of a flight looks: outline of the wing, body and colours, for the drawings alone.

The model has no shape of body and tail: drawn are an ellipsoid and a triangle.
"""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import SHAPE
from wingbeat._base.style import SCHEMATIC
from wingbeat.animal.species.numbers import COLOURS, EXTREMITIES, TRUNK
from wingbeat.animal.vehicle import Body, Tail, Wing

if TYPE_CHECKING:
    import xarray as xr

_STATIONS = 21


class _Plan(NamedTuple):
    """A schematic animal of one kind: guesses, for a flight whose species has no shape of its own."""

    cover: str
    taper: float  # share of the chord lost at the tip, before rounding
    rounding: float  # the chord is multiplied by sqrt(1 - s^rounding)
    camber: float
    thickness: float
    shares: tuple[float, float, float, float, float]  # of the extremities, over body length


_PLANS = {
    "bird": _Plan("feathers", 0.2, 4.0, 0.06, 0.04, (0.3, 0.1, 0.0, 0.5, 0.4)),
    "bat": _Plan("membrane", 0.45, 8.0, 0.08, 0.02, (0.3, 0.0, 0.15, 0.25, 0.35)),
    "robot": _Plan("film", 0.3, 12.0, 0.03, 0.01, (0.0, 0.0, 0.0, 0.5, 0.5)),
}


def look_of(dataset: xr.Dataset) -> dict[str, Any]:
    """Return how the animal of a flight looks: JSON-able, lengths in m, span fractions from root to tip.

    ``leading`` is the distance of the leading edge ahead of the pitch axis, ``trailing`` that of the trailing edge
    behind it; a swept tip lies behind the axis, where ``leading`` is negative. A flight that does not carry the
    shape of its species gets a schematic one from the numbers of its vehicle.
    """
    vehicle, beat = (json.loads(dataset.attrs[name]) for name in ("vehicle", "wingbeat"))
    known = json.loads(dataset.attrs.get(SHAPE, "{}"))
    kind = known.get("kind") or _kind(dataset, vehicle)
    found = _own(vehicle, known) if "cover" in known else _schematic(vehicle, kind)
    return {"kind": kind, **found, "wrist": beat.get("wrist", 0.5)}


def _kind(dataset: xr.Dataset, vehicle: dict[str, Any]) -> str:
    """Return the kind of a flight that does not say it: that of its inputs, or a guess."""
    species = json.loads(dataset.attrs.get("inputs", "{}")).get("species", {})
    return species.get("kind") or ("robot" if "motor" in vehicle else "bird")


def _own(vehicle: dict[str, Any], known: dict[str, Any]) -> dict[str, Any]:
    chord = Wing(**vehicle["wing"]).mean_chord
    tail = {} if known["tail_length"] else _tail(vehicle)
    return {
        **{name: known[name] for name in ("cover", "schematic", "camber", "thickness", "colours")},
        "leading": [chord * place for place in known["leading_edge"]],
        "trailing": [chord * place for place in known["trailing_edge"]],
        "body": {name.removeprefix("body_"): known[name] for name in TRUNK}
        | {name: known[name] for name in EXTREMITIES}
        | tail,
    }


def _schematic(vehicle: dict[str, Any], kind: str) -> dict[str, Any]:
    plan, wing = _PLANS[kind], Wing(**vehicle["wing"])
    chord = _chord(plan, wing)
    half_length, half_depth = body_axes(Body(**vehicle["body"]))
    length = 2 * half_length
    parts = dict(zip(EXTREMITIES, (share * length for share in plan.shares), strict=True))
    return {
        "cover": plan.cover,
        "schematic": True,
        "leading": (0.25 * chord).tolist(),
        "trailing": (0.75 * chord).tolist(),
        "camber": plan.camber,
        "thickness": plan.thickness,
        "body": {"length": length, "width": 2 * half_depth, "depth": 2 * half_depth} | parts | _tail(vehicle),
        "colours": dict(zip(COLOURS, SCHEMATIC[kind], strict=True)),
    }


def _tail(vehicle: dict[str, Any]) -> dict[str, float]:
    """Return the size of the tail that the vehicle has [m]; nothing if it has none."""
    if "tail" not in vehicle:
        return {}
    root, left, right = tail_corners(Tail(**vehicle["tail"]))
    length = float(np.linalg.norm(0.5 * (left + right) - root))
    return {"tail_length": length, "tail_width": float(np.linalg.norm(left - right))}


def _chord(plan: _Plan, wing: Wing) -> np.ndarray:
    """Return chords at equally spaced stations [m]: those of the vehicle, or an outline with its mean chord."""
    place = np.linspace(0.0, 1.0, _STATIONS)
    if isinstance(wing.chord, tuple):
        return np.interp(place, np.linspace(0.0, 1.0, len(wing.chord)), wing.chord)
    outline = (1.0 - plan.taper * place) * np.sqrt(1.0 - place**plan.rounding)
    return wing.mean_chord / float(np.trapezoid(outline, place)) * outline


_WATER = 1000.0  # kg/m3, the density that makes an ellipsoid of the body's mass and inertia


def body_axes(body: Body) -> tuple[float, float]:
    """Return half length and half depth [m] of a spheroid of water with the body's mass and pitch inertia.

    The model contains no shape of the body; this is a guess for drawings. If the body is too compact for such a
    spheroid, it is drawn as a sphere.

    >>> half_length, half_depth = body_axes(Body(mass=0.276, pitch_inertia=3.6e-4))
    >>> round(half_length, 3), round(half_depth, 3)
    (0.075, 0.03)
    """
    volume = 3 * body.mass / (4 * math.pi * _WATER)
    squares = 5 * body.pitch_inertia / body.mass
    # The half length a solves a^2 + volume/a = squares; the largest root is that of a long body.
    roots = np.roots([1.0, 0.0, -squares, volume])
    long = max((r.real for r in roots if abs(r.imag) < 1e-12 and r.real > 0), default=volume ** (1 / 3))
    return float(long), math.sqrt(volume / float(long))


def tail_corners(tail: Tail, tilt: float = 0.0) -> np.ndarray:
    """Return root, left and right corner of a tail in body axes (forward, left, up), shape (3, 3) [m].

    The triangle has the tail's area and incidence, and its centre of area is the tail's aerodynamic centre. Its
    aspect ratio is that of a slender tail with the same lift slope: ``2/pi`` times the slope.

    >>> corners = tail_corners(Tail(area=0.0064, arm=0.16, lift_slope=math.pi))
    >>> [round(float(x), 3) for x in corners[:, 0]], round(float(corners[1, 1]), 3)
    ([-0.085, -0.198, -0.198], 0.057)
    """
    half_width = 0.5 * math.sqrt(2.0 / math.pi * tail.lift_slope * tail.area)
    length, lifted = tail.area / half_width, tail.incidence + tilt
    chord = np.array([math.cos(lifted), 0.0, math.sin(lifted)])
    centre, left = np.array([-tail.arm, 0.0, tail.height]), np.array([0.0, half_width, 0.0])
    back = centre - length / 3.0 * chord
    return np.stack([centre + 2.0 * length / 3.0 * chord, back + left, back - left])
