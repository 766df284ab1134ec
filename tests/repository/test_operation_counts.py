"""The arithmetic of the programs that searches spend their time in does not grow unseen."""

import importlib.util
import json

import pytest

from tests.helpers.places import ROOT

FILE = ROOT / "benchmarks" / "operations.py"
SPEC = importlib.util.spec_from_file_location("operations", FILE)
operations = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(operations)

# Versions of JAX write some derivatives with a few operations more or less.
SLACK = 1.05


@pytest.fixture(scope="module")
def found():
    return operations.measure()


@pytest.mark.slow
def test_no_program_does_more_than_its_baseline(found):
    baseline = json.loads(operations.BASELINE.read_text())
    assert found.keys() == baseline.keys()
    for name, counts in found.items():
        for key, value in counts.items():
            assert value <= SLACK * baseline[name][key], f"{name}: {key}; write a new baseline if it must be so"


def test_the_count_sees_what_is_added(found):
    jax, jnp = operations.jax, operations.jnp

    def steps(x):
        return jax.lax.scan(lambda a, _: (a + jnp.exp(a), None), x, None, length=7)[0]

    counts = operations.traced(steps, operations.np.ones(3))
    assert counts["operations"] == 2 * 3 * 7
    assert counts["transcendentals"] == 3 * 7
    assert operations.traced(lambda x: operations.np.eye(3) @ x, operations.np.ones(3))["operations"] == 2 * 3 * 3
