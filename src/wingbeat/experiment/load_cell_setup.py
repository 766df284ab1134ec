"""What the files of a load cell do not say: which channel is which, units, and the constants of the rig."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import FaultList, InvalidInputError, is_number, read_text, suggest, toml_tables
from wingbeat._base.sheets import split_unit
from wingbeat.experiment.load_cell_run import COLUMN_UNITS, CONSTANT_UNITS, OPTIONAL_UNITS, TARE_UNITS

# What a setup can give beside the constants of a run.
SETUP_UNITS = {"sample_rate": "Hz", "moment_axis": "m"}
ROLES = {"time": "time", "normal": "normal_force", "tangential": "tangential_force", "moment": "moment"}
ROLES |= {"alpha": "alpha_deg"} | {name: name for name in COLUMN_UNITS}
_POUND, _INCH = 4.4482216152605, 0.0254  # [N, m], exact
_KILOPOND = 9.80665  # [N], exact
# Factors to SI by unit, in lower case and without spaces, dots, hyphens and asterisks.
_FACTORS: dict[str, dict[str, float]] = {
    "force": {
        **dict.fromkeys(("n", "newton", "newtons"), 1.0),
        **{"mn": 1e-3, "cn": 1e-2, "kn": 1e3, "un": 1e-6, "µn": 1e-6, "μn": 1e-6, "dyn": 1e-5},
        **dict.fromkeys(("lbf", "lb", "lbs", "pounds", "poundforce", "poundsforce"), _POUND),
        **{"klbf": 1e3 * _POUND, "klb": 1e3 * _POUND, "ozf": _POUND / 16},
        **{"kgf": _KILOPOND, "kp": _KILOPOND, "gf": 1e-3 * _KILOPOND},
    },
    "moment": {
        **dict.fromkeys(("nm", "newtonmeter", "newtonmeters", "newtonmetre", "newtonmetres"), 1.0),
        **{"nmm": 1e-3, "ncm": 1e-2, "knm": 1e3, "mnm": 1e-3, "unm": 1e-6, "µnm": 1e-6, "μnm": 1e-6},
        **dict.fromkeys(("lbfin", "lbin", "inlbf", "inlb", "inlbs"), _POUND * _INCH),
        **dict.fromkeys(("lbfft", "lbft", "ftlbf", "ftlb", "ftlbs"), _POUND * 12 * _INCH),
        **dict.fromkeys(("ozfin", "ozin", "inoz", "inozf"), _POUND / 16 * _INCH),
        **{"kgfm": _KILOPOND, "kgfcm": 1e-2 * _KILOPOND, "kgfmm": 1e-3 * _KILOPOND, "gfcm": 1e-5 * _KILOPOND},
    },
    "angle": {**dict.fromkeys(("deg", "degree", "degrees", "°"), 1.0), "rad": 180 / np.pi, "radians": 180 / np.pi},
    "time": {
        **dict.fromkeys(("s", "sec", "second", "seconds"), 1.0),
        "ms": 1e-3,
        "us": 1e-6,
        "µs": 1e-6,
        "min": 60.0,
    },
}
KINDS = {
    "normal_force": "force",
    "tangential_force": "force",
    "moment": "moment",
    "alpha_deg": "angle",
    "time": "time",
}
# What units mean that need more than a factor.
_UNCLEAR = {
    **dict.fromkeys(
        ("v", "volt", "volts", "mv", "mv/v", "v/v"),
        "is an electric signal; apply the load cell's calibration first",
    ),
    **dict.fromkeys(
        ("kg", "g", "grams", "kgcm", "kgm"), "is a mass; is it the weight of one? Then the unit is kgf or gf"
    ),
    **dict.fromkeys(
        ("counts", "forcecounts", "torquecounts"),
        "are numbers of the converter; divide them by the counts per unit",
    ),
}


@dataclass(frozen=True)
class LoadCellSetup:
    """What the files of a load cell do not say: which channel is which, the constants of the rig, and the zero.

    Parameters
    ----------
    channels : names of the file's channels by normal, tangential, moment, alpha, time. ``-Fz`` reverses a sign; a
        unit in brackets replaces that of the file, as in ``Ty [N mm]``.
    constants : speed, density, viscosity [m/s, kg/m3, m2/s], chord and span [m], and optionally thickness and
        channel_width [m], sample_rate [Hz], moment_axis: how far the axis of the moment is behind mid-chord [m],
        and zero readings such as tare_moment, before and after the run [N, N, N m].
    alpha_deg : angle of attack of the run [deg], if no channel has it.
    tare : files of the same kind with the fluid at rest: one, or one before and one after the run.

    Raises
    ------
    InvalidInputError : an unknown name, or a value that is no number.
    """

    channels: Mapping[str, str] = field(default_factory=dict)
    constants: Mapping[str, Any] = field(default_factory=dict)
    alpha_deg: float | None = None
    tare: tuple[Path, ...] = ()

    def __post_init__(self) -> None:
        faults = FaultList()
        roles = {}
        for role, name in self.channels.items():
            if role not in ROLES:
                faults.add("channels", role, "is no channel of a run", suggest(role, ROLES))
            elif not isinstance(name, str) or not name.strip():
                faults.add(f"channels, {role}", name, "must be the name of a channel")
            elif ROLES[role] in roles:
                faults.add("channels", role, "is given twice", "keep one")
            else:
                roles[ROLES[role]] = name.strip()
        for name, value in self.constants.items():
            if name in TARE_UNITS:
                pair = value if isinstance(value, list | tuple) else ()
                if len(pair) != 2 or not all(map(is_number, pair)):
                    faults.add(name, value, "must be two numbers, before and after the run")
            elif name in CONSTANT_UNITS | OPTIONAL_UNITS | SETUP_UNITS:
                unit = (CONSTANT_UNITS | OPTIONAL_UNITS | SETUP_UNITS)[name]
                faults.number(name, value, unit=unit, above=0.0 if name == "sample_rate" else -math.inf)
            else:
                known = [*CONSTANT_UNITS, *OPTIONAL_UNITS, *SETUP_UNITS, *TARE_UNITS]
                faults.add("constants", name, "is not known", suggest(name, known))
        if self.alpha_deg is not None:
            faults.number("alpha_deg", self.alpha_deg, at_least=-180, at_most=180, unit="deg")
        if len(self.tare) > 2:
            faults.add("tare", len(self.tare), "must be one file, or two: before and after the run")
        faults.raise_if_any()
        object.__setattr__(self, "channels", roles)
        object.__setattr__(self, "tare", tuple(map(Path, self.tare)))


def load_setup(path: str | Path) -> tuple[LoadCellSetup, tuple[tuple[float, float], ...]]:
    """Read a setup and the intervals of rest from a TOML file.

    The tables are channels and, at the top, the constants, alpha_deg, tare (names of files beside the TOML) and
    rest (pairs of start and end [s]).

    Parameters
    ----------
    path : of the TOML file.

    Raises
    ------
    FileError : the file is missing, or no TOML.
    InvalidInputError : an unknown key, or a value of another kind.
    """
    path, faults = Path(path), FaultList()
    tables = toml_tables(read_text(path), path.name)
    channels, rest = tables.pop("channels", {}), tables.pop("rest", [])
    tare, alpha_deg = tables.pop("tare", []), tables.pop("alpha_deg", None)
    if not isinstance(channels, dict):
        faults.add(f"{path.name}, channels", channels, "must be a table", 'such as channels = { normal = "Fz" }')
    tare = [tare] if isinstance(tare, str) else tare
    if not isinstance(tare, list) or not all(isinstance(name, str) for name in tare):
        faults.add(f"{path.name}, tare", tare, "must be the names of files")
    pairs = rest if isinstance(rest, list) else [rest]
    if any(not isinstance(p, list) or len(p) != 2 or not all(map(is_number, p)) for p in pairs):
        faults.add(f"{path.name}, rest", rest, "must be pairs of numbers", "such as rest = [[0, 5], [35, 40]]")
    faults.raise_if_any()
    try:
        setup = LoadCellSetup(channels, tables, alpha_deg, tuple(path.parent / name for name in tare))
    except InvalidInputError as error:
        named = [dataclasses.replace(fault, where=f"{path.name}, {fault.where}") for fault in error.faults]
        raise InvalidInputError(named) from None
    return setup, tuple((float(start), float(end)) for start, end in pairs)


def unit_in(name: str) -> str | None:
    """Return the unit that a channel's name ends in, as in "Ty [N mm]"; "(Filtered)" and "[0]" are none.

    >>> unit_in("Ty [N mm]"), unit_in("Fz (N)"), unit_in("Fz (Filtered)"), unit_in("Force[0]")
    ('N mm', 'N', None, None)
    """
    unit = split_unit(name).unit or ""
    known = _plain(unit) in _UNCLEAR or any(_plain(unit) in table for table in _FACTORS.values())
    square = name.rstrip().endswith("]") and re.search(r"[^\W\d_]", unit)
    return unit if known or square else None


def _plain(unit: str) -> str:
    return re.sub(r"[\s·*.\-⋅^]", "", unit).lower()


def unit_factor(unit: str, kind: str) -> tuple[float | None, str]:
    """Return the factor from a unit to SI, and nothing; if there is none, None and why."""
    plain = _plain(unit)
    if unit.strip()[:1] == "M" and plain in ("mn", "mnm"):
        return None, "is mega, not milli, of a unit"
    if (found := _FACTORS[kind].get(plain)) is not None:
        return found, ""
    if plain in _UNCLEAR:
        return None, _UNCLEAR[plain]
    other = next((name for name, table in _FACTORS.items() if plain in table), None)
    return None, f"is a unit of {other}, not of {kind}" if other else f"is no unit of {kind} that is read"
