"""The scene that the viewer draws for one or two flights, ready for JSON: arrays over the samples, and plots."""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.datasets import KIND, at_station, climb_text, downstrokes, flown
from wingbeat.errors import FaultList, FileError
from wingbeat.nomenclature import NOMENCLATURE, for_people
from wingbeat.vehicle import Body, Tail
from wingbeat.viewer.look import look_of
from wingbeat.viewer.pushes import Push
from wingbeat.viewer.shape import body_axes, tail_corners
from wingbeat.viewer.wake import wake_of

if TYPE_CHECKING:
    import xarray as xr

MOST_SAMPLES = 5000


def _unit(name: str) -> str:
    return for_people(NOMENCLATURE[name].unit)[1]


_PANELS: list[dict[str, Any]] = [
    {
        "title": "Air load over weight",
        "unit": "-",
        "curves": [{"array": "thrust", "label": "forward"}, {"array": "support", "label": "upward"}],
    },
    {
        "title": "Effective alpha",
        "unit": _unit("alpha"),
        "curves": [{"array": "alpha_arm", "label": "1/4 span"}, {"array": "alpha_hand", "label": "3/4 span"}],
    },
    {"title": "Hinge power", "unit": _unit("hinge_power"), "curves": [{"array": "power", "label": "hinge power"}]},
    {"title": "Body pitch", "unit": _unit("body_pitch"), "curves": [{"array": "pitch_deg", "label": "body pitch"}]},
]

_PUSHED: list[dict[str, Any]] = [
    {
        "title": "Body pitch away from the orbit's",
        "unit": _unit("body_pitch"),
        "curves": [{"array": "pitch_away", "label": "body pitch"}],
    },
    {"title": "Height above the path", "unit": _unit("z"), "curves": [{"array": "height", "label": "height"}]},
]


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
    found = {"flights": [_flight(label, dataset) for label, dataset in flights], "panels": _PANELS}
    return found | ({"pushes": [_push(one) for one in pushes]} if pushes else {})


def _push(push: Push) -> dict[str, Any]:
    flight = _flight(push.label, push.dataset)
    for name in ("lift", "drag"):  # of the arrows, the resultants are enough
        del flight["arrays"][name]
    flight["arrays"]["pitch_away"] = _packed(np.degrees(push.pitch), "f4")
    flight["arrays"]["height"] = _packed(push.height, "f4")
    flight["summary"] = f"{push.label}: {push.outcome}"
    return {
        "direction": push.direction,
        "size": push.size,
        "feedback": push.feedback,
        "outcome": push.outcome,
        "scene": {"flights": [flight], "panels": [*_PUSHED, _PANELS[0], _PANELS[2]]},
    }


def _flight(label: str, dataset: xr.Dataset) -> dict[str, Any]:
    if dataset.attrs.get(KIND) not in ("orbit", "flight") or "strip_corner" not in dataset:
        known = dataset.attrs.get(KIND)
        kind = f"of kind {str(known)!r}" if known else "not from wingbeat"
        way = "give a file that `orbit -o` or `simulate -o` of this version wrote"
        raise FileError(f"cannot show {label!r}: it is {kind} and does not hold the corners of the strips; {way}")
    reached = flown(dataset)
    if reached.sum() < 2:
        raise FileError(
            f"cannot show {label!r}: it has fewer than two samples before the vehicle tumbled; "
            "`wingbeat show` prints the status of a saved file"
        )
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
        "body_axes": body_axes(Body(**body)),
        "shape": look_of(dataset),
        **({} if tail is None else {"tail": tail.ravel().tolist()}),
        "downstrokes": [list(ends) for ends in downstrokes(dataset["phase"].values, dataset["flap_rate"].values)],
        "arrays": {name: _packed(*array) for name, array in _arrays(dataset, weight).items()},
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


def _arrays(dataset: xr.Dataset, weight: float) -> dict[str, tuple[np.ndarray, str]]:
    """Return the moving arrays with their number types; single precision suffices for positions about the body."""
    place = np.stack([dataset["x"].values, np.zeros(dataset.sizes["phase"]), dataset["z"].values], axis=-1)
    lift, drag = strip_loads(dataset)
    alpha = dataset["alpha"]
    exact = {name: dataset[name].values for name in ("phase", "time", "x", "z")}
    single = {
        "body_pitch": dataset["body_pitch"].values,
        "corners": dataset["strip_corner"].values - place[:, None, None],
        "alpha": alpha.values,
        "strip_lift": dataset["lift"].values,
        "lift": lift,
        "drag": drag,
        "force": dataset["strip_force"].values,
        "thrust": dataset["force_x"].values / weight,
        "support": dataset["force_z"].values / weight,
        "alpha_arm": np.degrees(at_station(alpha.values, 0.25)),
        "alpha_hand": np.degrees(at_station(alpha.values, 0.75)),
        "power": dataset["hinge_power"].values,
        "pitch_deg": np.degrees(dataset["body_pitch"].values),
    }
    return {n: (v, "f8") for n, v in exact.items()} | {n: (v, "f4") for n, v in single.items()}


def _packed(values: np.ndarray, kind: str) -> dict[str, str]:
    return {"kind": kind, "data": base64.b64encode(values.astype(f"<{kind}").tobytes()).decode()}
