"""Smaller scenes for pages with many flights: fewer samples of a beat, in whole numbers of 16 bits."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

SAMPLES = 64  # of a beat; the viewer draws straight lines between them
_TYPES = {"f4": "<f4", "f8": "<f8", "i2": "<i2"}
_WHOLE = 32767
# The viewer shows resultants first; without the two parts, a page has room for half as many flights again.
_LEFT_OUT = ("lift", "drag")
# The place in the flight, whose differences matter.
_EXACT = ("phase", "time", "x", "z")


def thinned(scene: dict[str, Any]) -> dict[str, Any]:
    """Return a scene with about 64 samples of each flight, its arrays in 16 bits, and without lift and drag.

    An array keeps its values to a thirty-thousandth of its largest one; phase, time and the body's path are in
    single precision.

    Parameters
    ----------
    scene : from `wingbeat.viewer.scene`.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> small = thinned(wb.viewer.scene([("pigeon", orbit.dataset)]))
    >>> len(unpacked(small["flights"][0]["arrays"]["phase"]))
    65
    """
    return scene | {"flights": [_thinned(flight) for flight in scene["flights"]]}


def _thinned(flight: dict[str, Any]) -> dict[str, Any]:
    count = len(unpacked(flight["arrays"]["phase"]))
    kept = np.unique(np.round(np.linspace(0, count - 1, min(count, SAMPLES + 1))).astype(int))
    arrays = {}
    for name, packed in flight["arrays"].items():
        if name not in _LEFT_OUT:
            values = unpacked(packed).reshape(count, -1)[kept]
            arrays[name] = _packed(values, "f4") if name in _EXACT else _in_16_bits(values)
    return flight | {"arrays": arrays}


def unpacked(packed: dict[str, Any]) -> np.ndarray:
    """Return the flat values of an array of a scene.

    Parameters
    ----------
    packed : with ``kind``, ``data`` and, for 16 bits, ``scale``.
    """
    values = np.frombuffer(base64.b64decode(packed["data"]), _TYPES[packed["kind"]])
    return values * packed["scale"] if packed["kind"] == "i2" else values


def _in_16_bits(values: np.ndarray) -> dict[str, Any]:
    scale = float(np.abs(values).max()) / _WHOLE or 1.0
    return _packed(np.round(values / scale), "i2") | {"scale": scale}


def _packed(values: np.ndarray, kind: str) -> dict[str, Any]:
    return {"kind": kind, "data": base64.b64encode(values.astype(_TYPES[kind]).tobytes()).decode()}
