"""
Can the animal glide there?
===========================

A jackdaw sits on a tower, 30 m above a field that is 250 m away. Can it reach the field without a wingbeat? And
if not, from what height could it?
"""

# %%
# The glide polar: speed, sink and path for each angle of attack, with the wings held still. The coefficients are
# those of feathered wings.
import matplotlib.pyplot as plt
import numpy as np

import wingbeat as wb
from wingbeat._base.style import BLUE, VERMILION

jackdaw = wb.load_species("jackdaw").with_alternative("body-drag")
polar = wb.glide_polar(jackdaw, "feathered", angles_of_attack=np.radians(np.arange(1.0, 13.0)))
flattest = polar.best_ratio
assert flattest is not None

# %%
# Sink against forward speed: the straight line from the origin touches the curve at the flattest glide.
height, distance = 30.0, 250.0
forward = np.array([glide.speed * np.cos(glide.glide_angle) for glide in polar.glides])
sink = np.array([glide.sink for glide in polar.glides])
figure, axes = plt.subplots(figsize=(5.5, 3.6), layout="constrained")
axes.plot(forward, sink, color=BLUE, marker="o", label="glides of the jackdaw")
reach = np.array([0.0, forward.max()])
axes.plot(reach, reach * height / distance, color=VERMILION, linestyle="--", label="path to the field")
axes.plot(reach, reach / flattest.glide_ratio, color="k", linestyle=":", label="flattest glide")
axes.set(xlabel="forward speed [m/s]", ylabel="sink [m/s]", xlim=(0, None), ylim=(0, None))
axes.invert_yaxis()
axes.spines[["top", "right"]].set_visible(False)
axes.legend(frameon=False, loc="lower left")

# %%
# The answer:
possible = flattest.glide_ratio >= distance / height
print(
    f"{'Yes' if possible else 'No'}: its flattest glide goes {flattest.glide_ratio:.1f} m forward for each metre "
    f"of height, at {flattest.speed:.1f} m/s. To get {distance:.0f} m far, it must start at "
    f"{distance / flattest.glide_ratio:.0f} m."
)
