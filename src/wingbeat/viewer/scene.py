"""The scene that the viewer draws for one or two flights, ready for JSON: looks, arrays over samples, plots.

The model has no shape of body and tail: drawn are an ellipsoid and a triangle.
"""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import KIND, NOMENCLATURE, SHAPE, FaultList, FileError, climb_text, for_people
from wingbeat._base.datasets import downstrokes, flown
from wingbeat._base.style import SCHEMATIC
from wingbeat.aero.closed_forms import body_drag, disc_area, induced_flow
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

    ``leading`` is the distance of the leading edge ahead of the quarter chords, ``trailing`` that of the trailing
    edge behind them; a swept tip lies behind them, where ``leading`` is negative. A flight that does not carry the
    shape of its species gets a schematic one from the numbers of its vehicle.
    """
    vehicle, beat = (json.loads(dataset.attrs[name]) for name in ("vehicle", "wingbeat"))
    known = json.loads(dataset.attrs.get(SHAPE, "{}"))
    species = json.loads(dataset.attrs.get("inputs", "{}")).get("species", {})
    kind = known.get("kind") or species.get("kind") or ("robot" if "motor" in vehicle else "bird")  # a guess
    found = _own(vehicle, known) if "cover" in known else _schematic(vehicle, kind)
    return {"kind": kind, **found, "wrist": beat.get("wrist", 0.5)}


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
    plan, wing, place = _PLANS[kind], Wing(**vehicle["wing"]), np.linspace(0.0, 1.0, _STATIONS)
    if isinstance(wing.chord, tuple):
        chord = np.interp(place, np.linspace(0.0, 1.0, len(wing.chord)), wing.chord)
    else:  # an outline with the mean chord
        outline = (1.0 - plan.taper * place) * np.sqrt(1.0 - place**plan.rounding)
        chord = wing.mean_chord / float(np.trapezoid(outline, place)) * outline
    half_length, half_depth = body_axes(Body(**vehicle["body"]))
    length = 2 * half_length
    parts = dict(zip(EXTREMITIES, (share * length for share in plan.shares), strict=True))
    return {
        **{"cover": plan.cover, "schematic": True},
        **{"leading": (0.25 * chord).tolist(), "trailing": (0.75 * chord).tolist()},
        **{"camber": plan.camber, "thickness": plan.thickness},
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


_WATER = 1000.0  # kg/m3, the density that makes an ellipsoid of the body's mass and inertia


def body_axes(body: Body) -> tuple[float, float]:
    """Return half length and half depth [m] of a spheroid of water with the body's mass and pitch inertia.

    This is a guess for drawings; a body that is too compact for such a spheroid is drawn as a sphere.
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
    """
    half_width = 0.5 * math.sqrt(2.0 / math.pi * tail.lift_slope * tail.area)
    length, lifted = tail.area / half_width, tail.incidence + tilt
    chord = np.array([math.cos(lifted), 0.0, math.sin(lifted)])
    centre, left = np.array([-tail.arm, 0.0, tail.height]), np.array([0.0, half_width, 0.0])
    back = centre - length / 3.0 * chord
    return np.stack([centre + 2.0 * length / 3.0 * chord, back + left, back - left])


MOST_SAMPLES = 5000
EXACT = ("phase", "time", "x", "z")  # time and place in the flight, of which a page takes small differences
_BASE = (*EXACT, "body_pitch")  # without which a flight cannot be drawn
# The curves of the plots that a page starts with, by the names of their series.
_PANELS: list[list[str]] = [["thrust", "support"], ["alpha_arm", "alpha_hand"], ["hinge_power"], ["body_pitch"]]
_PUSHED: list[list[str]] = [["pitch_away"], ["height"], ["thrust", "support"], ["hinge_power"]]
# Of a disturbed flight, a page has few series, for it has many such flights.
_PUSHED_SERIES = ("u", "w", "pitch_rate", "flap", "force_x", "force_z", "hinge_power")


def scene(flights: Sequence[tuple[str, xr.Dataset]], pushes: Sequence[Push] = ()) -> dict[str, Any]:
    """Return the viewer's data of one flight, or of two to compare.

    Parameters
    ----------
    flights : a label and the dataset of an orbit or a simulated flight, for one flight or for two.
    pushes : disturbed flights of the first that the reader can choose, from `fly_pushes`.

    Raises
    ------
    InvalidInputError : no flight or more than two, or one with more samples than a page can hold.
    FileError : a dataset that contains no flight.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0))
    >>> scene([("pigeon", flight.dataset)])["flights"][0]["strips"]
    10
    """
    faults = FaultList()
    if len(flights) not in (1, 2):
        faults.add("flights", len(flights), "must be 1 or 2", "give one, or two to compare")
    for label, dataset in flights:
        if dataset.sizes.get("phase", 0) > MOST_SAMPLES:
            rule = f"samples are too many: the viewer shows at most {MOST_SAMPLES}"
            faults.add(label, dataset.sizes["phase"], rule, "simulate fewer beats, or fewer samples per beat")
    faults.raise_if_any()
    found = {
        "flights": [_flight(label, dataset) for label, dataset in flights],
        "series": _series(dict.fromkeys(name for _, dataset in flights for name in _along_the_beat(dataset))),
        "panels": _PANELS,
    }
    return found | ({"pushes": [_push(one) for one in pushes]} if pushes else {})


def _series(names: Iterable[str]) -> list[dict[str, Any]]:
    """Return what the plots can show: how a page calls each series, and how it makes the series from an array.

    The array's values times ``scale`` are in ``unit``. With ``per``, they are divided by that number of the flight;
    with ``station``, the values of the strips are interpolated to this span fraction.
    """
    made = [
        _term("force_x") | {"name": "thrust", "label": "forward air load over weight", "unit": "", "per": "weight"},
        _term("force_z") | {"name": "support", "label": "upward air load over weight", "unit": "", "per": "weight"},
        _term("alpha") | {"name": "alpha_arm", "label": "effective alpha, 1/4 span", "station": 0.25},
        _term("alpha") | {"name": "alpha_hand", "label": "effective alpha, 3/4 span", "station": 0.75},
    ]
    return [*made, *(_term(name) for name in names)]


def _term(name: str) -> dict[str, Any]:
    term = NOMENCLATURE[name]
    scale, unit = for_people(term.unit)
    return {"name": name, "label": term.short_label, "unit": unit, "scale": scale, "array": name}


def _along_the_beat(dataset: xr.Dataset) -> list[str]:
    # Of variables: a data array for each would take longer than all the rest of a scene.
    known = dataset.variables
    return [str(n) for n in dataset.data_vars if known[n].dims == ("phase",) and n in NOMENCLATURE]


def _push(push: Push) -> dict[str, Any]:
    flight = _flight(push.label, push.dataset)
    # Of the arrows, the resultants are enough.
    names = _along_the_beat(push.dataset)
    left_out = {"lift", "drag"} | ({*names} - {*_BASE, *_PUSHED_SERIES})
    for name in left_out:
        del flight["arrays"][name]
    flight["arrays"]["pitch_away"] = packed(push.pitch, "f4")
    flight["arrays"]["height"] = packed(push.height, "f4")
    flight["summary"] = f"{push.label}: {push.outcome}"
    return {
        "direction": push.direction,
        "size": push.size,
        "feedback": push.feedback,
        "outcome": push.outcome,
        "scene": {
            "flights": [flight],
            "series": [
                _term("body_pitch")
                | {"name": "pitch_away", "label": "body pitch away from the orbit's", "array": "pitch_away"},
                _term("z") | {"name": "height", "label": "height above the path", "array": "height"},
                *_series(name for name in names if name not in left_out),
            ],
            "panels": _PUSHED,
        },
    }


def _flight(label: str, dataset: xr.Dataset) -> dict[str, Any]:
    known = dataset.attrs.get(KIND)
    if known not in ("orbit", "flight") or "strip_corner" not in dataset:
        kind = f"of kind {str(known)!r}" if known else "not from wingbeat"
        way = "give a file that `orbit -o` or `simulate -o` of this version wrote"
        raise FileError(f"cannot show {label!r}: it is {kind} and does not hold the corners of the strips; {way}")
    reached = flown(dataset)
    if reached.sum() < 2:
        raise FileError(
            f"cannot show {label!r}: it has fewer than two samples before the vehicle tumbled; "
            "`wingbeat show` prints the status of a saved file"
        )
    if not reached.all():
        dataset = dataset.isel(phase=reached)
    vehicle, air = (json.loads(dataset.attrs[name]) for name in ("vehicle", "air"))
    body, wing = vehicle["body"], vehicle["wing"]
    beat = json.loads(dataset.attrs["wingbeat"])
    tail = tail_of(dataset)
    weight = (body["mass"] + 2 * wing["mass"]) * air["gravity"]
    return {
        "label": label,
        "summary": _summary(dataset, beat["frequency"]),
        "strips": dataset.sizes["station"],
        "semi_span": wing["semi_span"],
        "wake": wake_of(dataset),
        "frequency": beat["frequency"],
        "weight": weight,
        "periodic": dataset.attrs[KIND] == "orbit" and dataset.attrs["status"] == "converged",
        "shape": look_of(dataset),
        **({} if tail is None else {"tail": tail.ravel().tolist()}),
        "downstrokes": [list(ends) for ends in downstrokes(dataset["phase"].values, dataset["flap_rate"].values)],
        "arrays": {name: packed(*array) for name, array in _arrays(dataset).items()},
    }


def tail_of(dataset: xr.Dataset) -> np.ndarray | None:
    """Return the corners of the tail in body axes, shape (3, 3) [m]; None without a tail."""
    tail = json.loads(dataset.attrs["vehicle"]).get("tail")
    if tail is None:
        return None
    return tail_corners(Tail(**tail), json.loads(dataset.attrs["wingbeat"]).get("tail_tilt", 0.0))


def _summary(dataset: xr.Dataset, frequency: float) -> str:
    about = dataset.attrs
    if about[KIND] != "orbit":
        return f"simulated, starting at {float(dataset['u'][0]):.3g} m/s, {frequency:.3g} Hz"
    climb = climb_text(about["climb"])
    loads = json.loads(about["aero"])["coefficients"]
    status = "" if about["status"] == "converged" else f"; NOT CERTIFIED ({about['status']})"
    return f"{about['species']} at {about['speed']:.3g} m/s{climb}, {loads}, {frequency:.3g} Hz{status}"


def strip_loads(dataset: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Return lift and drag of the left wing's strips as vectors in the world, shape (K, N, 3) [N].

    Drag is opposite to the component of the strip's velocity across its span. Lift is the rest of the air load.
    """
    corner, velocity = dataset["strip_corner"].values, dataset["strip_velocity"].values
    span = corner[:, :, 1] - corner[:, :, 0]
    span = span / np.linalg.norm(span, axis=-1, keepdims=True)
    across = velocity - np.sum(velocity * span, axis=-1, keepdims=True) * span
    speed = np.linalg.norm(across, axis=-1, keepdims=True)
    drag = -dataset["drag"].values[..., None] * across / np.where(speed > 0, speed, 1.0)
    return dataset["strip_force"].values - drag, drag


def _arrays(dataset: xr.Dataset) -> dict[str, tuple[np.ndarray, str]]:
    """Return the moving arrays with their number types, in SI units."""
    known = dataset.variables
    place = np.stack([known["x"].values, np.zeros(dataset.sizes["phase"]), known["z"].values], axis=-1)
    lift, drag = strip_loads(dataset)
    exact = {name: known[name].values for name in EXACT}
    single = {
        "corners": known["strip_corner"].values - place[:, None, None],
        "alpha": known["alpha"].values,
        "strip_lift": known["lift"].values,
        "lift": lift,
        "drag": drag,
        "force": known["strip_force"].values,
    }
    single |= {name: known[name].values for name in _along_the_beat(dataset) if name not in exact}
    return {n: (v, "f8") for n, v in exact.items()} | {n: (v, "f4") for n, v in single.items()}


def packed(values: np.ndarray, kind: str) -> dict[str, str]:
    """Return an array as a scene holds it, flat in the order of memory; its numbers are ``"f4"`` or ``"f8"``."""
    return {"kind": kind, "data": base64.b64encode(values.astype(f"<{kind}").tobytes()).decode()}


def wake_of(dataset: xr.Dataset) -> dict[str, list[float]] | None:
    """Return the induced velocity that the air loads of a saved orbit contain; None if they contain none.

    A simulated flight has None too: its file does not say which air loads it was flown with. The values of
    ``induced`` are forward and up [m/s], as at the wings; the far wake of an ideal disc moves twice as fast.
    """
    aero = json.loads(dataset.attrs.get("aero", "{}"))
    if aero.get("inflow", "none") == "none":
        return None
    vehicle, air = (json.loads(dataset.attrs[name]) for name in ("vehicle", "air"))
    body, wing = vehicle["body"], vehicle["wing"]
    velocity = dataset.attrs["speed"], dataset.attrs["climb"]
    drag = body_drag(body["drag_area"], air["density"], velocity, np)
    force = -drag[0], (body["mass"] + 2 * wing["mass"]) * air["gravity"] - drag[1]
    factor = aero.get("share", 1.0) * aero["induced_factor"]
    flow = induced_flow(air["density"], disc_area(wing["semi_span"]), factor, force, velocity)
    return {"induced": [float(part) for part in flow]}


class Push(NamedTuple):
    """A flight that begins on an orbit and meets a gust.

    Attributes
    ----------
    direction : of the gust, in words.
    size : largest velocity of the gust [m/s].
    feedback : whether feedback changes the wingbeat.
    outcome : how the flight ends, in words.
    dataset : time series of the flight, until it is lost.
    pitch : body pitch less that of the orbit at the same phase [rad], shape (K,).
    height : height above the path of the orbit [m], shape (K,).
    """

    direction: str
    size: float
    feedback: bool
    outcome: str
    dataset: xr.Dataset
    pitch: np.ndarray
    height: np.ndarray

    @property
    def label(self) -> str:
        """What is flown, in words."""
        return f"{self.direction} gust of {self.size:g} m/s, {'with' if self.feedback else 'without'} feedback"
