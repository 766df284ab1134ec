"""How the wings beat: the record of a wingbeat and its laws as functions of phase.

Phase runs from 0 at the top of the stroke to 1. The downstroke lasts from 0 to 1/2, or to `downstroke_fraction`.
All laws beyond those of Su et al. 2023 are off by default; a law that is off is left out of the compiled programs.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FIRST_ORDER, HARMONIC_NAMES, HIGHEST_ORDER, SHARES, FaultList, harmonic_place
from wingbeat._jax.arrays import at_default, atan2, cos, jnp, register_record, sin, unchecked
from wingbeat.animal.pitch_hinge import HINGE_NAMES, HeldHinge, PitchHinge

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Parameters, Phases, Scalar


_SWEEP = ("sweep_mean", "sweep_amplitude", "sweep_phase")
_CHORD_AND_TWIST = ("chord_retraction", "twist_mean")
# Records name these laws only if they are on; species name them only if the file gives them.
NAMED_IF_ON = ("tail_tilt", *_CHORD_AND_TWIST, "sweep_harmonics", "chord_harmonics", "twist_harmonics")
_OPTIONAL = ("pitch_phase", "downstroke_fraction", *_SWEEP, "stroke_plane_tilt", "tail_tilt", *_CHORD_AND_TWIST)


@register_record(optional=_OPTIONAL)
@dataclass(frozen=True)
class Wingbeat:
    """One periodic wingbeat; amplitudes are half of peak to peak.

    Parameters
    ----------
    frequency : [Hz].
    flap_mean, flap_amplitude : flap angle, wing up positive [rad].
    pitch_mean, pitch_amplitude : wing pitch at the root, leading edge up positive [rad].
    span_retraction : share of the span retracted at mid-upstroke, 0 to below 1.
    twist_ratio : ratio of wing pitch at the tip to wing pitch at the root; 1 is no twist.
    fold_amplitude : angle by which the hand drops below the arm at mid-upstroke [rad].
    wrist : span fraction of the wrist.
    pitch_phase : phase lead of pitch over flap, beyond a quarter of a wingbeat [rad].
    downstroke_fraction : share of the wingbeat that the downstroke takes; all laws are stretched equally.
    sweep_mean, sweep_amplitude, sweep_phase : angle by which the span points ahead of the stroke plane [rad];
        with `sweep_phase` 0 it is largest at mid-downstroke (protraction).
    stroke_plane_tilt : added to the wing's stroke-plane angle [rad].
    tail_tilt : added to the tail's incidence [rad]; without a tail it has no effect.
    flap_harmonics, pitch_harmonics : cosine and sine of order 2, of order 3 and so on, up to 8 [rad].
    span_harmonics : cosine and sine of order 1, 2 and so on, of the span divided by the full span.
    chord_retraction : share of the chord lost at mid-upstroke, 0 to below 1. Only the chord that meets the air
        shrinks; the wing's mass stays distributed over the full chord, and the quarter-chord line does not move.
    twist_mean : angle that is added to the pitch at the tip; elsewhere, this angle times the span fraction is added
        [rad].
    sweep_harmonics : cosine and sine of order 2, of order 3 and so on [rad].
    chord_harmonics : cosine and sine of order 1, 2 and so on, of the chord divided by the full chord.
    twist_harmonics : cosine and sine of order 1, 2 and so on, of the angle whose mean is `twist_mean` [rad].
    pitch_hinge : a hinge that gives way; unless it only twists the wing, the pitch law has no effect. None for a
        prescribed pitch.

    Raises
    ------
    InvalidInputError : frequency not positive, an amplitude negative, an angle above pi or a phase above 2 pi,
        which is most likely in degrees, retraction, wrist or downstroke fraction
        outside 0..1, a sweep that reaches a right angle, harmonics not in pairs, a span or a chord that vanishes.

    >>> Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3).twist_ratio
    1.0
    """

    frequency: float
    flap_mean: float
    flap_amplitude: float
    pitch_mean: float
    pitch_amplitude: float
    span_retraction: float = 0.0
    twist_ratio: float = 1.0
    fold_amplitude: float = 0.0
    wrist: float = 0.5
    pitch_phase: float = 0.0
    downstroke_fraction: float = 0.5
    sweep_mean: float = 0.0
    sweep_amplitude: float = 0.0
    sweep_phase: float = 0.0
    stroke_plane_tilt: float = 0.0
    tail_tilt: float = 0.0
    flap_harmonics: tuple[float, ...] = ()
    pitch_harmonics: tuple[float, ...] = ()
    span_harmonics: tuple[float, ...] = ()
    chord_retraction: float = 0.0
    twist_mean: float = 0.0
    sweep_harmonics: tuple[float, ...] = ()
    chord_harmonics: tuple[float, ...] = ()
    twist_harmonics: tuple[float, ...] = ()
    pitch_hinge: PitchHinge | None = None  # within the equations, a `HeldHinge` may stand in its place

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("wingbeat.frequency", self.frequency, above=0, unit="Hz")
        faults.angle("wingbeat.flap_mean", self.flap_mean)
        half = "amplitudes are half of peak to peak"
        faults.angle("wingbeat.flap_amplitude", self.flap_amplitude, at_least=0, fix=half)
        faults.angle("wingbeat.pitch_mean", self.pitch_mean)
        faults.angle("wingbeat.pitch_amplitude", self.pitch_amplitude, at_least=0, fix=half)
        faults.number("wingbeat.span_retraction", self.span_retraction, at_least=0, below=1)
        faults.number("wingbeat.twist_ratio", self.twist_ratio, fix="1 is no twist")
        faults.angle("wingbeat.fold_amplitude", self.fold_amplitude)
        faults.number("wingbeat.wrist", self.wrist, at_least=0, at_most=1, fix="a fraction of the span")
        faults.angle("wingbeat.pitch_phase", self.pitch_phase)
        even = "0.5 makes downstroke and upstroke equally long"
        faults.number("wingbeat.downstroke_fraction", self.downstroke_fraction, above=0, below=1, fix=even)
        faults.angle("wingbeat.sweep_phase", self.sweep_phase)
        faults.angle("wingbeat.stroke_plane_tilt", self.stroke_plane_tilt)
        faults.angle("wingbeat.tail_tilt", self.tail_tilt)
        faults.number("wingbeat.chord_retraction", self.chord_retraction, at_least=0, below=1)
        faults.angle("wingbeat.twist_mean", self.twist_mean)
        mean = faults.angle("wingbeat.sweep_mean", self.sweep_mean)
        swing = faults.angle("wingbeat.sweep_amplitude", self.sweep_amplitude, at_least=0)
        if mean and swing and abs(self.sweep_mean) + self.sweep_amplitude >= 0.5 * math.pi:
            rule = "|sweep_mean| plus sweep_amplitude must stay below a right angle"
            faults.add("wingbeat.sweep_amplitude", self.sweep_amplitude, rule, "give both in rad")
        sound = self._check_harmonics(faults) and not faults.faults
        if sound and (self.span_harmonics or self.chord_harmonics or self.sweep_harmonics):
            self._check_extremes(faults)
        faults.raise_if_any()

    def _check_harmonics(self, faults: FaultList) -> bool:
        """Note harmonics that are not lists of pairs; return whether all are lists of numbers."""
        sound = True
        for law, first in FIRST_ORDER.items():
            where, given = f"wingbeat.{law}_harmonics", getattr(self, f"{law}_harmonics")
            rule = (
                f"must be cosine and sine of order {first}, then of order {first + 1}, up to order {HIGHEST_ORDER}"
            )
            if not isinstance(given, list | tuple):
                faults.add(where, given, rule, "give a list of numbers, or [] for no harmonics")
                sound = False
                continue
            object.__setattr__(self, where.removeprefix("wingbeat."), tuple(given))
            if len(given) % 2 or len(given) > 2 * (HIGHEST_ORDER + 1 - first):
                faults.add(where, tuple(given), rule, "give the numbers in pairs")
            check = faults.number if law in SHARES else faults.angle
            sound &= all([check(f"{where}[{i}]", value) for i, value in enumerate(given)])
        return sound

    def _check_extremes(self, faults: FaultList) -> None:
        """Note harmonics with which a span or a chord vanishes in the beat, or the sweep reaches a right angle."""
        turn = np.linspace(0.0, 2 * math.pi, 721)
        for law, retraction in (("span", self.span_retraction), ("chord", self.chord_retraction)):
            harmonics = getattr(self, f"{law}_harmonics")
            if not harmonics:
                continue
            least = float((1.0 - retraction * 0.5 * (1.0 - np.sin(turn)) + self._waves(law, turn)).min())
            if least <= 0:
                rule = f"makes the {law} vanish, with a minimum of {least:.2g} of the full {law}"
                faults.add(f"wingbeat.{law}_harmonics", harmonics, rule, "make the harmonics smaller")
        if self.sweep_harmonics:
            swing = self.sweep_amplitude * np.sin(turn + self.sweep_phase) + self._waves("sweep", turn)
            if np.abs(self.sweep_mean + swing).max() >= 0.5 * math.pi:
                rule = "must keep the sweep below a right angle"
                faults.add("wingbeat.sweep_harmonics", self.sweep_harmonics, rule, "make the harmonics smaller")

    def _waves(self, law: str, turn: np.ndarray) -> np.ndarray:
        pairs = np.reshape(getattr(self, f"{law}_harmonics"), (-1, 2))
        angles = (FIRST_ORDER[law] + np.arange(len(pairs))[:, None]) * turn
        return pairs[:, 0] @ np.cos(angles) + pairs[:, 1] @ np.sin(angles)


WINGBEAT_NAMES = tuple(field.name for field in dataclasses.fields(Wingbeat))
# The numbers of a wingbeat by name, a harmonic's cosine and sine by names of their own such as flap_cos_2.
PARAMETER_NAMES = (
    *(name for name in WINGBEAT_NAMES if not name.endswith(("_harmonics", "_hinge"))),
    *HARMONIC_NAMES,
    *HINGE_NAMES,
)
# The pitch law: without effect if the wing's root pitches with a hinge.
PITCH_LAW = tuple(name for name in PARAMETER_NAMES if name.startswith("pitch_"))
# The wrist sits between two strips: moving it changes nothing until it jumps over a strip's centre.
FREE_NAMES = tuple(name for name in PARAMETER_NAMES if name != "wrist")
_PLAIN = ("frequency", "twist_ratio", "downstroke_fraction", "hinge_stiffness", "hinge_damping")
ANGLES = tuple(name for name in FREE_NAMES if name not in _PLAIN and not name.startswith(SHARES))


def stroke_phase(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return the phase of a wingbeat with equal down- and upstroke: 0 at the top, 1/2 at the bottom.

    If phases are angles from mid-downstroke, an angle alpha becomes theta with ``tan(theta/2) = cot(pi d/2)
    tan(alpha/2)``, where d is the downstroke fraction. Phase d becomes 1/2, and 1 stays 1. This Moebius map of the
    circle is smooth and increasing for every d. Theory: equation ``stroke-phase``.
    """
    if at_default(wingbeat, "downstroke_fraction"):
        return phase
    half = 0.5 * math.pi * wingbeat.downstroke_fraction
    c, s = cos(half), sin(half)
    pull = (c - s) / (c + s)
    around = 2 * math.pi * phase - 2.0 * half
    lead = atan2(pull * sin(around), 1.0 - pull * cos(around))
    return phase + 0.25 + (lead - half) / math.pi


def recovery(phase: Phases) -> Phases:
    """Return the recovery law ``(1 - sin 2 pi phase)/2``: 0 at mid-downstroke, 1 at mid-upstroke.

    Theory: equation ``recovery-law``.
    """
    return 0.5 * (1.0 - sin(2 * math.pi * phase))


def with_harmonics(base: Phases, pairs: Sequence[Scalar], first: int, phase: Phases) -> Phases:
    """Add to a law its cosines and sines of order `first` and up. Theory: equation ``harmonics``."""
    if not pairs:
        return base
    # All orders at once: one sine to trace and compile, however many there are.
    numbers = jnp.stack(jnp.broadcast_arrays(*[jnp.asarray(a, dtype=float) for a in pairs]))
    own = numbers.shape[1:]  # one wingbeat, or one for each of the last places
    waves = jnp.reshape(numbers, (-1, 2, *[1] * (jnp.ndim(phase) - len(own)), *own))
    turns = 2 * math.pi * np.arange(first, first + len(pairs) // 2).reshape(-1, *[1] * jnp.ndim(phase))
    angles = turns * phase
    return base + jnp.sum(waves[:, 0] * cos(angles) + waves[:, 1] * sin(angles), axis=0)


def flap_angle(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return the flap angle of the arm, up positive [rad]. Theory: equation ``flap-law``."""
    at = stroke_phase(wingbeat, phase)
    base = wingbeat.flap_mean + wingbeat.flap_amplitude * cos(2 * math.pi * at)
    return with_harmonics(base, wingbeat.flap_harmonics, FIRST_ORDER["flap"], at)


def pitch_angle(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return the wing pitch at the root, leading edge up positive [rad]; that at rest for a hinge that gives way.

    Theory: equation ``pitch-law``.
    """
    hinge = wingbeat.pitch_hinge
    if hinge is not None and hinge.moves_root:
        return _hinge_angle(wingbeat, phase) * (1.0 - _twist_share(hinge))
    at = stroke_phase(wingbeat, phase)
    turn = 2 * math.pi * at
    if not at_default(wingbeat, "pitch_phase"):
        turn = turn + wingbeat.pitch_phase
    base = wingbeat.pitch_mean - wingbeat.pitch_amplitude * sin(turn)
    return with_harmonics(base, wingbeat.pitch_harmonics, FIRST_ORDER["pitch"], at)


def span_ratio(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return the span divided by the full span. Theory: equation ``span-law``."""
    at = stroke_phase(wingbeat, phase)
    base = 1.0 - wingbeat.span_retraction * recovery(at)
    return with_harmonics(base, wingbeat.span_harmonics, FIRST_ORDER["span"], at)


def fold_angle(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return the angle of the hand below the arm [rad]. Theory: equation ``fold-law``."""
    return wingbeat.fold_amplitude * recovery(stroke_phase(wingbeat, phase))


def sweep_angle(wingbeat: Wingbeat, phase: Phases) -> Phases | None:
    """Return the angle by which the span points ahead of the stroke plane [rad], None for a wing without sweep.

    Theory: equation ``sweep-law``.
    """
    still = at_default(wingbeat, "sweep_mean") and at_default(wingbeat, "sweep_amplitude")
    if still and not wingbeat.sweep_harmonics:
        return None
    at = stroke_phase(wingbeat, phase)
    base = wingbeat.sweep_mean + wingbeat.sweep_amplitude * sin(2 * math.pi * at + wingbeat.sweep_phase)
    return with_harmonics(base, wingbeat.sweep_harmonics, FIRST_ORDER["sweep"], at)


def chord_ratio(wingbeat: Wingbeat, phase: Phases) -> Phases | None:
    """Return the chord that meets the air divided by the full chord, None if it is always the full chord.

    Theory: equation ``chord-law``.
    """
    if at_default(wingbeat, "chord_retraction") and not wingbeat.chord_harmonics:
        return None
    at = stroke_phase(wingbeat, phase)
    base = 1.0 - wingbeat.chord_retraction * recovery(at)
    return with_harmonics(base, wingbeat.chord_harmonics, FIRST_ORDER["chord"], at)


def tip_twist(wingbeat: Wingbeat, phase: Phases) -> Phases | None:
    """Return the angle that the twist law adds to the pitch at the tip [rad], None if the law is off.

    The whole pitch at the tip is this angle plus ``twist_ratio`` times the pitch at the root. At a span fraction
    s/L, the law adds s/L of the angle. Theory: equation ``twist-law``.
    """
    hinge = wingbeat.pitch_hinge
    given = None
    if hinge is not None and _twist_share(hinge):
        given = _twist_share(hinge) * _hinge_angle(wingbeat, phase)
    if at_default(wingbeat, "twist_mean") and not wingbeat.twist_harmonics:
        return given
    at = stroke_phase(wingbeat, phase)
    base = wingbeat.twist_mean + jnp.zeros_like(at)
    law = with_harmonics(base, wingbeat.twist_harmonics, FIRST_ORDER["twist"], at)
    return law if given is None else law + given


def _twist_share(hinge: PitchHinge | HeldHinge) -> float:
    return hinge.hinge.twist_share if isinstance(hinge, HeldHinge) else hinge.twist_share


def _hinge_angle(wingbeat: Wingbeat, phase: Phases) -> Phases:
    hinge: Any = wingbeat.pitch_hinge
    if isinstance(hinge, HeldHinge):
        return hinge.at(phase, wingbeat.frequency)
    assert hinge is not None
    return hinge.rest_angle + jnp.zeros_like(phase)


def at_rest(wingbeat: Wingbeat, phase: Phases) -> Wingbeat:
    """Return the wingbeat with its hinge held at its rest angle; a prescribed one as it is."""
    hinge = wingbeat.pitch_hinge
    if hinge is None:
        return wingbeat
    still = jnp.zeros_like(phase)
    return held_at(wingbeat, phase, hinge.rest_angle + still, still, still)


def held_at(wingbeat: Wingbeat, phase: Phases, angle: Phases, rate: Phases, acceleration: Phases) -> Wingbeat:
    """Return the wingbeat with its hinge moving so at a phase: near it, its laws hold for every function of phase.

    Their values and first two derivatives there are those of the flight.
    """
    assert isinstance(wingbeat.pitch_hinge, PitchHinge)
    held = HeldHinge(phase, angle, rate, acceleration, wingbeat.pitch_hinge)
    return unchecked(Wingbeat, vars(wingbeat) | {"pitch_hinge": held})


# The laws of a wing, by the names of their series; a law that is off may be None.
LAWS = {
    **{"flap": flap_angle, "wing_pitch": pitch_angle, "sweep": sweep_angle, "span_ratio": span_ratio},
    **{"fold": fold_angle, "tip_twist": tip_twist, "chord_ratio": chord_ratio},
}


def in_use(wingbeat: Wingbeat, name: str) -> bool:
    """Return whether a parameter is in use: a harmonic that is given, or a parameter of a law that is on."""
    harmonic, hinge = harmonic_place(name), wingbeat.pitch_hinge
    if name in HINGE_NAMES:
        return hinge is not None
    if name in PITCH_LAW and hinge is not None and hinge.moves_root:
        return False
    if harmonic is not None:
        return harmonic[1] < len(getattr(wingbeat, harmonic[0]))
    return name not in _OPTIONAL or not at_default(wingbeat, name)


def parameter(wingbeat: Wingbeat, name: str) -> Scalar:
    """Return one number of a wingbeat by its name; a harmonic that is not given is 0.

    >>> parameter(Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3, flap_harmonics=(0.0, 0.05)), "flap_sin_2")
    0.05
    """
    harmonic = harmonic_place(name)
    if name in HINGE_NAMES:
        return 0.0 if wingbeat.pitch_hinge is None else getattr(wingbeat.pitch_hinge, HINGE_NAMES[name])
    if harmonic is None:
        return getattr(wingbeat, name)
    pairs = getattr(wingbeat, harmonic[0])
    return pairs[harmonic[1]] if harmonic[1] < len(pairs) else 0.0


def _fields(wingbeat: Wingbeat, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields that change if these parameters take these values."""
    fields: dict[str, Any] = {}
    for name, value in values.items():
        harmonic = harmonic_place(name)
        if name in HINGE_NAMES:
            hinge = fields.get("pitch_hinge", wingbeat.pitch_hinge)
            fields["pitch_hinge"] = unchecked(PitchHinge, vars(hinge) | {HINGE_NAMES[name]: value})
            continue
        if harmonic is None:
            fields[name] = value
            continue
        field, place = harmonic
        pairs = list(fields.get(field, getattr(wingbeat, field)))
        pairs += [0.0] * (2 * (place // 2 + 1) - len(pairs))
        pairs[place] = value
        fields[field] = tuple(pairs)
    return fields


def with_parameters(wingbeat: Wingbeat, values: Mapping[str, Any]) -> Wingbeat:
    """Return the wingbeat with some of its numbers changed.

    >>> with_parameters(Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3), {"pitch_cos_2": 0.1}).pitch_harmonics
    (0.1, 0.0)
    """
    if wingbeat.pitch_hinge is None and (names := [name for name in values if name in HINGE_NAMES]):
        faults = FaultList()
        fix = "give the wingbeat a pitch_hinge"
        faults.add(f"wingbeat.{names[0]}", values[names[0]], "is a number of a pitch hinge, and there is none", fix)
        faults.raise_if_any()
    fields = _fields(wingbeat, values)
    if isinstance(hinge := fields.get("pitch_hinge"), PitchHinge):
        fields["pitch_hinge"] = PitchHinge(**vars(hinge))  # checked
    return dataclasses.replace(wingbeat, **fields)


def unpack(free: tuple[str, ...], wingbeat: Wingbeat, values: Parameters) -> Wingbeat:
    """Return the wingbeat with its free parameters replaced by `values`, in the order of `free`."""
    replaced = _fields(wingbeat, {name: values[i] for i, name in enumerate(free)})
    return unchecked(Wingbeat, vars(wingbeat) | replaced)
