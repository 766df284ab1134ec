"""The sentences of the page of the wings of animals, which `animal_wings_words` fills with numbers."""

from __future__ import annotations

INTRODUCTION = """
`python validation/animal_wings.py` writes this page and computes the numbers in it, but for those of the last
table. It fits the coefficient model `feathered` to measurements by other people, which are not part of this
project:
"""
SOURCES = (
    """- Nine printed half wings of a gull in a wind tunnel (github.com/charvey23/UMWTStaticStability). The units
    of the source are ambiguous; [measured wings](measured_wings.md) says how we read them.""",
    """- The wings of a live gliding jackdaw: induced and profile drag from its wake (KleinHeerenbrink, Warfvinge
    and Hedenstrom 2016, doi 10.1242/jeb.132480), in the {frames} frames that show its span and wing area.""",
)
COMMANDS = """```sh
uv run wingbeat polar feathered --alpha -180:180:5
uv run wingbeat glide jackdaw --aero feathered
uv run wingbeat orbit pigeon --speed 12 --aero feathered
```"""
FIGURE = """
Grey points: the gull wings at the faster tunnel speed. Triangles: the jackdaw. All are brought to aspect ratio
{ratio:g}. Band: 95 % of the resampled fits of `feathered`. a: lift. b: drag. c: drag against lift. d: the whole
turn of `feathered` (blue) and of the plate (`su-fan`).
"""
FORM = """## The form

With `ramp(x, w) = (x + sqrt(x^2 + w^2)) / 2` and `u = slope (a - zero_lift)`:

```text
C_L = lowest + ramp(u - lowest, rounding) - ramp(u - highest, rounding)
C_D = least + induced C_L^2 + low_rise ramp(low_onset - a, onset_rounding)
                            + high_rise ramp(a - high_onset, onset_rounding)
```"""
SIDES = """
Camber is the angle of zero lift. Lift is a line between two stalls that differ: with air from below the wing
reaches {highest:.2f}, with air from above {lowest:.2f}. The formulas hold from -20 to 25 degrees, where wings
were measured. From there to -45 and 45 degrees a quintic polynomial runs into the plate of `su-fan`, with equal
value, slope and curvature at its ends. Where in this range a wing becomes a plate is a guess.
"""
METHOD = """
Prandtl's lifting line brings each gull wing to aspect ratio {ratio:g}; its downwash angle is `C_L / (pi A)`.
`fit_curve` then fits lift and profile drag of each wing at the faster tunnel speed, and the shape is the median
of the nine. The rigid prints have least drags of {lowest:.3f} to {highest:.3f}, the live wings {live:.4f}: the
twist of a print is frozen, and its surface is not feathers. So least drag and induced part are the live bird's.
"""
INTERVALS = """
The intervals are those of a bootstrap over wings, and for {live} over flights and wings. The angle of zero lift
is that of a mount, and the prints are twisted: its spread is that of postures. `lift_rounding` (0.15) and
`onset_rounding_deg` (2) are held fixed. `drag_induced` is below that of an ideal wing, 0.053: the wake of the
jackdaw also holds the lift of its tail and body.
"""
LEFT_OUT = """
Each gull wing against the median of the other eight, prints against prints, at its own aspect ratio. *Sink* is
the least, in units of `sqrt(2 W / (rho S))`.
"""
LEFT_OUT_VERDICT = """
**The goal of {goal:.0%} does not hold for every gull wing.** It holds for the ratio of {ratios} and for the
sink of {sinks} of {wings} wings; the root-mean-square errors are {of_ratio:.0%} and {of_sink:.0%}. The measured
ratios themselves differ by {spread:.0%} from wing to wing (standard deviation): posture and twist differ, which
one set of numbers cannot follow.
"""
JACKDAW = """
The whole jackdaw, by `glide_polar` of its species file, against two studies. The fit did not see the first
(Rosen and Hedenstrom 2001, J. Exp. Biol. 204:1153, abstract). The second is the source of the wings' drag; its
body and its tail, often spread, had a drag area of {wide:.5f} m2 on average, against {folded:.5f} m2 of
`alternatives.body-drag`.
"""
JACKDAW_VERDICT = """
Against the study that the fit did not see, the errors of `feathered` are {ratio:+.1%} for the ratio and
{sink:+.1%} for the sink: **the goal of {goal:.0%} {holds}**. But the level of drag comes from the same species.
The printed gull wings alone would give these wings a best ratio of {printed:.1f} at the jackdaw's aspect ratio;
about 15 was measured on them.
"""
REYNOLDS = """
The gull wings were measured at two speeds, Reynolds numbers of about 130 and 190 thousand. Between them drag
from -4 to 12 degrees changes as Re to the power {mean:.2f} ± {error:.2f} (mean and standard error of nine
wings, which run from {low:.2f} to {high:.2f}). That is not different from zero, so no model here has a least
drag that depends on Reynolds number; each states its range instead.
"""
STALL = """
Lift from 14 to 20 degrees is higher at the faster speed by {mean:.2f} ± {error:.2f}: {stalled} of the nine
prints stall early at the slower one. The jackdaw, at still lower Reynolds numbers, glides with C_L up to 1.3.
We take the early stall to be a property of the smooth prints, and fit the faster speed.
"""
GUESSES = (
    """- `feathered` states an aspect ratio of 6 and holds its own induced drag. With `--inflow momentum` it is made
    sectional first.""",
    """- `feathered-revolving` has the delayed stall of revolving, dried pigeon wings: a C_L of 1.64 at 43 degrees
    (Usherwood 2009, PMC3380271) and a largest lift-to-drag ratio of 6.3 (Crandell and Tobalske 2011, J. Exp. Biol.
    214:1867). It states no aspect ratio, because a revolving wing holds its own induced flow. Its drag beyond stall
    is midway between 0.49, from the ratio of 3.33 that Crandell and Tobalske give at 46 degrees, and 1.53, for a
    force normal to the wing as on revolving plates: the sources differ by a factor of three. It is meant for hover
    and slow flight.""",
    """- `membrane` is in large part a guess, because we found no polar of a bat's wing that we could read. Measured
    are the camber of 12 species, 6.5 to 9 % (Bullen and McKenzie 2007, doi 10.1071/ZO07010), and the slope of thin
    plates. A bat in slow flight reaches a C_L of 4.8 (Muijres et al. 2008, doi 10.1126/science.1153019); no model
    here does.""",
    "- Choose a model by what the wing is, not by the flight that it gives.",
)
