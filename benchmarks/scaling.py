"""Cost against strips, steps, unknowns, lanes, animals of a batch and cores, drawn with its exponents.

Run from the root of a clone; it rewrites docs/evidence/scaling.png and data/scaling.csv. All but the last sweep use
one core::

    PJRT_NPROC=1 uv run python benchmarks/scaling.py
"""

from __future__ import annotations

import csv
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import wingbeat as wb
from wingbeat._base.style import BLUE, PAGE, VERMILION, drawing, legend_below, letter_panels, new_figure
from wingbeat._workers.tuning import core_count
from wingbeat.bench import median_seconds, mixed_problems, right_hand_side
from wingbeat.orbits.flight.period import STEPS, flier
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]
REPEATS = 60
FREE = (
    "frequency",
    "flap_mean",
    "flap_amplitude",
    "pitch_mean",
    "pitch_amplitude",
    "span_retraction",
    "twist_ratio",
)
START = np.array([0.2, 10.0, 0.0, 0.0])


def flight(strips: int = 10, free: int = 5, blocks: int = 1) -> float:
    """Return the time of a flight with its derivatives [s]."""
    species = wb.load_species("bat")
    model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan(), strips), species.air)
    names = FREE[:free]
    values = np.array([getattr(species.wingbeat, name) for name in names])
    fly = flier(model, species.wingbeat, names)
    return median_seconds(lambda: fly(values, START, blocks), max(REPEATS // blocks, 10))


def batch(count: int, processes: int = 1) -> float:
    """Return the time of a batch of mixed animals, with one start each [s]; the first run compiles."""
    problems = list(mixed_problems(count))
    taken = []
    for _ in range(2):
        begun = time.perf_counter()
        wb.solve_orbits(problems, starts=1, processes=processes)
        taken.append(time.perf_counter() - begun)
    return taken[-1]


class Sweep(NamedTuple):
    """Numbers to vary, what one of them costs [s], the axis of the cost, and the exponent of a dashed line."""

    sizes: tuple[int, ...]
    cost: Callable[[int], float]
    label: str
    ideal: int = 1


SWEEPS = {
    "strips of a wing": Sweep((5, 10, 20, 40, 80), lambda n: flight(strips=n), f"flight of {STEPS} steps [ms]"),
    "steps of a flight": Sweep(
        tuple(STEPS * 2**k for k in range(7)), lambda n: flight(blocks=n // STEPS), "flight with derivatives [ms]"
    ),
    "unknowns": Sweep((5, 6, 7, 8, 9, 10, 11), lambda n: flight(free=n - 4), f"flight of {STEPS} steps [ms]"),
    "lanes": Sweep(
        (64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384),
        lambda n: n * right_hand_side(n),
        "right-hand sides of all [ms]",
    ),
    "animals of a batch": Sweep((64, 128, 256, 512, 1024), batch, "orbits of all [ms]"),
    "cores": Sweep(
        tuple(2**k for k in range(core_count().bit_length())), lambda n: batch(2048, n), "2048 orbits [ms]", -1
    ),
}


def exponent(sizes: Any, times: Any) -> float:
    """Return the slope of the logarithms over the upper half of the sizes, where a constant share has faded."""
    upper = min(len(sizes) // 2, len(sizes) - 2)
    return float(np.polyfit(np.log(sizes[upper:]), np.log(times[upper:]), 1)[0])


@drawing()
def draw(results: dict[str, list[float]]) -> None:
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    figure = new_figure(PAGE, 200.0)
    panels = figure.subplots(3, 2)
    for axes, (name, times) in zip(panels.flat, results.items(), strict=True):
        sizes, _, label, ideal = SWEEPS[name]
        ms = 1e3 * np.array(times)
        power = exponent(sizes, times)
        axes.loglog(sizes, ms, "o-", color=BLUE, markersize=4, label="measured")
        reference = ms[-1] * (np.array(sizes) / sizes[-1]) ** ideal
        axes.loglog(sizes, reference, "--", color=VERMILION, linewidth=1, label="proportional, or inversely so")
        axes.set(xlabel=f"{name} [-]", ylabel=label)
        axes.set_xticks(sizes if len(sizes) < 8 else sizes[::2], minor=False)
        axes.xaxis.set_major_formatter(ScalarFormatter())
        decades = 10.0 ** np.arange(-1, 6)
        few = max(ms) < 30 * min(ms)
        axes.set_yticks(np.outer(decades, [1, 2, 5]).ravel() if few else decades, minor=False)
        axes.yaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set_ylim(0.6 * min(ms), 2 * max(ms))
        upper = " over the upper half" if len(sizes) > 3 else ""
        axes.set_title(f"exponent {power:.2f}{upper}", fontsize=8)
        axes.grid()
    letter_panels(panels)
    legend_below(figure, panels)
    save_figure(figure, ROOT / "docs" / "evidence" / "scaling.png")


def main() -> None:
    results: dict[str, list[float]] = {}
    with (ROOT / "data" / "scaling.csv").open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["varied", "value", "seconds"])
        for name, sweep in SWEEPS.items():
            times = results[name] = [sweep.cost(size) for size in sweep.sizes]
            rows.writerows([name, size, f"{t:.4g}"] for size, t in zip(sweep.sizes, times, strict=True))
            told = [f"{1e3 * t:.3g} ms" for t in times]
            print(name, f"exponent {exponent(sweep.sizes, times):.2f}", told, flush=True)
    draw(results)


if __name__ == "__main__":
    main()
