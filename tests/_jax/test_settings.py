"""A host program that changes JAX's settings changes no number, and keeps its own settings."""

import subprocess
import sys
import threading

import jax
import numpy as np
import pytest

import wingbeat as wb
from wingbeat._jax.exported import exported

SETTINGS = [
    ("jax_enable_x64", False),
    ("jax_numpy_rank_promotion", "raise"),
    ("jax_numpy_dtype_promotion", "strict"),
    ("jax_disable_jit", True),
    ("jax_debug_nans", True),
    ("jax_debug_infs", True),
    ("jax_transfer_guard", "disallow"),
]


def plate(alpha):
    return 1.2 * jax.numpy.sin(2 * alpha), 1.4 - jax.numpy.cos(2 * alpha)


def results():
    """Return numbers from a compiled program, one that is compiled now, an eager function and coefficients."""

    @exported(kept=False)
    def traced(values, matrix):
        return [matrix * values + 1, values[0] / 3, 1.0 / (values - values)]

    pigeon, rates = wb.load_species("pigeon"), np.array([10.0, 0.0, 0.1, 2.0, 0.3])
    model = wb.FlightModel(pigeon.vehicle, "su-fan")
    terms = wb.equations_of_motion(model, pigeon.wingbeat, np.zeros(5), rates, 0.01)
    lift = wb.aero.SuFan().lift(np.linspace(-3, 3, 50))
    own = wb.aero.FunctionCoefficients(plate).drag([0.1, 0.5])
    return [*traced(np.array([1.0, 2.0, 3.0]), np.ones((2, 3)) / 7), *jax.tree.leaves(terms), lift, own]


def same(one, other):
    return all(np.array_equal(a, b, equal_nan=True) for a, b in zip(one, other, strict=True))


@pytest.fixture(scope="module")
def undisturbed():
    return results()


@pytest.mark.parametrize(("name", "value"), SETTINGS)
def test_a_setting_of_the_host_changes_no_number(undisturbed, name, value):
    before = getattr(jax.config, name)
    jax.config.update(name, value)
    try:
        found = results()
        assert getattr(jax.config, name) == value
    finally:
        jax.config.update(name, before)
    assert same(found, undisturbed)


def test_settings_of_a_thread_change_no_number(undisturbed):
    found = []

    def work():
        with jax.enable_x64(False), jax.numpy_rank_promotion("raise"), jax.default_device(jax.devices()[-1]):
            found.append(results())
            found.append(jax.numpy.ones(2).dtype)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert same(found[0], undisturbed)
    assert found[1] == "float32"


def test_a_platform_that_is_missing_is_named():
    program = (
        "import jax, wingbeat as wb; jax.config.update('jax_platforms', 'tpu'); wb.aero.SuFan(); "
        "wb.aero.SuFan().lift(0.1)"
    )
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False).stderr
    assert "wingbeat._base.errors.InvalidInputError: jax_platforms = 'tpu': cannot be started: " in told
    assert told.strip().endswith("set JAX_PLATFORMS=cpu")
