"""
What if my animal carries a load?
=================================

A logger, a camera or a letter makes a pigeon heavier. How much more power does it need at 10 m/s, and does the
power grow faster than the weight?
"""

# %%
# ``with_payload`` puts a mass at the body's centre of mass. Moment of inertia and wings stay as they are.
import matplotlib.pyplot as plt
import numpy as np

import wingbeat as wb
from wingbeat._base.style import BLUE, GREY

pigeon = wb.load_species("pigeon")
loads = np.array([0.0, 0.02, 0.04, 0.06, 0.08])
problems = [
    wb.OrbitProblem(pigeon.with_payload(load) if load else pigeon, speed=10.0, minimise="mean_positive_power")
    for load in loads
]
orbits = wb.solve_orbits(problems, starts=1, in_order=True)
assert all(orbit.status is wb.Status.CONVERGED for orbit in orbits)
power = np.array([orbit.record()["mean_positive_power"] for orbit in orbits])

# %%
# The dashed line is what the power would be if it grew as fast as the weight.
mass = pigeon.vehicle.mass
figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
axes.plot(1e3 * loads, power, color=BLUE, marker="o", label="least positive power")
axes.plot(
    1e3 * loads, power[0] * (1 + loads / mass), color=GREY, linestyle="--", label="in proportion to the weight"
)
axes.set(xlabel="load [g]", ylabel="mean positive power [W]", ylim=(0, 1.1 * power.max()))
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower right")

# %%
# The answer:
heavier, dearer = loads[-1] / mass, power[-1] / power[0] - 1
assert dearer > heavier
print(
    f"A load of {1e3 * loads[-1]:.0f} g is {heavier:.0%} of the pigeon's mass, and raises the power by "
    f"{dearer:.0%}: the power grows faster than the weight."
)
