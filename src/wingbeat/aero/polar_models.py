"""Coefficient models from files of polars: one table, or a family over the Reynolds number."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._base.sheets import Sheet, same_name
from wingbeat.aero.coefficient_model import centre_from_moment, check_aspect_ratio
from wingbeat.aero.completion import VITERNA, closed_turn, viterna
from wingbeat.aero.extension import check_extension
from wingbeat.aero.family import FamilyCoefficients
from wingbeat.aero.polar_sheet import (
    REQUIRED,
    SAME_STREAM,
    PolarSheet,
    doubtful_drag,
    fitting,
    read_polar,
    refuse_several,
    reynolds_groups,
)
from wingbeat.aero.table import COLUMNS, MIN_ROWS, TableCoefficients, check_columns, check_coverage, numbers


def _stated_aspect_ratio(faults: FaultList, sheet: Sheet) -> float | None:
    """Return the aspect ratio that a comment of the file states, such as ``# aspect_ratio = 6``."""
    for key, (row, text) in sheet.constants.items():
        if same_name(key) == "aspectratio":
            where = f"{sheet.file} row {row}, aspect_ratio"
            stated = math.inf if text == "inf" else numbers(faults, [text], lambda _, where=where: where)[0]
            if not math.isnan(stated):
                check_aspect_ratio(faults, where, stated)
            return stated
    return None


# What a polar's head says in a note, and the Reynolds number at the end of a file's name.
_HEAD = re.compile(r"[\w ]+: (.+?), Re \d+(?:, Ncrit ([\d.]+))?")
_RE_OF_NAME = re.compile(r"(?i)([ _.-]+(re)?|re)[ _.-]*[\d.]+(e\d+|k)?$")
_BY_VITERNA = "--extension viterna"
_COMPLETED = "a fit completes it: {}; or complete it by Viterna's rule: {}"


def _whole_centre(polar: PolarSheet) -> tuple[list[float] | None, tuple[str, ...]]:
    """Return x_cp in every row, and notes; empty cells, where there is no force, are filled from neighbours."""
    given = polar.columns.get("x_cp")
    if given is None and polar.of_program and "C_M" in polar.columns:
        given = centre_from_moment(*(polar.columns[name] for name in ("alpha_deg", "C_L", "C_D", "C_M")))
    if given is None:
        return None, ()
    known, alpha = np.isfinite(given), polar.columns["alpha_deg"]
    if known.sum() < 2:
        return None, ("x_cp: no two rows have a value, so the model has no centre of pressure",)
    if known.all():
        return given.tolist(), ()
    period = 360.0 if alpha[-1] - alpha[0] == 360 else None
    filled = np.interp(alpha, alpha[known], given[known], period=period)
    angles = ", ".join(f"{angle:g}" for angle in alpha[~known][:8]) + ", ..." * bool((~known).sum() > 8)
    return filled.tolist(), (f"x_cp is empty at {angles} degrees and is filled from the neighbouring rows",)


def load_table(
    path: str | Path | Sequence[str | Path], extension: str = "mirrored", blend_width_deg: float = 1.0
) -> TableCoefficients | FamilyCoefficients:
    """Read a coefficient table: CSV with the columns alpha_deg, C_L, C_D and, if known, x_cp, reynolds; or a polar.

    Polars at several Reynolds numbers, in one file or in several, become a model that interpolates between them.

    Polars of XFOIL, XFLR5, AeroDyn, QBlade and others are read as they are (`wingbeat.aero.polar_formats`).
    Columns may have any order and spelling (alpha, c_l, CL, Cd, Re), with or without a unit in brackets. Others are
    ignored; the model's `notes` name them. Blank rows and rows that begin with # are skipped. One such row may
    state the wing's aspect ratio, for example ``# aspect_ratio = 6``, or ``inf`` for a section; the model of
    induced flow needs it.

    Parameters
    ----------
    path : the file, or several with one polar each; angles in degrees.
    extension, blend_width_deg : as in `TableCoefficients`; or "viterna", which completes a table that ends at the
        stall to the whole circle (`wingbeat.aero.completion.viterna`).

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : inputs that `TableCoefficients` refuses, each fault with its row and column; a table that is
        not one curve from 0 to at least 90 degrees, with the command that makes a curve of it.
    """
    wrong: list[Fault] = []
    found: list[tuple[float, TableCoefficients]] = []
    paths = [Path(path)] if isinstance(path, str | Path) else [Path(one) for one in path]
    advised: set[str] = set()
    for one in paths:
        faults = FaultList()
        check_extension(faults, "signed" if extension == VITERNA else extension, blend_width_deg)
        polar = read_polar(one, faults)
        parts = [] if faults.faults else _polars(polar)
        advice = f"complete each polar by Viterna's rule: {_BY_VITERNA}" if parts or len(paths) > 1 else ""
        if parts:
            stream = parts[0][1].columns["reynolds"]
            only = f" --reynolds-range {math.floor(stream.min())} {math.ceil(stream.max())}"
            advice += f"; or fit one of them: {fitting(one, parts[0][1], more=only)}"
        advised.add(advice)
        for reynolds, part in parts or [(None, polar)]:
            own = FaultList()
            own.faults += faults.faults
            try:
                table = _table_of(own, one, part, extension, blend_width_deg, advice)
            except InvalidInputError as error:
                wrong += error.faults
                continue
            if reynolds is None and len(paths) > 1:
                reynolds = _stream_of(own, part)
                wrong += own.faults
            found.append((reynolds or 0.0, table))
    short = [fault for fault in wrong if fault.fix and fault.fix in advised]
    if len(short) > 1:
        files = dict.fromkeys(fault.where.partition(" row ")[0] for fault in short)
        which = f": {', '.join(files)}" if len(files) > 1 else ""
        told = dataclasses.replace(short[0], rule=f"{short[0].rule} ({len(short)} polars do not{which})")
        wrong = [told, *(fault for fault in wrong if fault not in short)]
    if wrong:
        raise InvalidInputError(wrong)
    if len(found) == 1:
        return found[0][1]
    found.sort(key=lambda pair: pair[0])
    values, tables = zip(*found, strict=True)
    notes: dict[str, list[str]] = {}
    for reynolds, table in found:
        for note in table.notes:
            notes.setdefault(note, []).append(f"{reynolds:.0f}")
    heads = [head for note in notes if (head := _HEAD.match(note))]
    wings = dict.fromkeys(head[1] for head in heads)
    if len({re.sub(r"\W", "", wing).lower() for wing in wings}) > 1:
        rule = "are names of several sections in the heads of the polars"
        raise InvalidInputError([Fault(paths[0].name, ", ".join(wings), rule, "give polars of one section")])
    criteria = dict.fromkeys(head[2] for head in heads)
    told = [note if len(at) == len(found) else f"Re {', '.join(at)}: {note}" for note, at in notes.items()]
    if len(criteria) > 1:
        told.insert(0, f"the polars differ in Ncrit ({', '.join(map(str, criteria))}), not only in Re")
    ends = f"from Re {values[0]:.0f} to {values[-1]:.0f}; beyond, the nearest holds"
    own = paths[0].stem if len(paths) == 1 else _RE_OF_NAME.sub("", paths[0].stem) or paths[0].stem
    return FamilyCoefficients(own, values, tables, (f"{len(found)} polars make one model {ends}", *told))


def _polars(polar: PolarSheet) -> list[tuple[float, PolarSheet]]:
    """Return the polars of a table that holds several, each with its Reynolds number; none if it is one curve.

    They are the rows of one Reynolds number, or of groups 15 per cent apart, if no angle repeats within them.
    """
    alpha, stream = np.round(polar.columns["alpha_deg"], 6), polar.columns.get("reynolds")
    if stream is None or not np.isfinite(stream).all() or len(np.unique(alpha)) == len(alpha):
        return []
    exact = [(value, value) for value in np.unique(stream)]
    for groups in (exact, reynolds_groups(stream)):
        rows = [np.flatnonzero((stream >= low) & (stream <= high)) for low, high in groups]
        if len(groups) > 1 and all(MIN_ROWS <= len(at) == len(np.unique(alpha[at])) for at in rows):
            middles = [math.sqrt(low * high) for low, high in groups]
            return [(middle, polar.only(at)) for middle, at in zip(middles, rows, strict=True)]
    return []


def _stream_of(faults: FaultList, polar: PolarSheet) -> float | None:
    """Return the Reynolds number of a polar; note a fault if the file states none, or not one for all rows."""
    file, stream = polar.sheet.file, polar.columns.get("reynolds", np.empty(0))
    stream = stream[np.isfinite(stream)]
    if not len(stream):
        fix = "state it in a column reynolds; each polar of a family has its own"
        faults.add(file, "", "states no Reynolds number", fix)
        return None
    low, high = float(stream.min()), float(stream.max())
    if high > SAME_STREAM * low:
        fix = "a family is made of polars at fixed Reynolds numbers (XFOIL: TYPE 1)"
        faults.add(file, f"{low:.0f} to {high:.0f}", "is the Reynolds number along one polar", fix)
    return math.sqrt(low * high)


def _table_of(
    faults: FaultList, path: Path, polar: PolarSheet, extension: str, blend_width_deg: float, advice: str
) -> TableCoefficients:
    """Return the model of one curve; `advice` says what to do with one that ends below 90 degrees."""
    completed = extension == VITERNA
    aspect_ratio = _stated_aspect_ratio(faults, polar.sheet)
    columns = {name.lower(): polar.columns[name].tolist() for name in REQUIRED}
    if not faults.faults:
        refuse_several(faults, path, polar)
        faults.raise_if_any()
    centre, notes = _whole_centre(polar)
    if centre is not None:
        columns["x_cp"] = centre

    def where(row: int, name: str) -> str:
        return polar.where(row, {"c_l": "C_L", "c_d": "C_D"}.get(name, name))

    shape = FaultList()
    check_columns(shape, columns, where)
    if not (faults.faults or shape.faults):
        notes = (*notes, *closed_turn(columns))
        if completed:
            notes = (*notes, *viterna(faults, where, columns, aspect_ratio))
        elif columns["alpha_deg"][-1] < 90:
            at, rule = where(len(polar.sheet.rows) - 1, "alpha_deg"), "the table must reach at least 90 degrees"
            faults.add(
                at, columns["alpha_deg"][-1], rule, advice or _COMPLETED.format(fitting(path, polar), _BY_VITERNA)
            )
        else:
            check_coverage(shape, columns, extension, where)
    noted = {fault.where for fault in faults.faults}
    turned = any(where.endswith(f"column {polar.headings['alpha_deg']}") for where in noted)
    faults.faults += [
        one for one in shape.faults if one.where not in noted and not (turned and "alpha" in one.where)
    ]
    faults.raise_if_any()
    stream = polar.columns.get("reynolds", np.empty(0))
    stream = stream[np.isfinite(stream)]
    return TableCoefficients(
        path.stem,
        *(tuple(columns[name]) for name in COLUMNS),
        x_cp=tuple(columns["x_cp"]) if "x_cp" in columns else None,
        citation=polar.sheet.file,
        reynolds_range=(float(stream.min()), float(stream.max())) if len(stream) else None,
        extension="signed" if completed else extension,
        blend_width_deg=blend_width_deg,
        aspect_ratio=aspect_ratio,
        notes=(*polar.notes, *notes, *doubtful_drag(polar.columns["C_D"], polar.columns.get("reynolds"))),
    )
