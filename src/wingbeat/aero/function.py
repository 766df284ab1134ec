"""Coefficients from a user's function: traced once, checked, and identified by what it computes."""

from __future__ import annotations

import hashlib
import math
import pickle
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from jax.extend.core import jaxpr_as_fun

from wingbeat._base import TRACED, Fault, FaultList, InvalidInputError, is_traced
from wingbeat._jax.arrays import in_own_settings, jax, jnp, unchecked
from wingbeat.aero.coefficient_model import CoefficientModel, check_curve

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles


_WHERE = "aero.coefficients"
# A function is checked every half degree, also at 0, +-90 and +-180 degrees.
_SAMPLE_ANGLES = np.radians(np.arange(-180.0, 180.5, 0.5))
_TRACEABLE = "write it with jax.numpy in place of numpy or math, and jnp.where in place of if"
_PAIR = "return (C_L, C_D), each a number for one angle alpha [rad]"


class Program:
    """A user's coefficient function, as JAX traced it. Two are equal if JAX makes the same code of them.

    The `repr` contains a digest of that code. It is part of the name of every stored program that uses the
    function, so two functions of the same name are kept apart.
    """

    def __init__(self, function: Callable[[Any], Any], name: str, traced: Any) -> None:
        self.function = function
        self.name = name
        self._pair = jaxpr_as_fun(traced)
        # The digest includes the derivatives, because a function may have its own rules for them.
        differentiated = jax.jit(lambda a: (self(a), jax.jacfwd(self)(a), jax.jacfwd(jax.jacfwd(self))(a)))
        lowered = differentiated.trace(jax.ShapeDtypeStruct((), jnp.float64)).lower(lowering_platforms=("cpu",))
        self.digest = hashlib.sha256(lowered.as_text().encode()).hexdigest()

    def __call__(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at one angle [rad]."""
        lift, drag = self._pair(jnp.asarray(alpha, jnp.float64))
        return jnp.asarray(lift, jnp.float64), jnp.asarray(drag, jnp.float64)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Program) and other.digest == self.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        return f"Program({self.digest})"

    def __deepcopy__(self, memo: dict[int, Any]) -> Program:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        try:
            pickle.dumps(self.function)
        except Exception:  # each kind of function has its own way to refuse
            rule = "is a function that cannot be pickled and sent to other processes"
            fix = "define it with def at the top level of a module"
            raise InvalidInputError([Fault(_WHERE, self.name, rule, fix)]) from None
        return _unpickled, (self.function, self.name, self.digest)


def _unpickled(function: Callable[[Any], Any], name: str, digest: str) -> Program:
    """Return the program of an unpickled function; pickle stores only the function's name."""
    again = _checked(function, name)
    if again.digest != digest:
        rule = "differs from the function that was pickled under this name"
        raise InvalidInputError([Fault(_WHERE, name, rule, "use the module with which the function was pickled")])
    return again


@jax.tree_util.register_static
@dataclass(frozen=True)
class FunctionKernel:
    """Coefficients of a function at every angle in [-pi, pi], for use under JAX; a pytree without leaves."""

    program: Program

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape."""
        alpha = jnp.asarray(alpha)
        lift, drag = jax.vmap(self.program)(alpha.ravel())
        return lift.reshape(alpha.shape), drag.reshape(alpha.shape)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return not-a-number: a function gives no centre of pressure."""
        return jnp.full_like(alpha, math.nan)


@dataclass(frozen=True)
class FunctionCoefficients(CoefficientModel):
    """Quasi-steady coefficients of a wing strip, from a function of the angle of attack.

    JAX traces the function once, in the constructor. Later changes of variables that it reads have no effect. The
    function is used as it is at every angle from -pi to pi, without extension or blend.

    Parameters
    ----------
    function : JAX-traceable, of one angle alpha in [-pi, pi] [rad]; returns (C_L, C_D).
    name : name of the model, the function's own if not given.

    Attributes
    ----------
    program : the function as it was traced.

    Raises
    ------
    InvalidInputError : a function that JAX cannot trace, that does not return two numbers, whose values or slopes
        are not finite at some angle, or that gives negative drag, C_D > 5 or C_L beyond 2 pi.

    >>> import jax.numpy as jnp
    >>> plate = FunctionCoefficients(lambda a: (1.2 * jnp.sin(2 * a), 1.4 - jnp.cos(2 * a)), "plate")
    >>> round(float(plate.lift(math.radians(45.0))), 3)
    1.2
    """

    function: Callable[[Any], Any] = field(compare=False, repr=False)
    name: str = ""
    program: Program = field(init=False)

    citation = "a function of the user's"
    extension = "as given"
    blend_width_deg = None  # type: ignore[assignment]
    reynolds_range = None
    aspect_ratio = None
    alpha_range_deg = (-180.0, 180.0)

    def __post_init__(self) -> None:
        name = self.name or getattr(self.function, "__name__", type(self.function).__name__)
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "program", _checked(self.function, name))

    def kernel(self) -> FunctionKernel:
        """Return the JAX pytree that evaluates this function."""
        return FunctionKernel(self.program)

    def __reduce__(self) -> tuple[Any, ...]:
        return _of_program, (self.program,)


def _of_program(program: Program) -> FunctionCoefficients:
    fields = {"function": program.function, "name": program.name, "program": program}
    return unchecked(FunctionCoefficients, fields)


@in_own_settings
def _checked(function: Callable[[Any], Any], name: str) -> Program:
    """Return the traced function, or raise `InvalidInputError` that says why it cannot be used."""
    faults = FaultList()
    try:
        traced, shapes = jax.make_jaxpr(function, return_shape=True)(jax.ShapeDtypeStruct((), jnp.float64))
    except Exception as error:  # whatever the function raises
        faults.add(_WHERE, name, f"is not a function that JAX can trace ({_reason(error)})", _TRACEABLE)
        faults.raise_if_any()
        raise
    pair = list(shapes) if isinstance(shapes, tuple | list) else []
    real = [getattr(one, "shape", None) == () and jnp.issubdtype(one.dtype, jnp.number) for one in pair]
    if len(real) != 2 or not all(real) or any(jnp.issubdtype(one.dtype, jnp.complexfloating) for one in pair):
        faults.add(_WHERE, name, "does not return two real numbers for one angle", _PAIR)
        faults.raise_if_any()
    try:
        program = Program(function, name, traced)
    except Exception as error:
        faults.add(_WHERE, name, f"has no derivative in JAX ({_reason(error)})", _TRACEABLE)
        faults.raise_if_any()
        raise
    values, slopes = jax.jit(jax.vmap(lambda a: jax.jvp(program, (a,), (1.0,))))(_SAMPLE_ANGLES)
    if is_traced(values[0]):  # a variable that the function reads
        faults.add(_WHERE, name, *TRACED)
        faults.raise_if_any()
    names = ("C_L", "C_D", "a slope of C_L", "a slope of C_D")
    for what, found in zip(names, (*values, *slopes), strict=True):
        bad = np.flatnonzero(~np.isfinite(found))
        if bad.size:
            angle = math.degrees(_SAMPLE_ANGLES[bad[0]])
            rule = f"has {what} of {float(found[bad[0]])} at {angle:g} degrees"
            faults.add(_WHERE, name, rule, "C_L and C_D must be finite and smooth from -pi to pi radians")
    faults.raise_if_any()
    check_curve(faults, _WHERE, name, np.degrees(_SAMPLE_ANGLES), *values)
    faults.raise_if_any()
    return program


def _reason(error: Exception) -> str:
    first = str(error).strip().split("\n")[0]
    return f"{type(error).__name__}: {first[:120]}"
