"""The Pareto front of a study: the certified points that no other point beats in every wanted quantity.

A grid, not an evolutionary search: of 96 orbits of a robot over speed, payload and gear ratio, a grid's front had
1 % more hypervolume than that of NSGA-II (pymoo 0.6.2, 24 designs, one seed), in 60 % of the time. The front of
NSGA-II had more points.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import (
    FaultList,
    FileError,
    Line,
    Report,
    Row,
    Table,
    find,
    for_people,
    in_words,
    install_extra,
    label_of,
    suggest,
)
from wingbeat.animal.species.numbers import shown, spoken

if TYPE_CHECKING:
    import pandas as pd

CONTRIBUTION, MASS = "contribution", "mass"
WAYS = ("min", "max")
# Digits to which values count as equal: certified orbits agree to 1e-6.
_DIGITS = 6
# The worst corner of the box lies beyond the worst certified values by this share of their range.
_BEYOND = 0.1


def front_of(frame: pd.DataFrame, best: Mapping[str, str]) -> pd.DataFrame:
    """Return the certified rows of a study's table that no other beats in every wanted quantity.

    Each row minimises one quantity with the varied numbers given: the method of the epsilon-constraint (Haimes et
    al. 1971, IEEE Trans. Syst. Man Cybern. 1:296), as fine as the study's grid. `best` maps columns of numbers, or
    ``mass`` for the whole mass, to ``"min"`` or ``"max"``; the best of the first comes first. Values that agree to
    six digits are equal, and equal points are all kept. ``contribution`` is the share of the box from the best to
    10 % beyond the worst certified values that only this row dominates; ``attrs["hypervolume"]`` is the front's.
    """
    if MASS in best and {"vehicle.body.mass", "vehicle.wing.mass"} <= {*frame.columns}:
        frame = frame.assign(**{MASS: frame["vehicle.body.mass"] + 2 * frame["vehicle.wing.mass"]})
    _check(frame, best)
    names = list(best)
    # Libraries of Pareto fronts let not-a-number beat every number; no point without an orbit goes to them.
    known = (frame["status"] == "converged") & np.isfinite(frame[names].astype(float)).all(axis=1)
    certified = frame[known].reset_index(drop=True)
    front = certified.assign(**{CONTRIBUTION: 0.0})
    front.attrs = {"hypervolume": 0.0, "certified": len(certified)}
    if certified.empty:
        return front
    try:
        import moocore
    except ImportError:
        raise FileError(f"moocore, which finds fronts, is not installed here: {install_extra('pareto')}") from None
    signs = [1.0 if best[name] == "min" else -1.0 for name in names]
    values = np.asarray(certified[names], dtype=float)
    costs = np.array([[float(f"{value:.{_DIGITS}g}") for value in row] for row in values]) * signs
    kept = moocore.is_nondominated(costs, keep_weakly=True)
    low, reach = costs.min(axis=0), np.ptp(costs, axis=0)
    share = (costs[kept] - low) / np.where(reach > 0.0, reach, 1.0)
    corner, box = np.full(len(names), 1.0 + _BEYOND), (1.0 + _BEYOND) ** len(names)
    front = front[kept]
    front[CONTRIBUTION] = moocore.hv_contributions(share, ref=corner) / box
    front.attrs |= {"hypervolume": float(moocore.hypervolume(share, ref=corner)) / box}
    return front.iloc[np.argsort(costs[kept][:, 0], kind="stable")].reset_index(drop=True)


def _check(frame: pd.DataFrame, best: Any) -> None:
    """Refuse what is no choice of at least two columns of numbers with the end that is best."""
    faults, example = FaultList(), "for example speed=max electrical_power=min"
    if not isinstance(best, Mapping) or len(best) < 2:
        faults.add("best", shown(best), "must name at least two quantities, each with min or max", example)
        faults.raise_if_any()
    numbers = [str(name) for name in frame.columns if frame[name].dtype.kind in "fiu"]
    for name, way in best.items():
        if way not in WAYS:
            faults.add(f"best.{spoken(name)}", shown(way), "must be min or max", example)
        if name not in numbers:
            fix = suggest(str(name), numbers, otherwise="`wingbeat study export` writes all columns")
            faults.add("best", shown(name), "is no column of numbers of this study", fix)
    faults.raise_if_any()


def front_report(front: pd.DataFrame, best: Mapping[str, str], varied: list[str]) -> Report:
    """Return a row for each point of a front: the wanted quantities, the varied numbers, the contribution."""
    names = [*best, *(name for name in varied if name not in best)]
    heads, factors = [], []
    for name in names:
        term = find(name)
        factor, unit = for_people(term.unit) if term is not None else (1.0, "")
        heads.append(f"{in_words(name) if name in best else label_of(name, short=True)}\n[{unit or '-'}]")
        factors.append(factor)
    rows = tuple(
        Row(
            (
                *(f"{row[name] * factor:.4g}" for name, factor in zip(names, factors, strict=True)),
                f"{100 * row[CONTRIBUTION]:.2g}",
            )
        )
        for _, row in front.iterrows()
    )
    wanted = ", ".join(f"{'largest' if way == 'max' else 'least'} {in_words(name)}" for name, way in best.items())
    about = f"{len(front)} of {front.attrs['certified']} certified points are on the front of {wanted}"
    share = f"it dominates {100 * front.attrs['hypervolume']:.3g} % of the box between best and worst"
    return [Line(about), Table(rows, (*heads, "adds\n[%]"), "r" * (len(names) + 1)), Line(share)]
