"""Stored programs: the plain function's answers, whether bound, traced around, or read back from a spoilt file."""

import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

from wingbeat._jax import config
from wingbeat._jax import exported as exporting
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.config import kept_program, program_folder
from wingbeat._jax.exported import exported, jit_soon


@exported(static=("power",))
def weighted(numbers, weight, *, power):
    """Return a sum of powers, and the numbers themselves, weighted."""
    return {"total": weight * jnp.sum(numbers["a"] ** power + numbers["b"]), "rows": weight * numbers["a"]}


NUMBERS = {"a": np.arange(6.0).reshape(2, 3), "b": 2.0}


def expected(weight, power):
    return weight * np.sum(NUMBERS["a"] ** power + 2.0), weight * NUMBERS["a"]


def agrees(found, weight, power):
    total, rows = expected(weight, power)
    np.testing.assert_allclose(found["total"], total, rtol=1e-15)
    np.testing.assert_allclose(found["rows"], rows, rtol=1e-15)
    assert np.shape(found["rows"]) == (2, 3)


def test_called_and_bound_it_is_the_function():
    agrees(weighted(NUMBERS, 3.0, power=2), 3.0, 2)
    agrees(weighted(NUMBERS, 3.0, power=3), 3.0, 3)
    bound = weighted.bind(NUMBERS, power=2)
    for weight in (3.0, np.float64(0.5), np.array(-1.0), 2):
        agrees(bound(weight), weight, 2)


def test_arguments_by_name_are_those_in_their_places():
    @exported(static=("power",))
    def scaled(numbers, weight=1.0, shift=0.0, *, power=1):
        return weight * numbers**power + shift

    assert float(scaled(2.0, shift=1.0, power=3)) == 9.0
    assert float(scaled(numbers=2.0, weight=4.0)) == 8.0
    assert float(scaled(2.0)) == 2.0
    with pytest.raises(TypeError, match="wight"):
        scaled(2.0, wight=4.0)


def test_results_are_numbers_even_where_someone_traces_around_them():
    @jax.jit
    def around(x):
        held = weighted(NUMBERS, 2.0, power=2)
        assert isinstance(held["rows"], np.ndarray)
        return x * held["total"]

    assert float(around(1.0)) == pytest.approx(expected(2.0, 2)[0])


def test_traced_arguments_are_traced_through():
    slope = jax.grad(lambda w: weighted(NUMBERS, w, power=2)["total"])(1.5)
    assert float(slope) == pytest.approx(expected(1.0, 2)[0])


def test_a_spoilt_file_is_traced_anew(monkeypatch, tmp_path):
    monkeypatch.setenv("WINGBEAT_CACHE", str(tmp_path))

    def twice(x):
        return 2.0 * x

    assert float(exported(twice)(4.0)) == 8.0
    folder = program_folder()
    assert folder is not None
    assert folder.parent == tmp_path
    (file,) = folder.glob("traced-*")
    whole = file.read_bytes()
    for spoilt in (b"", whole[: len(whole) // 2], b"nonsense"):
        file.write_bytes(spoilt)
        assert float(exported(twice)(4.0)) == 8.0
        kept = kept_program(file.name)
        assert kept is not None
        assert len(pickle.loads(kept)) == 3
    read = []
    monkeypatch.setattr(exporting.jax.export, "export", lambda *_: read.append("traced"))
    assert float(exported(twice)(4.0)) == 8.0
    assert read == []


def test_an_option_that_xla_does_not_know_changes_nothing(monkeypatch, tmp_path):
    monkeypatch.setenv("WINGBEAT_CACHE", str(tmp_path))
    monkeypatch.setattr(exporting, "_SOON_ON_CPU", {"xla_cpu_no_such_option": True})

    def thrice(x):
        return 3.0 * x

    assert float(exported(thrice)(4.0)) == 12.0


@pytest.mark.parametrize("options", [exporting._SOON_ON_CPU, {"xla_cpu_no_such_option": True}])
def test_what_is_compiled_soon_is_the_function_inside_transformations_too(monkeypatch, options):
    monkeypatch.setattr(exporting, "_SOON_ON_CPU", options)

    def power(exponent, x):
        return x**exponent

    cube = jit_soon(power, static_argnums=0)
    assert float(cube(3, 2.0)) == float(cube(3, np.float64(2.0))) == 8.0
    assert float(jax.grad(lambda x: cube(3, x))(2.0)) == 12.0
    assert jax.vmap(lambda x: cube(2, x))(jnp.arange(3.0)).tolist() == [0.0, 1.0, 4.0]
    assert float(jax.jit(lambda x: x + cube(3, 2.0))(1.0)) == 9.0


@pytest.mark.parametrize(
    ("mine", "kept"),
    [
        ("", "small_while_loop"),
        ("--xla_cpu_enable_fast_math=false", "--xla_cpu_enable_fast_math=false"),
        ("--xla_backend_extra_options=xla_cpu_x", "--xla_backend_extra_options=xla_cpu_x"),
    ],
)
def test_flags_of_the_users_own_are_kept(monkeypatch, mine, kept):
    monkeypatch.setenv("XLA_FLAGS", mine)
    config._configure()
    assert kept in os.environ["XLA_FLAGS"]
    assert os.environ["XLA_FLAGS"].count("xla_backend_extra_options") == 1


def test_flags_are_set_as_jax_is_first_met():
    code = "import wingbeat._jax.config, os; print(os.environ['XLA_FLAGS'])"
    environment = os.environ | {"XLA_FLAGS": "--xla_cpu_enable_fast_math=false"}
    found = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert found.stdout.startswith("--xla_cpu_enable_fast_math=false --xla_backend_extra_options=")
    assert "small_while_loop" in found.stdout
