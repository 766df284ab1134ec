"""Which tracked point is which: shoulder, wrist, tip and trailing edge of each wing, and points of the body."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList, read_text, suggest, toml_tables
from wingbeat._base.sheets import SIDE_WORDS
from wingbeat.experiment.point_tables import FEWEST_SEEN, Array
from wingbeat.experiment.tracked_points import TrackedPoints

WING_POINTS = ("shoulder", "wrist", "tip", "trailing", "leading", "tip_trailing")
BODY_POINTS = ("front", "rear")
# Usual names, in lower case and without signs.
_ROLES = {
    **dict.fromkeys(("shoulder", "wingbase", "wingroot", "winghinge"), "shoulder"),
    **dict.fromkeys(("wrist", "carpus", "carpal"), "wrist"),
    **dict.fromkeys(("tip", "wingtip"), "tip"),
    **dict.fromkeys(("trailing", "trailingedge", "te"), "trailing"),
    **dict.fromkeys(("leading", "leadingedge", "le"), "leading"),
    **dict.fromkeys(("tiptrailing", "trailingtip", "tiptrailingedge"), "tip_trailing"),
    **dict.fromkeys(("front", "nose", "beak", "bill", "head", "snout"), "front"),
    **dict.fromkeys(("rear", "tail", "tailbase", "rump"), "rear"),
}


class NamedPoints(NamedTuple):
    """The points that are used: of each wing ("left", "right", or "" for a wing of unknown side), and of the body.

    Attributes
    ----------
    wings, body : positions by role, shape (n, 3) each.
    names : names in the file by role, such as "left_tip".
    notes : what was guessed.
    """

    wings: dict[str, dict[str, Array]]
    body: dict[str, Array]
    names: dict[str, str]
    notes: tuple[str, ...]


def _role(word: str) -> tuple[str, str] | None:
    """Return side ("" if it names none) and role of a name, None if it is not a usual one.

    >>> _role("wingtip_L"), _role("rightWrist"), _role("pt3")
    (('left', 'tip'), ('right', 'wrist'), None)
    """
    parts = [part.lower() for part in re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", word)]
    sides = {SIDE_WORDS[part] for part in parts if part in SIDE_WORDS}
    role = _ROLES.get("".join(part for part in parts if part not in SIDE_WORDS))
    return None if role is None or len(sides) > 1 else (next(iter(sides), ""), role)


def name_points(
    tracked: TrackedPoints, given: str | Path | Mapping[str, str] | None, side: str | None
) -> NamedPoints:
    """Return the points by role.

    Parameters
    ----------
    tracked : all points of a file.
    given : roles in the file's order, ``"shoulder,wrist,tip"``, where an empty word skips a point; or pairs,
        ``"shoulder=pt1,tip=pt3"``; or a mapping or TOML file of such pairs. If None, usual names are looked for.
    side : "left", "right", "both" or None. Points without a side in their name belong to this wing.

    Raises
    ------
    FileError : a TOML file that cannot be read.
    InvalidInputError : unknown roles or points, no shoulder or no tip, a point that was seen in too few frames.
    """
    faults, notes = FaultList(), []
    known, file = list(tracked.positions), tracked.name
    listed = f"{', '.join(known[:30])}{', ...' if len(known) > 30 else ''}"
    own = {name: role for name in known if (role := _role(name)) is not None}
    pairs: list[tuple[str, str]] = []
    where = "--points"
    if given is None:
        pairs = [("_".join(filter(None, role)), name) for name, role in own.items()]
        if pairs:
            notes.append(f"{file}: points by their names: {', '.join(f'{role} = {name}' for role, name in pairs)}")
    elif isinstance(given, Mapping) or str(given).lower().endswith(".toml"):
        table: Any = given
        if not isinstance(given, Mapping):
            table, where = toml_tables(read_text(Path(given)), str(given)), str(given)
            table = table.get("points", table)
        if not isinstance(table, Mapping):
            faults.add(
                f"{where}, points", str(table), "is no table of pairs", 'write [points], and below it tip = "pt3"'
            )
            faults.raise_if_any()
        pairs = [(str(role), str(name)) for role, name in table.items()]
    elif "=" in str(given):
        for word in filter(None, str(given).split(",")):
            role, _, name = word.partition("=")
            pairs.append((role.strip(), name.strip()))
    else:
        words = [word.strip() for word in str(given).split(",")]
        if len(words) > len(known):
            rule = f"names {len(words)} points, but {file} has {len(known)}: {listed}"
            faults.add(where, str(given), rule, "name them in the file's order; an empty word skips one")
        same = {word: name for name in known for word in words if word and _role(word) == own.get(name, ())}
        if len(same) == len(list(filter(None, words))):
            pairs = list(same.items())
            if list(same.values()) != known[: len(same)]:
                notes.append(f"{file}: the points are found by their names, not by the order of --points")
        else:
            pairs = [(word, name) for word, name in zip(words, known, strict=False) if word]
            shown = ", ".join(f"{word} = {name}" for word, name in pairs)
            notes.append(f"{file}: points in the file's order: {shown}")
    found: dict[tuple[str, str], str] = {}
    for word, name in pairs:
        role = _role(word)
        if role is None:
            fix = f"use one of {', '.join((*WING_POINTS, *BODY_POINTS))}, with left_ or right_ in front"
            faults.add(where, word, "is no point of an animal that wingbeat knows", fix)
        elif name not in tracked.positions:
            faults.add(where, f"{word}={name}", f"{file} has no such point", suggest(name, known))
        elif role in found:
            fix = f"give --points with one of each, such as {word}={name}"
            faults.add(where, name, f"and {found[role]} are both {' '.join(filter(None, role))}", fix)
        elif name in found.values():
            faults.add(where, f"{word}={name}", "is a point that has another role", "name each point once")
        else:
            found[role] = name
    faults.raise_if_any()
    sided = {one for one, role in found if one and role in WING_POINTS}
    chosen: dict[str, dict[str, str]] = {}
    for (one, role), name in found.items():
        mine = one or (side if side in ("left", "right") and not sided else "")
        if role in WING_POINTS and (side not in ("left", "right") or mine == side):
            chosen.setdefault(mine, {})[role] = name
    chosen = {one: wing for one, wing in chosen.items() if {"shoulder", "tip"} <= set(wing)}
    if len(chosen) > 1:
        chosen.pop("", None)
    wings = {one: {role: tracked.positions[name] for role, name in wing.items()} for one, wing in chosen.items()}
    if side == "both" and set(wings) != {"left", "right"}:
        fix = "name left_shoulder, left_tip, right_shoulder and right_tip, such as --points left_tip=pt1,..."
        faults.add("--side", side, f"needs both wings; the points of {file} are {listed}", fix)
    elif not wings:
        rule = f"has the points {listed}; which of them are the shoulder and the tip of a wing is not known"
        order = ",".join(["shoulder", "wrist", "tip", "trailing"][: max(len(known), 2)])
        order = "shoulder,tip" if len(known) == 2 else order
        fix = f"give --points in the file's order, such as --points {order} (an empty word skips a point), or "
        pair = f"--points shoulder={known[0]},tip={known[min(2, len(known) - 1)]}"
        what = f"the {side} wing's points" if side in ("left", "right") and sided else "points"
        faults.add(f"{file}, {what}", len(known), rule, fix + pair)
    faults.raise_if_any()
    for one, wing in wings.items():
        seen = {role: np.isfinite(at).all(axis=1) for role, at in wing.items()}
        rule = f"must be seen in at least {FEWEST_SEEN} frames"
        if min(there.sum() for there in seen.values()) >= FEWEST_SEEN:
            seen = {", ".join(seen): np.logical_and.reduce(list(seen.values()))}
            rule = rule.replace("seen", "seen together")
        for role, there in seen.items():
            if there.sum() < FEWEST_SEEN:
                where = f"{file}, {' '.join(filter(None, (one, role)))}"
                faults.add(where, f"{there.sum()} frames", rule, "track more frames")
    faults.raise_if_any()
    body = {role: tracked.positions[name] for (_, role), name in found.items() if role in BODY_POINTS}
    both = np.logical_and.reduce([np.isfinite(at).all(axis=1) for at in body.values()]) if body else np.empty(0)
    if body and (set(body) != set(BODY_POINTS) or both.sum() < FEWEST_SEEN):
        body = {}
        rule = f"the body axis needs the points front and rear, seen together in at least {FEWEST_SEEN} frames"
        notes.append(f"{file}: {rule}")
    used = {name for wing in chosen.values() for name in wing.values()}
    used |= {name for (_, role), name in found.items() if role in body}
    if rest := [f"{' '.join(filter(None, role))} = {name}" for role, name in found.items() if name not in used]:
        notes.append(f"{file}: not used: {', '.join(rest)}")
    names = {"_".join(filter(None, role)): name for role, name in found.items() if name in used}
    return NamedPoints(wings, body, names, tuple(notes))
