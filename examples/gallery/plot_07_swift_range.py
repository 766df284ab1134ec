"""
How fast should a swift fly to go far?
======================================

The flight of least power keeps the bird in the air for longest. The flight of least power divided by speed takes
it farthest on its fat. How fast are these two flights of a common swift, and how fast do live swifts fly?
"""

# %%
# ``solve_curve`` finds the orbits of least positive power along speed, and the two characteristic speeds. The swift
# has body drag, and wings with the coefficients of the plate of Su et al.
import csv
from pathlib import Path
from statistics import median

import matplotlib.pyplot as plt

import wingbeat as wb
from wingbeat._base.style import BLUE, GREEN, VERMILION

swift = wb.load_species("common-swift").with_alternative("body-drag")
problem = wb.OrbitProblem(swift, speed=8.0, minimise="mean_positive_power")
curve = wb.solve_curve(problem, [3.5, 5.0, 6.5, 8.0, 9.5], starts=1)
assert not curve.gaps
best = curve.characteristic_speeds

# %%
# Radar measured the airspeed of migrating swifts (Alerstam et al. 2007, doi 10.1371/journal.pbio.0050197). The same
# table holds the maximum-range speeds that this model predicts for 128 other birds.
with Path("..", "..", "data", "alerstam.csv").open(encoding="utf-8") as table:
    birds = [row for row in csv.DictReader(table) if row["model"] == "paper"]
measured = next(row for row in birds if row["species"] == "Apus apus")
radar, spread = float(measured["airspeed"]), float(measured["airspeed_sd"])

# %%
# Power against speed, with the two speeds and the measured one.
power = curve.dataset["mean_positive_power"].sel(optimum=0)
figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
axes.axvspan(radar - spread, radar + spread, color=GREEN, alpha=0.25, linewidth=0, label="live swifts, radar")
axes.plot(power["speed"], power, color=BLUE, marker="o", label="least power")
for name, color, line in (("minimum_power", "k", ":"), ("maximum_range", VERMILION, "--")):
    axes.axvline(best[name]["speed"], color=color, linestyle=line, label=name.replace("_", " "))
axes.set(xlabel="flight speed [m/s]", ylabel="mean positive power [W]", ylim=(0, 1.1 * float(power.max())))
axes.spines[["top", "right"]].set_visible(False)
figure.legend(loc="outside upper center", ncols=2, frameon=False)

# %%
# The answer:
ratio = median(float(bird["max_range_speed"]) / float(bird["airspeed"]) for bird in birds)
print(
    f"To go far, this swift should fly at {best['maximum_range']['speed']:.1f} m/s; it stays up for longest at "
    f"{best['minimum_power']['speed']:.1f} m/s. Live swifts migrate at {radar:.1f} m/s. The model is too slow for "
    f"most birds: its median over {len(birds)} birds is {ratio:.2f} times the measured speed."
)
assert len(birds) == 129
assert ratio < 1
assert best["minimum_power"]["speed"] < best["maximum_range"]["speed"]
