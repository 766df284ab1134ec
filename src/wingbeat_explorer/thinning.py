"""Smaller scenes for pages with many flights: fewer samples of a beat, in whole numbers of 16 bits."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from wingbeat.viewer.scene import EXACT, packed

SAMPLES = 64  # of a beat; the viewer draws straight lines between them
_WHOLE = 32767
# The viewer shows resultants first; without the two parts, a page has room for half as many flights again.
_LEFT_OUT = ("lift", "drag")


def thinned(scene: dict[str, Any]) -> dict[str, Any]:
    """Return a scene with about 64 samples of each flight, its arrays in 16 bits, and without lift and drag.

    An array keeps its values to a thirty-thousandth of its largest one; phase, time and the body's path are in
    single precision. Of a strip's four corners three are kept: it is a parallelogram.

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


def thinned_pushes(pushes: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return the pushes of a scene with arrays in 16 bits; they keep all their samples, which are few.

    Parameters
    ----------
    pushes : from the key ``pushes`` of `wingbeat.viewer.scene`.
    """
    return [
        push | {"scene": push["scene"] | {"flights": [_smaller(push["scene"]["flights"][0])]}} for push in pushes
    ]


def _thinned(flight: dict[str, Any]) -> dict[str, Any]:
    count = len(unpacked(flight["arrays"]["phase"]))
    return _smaller(flight, np.unique(np.round(np.linspace(0, count - 1, min(count, SAMPLES + 1))).astype(int)))


def _smaller(flight: dict[str, Any], kept: Any = slice(None)) -> dict[str, Any]:
    """Return a flight with these of its samples, in 16 bits."""
    count = len(unpacked(flight["arrays"]["phase"]))
    arrays = {}
    for name, array in flight["arrays"].items():
        if name not in _LEFT_OUT:
            values = unpacked(array).reshape(count, -1)[kept]
            if name == "corners":
                values = values.reshape(len(values), -1, 4, 3)[:, :, :3].reshape(len(values), -1)
            arrays[name] = packed(values, "f4") if name in EXACT else in_16_bits(values)
    return flight | {"arrays": arrays}


def unpacked(array: dict[str, Any]) -> np.ndarray:
    """Return the flat values of an array of a scene.

    Parameters
    ----------
    array : with ``kind``, ``data`` and, for 16 bits, ``scale`` and ``samples``.
    """
    data = base64.b64decode(array["data"])
    if array["kind"] != "d2":
        return np.frombuffer(data, f"<{array['kind']}")
    steps = np.frombuffer(data, np.uint8).reshape(2, -1).T.copy().view("<i2").reshape(-1, array["samples"])
    return np.cumsum(steps, axis=1, dtype=np.int16).T.ravel() * array["scale"]


def in_16_bits(values: np.ndarray) -> dict[str, Any]:
    """Return an array of a scene in 16 bits that compress well: steps from sample to sample, low bytes first.

    Parameters
    ----------
    values : finite, shape (samples, numbers in each).

    >>> unpacked(in_16_bits(np.array([[0.0], [2.0], [1.0]]))).round(4).tolist()
    [0.0, 2.0, 1.0]
    """
    scale = float(np.abs(values).max()) / _WHOLE or 1.0
    whole = np.round(values / scale).astype(np.int16).T
    steps = np.diff(whole, axis=1, prepend=np.int16(0)).astype("<i2")  # modulo 2^16, as the sums that undo it
    data = base64.b64encode(steps.ravel().view(np.uint8).reshape(-1, 2).T.tobytes())
    return {"kind": "d2", "data": data.decode(), "scale": scale, "samples": len(values)}
