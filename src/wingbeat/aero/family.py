"""Coefficients that depend on the Reynolds number: a family of polars becomes one model.

Between the polars, C_L, x_cp and the logarithm of C_D are quintics in the logarithm of Re. At each polar they have
its values, no curvature and the slope between its two neighbours. So C_D is positive, second derivatives are
continuous, and laws such as Re^-1/2 are exact, except within 5 per cent of both ends, where the model goes over to
the constant beyond. Of eight polars of XFOIL (NACA 0012 and 4412, Re 2e4 to 4e5) each was left out in turn: the
others give C_L within 0.053 and 0.054 (root mean square up to 9 degrees) and C_D within 5 and 12 per cent.
Straight lines give 0.057, 0.060, 5 and 13; not-a-knot splines 0.059, 0.067, 5 and 20.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import horner, jnp
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel
from wingbeat.aero.derived_kernels import ArmHandKernel, UpstrokeKernel
from wingbeat.aero.table import TableCoefficients

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, FamilyBasis, FamilyEnds, FamilyNodes, FamilyWeights, Scalar

# Polars nearer than this ratio are one stream, measured twice.
_CLOSEST = 1.02
# The change to the constant beyond an end takes so much of ln(Re) inside the range, at most half of the last gap.
_END = 0.05


class FamilyAt(NamedTuple):
    """The kernel of a family at given Reynolds numbers: kernels of the members, and weights, shape (n, ...)."""

    members: tuple[Kernel, ...]
    weights: FamilyWeights

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], whose shape is that of the Reynolds numbers."""
        pairs = [kernel.lift_drag(alpha) for kernel in self.members]
        lift = sum(weight * pair[0] for weight, pair in zip(self.weights, pairs, strict=True))
        drag = sum(weight * jnp.log(pair[1]) for weight, pair in zip(self.weights, pairs, strict=True))
        return lift, jnp.exp(drag)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad]; NaN if a member has none."""
        found = [kernel.centre_of_pressure(alpha) for kernel in self.members]
        return sum(weight * one for weight, one in zip(self.weights, found, strict=True))


class FamilyKernel(NamedTuple):
    """The kernel of a family, to be used at Reynolds numbers; a JAX pytree.

    `nodes` are the logarithms of the members' Reynolds numbers, shape (n,), `basis` the quintics of the members'
    weights between them, constant first, shape (6, n-1, n), `ends` the widths of the changes at both ends.
    """

    members: tuple[Kernel, ...]
    nodes: FamilyNodes
    basis: FamilyBasis
    ends: FamilyEnds

    def at(self, reynolds: Angles) -> FamilyAt:
        """Return the kernel at Reynolds numbers of any shape. Theory: equation ``reynolds-family``."""
        nodes, basis = jnp.asarray(self.nodes), jnp.asarray(self.basis)
        low, high = nodes[0], nodes[-1]
        place = jnp.log(jnp.clip(reynolds, jnp.exp(low), jnp.exp(high)))

        def eased(distance: Any, width: Scalar) -> Any:
            part = jnp.clip(distance / width, 0.0, 1.0)
            return jnp.where(
                distance < width, width * part * part * part * horner((6.0, -8.0, 3.0), part), distance
            )

        place = low + eased(place - low, self.ends[0])
        place = high - eased(high - place, self.ends[1])
        piece = sum((place >= node).astype(jnp.int32) for node in nodes[1:-1]) + jnp.zeros_like(place, jnp.int32)
        part = (place - nodes[piece]) / (nodes[piece + 1] - nodes[piece])
        weights = horner(tuple(basis[:, piece]), part[..., None])
        return FamilyAt(self.members, jnp.moveaxis(weights, -1, 0))

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad] in the middle of the range, for where a flight starts from."""
        return self.at(jnp.exp(0.5 * (self.nodes[0] + self.nodes[-1])) + jnp.zeros_like(alpha)).lift_drag(alpha)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad] in the middle of the range."""
        return self.at(jnp.exp(0.5 * (self.nodes[0] + self.nodes[-1])) + jnp.zeros_like(alpha)).centre_of_pressure(
            alpha
        )


def depends_on_reynolds(kernel: Any) -> bool:
    """Return whether a kernel, or a part of it, is that of a family."""
    if isinstance(kernel, ArmHandKernel):
        return depends_on_reynolds(kernel.arm) or depends_on_reynolds(kernel.hand)
    return isinstance(kernel, FamilyKernel) or (
        isinstance(kernel, UpstrokeKernel) and depends_on_reynolds(kernel.kernel)
    )


def at_reynolds(kernel: Any, reynolds: Angles) -> Kernel:
    """Return the kernel at the strips' Reynolds numbers, shape (N, ...); one that does not use them stays."""
    if isinstance(kernel, FamilyKernel):
        return kernel.at(reynolds)
    if isinstance(kernel, ArmHandKernel):
        count = kernel.arm_strips
        arm, hand = at_reynolds(kernel.arm, reynolds[:count]), at_reynolds(kernel.hand, reynolds[count:])
        return ArmHandKernel(arm, hand, count)
    if isinstance(kernel, UpstrokeKernel):
        return UpstrokeKernel(at_reynolds(kernel.kernel, reynolds), kernel.factor)
    return kernel


def family_kernel(reynolds: tuple[float, ...], members: tuple[Kernel, ...]) -> FamilyKernel:
    """Return the kernel of members at these Reynolds numbers. Theory: equation ``reynolds-family``."""
    nodes, count = np.log(reynolds), len(reynolds)
    unit, steps = np.eye(count), np.diff(nodes)
    secants = np.diff(unit, axis=0) / steps[:, None]
    slopes = np.vstack([secants[:1], (unit[2:] - unit[:-2]) / (nodes[2:] - nodes[:-2])[:, None], secants[-1:]])
    # The quintics of a rise by one, and of slopes of one at the begin and at the end, without curvature at both.
    rise, begin, end = (0, 0, 0, 10, -15, 6), (0, 1, 0, -6, 8, -3), (0, 0, 0, -4, 7, -3)
    basis = np.zeros((6, count - 1, count))
    for power in range(6):
        basis[power] = rise[power] * np.diff(unit, axis=0) + steps[:, None] * (
            begin[power] * slopes[:-1] + end[power] * slopes[1:]
        )
    basis[0] += unit[:-1]
    ends = np.minimum(_END, 0.5 * steps[[0, -1]])
    return FamilyKernel(members, *(jnp.asarray(one) for one in (nodes, basis, ends)))


@dataclass(frozen=True)
class FamilyCoefficients(CoefficientModel):
    """Quasi-steady coefficients of a wing strip at its own Reynolds number, from polars at two or more of them.

    The Reynolds number of a strip is its chord times its airspeed over the kinematic viscosity. Outside the range
    of the polars the nearest one holds. `lift` and the other methods of the base class are in the middle of the
    range (geometric mean); `at` gives the model at another Reynolds number.

    Theory: equation ``reynolds-family``.

    Parameters
    ----------
    name : name of the model.
    reynolds : chord Reynolds numbers of the polars, rising by 2 per cent or more, shape (n,).
    members : the polar at each, a `TableCoefficients`, of one extension and one aspect ratio, shape (n,).
    notes : what a reader of the files should know.

    Raises
    ------
    InvalidInputError : fewer than two polars, Reynolds numbers that do not rise, polars that are no tables or that
        do not go together.

    >>> from wingbeat.aero import TableCoefficients
    >>> alpha = np.arange(0.0, 91.0, 5.0)
    >>> thick, thin = (TableCoefficients("plate", alpha, 0 * alpha, 0 * alpha + drag) for drag in (0.04, 0.02))
    >>> plates = FamilyCoefficients("plates", (1e4, 4e4), (thick, thin))
    >>> round(float(plates.at(2e4).drag(0.0)), 4)  # as Re^-1/2
    0.0283
    """

    name: str
    reynolds: tuple[float, ...]
    members: tuple[TableCoefficients, ...]
    notes: tuple[str, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        faults = FaultList()
        where = self.name
        if len(self.members) < 2 or len(self.members) != len(self.reynolds):
            rule = f"are Reynolds numbers of {len(self.members)} polars"
            faults.add(where, list(self.reynolds), rule, "give two polars or more, each with its Reynolds number")
            faults.raise_if_any()
        for i, member in enumerate(self.members):
            if not isinstance(member, TableCoefficients):
                said = getattr(member, "name", type(member).__name__)
                faults.add(f"{where}, members[{i}]", said, "is no polar as a table", "give a TableCoefficients")
        for i, value in enumerate(self.reynolds):
            faults.number(f"{where}, reynolds[{i}]", value, at_least=1, fix="give chord times speed over viscosity")
        faults.raise_if_any()
        for before, after in zip(self.reynolds, self.reynolds[1:], strict=False):
            if after < _CLOSEST * before:
                rule = f"must be above the {before:g} before it by 2 per cent or more"
                faults.add(where, after, rule, "keep one polar of each Reynolds number, in rising order")
        for what in ("extension", "blend_width_deg", "aspect_ratio"):
            values = [getattr(member, what) for member in self.members]
            if len(set(values)) > 1:
                shown = ", ".join(
                    f"{value} at Re {re:.0f}" for value, re in zip(values, self.reynolds, strict=True)
                )
                fix = "give polars that cover the same angles, or complete all by --extension viterna"
                fix = "all polars of a family are of one wing" if what == "aspect_ratio" else fix
                faults.add(where, shown, f"differ in {what}", fix)
        faults.raise_if_any()
        object.__setattr__(self, "reynolds", tuple(float(value) for value in self.reynolds))
        object.__setattr__(self, "members", tuple(self.members))

    @property
    def extension(self) -> str:  # type: ignore[override]
        """How the polars are extended to all angles."""
        return self.members[0].extension

    @property
    def blend_width_deg(self) -> float:  # type: ignore[override]
        """Half width of the blends where pieces meet [deg]."""
        return self.members[0].blend_width_deg

    @property
    def aspect_ratio(self) -> float | None:  # type: ignore[override]
        """Aspect ratio of the wing that was measured."""
        return self.members[0].aspect_ratio

    @property
    def citation(self) -> str:  # type: ignore[override]
        """The files of the polars."""
        return ", ".join(dict.fromkeys(member.citation for member in self.members if member.citation))

    @property
    def reynolds_range(self) -> tuple[float, float]:  # type: ignore[override]
        """Lowest and highest Reynolds number of the polars."""
        return self.reynolds[0], self.reynolds[-1]

    @property
    def alpha_range_deg(self) -> tuple[float, float]:  # type: ignore[override]
        """Lowest and highest angle that all polars have [deg]."""
        ranges = [member.alpha_range_deg for member in self.members]
        return max(low for low, _ in ranges), min(high for _, high in ranges)

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether every polar has a centre of pressure."""
        return all(member.has_centre_of_pressure for member in self.members)

    def kernel(self) -> FamilyKernel:
        """Return the JAX pytree that evaluates this family. Theory: equation ``reynolds-family``."""
        return self.kernel_of(lambda member: member.kernel())

    def kernel_of(self, make: Callable[[CoefficientModel], Kernel]) -> FamilyKernel:
        """Return the kernel of a family of the kernels that `make` returns, such as sectional ones.

        Parameters
        ----------
        make : returns the kernel of a member.
        """
        return family_kernel(self.reynolds, tuple(make(member) for member in self.members))

    def at(self, reynolds: float) -> AtOneReynolds:
        """Return the model at one Reynolds number, the nearest polar outside the range.

        Parameters
        ----------
        reynolds : chord Reynolds number, above 0.

        Raises
        ------
        InvalidInputError : a number that is not positive.
        """
        faults = FaultList()
        faults.number("reynolds", reynolds, above=0, fix="give chord times speed over viscosity")
        faults.raise_if_any()
        return AtOneReynolds(self, float(reynolds))


@dataclass(frozen=True)
class AtOneReynolds(CoefficientModel):
    """A family at one Reynolds number (`FamilyCoefficients.at`)."""

    family: FamilyCoefficients
    reynolds: float

    def __post_init__(self) -> None:
        # What is that of the family; it has no members to make sections of, so its own curve is made sectional.
        for what in (
            "citation",
            "extension",
            "blend_width_deg",
            "reynolds_range",
            "alpha_range_deg",
            "aspect_ratio",
        ):
            object.__setattr__(self, what, getattr(self.family, what))

    @property
    def name(self) -> str:  # type: ignore[override]
        """Name of the family and the Reynolds number."""
        return f"{self.family.name} at Re {self.reynolds:.0f}"

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether every polar has a centre of pressure."""
        return self.family.has_centre_of_pressure

    def kernel(self) -> Kernel:
        """Return the JAX pytree that evaluates the family at this Reynolds number."""
        return _Fixed(self.family.kernel(), jnp.asarray(self.reynolds))


class _Fixed(NamedTuple):
    """The kernel of a family at one Reynolds number for all angles."""

    family: FamilyKernel
    reynolds: Scalar

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape."""
        return self.family.at(self.reynolds + jnp.zeros_like(alpha)).lift_drag(alpha)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], any shape; NaN if there is none."""
        return self.family.at(self.reynolds + jnp.zeros_like(alpha)).centre_of_pressure(alpha)
