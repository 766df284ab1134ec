"""How live animals of a kind move wings, body and tail: parameters to leave free, and the body's pitch by speed.

All ranges stand in `posture.toml`, with their sources.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat.animal.kinematics import PITCH_LAW
from wingbeat.animal.species.numbers import Bound
from wingbeat.animal.species.scaling import CRUISE_BY_MASS
from wingbeat.animal.species.species import Species

_FILE = Path(__file__).with_suffix(".toml")


@functools.cache
def _table() -> dict[str, Any]:
    return tomllib.loads(_FILE.read_text(encoding="utf-8"))


@functools.cache
def free_of(kind: str) -> dict[str, Bound]:
    """Return bounds and reasons of what live animals of a kind change in flight, by names of wingbeat parameters.

    >>> free_of("bird")["downstroke_fraction"].bounds
    (0.4, 0.6)
    """
    found = {}
    for name, entry in _table()[kind]["free"].items():
        low, high = (math.radians(value) if name.endswith("_deg") else float(value) for value in entry["bounds"])
        found[name.removesuffix("_deg")] = Bound((low, high), entry["reason"], entry["guessed"])
    return found


def with_free_stroke(species: Species) -> Species:
    """Return a bird, bat or robot with what live animals of its kind change free as well.

    Guessed bounds of a parameter that is free already become as narrow as those of its kind. A parameter that has
    no effect stays fixed.

    >>> from wingbeat import load_species
    >>> "twist_ratio" in with_free_stroke(load_species("pigeon").with_tail()).free
    True
    """
    vehicle, known = species.vehicle, free_of(species.kind)
    idle = set() if vehicle.tail is not None else {"tail_tilt"}
    upright = vehicle.tail is None and not vehicle.body.crossflow_area
    if upright and vehicle.wing.shoulder[0] == vehicle.wing.shoulder[2] == 0.0:
        idle.add("stroke_plane_tilt")
    added = [name for name in known if name not in species.free and name not in idle]
    bounds, reasons = dict(species.bounds), dict(species.reasons)
    for name, bound in known.items():
        low, high = bounds.get(name, bound.bounds)
        if name in species.free and name in species.guessed_bounds:
            low, high = max(low, bound.bounds[0]), min(high, bound.bounds[1])
        elif name not in added:
            continue
        if (low, high) != bounds.get(name) and low < high:
            bounds[name], reasons[name] = (low, high), bound.reason
    return dataclasses.replace(
        species,
        free=(*species.free, *added),
        bounds=bounds,
        guessed_bounds=species.guessed_bounds | {name for name in added if known[name].guessed},
        reasons=reasons,
    )


def with_posture(species: Species, speed: float) -> Species:
    """Return a bird or bat with the bounds of the body's pitch along the path that fit a flight speed [m/s].

    Bounds in the species file that are no guess stay.

    >>> from wingbeat import load_species
    >>> bounds = with_posture(load_species("pigeon"), 12.0).path_bounds["body_pitch"]
    >>> [round(float(np.degrees(bound))) for bound in bounds]
    [-14, 34]
    """
    if "body_pitch" not in species.guessed_bounds:
        return species
    known = _table()["body_pitch"]
    share = speed / CRUISE_BY_MASS(species.vehicle.mass)
    low, high = (float(np.interp(share, known["speeds"], known[f"{end}_deg"])) for end in ("low", "high"))
    bounds = (np.radians(low - known["wander_deg"]).item(), np.radians(high + known["wander_deg"]).item())
    reason = known["reason"].strip().format(low=low, high=high, speed=speed)
    return dataclasses.replace(
        species,
        path_bounds=species.path_bounds | {"body_pitch": bounds},
        reasons=species.reasons | {"body_pitch": " ".join(reason.split())},
    )


def with_pitch_given_way(species: Species) -> Species:
    """Return a species without the free parameters of a pitch law that a hinge replaces.

    If the mean pitch was free, the hinge's rest angle is so in its place, within the same bounds.

    >>> import wingbeat as wb
    >>> robot = wb.load_species("robofalcon2").with_values({"pitch_hinge.stiffness": 1.4})
    >>> with_pitch_given_way(robot).free
    ('frequency', 'flap_mean', 'flap_amplitude', 'hinge_rest_angle')
    """
    hinge = species.wingbeat.pitch_hinge
    if hinge is None or not hinge.moves_root:
        return species
    free, bounds, reasons = dict.fromkeys(species.free), dict(species.bounds), dict(species.reasons)
    guessed, rest, mean = set(species.guessed_bounds), "hinge_rest_angle", "pitch_mean"
    if mean in free and rest not in free:
        free[rest] = None
        bounds.setdefault(rest, bounds[mean])
        reasons.setdefault(rest, "as for the mean pitch that it replaces")
        guessed |= {rest} if mean in guessed else set()
    kept = tuple(name for name in free if name not in PITCH_LAW)
    return dataclasses.replace(
        species, free=kept, bounds=bounds, reasons=reasons, guessed_bounds=frozenset(guessed)
    )
