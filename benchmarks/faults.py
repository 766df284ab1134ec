"""Count how many measurement files with one fault are refused or warned of, and how many good ones are.

600 files with one fault and 600 without, a third each coefficient tables, films and load-cell records. Each file is
random; the seed makes them the same again. A fault counts as reported if the file is refused, or if the fit, the
film or the reduction carries a note that a good file does not carry.

Example: python benchmarks/faults.py --files 200 --seed 0
"""

from __future__ import annotations

import argparse
import collections
import math
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from wingbeat._base import InvalidInputError
from wingbeat.experiment import fit_film, fit_wing, load_measurements, read_film, read_run, reduce_runs

Random = np.random.Generator
Rows = list[list[float]]


# Tables of coefficients: thin wings with a soft stall, or plates to 90 degrees.


def wing_curves(random: Random) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """Return C_L and C_D of a random wing by the angle [deg]: attached lift that passes into a plate's."""
    slope, zero = random.uniform(0.06, 0.11), random.uniform(-4.0, 0.0)
    stall, soft = random.uniform(9.0, 16.0), random.uniform(1.5, 3.5)
    floor, bow = random.uniform(0.015, 0.06), random.uniform(0.02, 0.06)

    def curves(alpha: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        turn = np.radians(alpha - zero)
        past = 1 / (1 + np.exp(-(np.abs(alpha - zero) - stall) / soft))
        attached = slope * (alpha - zero)
        plate = 1.1 * np.sin(2 * turn)
        lift = (1 - past) * attached + past * plate
        drag = floor + bow * lift**2 * (1 - past) + past * 1.6 * np.sin(turn) ** 2
        return lift, drag

    return curves


def table(random: Random, fault: str | None) -> tuple[str, str]:
    """Return the text of a table of coefficients and the form to fit to it."""
    curves = wing_curves(random)
    step = random.choice([1.0, 1.5, 2.0])
    alpha = np.arange(-12.0, random.choice([16.0, 20.0, 24.0]) + 0.1, step)
    alpha = np.repeat(alpha, random.integers(1, 4))
    streams = random.choice([2e4, 3e4, 5e4, 8e4, 1.2e5], size=random.integers(1, 4), replace=False)
    if fault == "several Re" and len(streams) < 2:
        streams = np.array([2e4, 8e4])
    scatter = random.uniform(0.005, 0.03)
    rows: Rows = []
    loss = random.uniform(0.15, 0.5)
    for k, stream in enumerate(np.sort(streams)):
        lift, drag = curves(alpha)
        if fault == "several Re":
            share = 1 - loss * (len(streams) - 1 - k) / (len(streams) - 1)
            lift, drag = lift * share, drag * (1 + 1.5 * (1 - share))
        lift = lift + random.normal(scale=scatter, size=lift.size)
        drag = np.maximum(drag * (1 + random.normal(scale=scatter, size=drag.size)), 0.002)
        rows += [list(row) for row in zip(alpha, np.full(alpha.size, stream), lift, drag, strict=True)]
    data = np.array(rows)
    if fault == "two branches":
        first, wide = random.uniform(2.0, 9.0), random.uniform(4.0, 8.0)
        again = data.copy()
        again[:, 0] += random.choice([0.0, 0.3])
        inside = (again[:, 0] >= first) & (again[:, 0] <= first + wide)
        again[inside, 2] *= 1 - random.uniform(0.2, 0.45)
        again[inside, 3] *= random.uniform(1.2, 2.0)
        again[:, 2] += random.normal(scale=scatter, size=len(again))
        data = np.concatenate([data, again])
        if random.random() < 0.5:
            data = data[np.argsort(data[:, 0], kind="stable")]
    elif fault == "units":
        how = random.choice(["counts", "per cent", "radians", "millions", "thousands", "lift per cent"])
        column, factor = {
            **{"counts": (3, 1e4), "per cent": (3, 1e2), "radians": (0, math.pi / 180)},
            **{"millions": (1, 1e-6), "thousands": (1, 1e-3), "lift per cent": (2, 1e2)},
        }[how]
        data[:, column] *= factor
    names = random.choice(
        [["alpha_deg", "reynolds", "C_L", "C_D"], ["alpha_deg", "reynolds", "c_l", "c_d"]]
    ).tolist()
    cells = [
        [f"{a:.2f}" if fault != "units" else f"{a:.5g}", f"{re:.6g}", f"{cl:.4f}", f"{cd:.5g}"]
        for a, re, cl, cd in data
    ]
    if fault == "given twice":
        names.append("C_L" if "c_l" in names else "c_l")
        cells = [[*row, f"{float(row[2]) * 1.3:.4f}"] for row in cells]
    return "\n".join([",".join(names), *(",".join(row) for row in cells)]) + "\n", "cambered"


def judge_table(path: Path, form: str) -> tuple[str, ...]:
    """Return the warnings of a fit to a table; its notes are about the form, and good tables have them, too."""
    return tuple(fit_wing(load_measurements(path), form, "model", "made up").warnings)


# Films: some beats of flap and, in half of them, pitch, with noise and gaps.


def film(random: Random, fault: str | None) -> tuple[str, str]:
    """Return the text of a film."""
    frequency, beats = random.uniform(3.0, 25.0), random.uniform(2.0, 6.0)
    if fault == "frequency falls":
        beats = random.uniform(3.0, 6.0)
    count = int(beats * random.integers(14, 60))
    stamps = np.arange(count) / count * beats / frequency
    phase = frequency * stamps
    if fault == "frequency falls":
        fall = random.uniform(0.12, 0.25) * random.choice([-1, 1])
        phase = frequency * (stamps - 0.5 * fall * (stamps - stamps[-1]) ** 2 / stamps[-1])
    noise = random.uniform(0.3, 2.5)
    amplitude, mean = random.uniform(18.0, 60.0), random.uniform(-10.0, 20.0)
    second = random.uniform(0.0, 0.12) * amplitude
    turn = 2 * math.pi * (phase + random.random())
    flap = mean + amplitude * np.cos(turn) + second * np.cos(2 * turn + random.uniform(0, 6.3))
    names, columns = ["time", "flap_deg"], [stamps, flap + random.normal(scale=noise, size=count)]
    if random.random() < 0.5 or fault == "pitch in radians":
        pitch = random.uniform(0, 15) - random.uniform(8.0, 30.0) * np.sin(turn + random.uniform(-0.5, 0.5))
        names.append("pitch_deg")
        columns.append(pitch + random.normal(scale=noise, size=count))
    header = [f"# frequency = {frequency * (1 + random.normal(scale=0.003)):.4g}"]
    if fault == "wrong rate":
        factor = random.choice([0.5, 0.8, 0.9, 1.1, 1.25, 1.5, 2.0])
        header = [f"# frequency = {frequency * factor:.4g}"]
    elif fault == "units":
        how = random.choice(["radians", "milliseconds", "frames"])
        if how == "radians":
            columns[1:] = [np.radians(column) for column in columns[1:]]
        else:
            columns[0] = columns[0] * 1e3 if how == "milliseconds" else np.arange(count) * 1.0
    elif fault == "pitch in radians":
        columns[2] = np.radians(columns[2])
    elif fault == "given twice":
        header.append(f"# frequency [Hz] = {frequency * 1.2:.4g}")
    cells = [[f"{value:.6g}" for value in row] for row in zip(*columns, strict=True)]
    missing = random.uniform(0.0, 0.15) if random.random() < 0.5 else 0.0
    blank = random.choice(["", "NaN", "nan", "NA"])
    for row in cells:
        for k in range(1, len(row)):
            if random.random() < missing:
                row[k] = str(blank)
    return "\n".join([*header, ",".join(names), *(",".join(row) for row in cells)]) + "\n", ""


def judge_film(path: Path, _: str) -> tuple[str, ...]:
    """Return the notes of a fitted film."""
    return tuple(fit_film(read_film(path)).notes)


# Records of the load cell: a plate at one angle in water or air, with zero readings.


def record(random: Random, fault: str | None) -> tuple[str, str]:
    """Return the text of a record."""
    density, viscosity = [(998.0, 1.0e-6), (1.2, 1.5e-5)][random.integers(2)]
    chord, span = random.uniform(0.05, 0.15), random.uniform(0.2, 0.5)
    speed = random.uniform(0.2, 0.8) if density > 2 else random.uniform(4.0, 12.0)
    rate, seconds = random.choice([50.0, 100.0, 250.0]), random.uniform(25.0, 45.0)
    stamps = np.arange(int(rate * seconds)) / rate
    alpha = random.uniform(6.0, 80.0)
    turn = math.radians(alpha)
    force = 0.5 * density * speed**2 * chord * span
    scale = force * np.array([1.8 * math.sin(turn) + 0.1, 0.03, 0.15 * chord])
    slow = np.zeros((3, stamps.size))
    white = random.normal(size=(3, stamps.size))
    keep = math.exp(-1 / (rate * random.uniform(0.02, 0.1)))
    for i in range(1, stamps.size):
        slow[:, i] = keep * slow[:, i - 1] + math.sqrt(1 - keep**2) * white[:, i]
    level = random.uniform(0.03, 0.12) * scale[0] * np.array([1.0, 0.1, 0.1 * chord])
    start = 1 - np.exp(-stamps / 1.0)
    loads = scale[:, None] * start + level[:, None] * (0.7 * slow + 0.7 * random.normal(size=slow.shape))
    zero = 0.05 * scale * random.normal(size=3)
    loads += zero[:, None]
    after = zero.copy()
    if fault == "step":
        still = stamps > stamps[-1] - random.uniform(3.0, 9.0)
        loads[:, still] -= scale[:, None]
    elif fault == "drift":
        way = random.uniform(0.2, 0.6) * random.choice([-1.0, 1.0])
        loads += way * scale[:, None] * (stamps / stamps[-1])
    constants = {"speed": speed, "density": density, "viscosity": viscosity, "chord": chord, "span": span}
    angle = np.full(stamps.size, alpha)
    if fault == "units":
        how = random.choice(
            ["millinewton", "millimetres", "dynamic viscosity", "grams", "milliseconds", "centimetres a second"]
        )
        if how == "millinewton":
            loads, zero, after = loads * 1e3, zero * 1e3, after * 1e3
        elif how == "millimetres":
            constants["chord"], constants["span"] = 1e3 * chord, 1e3 * span
        elif how == "dynamic viscosity":
            constants["viscosity"] = viscosity * density if density > 2 else 1.8e-2  # the latter in mPa s
        elif how == "grams":
            constants["density"] = density / 1e3
        elif how == "milliseconds":
            stamps = stamps * 1e3
        else:
            constants["speed"] = 1e2 * speed
    lines = [f"# {name} = {value:.6g}" for name, value in constants.items()]
    if fault == "given twice":
        name = random.choice(list(constants))
        unit = {"speed": "m/s", "density": "kg/m3", "viscosity": "m2/s", "chord": "m", "span": "m"}[str(name)]
        lines.append(f"# {name} [{unit}] = {constants[str(name)] * random.choice([0.1, 0.5, 2.0]):.6g}")
    for channel, low, high in zip(("normal_force", "tangential_force", "moment"), zero, after, strict=True):
        lines.append(f"# tare_{channel} = {low:.6g}, {high:.6g}")
    columns = (stamps, *loads, angle)
    lines.append(
        "time [s],normal_force [N],tangential_force [N],moment [N m],alpha_deg"
        if fault != "units"
        else "time,normal_force,tangential_force,moment,alpha_deg"
    )
    lines += [",".join(f"{value:.6g}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join(lines) + "\n", ""


def judge_record(path: Path, _: str) -> tuple[str, ...]:
    """Return the notes of a reduced record."""
    return tuple(reduce_runs([read_run(path)]).notes)


KINDS = {
    "table": (table, judge_table, ("units", "given twice", "two branches", "several Re")),
    "film": (film, judge_film, ("units", "pitch in radians", "given twice", "wrong rate", "frequency falls")),
    "record": (record, judge_record, ("units", "given twice", "step", "drift")),
}


def main() -> None:
    """Print how many files of each kind and fault are reported, and each good file that is."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=200, help="files with a fault, and good ones, of each kind")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kind", choices=list(KINDS), help="only this kind")
    parser.add_argument(
        "--show", action="store_true", help="print what is missed and what good files are warned of"
    )
    options = parser.parse_args()
    reported, asked = collections.Counter(), collections.Counter()
    began = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        for kind, (make, judge, faults) in KINDS.items():
            if options.kind not in (None, kind):
                continue
            for fault in (None, *faults):
                for i in range(options.files if fault is None else -(-options.files // len(faults))):
                    random = np.random.default_rng([options.seed, *kind.encode(), *(fault or "").encode(), i])
                    text, form = make(random, fault)
                    path = Path(folder, f"{kind}.csv")
                    path.write_text(text)
                    try:
                        notes = judge(path, form)
                    except InvalidInputError as error:
                        notes = tuple(map(str, error.faults))
                    asked[kind, fault] += 1
                    reported[kind, fault] += bool(notes)
                    if options.show and bool(notes) is (fault is None):
                        print(f"  {kind} {i}, {fault or 'good'}: {notes[:2] or 'nothing is said'}")
    for kind, fault in asked:
        print(f"{kind:8} {fault or 'good':18} {reported[kind, fault]:4d} of {asked[kind, fault]:4d} reported")
    for title, good in (("with a fault", False), ("good", True)):
        keys = [key for key in asked if (key[1] is None) is good]
        total, hit = sum(asked[key] for key in keys), sum(reported[key] for key in keys)
        print(f"{title}: {hit} of {total} reported, {hit / total:.1%}")
    print(f"{time.process_time() - began:.0f} s of processor time")


if __name__ == "__main__":
    main()
