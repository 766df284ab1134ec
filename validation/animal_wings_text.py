"""The sentences of the page of the wings of animals, which `animal_wings_words` fills with numbers."""

from __future__ import annotations

INTRODUCTION = """
`python validation/animal_wings.py` writes this page and computes all its numbers except those of the last table.
It fits the coefficient model `feathered` to two sets of measurements. Other people made these measurements, and
they are not part of this project:
"""
SOURCES = (
    """- Nine 3D-printed half wings of a gull in a wind tunnel (github.com/charvey23/UMWTStaticStability). The units
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
Grey points are the gull wings at the faster tunnel speed and triangles are the jackdaw, all converted to
aspect ratio {ratio:g}. The band contains 95 % of the resampled fits of `feathered`. a: lift. b: drag. c: drag
against lift. d: lift and drag of `feathered` (blue) and of the plate (`su-fan`) at all angles of attack.
"""
FORM = """## The form

With `ramp(x, w) = (x + sqrt(x^2 + w^2)) / 2` and `u = slope (a - zero_lift)`:

```text
C_L = lowest + ramp(u - lowest, rounding) - ramp(u - highest, rounding)
C_D = least + induced C_L^2 + low_rise ramp(low_onset - a, onset_rounding)
                            + high_rise ramp(a - high_onset, onset_rounding)
```"""
SIDES = """
Here a is the angle of attack, and the other symbols are the terms of the table below (`slope` is `lift_slope`).
The table counts the two onsets from the angle of zero lift. In the formula, `low_onset` is therefore
`zero_lift_deg` plus `low_onset_deg`. The angle of zero lift represents camber. Lift is linear between two
different stalls: C_L is at most {highest:.2f} with air from below the wing and at least {lowest:.2f} with air from
above. The formulas hold from -20 to 25 degrees, where wings were measured. From there to -45 and 45 degrees a
quintic polynomial leads to the coefficients of the plate (`su-fan`), with equal value, slope and curvature at its
ends. It is a guess that a wing acts like a plate from 45 degrees on. `wingbeat fit TABLE --form cambered` fits
this form to a wing of your own ([how](../guide/own_coefficients.md)).
"""
METHOD = """
We convert each gull wing to aspect ratio {ratio:g} with Prandtl's lifting line, whose downwash angle is `C_L / (pi
A)` (A: aspect ratio). `fit_curve` then fits lift and profile drag of each wing at the faster tunnel speed. Each
term is the median of the nine wings, except least drag and induced drag. The least C_D of the rigid prints is
{lowest:.3f} to {highest:.3f}, and that of the live wings is {live:.4f}: a print cannot change its twist and has no
feathers. We therefore take least drag and induced drag from the live bird.
"""
INTERVALS = """
The intervals come from a bootstrap over wings, and for {live} from a bootstrap over flights and wings. The
angle of zero lift is counted from the wing's mount. The nine prints are twisted and have nine postures of elbow
and wrist, so this angle differs from print to print. `lift_rounding` (0.15) and `onset_rounding_deg` (2) are
not fitted. `drag_induced` is below that of an ideal wing, 0.053, because the wake of the jackdaw also contains
the lift of its tail and body.
"""
LEFT_OUT = """
We leave out each gull wing in turn. The median of the other eight wings predicts the glide of this wing, at
this wing's aspect ratio. The drag is that of the prints, not of the live bird. *Ratio* is the lift-to-drag
ratio. *Sink* is the least sink speed in units of `sqrt(2 W / (rho S))`, with W the weight and S the wing
area.
"""
LEFT_OUT_VERDICT = """
Our goal was an error of at most {goal:.0%} for wings that the fit did not see. **Not every gull wing meets it.**
Of the {wings} wings, {ratios} meet it in ratio and {sinks} in sink; the root-mean-square errors are {of_ratio:.0%}
(ratio) and {of_sink:.0%} (sink). The measured ratios themselves differ by {spread:.0%} from wing to wing (standard
deviation). One set of numbers for all wings cannot reproduce these differences.
"""
OWN_DRAG = """
Most of the error comes from one term, the least drag (`drag_least`), which differs twofold among the printed
wings. We repeated the prediction with this term measured on the wing that was left out. The other fitted terms
were still the medians of the other eight wings. Then {ratios} of {wings} ratios and {sinks} of {wings} sinks are
within the goal (root-mean-square errors {of_ratio:.0%} and {of_sink:.0%}). No other single term brings all wings
within the goal. Among these wings least drag rises with aspect ratio, but a straight line through the other eight
wings does not predict it well enough.
"""
JACKDAW = """
The next table compares glides of the whole jackdaw, computed by `glide_polar` from its species file, with two
studies. The fit did not use the first study (Rosen and Hedenstrom 2001, J. Exp. Biol. 204:1153, abstract).
The second study is the source of the wings' drag. Its jackdaws often spread their tails; body and tail had a
drag area of {wide:.5f} m2 on average. The species file has {folded:.5f} m2 (`alternatives.body-drag`).
"""
JACKDAW_VERDICT = """
In comparison with the first study, the errors of `feathered` are {ratio:+.1%} for the ratio and {sink:+.1%}
for the sink: **the goal of {goal:.0%} {holds}**. But the model takes its least drag from the same species.
With the drag of the printed gull wings, the jackdaw's wings alone would have a best ratio of {printed:.1f};
the measured ratio of its wings is about 15.
"""
REYNOLDS = """
The gull wings were measured at two speeds, at Reynolds numbers of about 130 and 190 thousand. Between the
two, drag from -4 to 12 degrees changes as Re to the power {mean:.2f} ± {error:.2f} (mean and standard error
of nine wings, whose exponents range from {low:.2f} to {high:.2f}). This exponent is not distinguishable from
zero. In our models, least drag therefore does not depend on Reynolds number; each model states its range of
Reynolds numbers instead.
"""
STALL = """
At angles from 14 to 20 degrees, C_L is higher at the faster speed by {mean:.2f} ± {error:.2f}: {stalled} of
the nine prints stall early at the slower speed. At still lower Reynolds numbers, the jackdaw glides with C_L
up to 1.3. We therefore think that the early stall is a property of the smooth prints, and we fit the faster
speed.
"""
GUESSES = (
    """- `feathered` is a wing of aspect ratio 6, and its drag includes induced drag. With `--inflow momentum`
    wingbeat first converts it to a section, which has no induced drag.""",
    """- `feathered-revolving` has the delayed stall of revolving, dried pigeon wings: a C_L of 1.64 at 43
    degrees (Usherwood 2009, PMC3380271) and a largest lift-to-drag ratio of 6.3 (Crandell and Tobalske 2011,
    J. Exp. Biol. 214:1867). It states no aspect ratio, because coefficients of a revolving wing already
    include its induced flow. For its C_D beyond stall, the sources differ by a factor of three: 0.49 follows
    from the lift-to-drag ratio of 3.33 that Crandell and Tobalske give at 46 degrees, and 1.53 from a force
    normal to the wing, as on revolving plates. The model uses the geometric mean of these two values. Use
    this model for hover and slow flight.""",
    """- `feathered-flapping` has the attached flow of `feathered` and the stall of `feathered-revolving`, so
    it holds for slow and fast flight. It is a guess that one wing has both this flow and this stall. Do not use
    this model for glides, because gliding wings stall earlier.""",
    """- `membrane` is largely a guess, because we found no polar of a bat's wing in a source that we could
    access. Only two of its numbers are measured: the camber of 12 species, 6.5 to 9 % (Bullen and McKenzie
    2007, doi 10.1071/ZO07010), and the lift slope of thin plates. A bat in slow flight reaches a C_L of 4.8
    (Muijres et al. 2008, doi 10.1126/science.1153019); no model here reaches that.""",
    "- Choose a model by the kind of wing, not by the flight that the model gives.",
)
