"""Whatever the bytes, loading a species ends in a species or in a message, never in a traceback."""

import json
import math
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from tests.helpers.species_texts import check_words
from wingbeat._base import FileError, InvalidInputError
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.numbers import KEYS, LOOKS, SHAPE
from wingbeat.animal.species.reading import parse_setting, template

FIXED = settings(
    derandomize=True,
    deadline=None,
    max_examples=300,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

BARE = ["0", "-1", "1e308", "5e-324", "1e-320", "nan", "inf", "-inf", "1_0", "0x10", "9" * 400, "0b1", "1.0", "0.3"]
ODD = [
    "true",
    '"x"',
    "''",
    "1979-05-27",
    "07:32:00",
    "[]",
    "[[]]",
    "{}",
    "[1, 2]",
    "[1, 2, 3]",
    "[1, 'a']",
    '"\\u0000"',
    '"\\u001b[31m"',
    "'''a\\nb'''",
]
TABLES = [
    "{ value = 1 }",
    "{ value = [0.1, 0.2] }",
    '{ value = 1, unit = "furlong" }',
    "{ value = 1, range = [2, 1] }",
    "{ value = 1, range = [2, 3] }",
    "{ bounds = [1, 2] }",
    "{ bounds = [1, 1], guessed = 3 }",
    "{ value = { value = 1 } }",
]
LEAVES = st.sampled_from(BARE + ODD + TABLES) | st.floats().map(repr) | st.integers().map(str)
PATHS = [spelling for key in (*KEYS, *SHAPE, *LOOKS) for spelling in key.spellings]
PATHS += [f"alternatives.a.{path}" for path in PATHS[:8]] + ["alternatives.a", "alternatives.a.reason"]
PATHS += [path.replace("wingbeat.", "free.") for path in PATHS if path.startswith("wingbeat.")]
PATHS += [
    "path.body_pitch",
    "path.body_pitch_deg",
    "name",
    "vehicle",
    "free",
    "air",
    "colour",
    "vehicle.wing.x",
    "shape",
    "shape.colours",
]


def outcome(path: Path, content: bytes) -> str:
    """Return "loaded" or the message; anything but our own errors passes through."""
    path.write_bytes(content)
    try:
        species = load_species(path)
    except (InvalidInputError, FileError) as error:
        return check_words(str(error))
    plain = json.dumps(species.as_dict(), allow_nan=False)
    assert math.isfinite(species.vehicle.mass)
    for name in species.alternatives:
        species.with_alternative(name)
    assert json.loads(plain)["name"]
    return "loaded"


@FIXED
@given(st.binary(max_size=300))
@example(b"\x00")
@example(b"\xef\xbb\xbf")
@example(b"[" * 200_000)
@example(b"a." * 100_000 + b"a = 1")
@example(b"a = {" + b"b = {" * 3000)
@example(b"[a" + b".a" * 50_000 + b"]")
def test_random_bytes(tmp_path: Path, content: bytes) -> None:
    outcome(tmp_path / "fuzz.toml", content)


@FIXED
@given(st.dictionaries(st.sampled_from(PATHS), LEAVES, max_size=12))
def test_random_toml(tmp_path: Path, leaves: dict[str, str]) -> None:
    outcome(tmp_path / "fuzz.toml", "".join(f"{path} = {leaf}\n" for path, leaf in leaves.items()).encode())


@pytest.mark.slow
@FIXED
@given(st.data())
def test_a_good_file_with_some_values_changed(tmp_path: Path, data: st.DataObject) -> None:
    lines = template().splitlines()
    numbers = [i for i, line in enumerate(lines) if " = " in line and not line.startswith("#")]
    for i in data.draw(st.lists(st.sampled_from(numbers), min_size=1, max_size=4, unique=True)):
        lines[i] = f"{lines[i].split(' = ')[0]} = {data.draw(LEAVES)}"
    outcome(tmp_path / "fuzz.toml", "\n".join(lines).encode())


@FIXED
@given(st.data())
def test_a_good_file_with_some_bytes_changed(tmp_path: Path, data: st.DataObject) -> None:
    content = bytearray(template().encode())
    for _ in range(data.draw(st.integers(1, 5))):
        start = data.draw(st.integers(0, len(content) - 1))
        length = data.draw(st.integers(0, 20))
        content[start : start + length] = data.draw(st.binary(max_size=5))
    outcome(tmp_path / "fuzz.toml", bytes(content))


def test_the_good_file_itself_loads(tmp_path: Path) -> None:
    assert outcome(tmp_path / "good.toml", template().encode()) == "loaded"


@pytest.mark.parametrize("end", ["1e308", "1.7e308", "5e-324"])
@pytest.mark.parametrize("path", ["vehicle.mass", "vehicle.wing.mass", "vehicle.wing.chord", "air.viscosity"])
def test_numbers_at_the_ends_of_the_range(tmp_path: Path, path: str, end: str) -> None:
    section, _, name = path.rpartition(".")
    head, mark, tail = template().partition(f"\n[{section}]\n")
    assert mark
    changed = re.sub(rf"^{name} = .*$", f"{name} = {end}", tail, count=1, flags=re.MULTILINE)
    assert changed != tail
    outcome(tmp_path / "ends.toml", f"{head}{mark}{changed}".encode())


VALUES = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=4) | st.tuples(inner) | st.dictionaries(st.text(), inner, max_size=2),
    max_leaves=6,
)


@pytest.mark.slow
@FIXED
@given(st.dictionaries(st.sampled_from(PATHS) | st.text(max_size=8), VALUES, max_size=5))
def test_random_settings(values: dict[str, Any]) -> None:
    try:
        changed = load_pigeon().with_values(values)
    except InvalidInputError as error:
        check_words(str(error))
    else:
        json.dumps(changed.as_dict(), allow_nan=False)


@FIXED
@given(st.text(max_size=30) | st.tuples(st.sampled_from(PATHS), LEAVES).map("=".join))
def test_random_words_after_set(text: str) -> None:
    try:
        path, _ = parse_setting(text)
        assert path
    except InvalidInputError as error:
        check_words(str(error))


_PIGEON: list[Any] = []


def load_pigeon() -> Any:
    """Load the pigeon once for all examples."""
    if not _PIGEON:
        _PIGEON.append(load_species("pigeon"))
    return _PIGEON[0]
