"""A SYNTHETIC water-channel campaign: records made by a random generator from a known truth, never measured.

It tests how real records are processed: the results of the pipeline can be compared with the truth.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from io import StringIO
from itertools import product
from pathlib import Path

import numpy as np

from wingbeat._base import FaultList, write_atomically
from wingbeat.aero import SuFan
from wingbeat.aero.formula_models import CentreTerms, FormulaTerms
from wingbeat.experiment.curve_forms import Array, value_and_slopes
from wingbeat.experiment.load_cell_run import CHANNELS, COLUMN_UNITS, CONSTANT_UNITS, OPTIONAL_UNITS, LoadCellRun

_SU_FAN = SuFan()
assert _SU_FAN.centre_terms is not None  # Su et al. give one
# The published formulas themselves, without blends, as a fit meets them.
TRUTH: dict[str, FormulaTerms | CentreTerms] = {
    "C_L": _SU_FAN.lift_terms,
    "C_D": _SU_FAN.drag_terms,
    "x_cp": _SU_FAN.centre_terms,
}


@dataclass(frozen=True)
class Campaign:
    """Points and errors of a synthetic campaign; the defaults are the plate, water and sweep of Su et al.

    Parameters
    ----------
    reynolds : chord Reynolds numbers.
    alpha_deg : angles of attack [deg].
    repeats : runs of each point.
    duration, rate : length of a record [s] and samples per second [Hz].
    turbulence : standard deviation of each force coefficient within a record [-]; C_M gets a quarter of it.
    memory : correlation time of the turbulence [s].
    cell_noise : standard deviation of the load cell's white noise, as a share of its scale (1 N, 0.1 N m).
    drift : largest change of the zero readings over a run, as a share of the same scale.
    start : share by which loads overshoot when the stream starts; this share decays with a time constant of 1.5 s.
    chord, span, thickness, channel_width : of plate and channel [m].
    density, viscosity : of the water [kg/m3, m2/s].

    Raises
    ------
    InvalidInputError : no angles, Reynolds numbers or repeats, or numbers that are not positive.
    """

    reynolds: tuple[float, ...] = (2e4, 3e4, 4e4, 5e4)
    alpha_deg: tuple[float, ...] = tuple(float(a) for a in range(0, 111, 2))
    repeats: int = 3
    duration: float = 30.0
    rate: float = 100.0
    turbulence: float = 0.1
    memory: float = 0.2
    cell_noise: float = 0.01
    drift: float = 0.02
    start: float = 0.6
    chord: float = 0.076
    span: float = 0.456
    thickness: float = 0.008
    channel_width: float = 0.8
    density: float = 998.0
    viscosity: float = 1.0e-6

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("reynolds", "alpha_deg"):
            if not getattr(self, name):
                faults.add(name, getattr(self, name), "is empty", "give at least one")
        for name in ("duration", "rate", "memory", "chord", "span", "channel_width", "density", "viscosity"):
            faults.number(name, getattr(self, name), above=0)
        for name in ("turbulence", "cell_noise", "drift", "thickness"):
            faults.number(name, getattr(self, name), at_least=0)
        if self.repeats < 1:
            faults.add("repeats", self.repeats, "must be at least 1")
        faults.raise_if_any()


def true_coefficients(alpha_deg: Array) -> tuple[Array, Array, Array]:
    """Return the true coefficients C_L, C_D and x_cp at angles [deg], shape (n,)."""
    lift, drag, centre = (value_and_slopes(terms, alpha_deg)[0] for terms in TRUTH.values())
    return lift, drag, centre


def synthetic_runs(campaign: Campaign, seed: int = 0) -> list[LoadCellRun]:
    """Return the records of a synthetic campaign; the same seed gives the same records.

    Each channel is a sum of four parts: the true load times the start-up factor ``1 + start exp(-t/1.5)``,
    fluctuations of the flow (a first-order Markov process), white noise of the load cell, and the zero. The zero
    drifts linearly from the zero reading before the run to the zero reading after the run.

    Parameters
    ----------
    campaign : the angles and Reynolds numbers to measure, and the errors.
    seed : of the random numbers.

    >>> small = Campaign(reynolds=(3e4,), alpha_deg=(10.0, 20.0), repeats=2, rate=10.0)
    >>> [run.name for run in synthetic_runs(small)]
    ['re30000_a10_1', 're30000_a10_2', 're30000_a20_1', 're30000_a20_2']
    """
    from scipy.signal import lfilter

    random = np.random.default_rng(seed)
    count = round(campaign.duration * campaign.rate)
    time = np.arange(count) / campaign.rate
    lift, drag, centre = true_coefficients(np.array(campaign.alpha_deg))
    cos, sin = np.cos(np.deg2rad(campaign.alpha_deg)), np.sin(np.deg2rad(campaign.alpha_deg))
    normal = lift * cos + drag * sin
    true = np.stack([normal, drag * cos - lift * sin, normal * (0.5 - centre)], axis=1)
    plate = {key: getattr(campaign, key) for key in CONSTANT_UNITS | OPTIONAL_UNITS if key != "speed"}
    memory = np.exp(-1.0 / (campaign.rate * campaign.memory))
    level = campaign.turbulence * np.array([[1.0], [1.0], [0.25]])
    transient = 1.0 + campaign.start * np.exp(-time / 1.5)
    scale = np.array([[1.0], [1.0], [0.1]])
    runs = []
    for reynolds in campaign.reynolds:
        speed = reynolds * campaign.viscosity / campaign.chord
        force = 0.5 * campaign.density * speed**2 * campaign.chord * campaign.span
        full = np.array([[force], [force], [force * campaign.chord]])
        for (alpha, coefficients), repeat in product(
            zip(campaign.alpha_deg, true, strict=True), range(1, campaign.repeats + 1)
        ):
            kicks = random.normal(size=(3, count)) * np.sqrt(1.0 - memory**2)
            # Start from the stationary distribution; otherwise the first second would be too quiet.
            kicks[:, 0] /= np.sqrt(1.0 - memory**2)
            flow = np.asarray(lfilter([1.0], [1.0, -memory], kicks))
            zero = random.uniform(-campaign.drift, campaign.drift, (3, 2)) * scale
            drifting = zero[:, :1] + (zero[:, 1:] - zero[:, :1]) * (time - time[0]) / (time[-1] - time[0])
            loads = full * (coefficients[:, None] * transient + level * flow) + drifting
            loads += campaign.cell_noise * scale * random.normal(size=(3, count))
            name = f"re{reynolds:.0f}_a{alpha:g}_{repeat}"
            series = dict(zip(CHANNELS, loads, strict=True))
            runs.append(LoadCellRun(name, time, **series, alpha_deg=alpha, speed=speed, tare=zero, **plate))
    return runs


def save_runs(runs: list[LoadCellRun], folder: str | Path) -> list[Path]:
    """Write each run as a CSV file that `read_run` reads, labelled as synthetic; return the paths.

    Parameters
    ----------
    runs : the records.
    folder : to write to; it must be there already.

    Raises
    ------
    FileError : the folder is not there, or a file cannot be written.
    """
    paths = []
    for run in runs:
        text = StringIO()
        text.write("# SYNTHETIC: made by wingbeat's random generator from known coefficients, not measured\n")
        for key, unit in (CONSTANT_UNITS | OPTIONAL_UNITS).items():
            if getattr(run, key) is not None:
                text.write(f"# {key} [{unit}] = {float(getattr(run, key))!r}\n")
        for channel, (before, after) in zip(CHANNELS, np.asarray(run.tare).tolist(), strict=True):
            text.write(f"# tare_{channel} = {before!r}, {after!r}\n")
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(f"{name} [{unit}]" for name, unit in COLUMN_UNITS.items())
        columns = [np.asarray(getattr(run, name)) for name in COLUMN_UNITS]
        writer.writerows([f"{cell:.7g}" for cell in row] for row in zip(*columns, strict=True))
        path = Path(folder) / f"{run.name}.csv"
        write_atomically(path, text.getvalue())
        paths.append(path)
    return paths
