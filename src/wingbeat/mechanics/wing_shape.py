"""The strips of a wing: their constant numbers, and where the wingbeat moves them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from wingbeat._jax.arrays import jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import PerStripBroadcast, Phases, Triple


class Strips(NamedTuple):
    """Numbers of one wing's strips that are constant in time, shape (N,), or (N, 1, ...) to match axes of time.

    Attributes
    ----------
    span_fraction : distance of the strip's centre from the shoulder, divided by the semi-span, 0 to 1.
    chord : [m].
    mass : [kg].
    """

    span_fraction: PerStripBroadcast
    chord: PerStripBroadcast
    mass: PerStripBroadcast


class WingShape(NamedTuple):
    """Where the strips of the left wing are, in stroke axes, arrays of shape (N, ...).

    Flap turns a strip about the first axis. Sweep then turns the strip's span forward, in the plane of that
    axis and the span. Pitch turns the strip about its own span, which runs along the quarter chords.

    Theory: equation ``flap-vectors``.

    Attributes
    ----------
    ahead, left, above : position of the quarter chord relative to the body's centre of mass [m].
    flap_sine, flap_cosine : of the strip's flap angle.
    pitch : pitch of the strip [rad].
    pitch_sine, pitch_cosine : of that pitch.
    sweep_sine, sweep_cosine : of the sweep angle, shape (...); None for a wing without sweep.
    """

    ahead: PerStripBroadcast
    left: PerStripBroadcast
    above: PerStripBroadcast
    flap_sine: PerStripBroadcast
    flap_cosine: PerStripBroadcast
    pitch: PerStripBroadcast
    pitch_sine: PerStripBroadcast
    pitch_cosine: PerStripBroadcast
    sweep_sine: Phases | None = None
    sweep_cosine: Phases | None = None

    @property
    def quarter_chord(self) -> Triple:
        """Position of the quarter chord, forward, left and up [m]."""
        return self.ahead, self.left, self.above

    @property
    def unpitched(self) -> Triple:
        """Unit vector along the chord of the unpitched strip.

        Theory: equation ``strip-axes``.
        """
        if self.sweep_sine is None:
            return 1.0, 0.0, 0.0
        inward = -self.sweep_sine
        return self.sweep_cosine, inward * self.flap_cosine, inward * self.flap_sine

    @property
    def spanwise(self) -> Triple:
        """Unit vector towards the tip.

        Theory: equation ``strip-axes``.
        """
        if self.sweep_sine is None:
            return jnp.zeros_like(self.flap_sine), self.flap_cosine, self.flap_sine
        return self.sweep_sine, self.sweep_cosine * self.flap_cosine, self.sweep_cosine * self.flap_sine

    @property
    def chordwise(self) -> Triple:
        """Unit vector to the leading edge.

        Theory: equation ``strip-axes``.
        """
        if self.sweep_sine is not None:
            return self._pitched(self.pitch_cosine, self.pitch_sine)
        return self.pitch_cosine, -self.pitch_sine * self.flap_sine, self.pitch_sine * self.flap_cosine

    @property
    def normal(self) -> Triple:
        """Unit vector normal to chord and span, up at rest.

        Theory: equation ``strip-axes``.
        """
        if self.sweep_sine is not None:
            return self._pitched(-self.pitch_sine, self.pitch_cosine)
        return -self.pitch_sine, -self.pitch_cosine * self.flap_sine, self.pitch_cosine * self.flap_cosine

    def _pitched(self, along: PerStripBroadcast, across: PerStripBroadcast) -> Triple:
        """Return the vector with these components along the unpitched strip's chord and normal."""
        forward, left, up = self.unpitched
        return along * forward, along * left - across * self.flap_sine, along * up + across * self.flap_cosine
