"""
Which wings for my robot?
=========================

A robot of 26 g may have longer, shorter, broader or narrower wings. Its motors flap at most eight times per
second. Which wings need the least power at 5 m/s?
"""

# %%
# The wings are film on spars, so that a wing's mass is proportional to its area. The total mass stays 26 g: a
# heavier wing leaves less mass for the body.
import matplotlib.pyplot as plt

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

robot = wb.robot(mass=0.026, wing_span=0.62, wing_area=0.055)
wing = robot.vehicle.wing
mass_per_area = wing.mass / (wing.semi_span * wing.mean_chord)


def with_wings(length, chord):
    """Return the robot with other wings [m]."""
    mass = mass_per_area * length * chord
    return robot.with_values(
        {
            "wing.semi_span": length,
            "wing.chord": chord,
            "wing.mass": mass,
            "body.mass": robot.vehicle.mass - 2 * mass,
        }
    )


# %%
# One problem for each pair of wings. The results of a problem serve as starts for similar problems.
lengths, chords = [0.22, 0.26, 0.31], [0.06, 0.09]
pairs = [(length, chord) for chord in chords for length in lengths]
problems = [
    wb.OrbitProblem(with_wings(*pair), speed=5.0, minimise="mean_positive_power", subject_to=["frequency<=8"])
    for pair in pairs
]
orbits = wb.solve_orbits(problems, starts=2)
assert all(orbit.status is wb.Status.CONVERGED for orbit in orbits)
power = {pair: orbit.record()["mean_positive_power"] for pair, orbit in zip(pairs, orbits, strict=True)}

# %%
# Least power against the length of a wing, one line for each chord.
figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
for chord, color, mark in zip(chords, (BLUE, VERMILION), "os", strict=True):
    axes.plot(
        [100 * length for length in lengths],
        [power[length, chord] for length in lengths],
        color=color,
        marker=mark,
        label=f"chord {100 * chord:g} cm",
    )
axes.set(
    xlabel="length of a wing [cm]", ylabel="least mean positive power [W]", ylim=(0, 1.1 * max(power.values()))
)
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False)

# %%
# The answer:
best = min(power, key=power.__getitem__)
saved = 1 - power[best] / power[0.31, 0.09]
print(
    f"Of these wings, those of {100 * best[0]:g} by {100 * best[1]:g} cm need the least power: {power[best]:.2f} "
    f"W, {saved:.0%} less than wings of 31 by 9 cm."
)
