"""The interface of every coefficient model, arrays of angles in, coefficients out, and what no wing can have."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._jax.arrays import in_own_settings, jax

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles

# What a wing can have. Sections with slotted flaps reach a lift coefficient of about 4.5, and a plate across the
# flow has a drag coefficient of about 2. The centre of pressure is in chords from the leading edge.
MAX_LIFT, MAX_DRAG, CENTRE_RANGE = 5.0, 5.0, (-1.0, 2.0)

# The thin aerofoil in an ideal fluid has a lift coefficient of 2 pi sin(alpha) at most. Formulas and functions may
# state it, and a drag of 0; tables, which are measurements, may not.
IDEAL_LIFT = 2 * math.pi
_ROUNDING = 1e-9
# The centre of pressure comes from the moment where the normal force coefficient is at least this.
_LEAST_NORMAL = 0.1
# How far a model is to be trusted, and what its name then says.
GRADES = {"A": "", "B": ", cited second-hand", "C": ", in part a guess"}


class Kernel(Protocol):
    """The kernel of a coefficient model: a JAX pytree that gives coefficients at angles in [-pi, pi]."""

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape."""
        ...

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], any shape, in chords from the leading edge; NaN if there is none."""
        ...


@jax.jit
def _lift_drag(kernel: Kernel, alpha: Angles) -> tuple[Angles, Angles]:
    return kernel.lift_drag(alpha)


@jax.jit
def _centre_of_pressure(kernel: Kernel, alpha: Angles) -> Angles:
    return kernel.centre_of_pressure(alpha)


def check_aspect_ratio(faults: FaultList, where: str, given: Any) -> None:
    """Note a fault unless an aspect ratio is a positive number, infinite, or None."""
    if given is not None and given != math.inf:
        faults.number(where, given, above=0, fix="give span over mean chord, inf for a section, or none if unknown")


def check_about(faults: FaultList, model: CoefficientModel, grade: str) -> None:
    """Note faults of what a model of formulas states about itself."""
    check_aspect_ratio(faults, "aspect_ratio", model.aspect_ratio)
    faults.choice("grade", grade, tuple(GRADES))
    if model.reynolds_range is not None:
        check_range(faults, "reynolds_range", model.reynolds_range)


def check_range(faults: FaultList, where: str, limits: Any) -> None:
    """Note a fault unless `limits` are two numbers that do not decrease."""
    if not isinstance(limits, tuple) or len(limits) != 2:
        faults.add(where, limits, "must be a pair", "give (lowest, highest)")
    elif all([faults.number(f"{where}[{i}]", limit) for i, limit in enumerate(limits)]) and limits[0] > limits[1]:
        faults.add(where, limits, "must not decrease", "give (lowest, highest)")


def check_possible(faults: FaultList, quantity: str, values: Sequence[float], where: Callable[[int], str]) -> None:
    """Note one fault, at the worst row, if a column holds finite coefficients that no wing has."""
    name = quantity.lower()
    limits = {"c_l": (-MAX_LIFT, MAX_LIFT), "c_d": (0.0, MAX_DRAG), "x_cp": CENTRE_RANGE}
    if name not in limits:
        return
    low, high = limits[name]
    given = [(value, i) for i, value in enumerate(values) if math.isfinite(value)]
    bad = [(v, i) for v, i in given if not low <= v <= high or (name == "c_d" and v == 0)]
    if not bad:
        return
    worst, row = max(bad, key=lambda pair: max(low - pair[0], pair[0] - high))
    usual = sorted(abs(value) for value, _ in given)[len(given) // 2]
    if name == "x_cp":
        rule = f"must lie between {low:g} and {high:g} chords from the leading edge"
        fix = "where the force is nearly zero it has no centre: give a value from a neighbouring row"
        fix = "the column looks like per cent of the chord: divide it by 100" if usual > high else fix
    elif name == "c_d" and worst <= 0:
        rule = "must be > 0: every wing has drag, and drag is measured against the motion"
        reversed_ = all(value <= 0 for value, _ in given)
        fix = "reverse its sign" if reversed_ and worst < 0 else "check the zero of the balance, or drop the row"
    else:
        rule = f"must lie between {low:g} and {high:g}: no wing has more"
        counts = name == "c_d" and usual > 2 * high
        fix = "give it without a unit; per cent divided by 100 are coefficients"
        fix = "the column looks like drag counts: divide it by 10000" if counts else fix
    faults.add(where(row), worst, rule + (f" ({len(bad)} of {len(values)} rows)" if len(bad) > 1 else ""), fix)


def centre_from_moment(
    alpha_deg: NDArray[np.float64],
    lift: NDArray[np.float64],
    drag: NDArray[np.float64],
    moment: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return x_cp from the moment coefficient about mid-chord; NaN where the normal force is too small for it."""
    turn = np.radians(alpha_deg)
    normal = lift * np.cos(turn) + drag * np.sin(turn)
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = 0.5 - moment / normal
    low, high = CENTRE_RANGE
    return np.where((np.abs(normal) >= _LEAST_NORMAL) & (low <= centre) & (centre <= high), centre, np.nan)


def check_curve(faults: FaultList, where: str, name: str, degrees: Angles, lift: Angles, drag: Angles) -> None:
    """Note lift that not even an ideal fluid gives, and drag that is negative or more than any wing has."""
    for label, values, low, high in (("C_L", lift, -IDEAL_LIFT, IDEAL_LIFT), ("C_D", drag, 0.0, MAX_DRAG)):
        over = np.maximum(np.asarray(values) - high, low - np.asarray(values))
        worst = int(np.nanargmax(over))
        if over[worst] > _ROUNDING:
            negative = label == "C_D" and values[worst] < 0
            rule = f"has a {label} of {float(values[worst]):.3g} at {degrees[worst]:g} degrees, which "
            rule += "would drive the wing forward: drag is never negative" if negative else "no wing has"
            faults.add(
                where, name, rule, f"{label} must lie between {low:.3g} and {high:.3g} at all angles of attack"
            )


def is_whole_turn(angles: Sequence[float]) -> bool:
    """Return whether a table runs from -180 to 180 degrees."""
    return angles[0] == -180 and angles[-1] == 180


def wrapped(alpha: ArrayLike) -> NDArray[np.float64]:
    """Return angles [rad] brought to [-pi, pi], as an exactly odd function of `alpha`; infinite angles become NaN.

    >>> wrapped([0.5, 1.0 + 2 * math.pi, -math.pi]).tolist()
    [0.5, 1.0, -3.141592653589793]
    """
    try:
        angles = np.asarray(alpha, dtype=np.float64)
    except (TypeError, ValueError) as error:
        rule, fix = "must be a number or an array of numbers [rad]", "under JAX's jit, use kernel()"
        raise InvalidInputError([Fault("alpha", alpha, rule, fix)]) from error
    with np.errstate(invalid="ignore"):
        remainder = np.fmod(angles, 2 * math.pi)
    return remainder - 2 * math.pi * np.round(remainder / (2 * math.pi))


@in_own_settings
def at_angles(function: Any, numbers: Any, angles: NDArray[np.float64]) -> Any:
    """Return the values of a compiled function of `numbers` and angles of any shape, as NumPy arrays."""
    # Padded to a power of two: XLA compiles anew for each length it has not met.
    padded = np.zeros(1 << max(angles.size - 1, 0).bit_length())
    padded[: angles.size] = angles.ravel()
    result = function(numbers, padded)
    return jax.tree.map(lambda leaf: np.array(leaf)[: angles.size].reshape(angles.shape)[()], result)


def kernel_lift(kernel: Kernel, alpha: ArrayLike) -> NDArray[np.float64]:
    """Return C_L of a kernel at angles of attack."""
    return at_angles(_lift_drag, kernel, wrapped(alpha))[0]


class CoefficientModel:
    """Lift, drag and centre of pressure of a wing strip as functions of the angle of attack alone.

    Angles are in radians, of any shape and any size; values come back as float64 of that shape. Inside JAX use
    `kernel`, a pytree whose ``lift_drag(alpha)`` and ``centre_of_pressure(alpha)`` take angles in
    [-pi, pi] and whose leaves are the model's numbers.

    Attributes
    ----------
    name : name of the model.
    citation : its source.
    extension : how it is extended to all angles, one of `EXTENSIONS`.
    blend_width_deg : half width of the blends where pieces meet [deg].
    reynolds_range : chord Reynolds numbers of the measurements, or None.
    alpha_range_deg : lowest and highest angle of the measurements [deg].
    aspect_ratio : span over mean chord of the measured wing; infinite for coefficients of a section. None if no
        source states it. None also for a revolving wing, whose induced flow differs from that of a wing in
        translation.
    """

    name: str
    citation: str
    extension: str
    blend_width_deg: float
    reynolds_range: tuple[float, float] | None
    alpha_range_deg: tuple[float, float]
    aspect_ratio: float | None

    def __str__(self) -> str:
        return f"{self.name} ({self.citation or 'no source given'}{GRADES[getattr(self, 'grade', 'A')]})"

    @property
    def used_range_deg(self) -> tuple[float, float]:
        """Lowest and highest angle [deg] where the measured coefficients are used; beyond, the extension applies.

        The extension begins at 90 degrees even if the measurements went further, because a plate seen from behind
        must be the same plate.
        """
        low, high = self.alpha_range_deg
        if low <= -180 and high >= 180:
            return low, high
        return max(low, -90.0 if self.extension == "signed" else 0.0), min(high, 90.0)

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether the model has a centre of pressure."""
        return False

    def kernel(self) -> Kernel:
        """Return the JAX pytree that evaluates this model."""
        raise NotImplementedError

    def lift(self, alpha: ArrayLike) -> NDArray[np.float64]:
        """Return the lift coefficient C_L at `alpha` [rad].

        Parameters
        ----------
        alpha : angle of attack [rad], any shape.

        Raises
        ------
        InvalidInputError : angles that are not numbers.
        """
        return kernel_lift(self.kernel(), alpha)

    def drag(self, alpha: ArrayLike) -> NDArray[np.float64]:
        """Return the drag coefficient C_D at `alpha` [rad].

        Parameters
        ----------
        alpha : angle of attack [rad], any shape.

        Raises
        ------
        InvalidInputError : angles that are not numbers.
        """
        return at_angles(_lift_drag, self.kernel(), wrapped(alpha))[1]

    def normal(self, alpha: ArrayLike) -> NDArray[np.float64]:
        """Return the normal force coefficient ``C_N = C_L cos(alpha) + C_D sin(alpha)`` at `alpha` [rad].

        Theory: equation ``normal-coefficient``.

        Parameters
        ----------
        alpha : angle of attack [rad], any shape.

        Raises
        ------
        InvalidInputError : angles that are not numbers.
        """
        angles = wrapped(alpha)
        lift, drag = at_angles(_lift_drag, self.kernel(), angles)
        return lift * np.cos(angles) + drag * np.sin(angles)

    def centre_of_pressure(self, alpha: ArrayLike) -> NDArray[np.float64]:
        """Return the centre of pressure at `alpha` [rad], in chords from the leading edge.

        Parameters
        ----------
        alpha : angle of attack [rad], any shape.

        Raises
        ------
        InvalidInputError : angles that are not numbers, or a model without a centre of pressure.
        """
        if not self.has_centre_of_pressure:
            fix = "use su-fan, or a table with the column x_cp"
            raise InvalidInputError([Fault("coefficients", self.name, "has no centre of pressure", fix)])
        return at_angles(_centre_of_pressure, self.kernel(), wrapped(alpha))

    def moment(self, alpha: ArrayLike, about: float = 0.5) -> NDArray[np.float64]:
        """Return the moment coefficient ``C_M = C_N (about - x_cp)``, nose-up positive.

        Theory: equation ``moment-coefficient``.

        Parameters
        ----------
        alpha : angle of attack [rad], any shape.
        about : the axis, in chords from the leading edge.

        Raises
        ------
        InvalidInputError : angles that are not numbers, or a model without a centre of pressure.
        """
        return self.normal(alpha) * (about - self.centre_of_pressure(alpha))
