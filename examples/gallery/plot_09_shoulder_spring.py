"""
What does a spring at the shoulder save?
========================================

Wings that flap fast must be braked and accelerated twice in each beat. A spring at the shoulder can store the
energy of the braking wing. How stiff should it be, and how much power does it save?
"""

# %%
# Take the pigeon's wingbeat of least positive power at 10 m/s.
import wingbeat as wb

problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, minimise="mean_positive_power")
orbit = wb.solve_orbit(problem, starts=2)
assert orbit.status is wb.Status.CONVERGED

# %%
# ``power_account`` says what the power is made of. It also finds the spring that saves most for this wingbeat.
account = wb.power_account(orbit.dataset)
spring = account["best_spring"]
saved = 1 - spring["mean_positive_power"] / account["mean_positive_power"]

# %%
# Hinge power and its parts through the beat (a); flap torque with and without the spring (b); the mean power if a
# share of the negative work is returned (c).
page = wb.plots.power_page(orbit.dataset)
page

# %%
# The answer:
assert 0 < saved < 1
print(
    f"Springs of {spring['stiffness']:.1f} N m/rad, for both shoulders together, save {saved:.0%}: the power falls "
    f"from {account['mean_positive_power']:.1f} to {spring['mean_positive_power']:.1f} W."
)
