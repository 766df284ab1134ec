"""
Which gusts does my robot survive with feedback one beat late?
==============================================================

Most orbits are unstable, so a flapping robot needs a controller. Sensors, filters and motors take time: a command
that is computed at one top of the stroke may act only one beat later. Which gusts does the robot then survive?
"""

# %%
# The robot is a pigeon at 12 m/s. ``feedback`` computes the gains of a linear-quadratic regulator: gains for a
# prompt controller, and gains that allow for a delay of one beat.
import matplotlib.pyplot as plt

import wingbeat as wb
from wingbeat._base.style import BLUE, GREEN, VERMILION

orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
assert orbit.status is wb.Status.CONVERGED
late = wb.feedback(orbit, delay=1)

# %%
# Fly random gusts of up to 10 m/s, which is nearly the speed of flight. A flight is lost if the body pitch
# differs by 60 degrees from the orbit's, or if the robot sinks 5 m.
controls = {"no feedback": None, "feedback": wb.feedback(orbit), "feedback one beat late": late}
survey = wb.survey_gusts(orbit, controls, flights=200, size=10.0, seed=1)

# %%
# Each point is a fifth of the range of sizes.
figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
for name, color, mark in zip(controls, (VERMILION, BLUE, GREEN), "so^", strict=True):
    edges, shares = survey.by_size(name, bins=5)
    axes.plot((edges[1:] + edges[:-1]) / 2, 100 * shares, color=color, marker=mark, label=name)
axes.set(xlabel="largest velocity of the gust [m/s]", ylabel="gusts survived [%]", ylim=(-3, 103))
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="center left")

# %%
# The answer:
edges, shares = survey.by_size("feedback one beat late", bins=5)
safe = next((edge for edge, share in zip(edges, shares, strict=False) if share < 0.95), edges[-1])
print(
    f"With feedback one beat late it survives {survey.share('feedback one beat late'):.0%} of these gusts, and at "
    f"least 95 % of those of up to {safe:.0f} m/s. Without feedback it survives {survey.share('no feedback'):.0%}."
)
assert survey.share("no feedback") < 0.1 < survey.share("feedback one beat late")
