"""A strip-motion case from its files: ``case.toml`` and the tables of strips and forces beside it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, FileError, InvalidInputError, is_number, read_text, suggest, toml_tables
from wingbeat._base.sheets import read_sheet
from wingbeat_evidence.measured_motion.force_table import read_forces
from wingbeat_evidence.measured_motion.strip_case import WINGS, StripCase
from wingbeat_evidence.measured_motion.strip_checks import (
    SCALAR_LIMITS,
    check_arrays,
    check_mean_force,
    check_scalars,
    check_window,
)
from wingbeat_evidence.measured_motion.strip_table import read_strips

REQUIRED_KEYS = ("name", *SCALAR_LIMITS, "mirrored", "periodic", "strips")
KNOWN_KEYS = (*REQUIRED_KEYS, "from", "to", "forces", "mean_force", "wing", "title")
# If the frequency is invalid, steps of up to ten minutes are accepted, because we cannot say what is wrong with
# them.
_UNKNOWN_FREQUENCY = 3e-4
_WINDOW = {"start": "from", "end": "to"}


def read_strip_case(path: str | Path) -> StripCase:
    """Read a strip-motion case: a TOML file, a CSV file of strips and, if there is one, a CSV file of forces.

    ``case.toml`` states name, mass [kg], density [kg/m3], gravity [m/s2], frequency [Hz], speed [m/s], mirrored,
    periodic and strips. The value of strips is the name of the file of strips, in the same folder. The forces are
    given either by forces, the name of the file of forces, or by mean_force ([fx, fz] in N). Optional are from and
    to [s], wing ("feathered", "membrane" or "rigid"), and title (text for figures). `StripCase` explains
    these values.

    The file of strips has one row for each time and strip, with the columns ``time_s, strip``, quarter chord
    ``x_m, y_m, z_m``, chord from trailing to leading edge ``chord_x_m, chord_y_m, chord_z_m``, and ``area_m2``.
    Optional are velocities through still air at the quarter chord ``vx_m_s, vy_m_s, vz_m_s`` and at the
    three-quarter chord ``v3x_m_s, v3y_m_s, v3z_m_s``. The strips of a wing are numbered along it. The file of
    forces has ``time_s``, with the same times as the strips, and any of ``fx_n, fz_n, fx_n_se, fz_n_se``.

    Parameters
    ----------
    path : of the TOML file.

    Raises
    ------
    FileError : a file is missing or cannot be read.
    InvalidInputError : missing or unknown keys and columns, numbers out of range, times that do not rise, strips
        that lack a row at some time, times of forces that differ from those of strips, each fault with its file and
        row.

    >>> read_strip_case(shipped_cases()[-1]).name
    'flapper-yeo2011'
    """
    path = Path(path)
    faults = FaultList()
    given = toml_tables(read_text(path), str(path))
    _check_keys(faults, given, path.name)
    strips = _table(faults, given, "strips", path, lambda sheet: read_strips(faults, sheet))
    times = None if strips is None else strips.arrays["times"]
    window: tuple[Any, Any] = (None, None)
    if strips is not None and times is not None:
        before = len(faults.faults)
        check_arrays(faults, strips.arrays, _frequency(given), strips.where)
        if len(faults.faults) == before:
            start, end = given.get("from"), given.get("to")
            check_window(faults, times, start, end, lambda name: f"{path.name}, {_WINDOW[name]}")
            window = (start, end) if len(faults.faults) == before else window
    measured = _table(faults, given, "forces", path, lambda sheet: read_forces(faults, sheet, times, window))
    faults.raise_if_any()
    assert strips is not None
    forces, errors = measured or ({}, {})
    mean = given.get("mean_force")
    scalars = {name: float(given[name]) for name in SCALAR_LIMITS}
    return StripCase(
        name=given["name"],
        mirrored=given["mirrored"],
        periodic=given["periodic"],
        **scalars,
        **strips.arrays,  # type: ignore[arg-type]
        forces=forces,
        errors=errors,
        mean_force=None if mean is None else (float(mean[0]), float(mean[1])),
        start=given.get("from"),
        end=given.get("to"),
        wing=given.get("wing"),
        title=given.get("title", ""),
    )


def _frequency(given: dict[str, Any]) -> float:
    """Return the stated frequency; if it is invalid, a number so low that no step of time counts as wide."""
    frequency, limits = given.get("frequency"), SCALAR_LIMITS["frequency"]
    if is_number(frequency) and limits.least <= frequency <= limits.most:
        return float(frequency)
    return _UNKNOWN_FREQUENCY


def shipped_cases() -> list[Path]:
    """Return the paths of the cases that the package contains, sorted by name.

    >>> len(shipped_cases())
    5
    """
    folder = Path(__file__).parent.parent / "data" / "flights"
    return sorted(folder.glob("*/case.toml"))


def _check_keys(faults: FaultList, given: dict[str, Any], file: str) -> None:
    for key in given:
        if key not in KNOWN_KEYS:
            faults.add(f"{file}, {key!r}"[:100], "", "is not a known key", suggest(key, KNOWN_KEYS))
    for key in REQUIRED_KEYS:
        if key not in given:
            faults.add(f"{file}, {key}", "", "is missing", f"a case has {', '.join(REQUIRED_KEYS)}")
    check_scalars(faults, {k: v for k, v in given.items() if k not in ("strips",)}, lambda name: f"{file}, {name}")
    for key in ("strips", "forces"):
        if key in given and not (isinstance(given[key], str) and given[key].strip()):
            faults.add(f"{file}, {key}", given[key], "must be the name of a file", f'for example "{key}.csv"')
    if ("forces" in given) == ("mean_force" in given):
        both = "both" if "forces" in given else "none"
        fix = "give the file of the forces, or their mean [fx, fz] in N"
        faults.add(f"{file}, forces", both, "exactly one of forces and mean_force must be given", fix)
    if "mean_force" in given:
        check_mean_force(faults, f"{file}, mean_force", given["mean_force"])
    if not isinstance(given.get("title", ""), str):
        faults.add(f"{file}, title", given["title"], "must be a text", 'for example "dragonfly 1"')
    if "wing" in given and given["wing"] not in WINGS:
        faults.choice(f"{file}, wing", given["wing"], WINGS)


def _table(faults: FaultList, given: dict[str, Any], key: str, path: Path, read: Any) -> Any:
    """Return what `read` returns for the table that a key names, or None if the table has a fault."""
    name = given.get(key)
    if not isinstance(name, str) or not name.strip():
        return None
    try:
        return read(read_sheet(path.parent / name))
    except InvalidInputError as error:
        faults.faults.extend(error.faults)
    except FileError as error:
        faults.add(
            f"{path.name}, {key}", name, str(error), f"give the file's path relative to the folder of {path.name}"
        )
    return None
