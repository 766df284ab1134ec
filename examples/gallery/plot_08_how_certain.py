"""
How certain is this power?
==========================

Nobody has measured every number of your animal. If each number may lie anywhere within a tenth of its plausible
range, how uncertain is the power, and which number should you measure better?
"""

# %%
# ``sensitivities`` differentiates the optimum with respect to every number. This ranks the numbers.
import wingbeat as wb

orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=2)
assert orbit.status is wb.Status.CONVERGED
quantities = ["frequency", "mean_positive_power"]
found = wb.sensitivities(orbit, quantities)

# %%
# A ranking is no error bar. For the error bar we draw all numbers at once, and solve the orbit for each draw.
sampled = wb.uncertainty_by_samples(found, quantities, samples=40, seed=1, share=0.1)
power = sampled["mean_positive_power"]
assert power.certified == power.drawn

# %%
# The numbers that matter most are on top. Bars are shares of the longest.
page = wb.plots.tornado_page(found)
page

# %%
# The answer:
first = found.ranked("mean_positive_power")[0].parameter.path
names = {"body.mass": "the mass of the body", "wing.semi_span": "the length of a wing"}
assert power.first_order_holds
print(
    f"Within a tenth of each plausible range the power is {power.mean:.1f} ± {power.deviation:.1f} W (mean and "
    f"standard deviation of {power.drawn} draws). What matters most: {names.get(first, first)}."
)
