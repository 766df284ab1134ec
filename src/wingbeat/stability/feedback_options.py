"""Options of feedback from beat to beat: which deviations and changes of the wingbeat count as equally large."""

from __future__ import annotations

import math
from dataclasses import dataclass

from wingbeat._base import SHARES
from wingbeat.animal.kinematics import ANGLES
from wingbeat.orbits.options.checks import check_options
from wingbeat.stability.options import LinearOptions


@dataclass(frozen=True)
class FeedbackOptions:
    """Options of feedback from beat to beat.

    A deviation of the state by its scale costs as much as a change of an input by its unit.

    Parameters
    ----------
    z : scale of the height [m].
    body_pitch : scale [rad].
    u, w : scales of the velocity, forward and up [m/s].
    pitch_rate : scale [rad/s].
    angle : unit of inputs that are angles [rad].
    frequency : unit of the frequency [Hz].
    ratio : unit of inputs that are shares or ratios, such as the twist ratio [-].
    reach : inputs change by at most so many units, if no limits are given [-].
    least_effect : an input reaches a mode if its unit moves the mode by more than this share of a unit [-].
    linear : options of the linearisation.

    >>> import wingbeat as wb
    >>> options = wb.FeedbackOptions(z=0.5)  # pass them on: wb.feedback(orbit, options=options)
    >>> options.z, options.body_pitch
    (0.5, 0.1)
    """

    z: float = 0.2
    body_pitch: float = 0.1
    u: float = 1.0
    w: float = 1.0
    pitch_rate: float = 2.0
    angle: float = math.radians(3.0)
    frequency: float = 0.5
    ratio: float = 0.05
    reach: float = 4.0
    least_effect: float = 1e-6
    linear: LinearOptions = LinearOptions()  # noqa: RUF009, frozen

    def __post_init__(self) -> None:
        check_options(self)

    def scale(self, state: str) -> float:
        """Return the scale of a state [m, rad, m/s, rad/s].

        Parameters
        ----------
        state : its name.
        """
        return getattr(self, state)

    def unit(self, name: str) -> float:
        """Return the unit of an input [Hz, rad or shares].

        Parameters
        ----------
        name : of the input.
        """
        if name == "frequency":
            return self.frequency
        return self.angle if name in ANGLES and not name.startswith(SHARES) else self.ratio


DEFAULTS = FeedbackOptions()
