"""The files of the built-in species: every number has a source, a unit and a range that contains it."""

import tomllib
from typing import Any

import pytest

import wingbeat as wb
from wingbeat._base import FaultList
from wingbeat.animal.species.file_schema import check_shape
from wingbeat.animal.species.reading import packaged_text, species_names

# Alternatives meant to lie outside the range: what a reader of the paper would assume; a warning says so.
OUTSIDE_ON_PURPOSE = {("pigeon", "uniform-wing"), ("bat", "uniform-wing")}


@pytest.mark.parametrize("name", species_names())
def test_every_number_of_a_built_in_species_has_unit_source_and_range(name: str) -> None:
    raw = _raw(name)
    leaves = _leaves({key: raw[key] for key in ("vehicle", "wingbeat", "air")})
    assert len(leaves) >= 21
    for path, leaf in leaves.items():
        assert set(leaf) == {"value", "unit", "source", "range"}, path
        assert leaf["source"].strip(), path
        assert leaf["unit"].strip(), path
        assert _inside(leaf["value"], leaf["range"]), path
    for path, bound in {**raw["free"], **raw["path"]}.items():
        assert set(bound) == {"bounds", "unit", "guessed", "reason"}, path
        assert bound["reason"].strip(), path
    for path, known in raw["plausible"].items():
        assert known["source"].strip(), path
        assert known["unit"].strip(), path
    warnings = wb.load_species(name).warnings
    assert all(line.startswith(("derived by", "scaling laws used")) for line in warnings)


@pytest.mark.parametrize("name", species_names())
def test_every_number_of_an_alternative_has_unit_source_and_range(name: str) -> None:
    """Where an alternative gives no range, that of the default holds."""
    raw = _raw(name)
    usual = _leaves({key: raw[key] for key in ("vehicle", "wingbeat", "air")})
    for key, other in raw["alternatives"].items():
        for path, leaf in _leaves({part: other[part] for part in other if part != "reason"}).items():
            assert set(leaf) | {"range"} == {"value", "unit", "source", "range"}, (key, path)
            assert leaf["source"].strip(), (key, path)
            inside = _inside(leaf["value"], leaf.get("range") or usual[path]["range"])
            assert inside or (name, key) in OUTSIDE_ON_PURPOSE, (key, path)


def _raw(name: str) -> dict[str, Any]:
    return tomllib.loads(packaged_text(name))


def _leaves(table: dict[str, Any], path: str = "") -> dict[str, dict[str, Any]]:
    """Return the tables that have a value, by their paths."""
    if "value" in table:
        return {path: table}
    found: dict[str, dict[str, Any]] = {}
    for key, inner in table.items():
        found |= _leaves(inner, f"{path}.{key}".lstrip("."))
    return found


def _inside(value: Any, limits: list[float]) -> bool:
    low, high = limits
    return low < high and all(low <= each <= high for each in (value if isinstance(value, list) else [value]))


@pytest.mark.parametrize("text", [packaged_text(name) for name in (*species_names(), "template")])
def test_a_file_of_the_package_has_the_shape_that_loading_takes_for_granted(text: str) -> None:
    faults = FaultList()
    check_shape(tomllib.loads(text), faults)
    assert faults.faults == []
