"""Which air loads: coefficients, strips, and the terms that blade elements add, checked together."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Sequence
from dataclasses import dataclass, fields
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError, suggest
from wingbeat.aero.closed_forms import INFLOWS, UNSTEADY
from wingbeat.aero.coefficient_model import CoefficientModel, check_curve
from wingbeat.aero.derived_kernels import ArmHandKernel, UpstrokeKernel, count_arm_strips, sectional_kernel
from wingbeat.aero.family import FamilyCoefficients
from wingbeat.aero.formula_models import CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.function import FunctionCoefficients
from wingbeat.aero.library import LIBRARY
from wingbeat.aero.model_file import load_model
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat.aero.polar_models import load_table
from wingbeat.aero.wake import WAKES, WakeLag, check_finite_wing, jones_numbers, stall_numbers

if TYPE_CHECKING:
    from wingbeat.aero.coefficient_model import CoefficientModel, Kernel


def coefficients_of(given: Any) -> CoefficientModel:
    """Return the coefficient model for any value that ``aero`` accepts.

    Parameters
    ----------
    given : a coefficient model; a name, a path, or a list of paths of polars at several Reynolds numbers, as for
        `load_coefficients`; or a JAX function of the angle of attack [rad] that returns (C_L, C_D), see
        `FunctionCoefficients`.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown name, a function that `FunctionCoefficients` refuses, a model with negative drag,
        C_D > 5 or C_L beyond 2 pi at some angle, a value of another type.

    >>> coefficients_of("dickinson").name, coefficients_of(LIBRARY["su-fan"]()).name
    ('dickinson', 'su-fan')
    """
    if isinstance(given, str | PathLike | list | tuple):
        return load_coefficients(Path(given) if isinstance(given, PathLike) else given)
    if isinstance(given, type) or any(given is maker for maker in LIBRARY.values()):
        name, rule = getattr(given, "__name__", "?"), "is a class of coefficient models, not a model"
        raise InvalidInputError([Fault("aero.coefficients", name, rule, f"call it: {name}()")])
    if hasattr(given, "kernel"):
        return _possible(given)
    if callable(given):
        return FunctionCoefficients(given)
    fix = "give SuFan(), a name such as su-fan, the path of a model file, or a function alpha -> (C_L, C_D)"
    raise InvalidInputError([Fault("aero.coefficients", given, "is not a coefficient model", fix)])


def load_coefficients(
    name_or_path: str | Path | Sequence[str | Path], extension: str = "mirrored", blend_width_deg: float = 1.0
) -> CoefficientModel:
    """Return a coefficient model by its name in `LIBRARY`, or a table, polar or fit from a file.

    Parameters
    ----------
    name_or_path : "su-fan", "dickinson", ... or the path of a table (.csv), of a polar that another program wrote
        (.pol, .dat, ...), or of a fitted model (.toml); or a list of paths of polars at several Reynolds numbers.
    extension : how the coefficients are extended to all angles, one of `EXTENSIONS`; of a table also "viterna".
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown name, or inputs that the model's constructor refuses.

    >>> load_coefficients("su-fan").name
    'su-fan'
    """
    if isinstance(name_or_path, list | tuple) and len(name_or_path) != 1:
        faults = FaultList()
        for one in name_or_path:
            if str(one) in LIBRARY or str(one).lower().endswith(".toml"):
                faults.add("coefficients", str(one), "is not a polar", "several files must be polars of one wing")
        if not name_or_path:
            faults.add("coefficients", "", "names no file", "give the paths of polars")
        faults.raise_if_any()
        return load_table(list(name_or_path), extension, blend_width_deg)
    name = str(name_or_path if isinstance(name_or_path, str | Path) else name_or_path[0])
    if name.lower().endswith(".toml"):
        return _possible(load_model(name, extension, blend_width_deg))
    if name.lower().endswith(POLAR_SUFFIXES) or (name not in LIBRARY and name and Path(name).is_file()):
        return load_table(name, extension, blend_width_deg)
    if name not in LIBRARY:
        rule, guess = "is not a known coefficient model", suggest(name.lower(), LIBRARY, most=2, otherwise="")
        ends = ", ".join(POLAR_SUFFIXES)
        known = f"The models are {', '.join(LIBRARY)}; a table's path ends in {ends}, a fitted model's in .toml"
        raise InvalidInputError([Fault("coefficients", name, rule, f"{guess} {known}".lstrip())])
    return LIBRARY[name](extension, blend_width_deg)


def load_hand(
    name_or_path: str, extension: str = "mirrored", blend_width_deg: float = 1.0
) -> CoefficientModel | str:
    """Return the coefficient model of a hand, from `load_coefficients`; if "none" is given, return "none"."""
    return name_or_path if name_or_path == "none" else load_coefficients(name_or_path, extension, blend_width_deg)


def _possible(model: CoefficientModel) -> CoefficientModel:
    """Return a model of formulas after a check of its curve at all angles; tables and functions check their own."""
    if isinstance(model, FormulaCoefficients | CamberedCoefficients):
        # Under JAX's transformations a model holds tracers, which have no hash.
        with contextlib.suppress(TypeError):
            if faults := _curve_faults(model):
                raise InvalidInputError(list(faults))
    return model


@functools.lru_cache(maxsize=256)
def _curve_faults(model: FormulaCoefficients | CamberedCoefficients) -> tuple[Fault, ...]:
    """Return what no wing has in the curve of a model of formulas; those of the library are known to be good."""
    if any(model == maker(model.extension, model.blend_width_deg) for maker in LIBRARY.values()):
        return ()
    faults, degrees = FaultList(), np.arange(-180.0, 180.25, 0.5)
    alpha = np.radians(degrees)
    check_curve(faults, "aero.coefficients", model.name, degrees, model.lift(alpha), model.drag(alpha))
    return tuple(faults.faults)


class SpanPart(NamedTuple):
    """A part of the wing with coefficients of its own."""

    name: str  # "wing" for the whole of it, "arm" or "hand"
    coefficients: CoefficientModel
    strips: slice  # those that belong to it


FORCE_POINTS = ("quarter-chord", "centre-of-pressure")
AIRSPEEDS = ("planar", "full")
# What the choices of `BladeElement` may be, for every door that asks for them: words, and limits of numbers.
ELEMENT_WORDS = {"force_point": FORCE_POINTS, "airspeed": AIRSPEEDS, "unsteady": UNSTEADY, "wake": WAKES}
ELEMENT_WORDS |= {"inflow": INFLOWS}
ELEMENT_LIMITS: dict[str, dict[str, Any]] = {
    "induced_factor": {"at_least": 0},
    **{name: {"at_least": 0, "at_most": 1} for name in ("share", "hand_from", "upstroke_factor")},
}


@dataclass(frozen=True)
class BladeElement:
    """Model of the air loads: coefficients, strips, point where the force acts, airspeed, and further terms.

    Parameters
    ----------
    coefficients : a coefficient model such as `SuFan()`, its name, the path of its file, or a function of the angle
        of attack [rad] that returns (C_L, C_D); see `coefficients_of`.
    strips : number of equal strips of one wing.
    force_point : "quarter-chord", as in Su et al., or "centre-of-pressure".
    airspeed : the speed V whose square determines lift and drag. "planar" is the speed across the span; "full" is
        the magnitude of the strip's whole velocity, as in the words of Su et al. Reynolds numbers use the same
        speed.
    unsteady : "thin-aerofoil" adds rotation, added mass and the couples of a thin aerofoil
        (`wingbeat.aero.closed_forms`); "none", as in Su et al., leaves them out.
    wake : "jones-section" adds the lag of the wake of a section, "jones-finite" that of a wing of the vehicle's
        aspect ratio (`wingbeat.aero.wake`); "none" leaves it out. The lag is that of a straight wake, so the
        coefficients must state the aspect ratio of the wing on which they were measured.
    inflow : "momentum" adds the induced flow of wings that carry the weight (`wingbeat.aero.closed_forms`) and uses
        sectional coefficients. Coefficients of a finite wing are converted to sectional ones. "none" leaves the
        induced flow out.
    induced_factor : induced power divided by that of an ideal disc, a ratio; 1.2 after Pennycuick 2008.
    hand : coefficients of the strips outside `hand_from`, given like `coefficients`. Then `coefficients` are those
        of the arm. "none" uses `coefficients` from root to tip.
    hand_from : span fraction where the hand begins. A strip whose centre lies at or inside this fraction belongs to
        the arm.
    upstroke_factor : factor from 0 to 1 that multiplies lift and drag of the coefficients where air meets the wing
        from above. It is below 1 if feathers separate and let air through. In slow flight, the wake of a pigeon
        contains vortices of the downstroke alone (Spedding, Rayner and Pennycuick 1984, doi 10.1242/jeb.111.1.81),
        as a factor near 0 predicts. No source measured a value.
    share : factor from 0 to 1 by which unsteady terms, lag and induced factor are multiplied. Real air has a
        share of 1; orbits at smaller shares show what the terms do (`trace_terms`).

    Raises
    ------
    InvalidInputError : strips not a whole number from 1 to 1000, an unknown force point, airspeed or term, a
        negative induced factor, a share outside 0 to 1 or one that no term uses, a centre of pressure with a model
        that has none, inflow or a lag with a model without an aspect ratio, a `hand_from` outside 0 to 1 or without
        a hand, an upstroke factor outside 0 to 1; inputs that `coefficients_of` refuses.
    FileError : the file of a model is missing or cannot be read.

    >>> from wingbeat.aero import SuFan
    >>> BladeElement(SuFan(), airspeed="full").airspeed
    'full'
    """

    coefficients: Any
    strips: int = 10
    force_point: str = "quarter-chord"
    airspeed: str = "planar"
    unsteady: str = "none"
    wake: str = "none"
    inflow: str = "none"
    induced_factor: float = 1.2
    hand: Any = "none"
    hand_from: float = 0.5
    upstroke_factor: float = 1.0
    share: float = 1.0

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("coefficients",) if self.hand == "none" else ("coefficients", "hand"):
            try:
                object.__setattr__(self, name, coefficients_of(getattr(self, name)))
            except InvalidInputError as error:
                faults.faults.extend(error.faults)

        def check_number(name: str, fix: str) -> None:
            faults.number(f"aero.{name}", getattr(self, name), **ELEMENT_LIMITS[name], fix=fix)

        faults.whole("aero.strips", self.strips, 1, 1000, "Su et al. use 10")
        for name, words in ELEMENT_WORDS.items():
            faults.choice(f"aero.{name}", getattr(self, name), words)
        check_number("induced_factor", fix="1 is an ideal disc")
        check_number("share", fix="1 applies each term in full")
        if self.share != 1 and self.unsteady == self.wake == self.inflow == "none":
            rule = "has no effect without unsteady terms, wake or inflow"
            faults.add("aero.share", self.share, rule, "set unsteady, wake or inflow, or leave share out")
        check_number("hand_from", fix="a fraction of the span")
        if self.hand == "none" and self.hand_from != type(self).hand_from:
            rule = "has no effect without a hand"
            faults.add("aero.hand_from", self.hand_from, rule, "set hand to the coefficients of the hand")
        check_number("upstroke_factor", fix="1 is off")
        faults.raise_if_any()
        for _, coefficients, _ in self.parts:
            if self.inflow != "none":
                sectional_kernel(coefficients)  # refuses a model that it cannot make sectional
            if self.wake != "none" and coefficients.aspect_ratio is None:
                rule = "needs a polar that was measured in straight flow and states its aspect ratio"
                rule += f"; {coefficients.name} states none"
                fix = (
                    "leave the wake out: a revolving wing keeps its leading-edge vortex and sheds no straight wake"
                )
                faults.add("aero.wake", self.wake, rule, fix)
            if self.wake != "none" and isinstance(coefficients, FamilyCoefficients):
                rule = f"needs one polar, and {coefficients.name} depends on the Reynolds number"
                faults.add("aero.wake", self.wake, rule, "give the polar of one Reynolds number")
            if self.force_point == "centre-of-pressure" and not coefficients.has_centre_of_pressure:
                rule = f"needs a centre of pressure, and {coefficients.name} has none"
                fix = "use quarter-chord, or a model that has one"
                faults.add("aero.force_point", self.force_point, rule, fix)
        faults.raise_if_any()

    @property
    def parts(self) -> tuple[SpanPart, ...]:
        """The parts of the wing from root to tip that have coefficients of their own."""
        if self.hand == "none":
            return (SpanPart("wing", self.coefficients, slice(0, self.strips)),)
        inner = count_arm_strips(self.strips, self.hand_from)
        return (
            SpanPart("arm", self.coefficients, slice(0, inner)),
            SpanPart("hand", self.hand, slice(inner, self.strips)),
        )

    def kernel(self) -> Kernel:
        """Return the kernel of the strips' coefficients; with inflow, these are sectional coefficients."""
        arm, *hand = (self._kernel_of(part) for part in self.parts)
        whole = ArmHandKernel(arm, hand[0], self.parts[0].strips.stop) if hand else arm
        return self._in_upstroke(whole)

    def _kernel_of(self, part: SpanPart) -> Kernel:
        return part.coefficients.kernel() if self.inflow == "none" else sectional_kernel(part.coefficients)

    def _in_upstroke(self, kernel: Kernel) -> Kernel:
        return kernel if self.upstroke_factor == 1 else UpstrokeKernel(kernel, self.upstroke_factor)

    def wake_lag(self, aspect_ratio: float) -> WakeLag | None:
        """Return the numbers of the lag of the wake for wings of an aspect ratio; None without it.

        Parameters
        ----------
        aspect_ratio : of both wings together, a ratio.

        Raises
        ------
        InvalidInputError : an aspect ratio at which the lag of a finite wing is not known.
        """
        if self.wake == "none":
            return None
        faults = FaultList()
        check_finite_wing(faults, self.wake, aspect_ratio)
        faults.raise_if_any()
        shares, rates = jones_numbers(self.wake, aspect_ratio)
        stall, per_lift = self.stall_numbers()
        if self.hand == "none":
            stall, per_lift = stall[:, 0], per_lift[:, 0]
        return WakeLag(self.share * np.array(shares), np.array(rates), stall, per_lift)

    def stall_numbers(self) -> np.ndarray:
        """Return for each strip what `wingbeat.aero.wake.stall_numbers` does, shape (2, 2, strips)."""
        found = [np.array(stall_numbers(self._in_upstroke(self._kernel_of(part)))) for part in self.parts]
        counts = [part.strips.stop - part.strips.start for part in self.parts]
        return np.repeat(np.stack(found, axis=-1), counts, axis=-1)


# The choices of the air loads besides the coefficients, in the order of the constructor; `share` is for studies of
# single terms and no choice of a user's.
OF_ELEMENTS = tuple(field.name for field in fields(BladeElement) if field.name not in ("coefficients", "share"))


def blade_element_of(aero: Any, force_point: str = "quarter-chord") -> BladeElement:
    """Return the model of the air loads for ``aero``: a `BladeElement`, or what `coefficients_of` takes.

    `force_point` is that of coefficients, which say none.
    """
    return aero if isinstance(aero, BladeElement) else BladeElement(aero, force_point=force_point)
