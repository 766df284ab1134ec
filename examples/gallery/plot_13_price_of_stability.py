"""
What does stability cost?
=========================

The pigeon's wingbeat of least power at 8 m/s is unstable. A slightly different wingbeat needs slightly more
power, but disturbances grow more slowly or decay. How much power does it cost to fly without a controller?
"""

# %%
# The spectral radius is the factor by which the worst disturbance grows in each beat. ``pareto_front`` finds the
# wingbeat of least power for each limit of it, the loosest first.
import wingbeat as wb

problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=8.0, minimise="mean_positive_power")
front = wb.pareto_front(problem, "spectral_radius", [1.2, 1.0], starts=3)
assert all(orbit.status is wb.Status.CONVERGED for orbit in front.orbits)

# %%
# Least power for each limit (a), and how frequency and power change along the front (b).
page = wb.plots.pareto_page(front.record())
page

# %%
# The answer:
free, stable = front.objectives[0], front.objectives[-1]
assert front.values[0] > 1.0 >= front.values[-1] - 1e-3
print(
    f"Without a limit disturbances grow by a factor of {front.values[0]:.2f} in each beat. A wingbeat on which "
    f"they no longer grow costs {stable / free - 1:.1%} more power."
)
