"""Write docs/theory/symbols.md: the symbols of the nomenclature, and those that only the pages of theory use.

Run from the root of a clone::

    uv run python validation/theory_symbols.py
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from wingbeat._base import NOMENCLATURE, plain, write_atomically

PAGE = Path(__file__).resolve().parents[1] / "docs" / "theory" / "symbols.md"


class Local(NamedTuple):
    """A symbol of the pages: in TeX, its meaning, its unit, and the page that defines it."""

    symbol: str
    meaning: str
    unit: str
    page: str


LOCAL = (
    Local(r"\mathbf{x}_b, \mathbf{y}, \mathbf{z}_b", "body axes in the world", "1", "frames"),
    Local(r"\mathbf{e}_{c0}, \mathbf{d}", "stroke axes: normal to the stroke plane, and up in it", "1", "frames"),
    Local(r"\chi", "nose-up pitch of stroke axes from the world", "rad", "frames"),
    Local("E", "nose-up turn of an in-plane vector by a right angle", "1", "frames"),
    Local(r"\mathbf{u}, \mathbf{n}", "unit vectors along and normal to a flapped span", "1", "frames"),
    Local(r"\mathbf{e}_s, \mathbf{e}_c, \mathbf{e}_n", "span, chord and normal of a strip", "1", "frames"),
    Local(r"\xi", "place on the chord ahead of the quarter chord", "m", "frames"),
    Local(r"\hat t, \hat\tau", "phase, and phase of the stroke", "1", "wing"),
    Local("T", "period of the wingbeat", "s", "wing"),
    Local("r", "recovery law", "1", "wing"),
    Local(r"a_n, b_n", "cosine and sine of a harmonic of order n", "rad or 1", "wing"),
    Local(r"\varphi_0, \varphi_1", "mean and amplitude of flap", "rad", "wing"),
    Local(r"\theta_0, \theta_1, \delta", "mean, amplitude and phase lead of wing pitch", "rad", "wing"),
    Local("d", "downstroke fraction", "1", "wing"),
    Local("x_p, x_m, r_m", "pitch axis, centre and gyration of a strip's mass, in chords", "1", "wing"),
    Local(r"\lambda_L, \lambda_c", "retraction of span and chord at mid-upstroke", "1", "wing"),
    Local(r"\kappa, \kappa_1", "fold of the hand below the arm, and its largest value", "rad", "wing"),
    Local(r"\sigma", "sweep of the span ahead of the stroke plane", "rad", "wing"),
    Local(r"\vartheta", "angle that the twist law adds at the tip", "rad", "wing"),
    Local(r"k_\theta, g_i", "twist ratio, and twist factor of a strip", "1", "wing"),
    Local(r"\eta_i, \eta_w", "span fraction of a strip's centre, and of the wrist", "1", "wing"),
    Local(r"\varphi_i, \theta_i", "flap angle and pitch of a strip", "rad", "wing"),
    Local(r"\mathbf{b}", "place in stroke axes from the body's centre of mass", "m", "wing"),
    Local(r"\Delta s", "width of a strip", "m", "wing"),
    Local(r"c_i, \tilde c_i", "full chord of a strip, and the chord that meets the air", "m", "wing"),
    Local("N", "number of strips of a wing", "1", "wing"),
    Local("m_b, m_w, m_i", "mass of the body, of a wing, of a strip", "kg", "masses"),
    Local("I_b", "pitch inertia of the body", "kg m2", "masses"),
    Local("C_L, C_D, C_N, C_M", "coefficients of lift, drag, normal force and moment", "1", "coefficients"),
    Local("x_{cp}", "centre of pressure from the leading edge, in chords", "1", "coefficients"),
    Local("A", "aspect ratio of a measured wing", "1", "coefficients"),
    Local(r"v_c, v_n, v_s", "velocity of a strip along chord, normal and span", "m s-1", "air_loads"),
    Local(r"V_1, V_3", "velocity of the body through the air, in stroke axes", "m s-1", "air_loads"),
    Local(r"\mathbf{F}_i, \ell_i, d_i", "air load of a strip, its lift and drag", "N", "air_loads"),
    Local(r"\omega_i", "turning rate of a strip's chord, leading edge up", "rad s-1", "air_loads"),
    Local(r"\mu_i, \iota_i", "added mass and added inertia of a strip", "kg, kg m2", "air_loads"),
    Local("G_i", "couple on a strip, leading edge up", "N m", "air_loads"),
    Local(r"\varsigma", "share of the unsteady terms and of the induced factor", "1", "air_loads"),
    Local(r"\mathbf{w}", "velocity of the air at the wings", "m s-1", "air_loads"),
    Local(r"S_b, S_t, a_t", "drag area of the body; area and lift slope of the tail", "m2, m2, rad-1", "air_loads"),
    Local(r"\mathbf{S}, I, K", "first moment, inertia and acceleration moment of the wings", "SI", "dynamics"),
    Local(r"\mathbf{q}, J", "five coordinates, and partial velocities", "SI", "dynamics"),
    Local(r"D, C, \mathbf{h}, \mathbf{g}, \mathbf{f}", "terms of the equations of motion", "SI", "dynamics"),
    Local(
        r"k, c, \theta_0, \theta_s, k_s, t",
        "a pitch hinge's stiffness, damping, rest angle, stops, and share of twist",
        "SI",
        "dynamics",
    ),
    Local(r"\mathbf{y}, \mathbf{c}, \mathbf{c}_A", "unknowns, closure, active conditions", "SI", "orbit"),
    Local(r"\boldsymbol{\lambda}, \boldsymbol{\nu}", "multipliers of the optimality conditions", "1", "orbit"),
    Local(r"\Phi, \mu_k", "monodromy matrix, and Floquet multipliers", "1", "orbit"),
    Local("A, B, G", "map of a beat: by state, inputs and gusts", "SI", "stability"),
    Local("Q, R, \\Pi, K", "costs, cost to go and gains of feedback", "SI", "stability"),
    Local("X, Y", "scales of the state and units of the inputs", "SI", "stability"),
)


def page() -> str:
    """Return the text of the page."""
    named: dict[str, list[str]] = {}
    for term in NOMENCLATURE.values():
        if term.symbol:
            named.setdefault(term.unit, []).append(f"{term.symbol} `{term.name}`")
    lines = [
        "# Symbols",
        "",
        "## Symbols of records",
        "",
        "Records, data sets and figures use these, here by unit; the site's {doc}`reference <../reference/record>` "
        r"defines each. The pages write φ as $\varphi$ and L₀ as $L_0$.",
        "",
        *(f"- {'no unit' if unit == '1' else plain(unit)}: {', '.join(terms)}" for unit, terms in named.items()),
        "",
        "## Symbols of the pages",
        "",
        "A bracket gives the unit, if there is one.",
    ]
    for name in dict.fromkeys(symbol.page for symbol in LOCAL):
        lines += ["", f"[{name.replace('_', ' ').capitalize()}]({name}.md):", ""]
        lines += [f"- ${s.symbol}$: {s.meaning}{_bracket(s.unit)}" for s in LOCAL if s.page == name]
    return "\n".join([*lines, ""])


def _bracket(unit: str) -> str:
    if unit == "1":
        return ""
    parts = (part if part == "SI" or " or " in part else plain(part) for part in unit.split(", "))
    return f" [{', '.join(parts)}]"


if __name__ == "__main__":
    write_atomically(PAGE, page())
