"""
Why is there no orbit at 3 m/s?
===============================

Live pigeons beat at up to 10 Hz. With this bound, the solver finds no orbit of the pigeon at 3 m/s. That is an
answer, too: wingbeat says which balance fails, by how much, and what would have to change.
"""

# %%
# A failed search raises no exception. Its status says what happened, and ``relaxations`` holds the smallest
# changes of a single number with which there is an orbit.
import matplotlib.pyplot as plt

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

pigeon = wb.load_species("pigeon")
slow = wb.solve_orbit(wb.OrbitProblem(pigeon, speed=3.0, bounds={"frequency": (1.0, 10.0)}), starts=1)
assert slow.status is wb.Status.INFEASIBLE
failed = slow.record()["failed_balance"][0]
for change in slow.relaxations:
    print(change.text)

# %%
# Without the bound there is an orbit at each speed. The figure shows the lowest frequency, and the bound.
speeds = [3.0, 4.5, 6.0, 8.0, 10.0, 12.0]
orbits = wb.solve_orbits([wb.OrbitProblem(pigeon, speed=speed) for speed in speeds], starts=1, in_order=True)
frequency = [orbit.wingbeat.frequency for orbit in orbits]
assert all(orbit.status is wb.Status.CONVERGED for orbit in orbits)

figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
axes.plot(speeds, frequency, color=BLUE, marker="o", label="lowest frequency with an orbit")
axes.axhline(10.0, color=VERMILION, linestyle="--", label="bound")
axes.set(xlabel="flight speed [m/s]", ylabel="wingbeat frequency [Hz]")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False)

# %%
# The answer:
print(
    f"At 3 m/s and 10 Hz, {failed['law']} is short by {failed['share']:.0%} of the weight. The lowest frequency "
    f"with an orbit is {frequency[0]:.1f} Hz."
)
assert failed["law"] == "lift"
