"""
Which coefficient model should I use?
=====================================

Models of lift and drag were measured on flat plates, insects, feathers and membranes. A measured motion with measured
forces can tell which of them suits a vehicle. We take a flapping robot with rigid wings in a wind tunnel (Yeo, Atkins
and Shyy 2011), which comes with wingbeat.
"""

# %%
# ``validate`` computes the forces of each model on the measured motion. A rule that never sees the measured forces
# recommends one model and one choice of unsteady terms.
import wingbeat as wb

case = next(path for path in wb.shipped_cases() if "flapper" in str(path))
found = wb.validate(case)
print(f"recommended: {found.recommended.aero.coefficients.name}. {found.reason}")

# %%
# The error is the root mean square of the difference, each force about its mean, divided by that of the measured force.
errors = sorted((row.fz.rms_about_mean, row.aero.coefficients.name, row.unsteady) for row in found.rows)
for error, name, unsteady in errors[:3]:
    print(f"{error:.2f} {name}, unsteady terms: {unsteady}")

# %%
# The measured force, and those of the models.
page = wb.plots.validation_page(found)
page

# %%
# The answer:
chosen = found.recommended
rank = sum(error < chosen.fz.rms_about_mean for error, _, _ in errors) + 1
print(
    f"For this robot the rule recommends {chosen.aero.coefficients.name}. Its error is {chosen.fz.rms_about_mean:.0%} "
    f"of the measured force; by this error it has place {rank} of {len(errors)}."
)
assert chosen.fz.rms_about_mean < 0.5
