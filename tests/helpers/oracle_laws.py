"""The laws of the wingbeat for the plain oracle, with their time derivatives written out by hand; NumPy alone."""

import math

import numpy as np


def warped(wingbeat, phase):
    """Stroke phase and its first and second derivatives by phase: tan(half turn) is stretched by cot(pi d/2).

    Theory: equation ``stroke-phase``.
    """
    d = wingbeat["downstroke_fraction"]
    k, a = 1.0 / math.tan(0.5 * math.pi * d), math.pi * (phase - 0.5 * d)
    s, c = math.sin(a), math.cos(a)
    spread = c**2 + (k * s) ** 2
    return 0.25 + math.atan2(k * s, c) / math.pi, k / spread, -2.0 * math.pi * k * (k**2 - 1.0) * s * c / spread**2


def series(wingbeat, phase, mean, terms):
    """A mean and (order, cosine, sine) terms of the stroke phase, with first and second time derivatives.

    Theory: equations ``phase`` and ``harmonics``.
    """
    tau, tau_d, tau_dd = warped(wingbeat, phase)
    value, slope, curve = mean, 0.0, 0.0
    for order, a, b in terms:
        w = 2.0 * math.pi * order
        s, c = math.sin(w * tau), math.cos(w * tau)
        value, slope, curve = value + a * c + b * s, slope + w * (b * c - a * s), curve - w**2 * (a * c + b * s)
    f = wingbeat["frequency"]
    return value, f * slope * tau_d, f**2 * (curve * tau_d**2 + slope * tau_dd)


def harmonics(wingbeat, law, first):
    """(order, cosine, sine) terms of a list of harmonics."""
    pairs = np.reshape(wingbeat[f"{law}_harmonics"], (-1, 2))
    return [(first + i, *pair) for i, pair in enumerate(pairs)]


def wing_angles(wingbeat, phase):
    """Flap and root pitch with their first and second time derivatives: two triples (rad, rad/s, rad/s2).

    Theory: equations ``flap-law`` and ``pitch-law``.
    """
    pitch, ahead = wingbeat["pitch_amplitude"], wingbeat["pitch_phase"]
    flaps = [(1, wingbeat["flap_amplitude"], 0.0), *harmonics(wingbeat, "flap", 2)]
    pitches = [(1, -pitch * math.sin(ahead), -pitch * math.cos(ahead)), *harmonics(wingbeat, "pitch", 2)]
    return (
        series(wingbeat, phase, wingbeat["flap_mean"], flaps),
        series(wingbeat, phase, wingbeat["pitch_mean"], pitches),
    )


def prescribed(wingbeat, phase, frozen):
    """What time prescribes, each with its two time derivatives, none if frozen: recovery, span, sweep, twist.

    Theory: equations ``recovery-law``, ``fold-law``, ``span-law``, ``sweep-law`` and ``twist-law``.
    """
    shrink, swing, ahead = wingbeat["span_retraction"], wingbeat["sweep_amplitude"], wingbeat["sweep_phase"]
    spans = [(1, 0.0, 0.5 * shrink), *harmonics(wingbeat, "span", 1)]
    sweeps = [(1, swing * math.sin(ahead), swing * math.cos(ahead)), *harmonics(wingbeat, "sweep", 2)]
    laws = (
        series(wingbeat, phase, 0.5, [(1, 0.0, -0.5)]),
        series(wingbeat, phase, 1.0 - 0.5 * shrink, spans),
        series(wingbeat, phase, wingbeat["sweep_mean"], sweeps),
        series(wingbeat, phase, wingbeat["twist_mean"], harmonics(wingbeat, "twist", 1)),
    )
    return [(value, 0.0, 0.0) for value, *_ in laws] if frozen else laws


def chord_ratio(wingbeat, phase):
    """The chord that meets the air over the full chord. Theory: equation ``chord-law``."""
    lost = wingbeat["chord_retraction"]
    return series(wingbeat, phase, 1.0 - 0.5 * lost, [(1, 0.0, 0.5 * lost), *harmonics(wingbeat, "chord", 1)])[0]
