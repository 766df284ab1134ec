"""A gait as a table: CSV for a robot's controller, and structures with time for MATLAB and Simulink."""

from __future__ import annotations

import csv
import io
import json
from typing import Any

import numpy as np

from wingbeat.exports.gait import Column, Gait


def _about(gait: Gait) -> str:
    what = gait.orbit.inputs
    return f"{what['species']['name']} at {what['speed']:g} m/s"


def gait_csv(gait: Gait) -> bytes:
    """Return a CSV table: a header of comment lines with units, then one row for each equal phase of the beat.

    The beat repeats: one time step after the last row, the first row follows again. The table therefore leaves out
    the end of the beat.

    Parameters
    ----------
    gait : the gait.
    """
    out = io.StringIO()
    out.write(f"# gait of one wing of {_about(gait)}, written by the package wingbeat; SI units, radians\n")
    out.write("# the wings move alike; the beat repeats after the last row\n")
    for name, (value, unit) in gait.constants.items():
        out.write(f"# {name} = {json.dumps(value)}{_bracket(unit)}\n")
    out.write("#\n# columns: name [unit] meaning\n")
    for term, _ in gait.columns:
        out.write(f"# {term.name}{_bracket(term.unit)} {term.label}\n")
    table = csv.writer(out, lineterminator="\n")
    table.writerow(term.name for term, _ in gait.columns)
    table.writerows(zip(*(map(repr, values[:-1].tolist()) for _, values in gait.columns), strict=True))
    return out.getvalue().encode()


def _bracket(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def gait_mat(gait: Gait) -> bytes:
    """Return a MATLAB file, version 5, with a structure with time for each series of the gait.

    Simulink's block From Workspace takes such structures: `time`, and `signals` with `values` and `dimensions`.
    The last value belongs to the next top of the stroke, so that interpolation covers the whole beat.

    Parameters
    ----------
    gait : the gait.
    """
    from scipy.io import savemat

    time, *series = gait.columns
    content: dict[str, Any] = {
        "gait": {column.term.name: _with_time(time.values, column) for column in series},
        "units": {term.name: term.unit for term, _ in gait.columns},
        "meaning": {term.name: term.label for term, _ in gait.columns},
        "constants": {name: value for name, (value, _) in gait.constants.items()},
        "constants_units": {name: unit for name, (_, unit) in gait.constants.items()},
        "about": _about(gait),
    }
    held = io.BytesIO()
    savemat(held, content, long_field_names=True, do_compression=True, oned_as="column")
    return held.getvalue()


def _with_time(time: np.ndarray, column: Column) -> dict[str, Any]:
    signals = {"values": column.values[:, None], "dimensions": 1.0, "label": column.term.name}
    return {"time": time[:, None], "signals": signals}
