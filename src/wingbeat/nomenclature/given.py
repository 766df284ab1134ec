"""Names of inputs: the animal, its wingbeat, the air, the coefficients, a run in a tunnel."""

from __future__ import annotations

from wingbeat.harmonics import HARMONIC_NAMES, HIGHEST_ORDER, SHARES
from wingbeat.nomenclature.term import Term

_ORDERS = f"cosine, sine of order 2, 3, .. {HIGHEST_ORDER}"
_HALF = "half of peak to peak"
GIVEN = (
    Term("mass", "kg", "whole mass", "M", "whole mass, body and both wings; give this or body.mass"),
    Term("body.mass", "kg", "mass without the wings", "", "mass without the wings; give this or vehicle.mass"),
    Term(
        "pitch_inertia",
        "kg m2",
        "pitch inertia of the body",
        "",
        "of the body alone, about the pitch axis through its centre of mass",
    ),
    Term("drag_area", "m2", "drag area of the body", "", "drag coefficient times frontal area; 0 is no body drag"),
    Term("tail.area", "m2", "area of the tail"),
    Term("tail.arm", "m", "arm of the tail", "", "aerodynamic centre of the tail behind the body's centre of mass"),
    Term("lift_slope", "rad-1", "lift slope of the tail", "", "pi/2 times the aspect ratio if slender"),
    Term("drag_coefficient", "1", "drag coefficient of the tail at no lift"),
    Term("tail.height", "m", "height of the tail", "", "of its aerodynamic centre above the body axis"),
    Term("incidence", "rad", "incidence of the tail", "", "of its chord above the body axis, leading edge up"),
    Term("semi_span", "m", "semi-span of the wing", "L₀", "shoulder to tip at mid-downstroke"),
    Term("chord", "m", "chord of the wing", "c", "one number, or stations from root to tip"),
    Term("wing.mass", "kg", "mass of one wing"),
    Term(
        "mass_exponent", "1", "exponent of the strip masses", "p", "p in the strip masses (1 - s/L)^p; 0 is uniform"
    ),
    Term("shoulder", "m", "position of the shoulder", "", "forward, left, up of the body's centre of mass"),
    Term("stroke_plane_angle", "rad", "stroke-plane angle", "β", "from the body axis; a quarter turn is vertical"),
    Term("density", "kg m-3", "density of the air", "ρ"),
    Term("viscosity", "m2 s-1", "kinematic viscosity of the air", "ν"),
    Term("gravity", "m s-2", "acceleration of gravity", "g"),
    Term("payload", "kg", "payload"),
    Term("speed", "m s-1", "mean horizontal speed", "U", short="speed"),
    Term("climb", "m s-1", "mean vertical speed"),
    Term("path.body_pitch", "rad", "body pitch along the path", "ψ", "body pitch, nose up, along the whole path"),
    Term(
        "path.flap",
        "rad",
        "flap angle along the stroke",
        "φ",
        "flap angle of arm and hand, wing up positive, along the whole stroke",
    ),
)
WINGBEAT = (
    Term("frequency", "Hz", "wingbeat frequency", "f", "wingbeats per second"),
    Term("flap_mean", "rad", "mean flap angle", "", "mean flap angle, wing up positive"),
    Term("flap_amplitude", "rad", f"flap amplitude, {_HALF}", "", _HALF, "flap amplitude"),
    Term("pitch_mean", "rad", "mean wing pitch", "", "mean wing pitch at the root, leading edge up positive"),
    Term("pitch_amplitude", "rad", f"wing pitch amplitude, {_HALF}", "", _HALF),
    Term(
        "span_retraction", "1", "span retraction at mid-upstroke", "", "share of the span retracted at mid-upstroke"
    ),
    Term(
        "twist_ratio",
        "1",
        "pitch at the tip over that at the root",
        "",
        "pitch at the tip over that at the root; 1 is no twist",
    ),
    Term("fold_amplitude", "rad", "largest fold of the hand", "", "drop of the hand below the arm at mid-upstroke"),
    Term("wrist", "1", "span fraction of the wrist"),
    Term("pitch_phase", "rad", "phase lead of wing pitch over flap"),
    Term("downstroke_fraction", "1", "share of the wingbeat taken by the downstroke"),
    Term(
        "sweep_mean",
        "rad",
        "mean sweep of the span ahead of the stroke plane",
        "",
        "mean angle of the span ahead of the stroke plane",
    ),
    Term(
        "sweep_amplitude",
        "rad",
        f"sweep amplitude, {_HALF}",
        "",
        f"{_HALF}; ahead at mid-downstroke (protraction)",
    ),
    Term(
        "sweep_phase",
        "rad",
        "phase lead of sweep over the downstroke",
        "",
        "phase lead over mid-downstroke",
    ),
    Term(
        "stroke_plane_tilt",
        "rad",
        "tilt added to the stroke-plane angle",
        "",
        "added to the wing's stroke-plane angle",
    ),
    Term("tail_tilt", "rad", "tilt added to the tail's incidence", "", "added to the tail's incidence"),
    Term("flap_harmonics", "rad", "harmonics of the flap angle", "", _ORDERS),
    Term("pitch_harmonics", "rad", "harmonics of the wing pitch", "", _ORDERS),
    Term(
        "span_harmonics",
        "1",
        "harmonics of the span over full span",
        "",
        f"of span over full span: order 1, 2, .. {HIGHEST_ORDER}",
    ),
    Term("chord_retraction", "1", "chord lost at mid-upstroke", "", "share of the chord lost at mid-upstroke"),
    Term(
        "twist_mean",
        "rad",
        "mean twist of the tip",
        "",
        "mean angle that adds to the pitch in proportion to the span fraction, full at the tip",
    ),
    Term("sweep_harmonics", "rad", "harmonics of the sweep", "", _ORDERS),
    Term(
        "chord_harmonics",
        "1",
        "harmonics of the chord over full chord",
        "",
        f"of chord over full chord: order 1, 2, .. {HIGHEST_ORDER}",
    ),
    Term(
        "twist_harmonics",
        "rad",
        "harmonics of the twist of the tip",
        "",
        f"cosine and sine of order 1, 2, .. {HIGHEST_ORDER}",
    ),
    *(
        Term(
            name,
            "1" if name.startswith(SHARES) else "rad",
            f"harmonic {name} of the wingbeat",
            "",
            "one number of the harmonics",
        )
        for name in HARMONIC_NAMES
    ),
)
AERO = (
    Term("coefficients", "", "name of the coefficients"),
    Term("extension", "", "extension of the coefficients to all angles of attack"),
    Term("blend_width_deg", "deg", "half width of the blends where pieces of the coefficients meet"),
    Term("strips", "1", "number of strips of a wing"),
    Term("force_point", "", "where on the chord the air load acts"),
    Term("airspeed", "", "airspeed that determines the loads of a strip"),
    Term("unsteady", "", "unsteady terms of the air loads"),
    Term("inflow", "", "model of the induced flow"),
    Term("share", "1", "factor on the unsteady terms and on the induced factor; 1 is all"),
    Term("induced_factor", "1", "induced power of the inflow divided by that of an ideal disc", "k"),
    Term("hand", "", "coefficients of the hand"),
    Term("hand_from", "1", "span fraction where the hand's coefficients begin"),
    Term("upstroke_factor", "1", "factor on lift and drag where air meets the wing from above"),
    Term("function", "", "digest of a coefficient function"),
    Term("constant", "1", "constant of a coefficient formula"),
    Term("amplitude", "1", "amplitude of a coefficient formula's sine"),
    Term("rate", "1", "factor of the angle of attack in a coefficient formula's sine"),
    Term("phase_deg", "deg", "phase of a coefficient formula's sine"),
    Term("decay_amplitude", "1", "amplitude of a coefficient formula's decaying part"),
    Term("decay_rate", "deg-1", "rate of a coefficient formula's decay"),
    Term("power_amplitude", "1", "amplitude of a coefficient formula's power law"),
    Term("exponent", "1", "exponent of a coefficient formula's power law"),
    Term("zero_lift_deg", "deg", "angle of attack at which a cambered wing's line of lift is zero"),
    Term("wing.lift_slope", "rad-1", "lift slope of a cambered wing in attached flow"),
    Term("lift_lowest", "1", "lift coefficient of a cambered wing beyond the stall at negative lift"),
    Term("lift_highest", "1", "lift coefficient of a cambered wing beyond the stall at positive lift"),
    Term("lift_rounding", "1", "how widely a cambered wing's line of lift bends at its ends"),
    Term("drag_least", "1", "drag coefficient of a cambered wing without lift or separated flow"),
    Term(
        "drag_induced", "1", "induced drag coefficient of a cambered wing over the square of its lift coefficient"
    ),
    Term("low_onset_deg", "deg", "angle above zero lift where flow separates from a cambered wing's lower side"),
    Term("low_rise", "rad-1", "drag coefficient that separation from the lower side adds for each radian"),
    Term("high_onset_deg", "deg", "angle above zero lift where flow separates from a cambered wing's upper side"),
    Term("high_rise", "rad-1", "drag coefficient that separation from the upper side adds for each radian"),
    Term("onset_rounding_deg", "deg", "how widely a cambered wing's drag bends at its onsets"),
)
RUN = (
    Term("normal_force", "N", "force normal to the plate"),
    Term("tangential_force", "N", "force along the plate"),
    Term("moment", "N m", "moment on the plate"),
    Term("span", "m", "span of the plate"),
    Term("thickness", "m", "thickness of the plate"),
    Term("channel_width", "m", "width of the channel"),
)
