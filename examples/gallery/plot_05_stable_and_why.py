"""
Is this animal stable, and why?
===============================

A certified orbit closes, but a small disturbance may grow from beat to beat. Which numbers of the animal decide
whether it does? They are the numbers to measure best, and the numbers that a designer can change.
"""

# %%
# ``linearise`` gives the modes of the flight: what each of them is, and by what it is multiplied in a beat.
import matplotlib.pyplot as plt

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
assert orbit.status is wb.Status.CONVERGED
flight = wb.linearise(orbit)
for mode in flight.modes:
    print(f"{mode.kind:12} {abs(mode.multiplier):.3f}")

# %%
# Now the derivatives of the spectral radius, the largest modulus of a multiplier. For each number, the bars show
# the change at both ends of its plausible range, if the change were linear.
causes = wb.stability_sensitivities(orbit)
ranked = causes.sensitivities.ranked("spectral_radius")[:7]
names = {
    "wing.shoulder.x": "shoulder, forward",
    "wing.shoulder.z": "shoulder, up",
    "wing.semi_span": "length of a wing",
    "wingbeat.span_retraction": "span retraction",
    "wing.mass": "mass of a wing",
    "body.mass": "mass of the body",
    "body.pitch_inertia": "pitch inertia",
}
figure, axes = plt.subplots(figsize=(6.0, 3.4), layout="constrained")
for place, slope in enumerate(ranked):
    low, high = causes.sensitivities.swing(slope, "spectral_radius")
    axes.barh(place, low, color=BLUE, label="lowest plausible value" if place == 0 else None)
    axes.barh(place, high, color=VERMILION, label="highest plausible value" if place == 0 else None)
axes.axvline(0, color="k", linewidth=0.8)
axes.set_yticks(range(len(ranked)), [names.get(slope.parameter.path, slope.parameter.path) for slope in ranked])
axes.invert_yaxis()
axes.set(xlabel="linear change of the spectral radius [-]", ylabel="number of the animal")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower right")

# %%
# The answer:
first = ranked[0].parameter.path
assert flight.spectral_radius > 1
print(
    f"It is unstable: a disturbance grows by a factor of {flight.spectral_radius:.2f} in each beat. The strongest "
    f"cause is this number: {names[first]}."
)
