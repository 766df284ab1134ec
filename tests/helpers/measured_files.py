"""Random films and load-cell records, good ones and ones with one fault; a seed makes the same again."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat.experiment import LoadCellRun

FILM_FAULTS = (
    "rate",
    "drift",
    "radians",
    "pitch in radians",
    "milliseconds",
    "frames",
    "lengths",
    "swapped",
    "mirror",
)
RECORD_FAULTS = ("step", "drift", "rest", "millinewton", "millimetres", "dynamic viscosity", "density", "speed")


def film_text(random: np.random.Generator, fault: str = "") -> str:
    """Return a film of 1 to 6 beats, as CSV: noise, harmonics, gaps, beats that differ, drifts below 2 per cent.

    A film with a fault has at least two beats and a half.
    """
    beats, frequency = random.uniform(2.5 if fault else 1.0, 6.0), random.uniform(3.0, 25.0)
    rate = min(max(random.uniform(60.0, 1000.0), 12 * frequency), 80 * frequency)
    clock = np.arange(int(beats / frequency * rate)) / rate
    drift = random.uniform(0.13, 0.3) * random.choice([-1, 1]) if fault == "drift" else random.uniform(-0.02, 0.02)
    phase = frequency * (clock + 0.5 * drift * clock * (clock / clock[-1] - 1))
    turn, noise = 2 * math.pi * (phase + random.random()), random.uniform(0.5, 3.0)
    amplitude = random.uniform(20.0, 60.0) * (1 + 0.03 * np.cos(turn / random.uniform(2.0, 5.0)))
    swing = (
        np.cos(turn) + random.uniform(0, 0.12) * np.cos(2 * turn + 1.0) + random.uniform(0, 0.05) * np.cos(3 * turn)
    )
    columns: dict[str, Any] = {"flap_deg": random.uniform(-10, 20) + amplitude * swing}
    if random.random() < 0.5 or fault == "pitch in radians":
        columns["pitch_deg"] = random.uniform(-5, 15) + random.uniform(8, 30) * np.sin(turn + random.uniform(-1, 1))
    if random.random() < 0.3 or fault == "lengths":
        columns["span_fraction"] = 0.9 + 0.1 * np.cos(turn - 1.0)
    seen = {}
    for name, values in columns.items():
        scatter = 0.01 if name == "span_fraction" else noise
        seen[name] = values + random.normal(scale=scatter, size=values.size)
        seen[name][random.random(values.size) < random.choice([0.0, 0.15])] = np.nan
    header = f"# frequency [Hz] = {frequency:.4g}\n"
    if fault == "rate":
        header = f"# frequency = {frequency * random.choice([0.5, 0.67, 0.8, 0.9, 1.1, 1.25, 1.5, 2.0]):.4g}\n"
    elif not fault and beats > 2.2 and random.random() < 0.3:
        header = ""
    elif fault == "radians":
        seen = {name: np.radians(values) if name.endswith("deg") else values for name, values in seen.items()}
    elif fault == "pitch in radians":
        seen["pitch_deg"] = np.radians(seen["pitch_deg"])
    elif fault == "milliseconds":
        clock = 1e3 * clock
    elif fault == "frames":
        clock = np.arange(clock.size)
    elif fault == "lengths":
        seen["span_fraction"] = seen["span_fraction"] * random.choice([0.33, 100.0, 330.0])
    elif fault == "swapped":
        there = np.flatnonzero(np.isfinite(seen["flap_deg"]))
        seen["flap_deg"][random.choice(there)] += random.uniform(0.8, 1.5) * amplitude[0] * random.choice([-1, 1])
    elif fault == "mirror":
        seen = {"left_flap_deg": seen["flap_deg"], "right_flap_deg": -seen["flap_deg"]}
    lines = [",".join(["time", *seen])]
    blank = random.choice(["", "NaN", "NA"])
    for row in zip(clock, *seen.values(), strict=True):
        lines.append(",".join(str(blank) if math.isnan(cell) else f"{cell:.6g}" for cell in row))
    return header + "\n".join(lines) + "\n"


def record(random: np.random.Generator, fault: str = "") -> LoadCellRun:
    """Return a record of 25 to 45 s in water, oil or air: turbulence with memory, a start, two zeros.

    Raises
    ------
    InvalidInputError : with most faults of units, as a file of that record would be refused.
    """
    density, viscosity = [(998.0, 1e-6), (998.0, 1e-6), (880.0, 1e-4), (1.2, 1.5e-5)][random.integers(4)]
    if fault == "dynamic viscosity":
        density, viscosity = 998.0, 1e-6
    speed = random.uniform(4.0, 12.0) if density < 2 else random.uniform(0.2, 0.8)
    chord, span, alpha = random.uniform(0.05, 0.15), random.uniform(0.2, 0.5), random.uniform(4.0, 90.0)
    rate, seconds = random.choice([50.0, 100.0, 200.0]), random.uniform(25.0, 45.0)
    time = np.arange(int(rate * seconds)) / rate
    force = 0.5 * density * speed**2 * chord * span
    normal = force * (1.8 * math.sin(math.radians(alpha)) + 0.1)
    scale = np.array([[normal], [0.04 * force], [0.15 * normal * chord]])
    keep = math.exp(-1 / (rate * random.uniform(0.02, 0.2)))
    kicks, slow = random.normal(size=(3, time.size)), np.zeros((3, time.size))
    for k in range(1, time.size):
        slow[:, k] = keep * slow[:, k - 1] + math.sqrt(1 - keep**2) * kicks[:, k]
    level = random.uniform(0.02, 0.1) * scale
    start = 1 + random.uniform(-1.0, 0.6) * np.exp(-time / random.uniform(0.3, 1.0))
    loads = scale * start + level * (0.7 * slow + 0.7 * random.normal(size=slow.shape))
    zero = 0.1 * scale * random.normal(size=(3, 2))
    loads += zero[:, :1] + (zero[:, 1:] - zero[:, :1]) * time / time[-1]
    more: dict[str, Any] = {
        "speed": speed,
        "density": density,
        "viscosity": viscosity,
        "chord": chord,
        "span": span,
    }
    if fault == "step":
        loads[:, time > time[-1] - random.uniform(3.0, 12.0)] -= random.uniform(0.3, 1.0) * scale
    elif fault == "rest":
        loads[:, time > time[-1] - random.uniform(20.0, 22.0)] -= scale
    elif fault == "drift":
        loads += random.uniform(0.3, 0.8) * random.choice([-1, 1]) * scale * time / time[-1]
    elif fault == "millinewton":
        loads, zero = 1e3 * loads, 1e3 * zero
    elif fault == "millimetres":
        more |= {"chord": 1e3 * chord, "span": 1e3 * span}
    elif fault == "dynamic viscosity":
        more["viscosity"] = random.choice([1.0, 1e3]) * 1e-3
    elif fault == "density":
        more["density"] = 1e-3 * density
    elif fault == "speed":
        more["speed"] = 1e2 * speed
    angles = np.full(time.size, alpha)
    return LoadCellRun("record", time, loads[0], loads[1], loads[2], angles, tare=zero, **more)
