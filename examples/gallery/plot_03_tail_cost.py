"""
What does a tail cost?
======================

The pigeon of Su et al. has no tail, and its flight at 12 m/s is unstable. A tail may make it stable, but a tail
has drag. How large must the tail be, and what does it cost? The orbits are those of lowest frequency.
"""

# %%
# ``with_tail`` gives the pigeon the tail that scaling laws predict. We vary its area from nothing to twice that.
import matplotlib.pyplot as plt
import numpy as np

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

pigeon = wb.load_species("pigeon").with_tail()
lawful = pigeon.vehicle.tail.area
areas = lawful * np.array([0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0])
bare = wb.load_species("pigeon")
birds = [bare, *(pigeon.with_values({"tail.area": area}) for area in areas[1:])]
problems = [wb.OrbitProblem(bird, speed=12.0) for bird in birds]
orbits = wb.solve_orbits(problems, starts=2)
assert all(orbit.status is wb.Status.CONVERGED for orbit in orbits)

# %%
# The largest Floquet multiplier says by what factor a disturbance grows in each beat; below 1 it decays.
radius = [max(np.hypot(*pair) for pair in orbit.record()["floquet_multipliers"]) for orbit in orbits]
frequency = np.array([orbit.wingbeat.frequency for orbit in orbits])
power = np.array([orbit.record()["mean_positive_power"] for orbit in orbits])
change = {"lowest frequency": frequency / frequency[0] - 1, "its mean positive power": power / power[0] - 1}

figure, panels = plt.subplots(1, 2, figsize=(7.2, 3.2), sharex=True, layout="constrained")
square_cm = 1e4 * areas
panels[0].axhspan(0.9, 1.0, color="0.91", linewidth=0)
panels[0].annotate("disturbances decay", (square_cm[-1], 0.91), ha="right", color="0.35")
panels[0].plot(square_cm, radius, color=BLUE, marker="o")
panels[0].set(xlabel="area of the tail [cm²]", ylabel="largest multiplier [-]", ylim=(0.9, None))
for (name, values), color, mark in zip(change.items(), (BLUE, VERMILION), "os", strict=True):
    panels[1].plot(square_cm, 100 * values, color=color, marker=mark, label=name)
panels[1].set(xlabel="area of the tail [cm²]", ylabel="change [%]")
panels[1].legend(frameon=False)
for axes in panels:
    axes.spines[["top", "right"]].set_visible(False)

# %%
# The answer:
first = next(i for i, value in enumerate(radius) if value < 1)
slower, cheaper = (100 * values[first] for values in change.values())
print(
    f"Of these tails, the smallest that makes the flight stable has {square_cm[first]:.0f} cm². It changes the "
    f"lowest frequency by {slower:+.1f} % and its power by {cheaper:+.1f} %."
)
