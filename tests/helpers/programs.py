"""Programs of the tests' own, compiled as most of the package's are."""

from wingbeat._jax.arrays import jax
from wingbeat._jax.exported import _SOON_ON_CPU


def compiled(function, **options):
    """Return a function as `jax.jit` does with these options, compiled in two thirds of the time.

    What differs between calls should be an argument: a program in which a vehicle's numbers are constants is
    compiled again for the next vehicle. Inside another program call the function's `__wrapped__`.
    """
    return jax.jit(function, compiler_options=dict(_SOON_ON_CPU), **options)
