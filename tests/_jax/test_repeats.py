"""Traced programs without their repeats: fewer operations, the same numbers."""

import jax.export
import numpy as np

from wingbeat._jax.arrays import cos, jax, jnp, sin
from wingbeat._jax.private import without_repeats

ANGLES = np.linspace(-3, 3, 8)


def traced(function):
    return jax.export.export(jax.jit(function))(jax.ShapeDtypeStruct(ANGLES.shape, jnp.float64))


def calls_of_sine(program):
    return program.mlir_module().count("call @sin")


def test_a_sine_that_is_asked_for_twice_is_called_once():
    program = traced(lambda x: sin(x) * cos(x) + sin(x) / cos(x) + sin(sin(x)) - sin(sin(x)))
    assert calls_of_sine(program) == 8
    lean = without_repeats(program)
    assert calls_of_sine(lean) == 3
    np.testing.assert_array_equal(jax.jit(lean.call)(ANGLES), jax.jit(program.call)(ANGLES))


def test_sines_of_other_angles_and_turned_operands_stay():
    program = traced(lambda x: (sin(x) - sin(2 * x)) / (sin(2 * x) - sin(x)))
    lean = without_repeats(program)
    assert calls_of_sine(lean) == 2
    np.testing.assert_array_equal(jax.jit(lean.call)(ANGLES), -np.ones(8))


def test_a_loop_keeps_its_calls_and_gives_the_same():
    def march(x):
        return jax.lax.fori_loop(0, 5, lambda _, y: y + 0.1 * sin(y) * sin(y), x) + sin(x)

    program = traced(march)
    lean = without_repeats(program)
    assert calls_of_sine(program) == 3
    assert calls_of_sine(lean) == 2
    np.testing.assert_array_equal(jax.jit(lean.call)(ANGLES), jax.jit(program.call)(ANGLES))
