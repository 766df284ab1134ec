"""
Which coefficient model should I use?
=====================================

Models of lift and drag were measured on flat plates, insects, feathers and membranes. A measured motion with
measured forces can tell which of them suits a vehicle. We take a flapping robot with rigid wings in a wind tunnel
(Yeo, Atkins and Shyy 2011), which comes with wingbeat.
"""

# %%
# ``validate`` computes the forces of each model on the measured motion. A rule that never sees the measured
# forces recommends one model and one choice of unsteady terms.
import matplotlib.pyplot as plt

import wingbeat_evidence as evidence
from wingbeat._base.style import BLUE, VERMILION

case = next(path for path in evidence.shipped_cases() if "flapper" in str(path))
found = evidence.validate(case)
print(f"recommended: {found.recommended.aero.coefficients.name}. {found.reason}")

# %%
# The error is the root mean square of the difference, each force about its mean, divided by that of the measured
# force.
rows = sorted(found.rows, key=lambda row: row.fz.rms_about_mean)
for row in rows[:3]:
    print(f"{row.fz.rms_about_mean:.2f} {row.aero.coefficients.name}, {row.unsteady}, inflow {row.aero.inflow}")

# %%
# The measured force (black), that of the recommended model, that of the insect wing's model, and all others
# (grey). Each force is about its mean.
beats = (found.case.times - found.case.times[0]) * found.case.frequency
insect = next(row for row in rows if row.aero.coefficients.name == "dickinson" and row.unsteady == "none")
looks = {
    "recommended: plate of Su et al.": (found.recommended, BLUE, "-"),
    "insect wing": (insect, VERMILION, "--"),
}


def about_mean(force):
    """Return a force without its mean, divided by the root mean square of the measured force."""
    return (force - force.mean()) / found.case.weight


figure, axes = plt.subplots(figsize=(6.0, 3.6), layout="constrained")
for row in rows:
    axes.plot(beats, about_mean(row.loads.fz), color="0.8", linewidth=0.6)
for name, (row, color, line) in looks.items():
    axes.plot(beats, about_mean(row.loads.fz), color=color, linestyle=line, label=name)
axes.plot(beats, about_mean(found.case.forces["fz"]), color="k", linewidth=2, label="measured")
axes.set(xlabel="time [beats]", ylabel="upward force about its mean / rms [-]")
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower center")

# %%
# The answer:
chosen = found.recommended
place = 1 + rows.index(chosen)
print(
    f"For this robot the rule recommends {chosen.aero.coefficients.name}. Its error is "
    f"{chosen.fz.rms_about_mean:.0%} of the measured force; by this error it has place {place} of {len(rows)}."
)
assert chosen.fz.rms_about_mean < 0.5
