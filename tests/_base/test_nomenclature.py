"""Names, units and labels stand in one table: whatever data sets and records say of a number is said there."""

import ast
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._base import GLIDE, HIGHEST_ORDER, NOMENCLATURE, SERIES, cf, find, label_of, plain
from wingbeat.aero import BladeElement, SuFan
from wingbeat.animal.kinematics import PARAMETER_NAMES
from wingbeat.animal.species.numbers import FREE, KEYS, LOOKS, PATH, PLAUSIBLE, SHAPE
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.quantities import QUANTITIES, Frequency
from wingbeat.records.tables import flat

SOURCE = Path(wb.__file__).parent
# Lists that are not ours: spellings in other people's files.
EXCEPTIONS = {"_base/sheets.py", "experiment/flights_file.py", "experiment/load_cell_setup.py"}
UNITS = {term.unit for term in NOMENCLATURE.values()} - {"", "1"}
SPELLED = UNITS | {plain(unit) for unit in UNITS} | {"deg", "deg/s"}


def test_each_name_is_its_own_and_has_a_label():
    for name, term in NOMENCLATURE.items():
        assert term.name == name
        assert term.label.strip(), name
        assert cf(plain(term.unit)) == term.unit, name


def test_meanings_of_the_harmonics_name_the_highest_order():
    said = [term for name, term in NOMENCLATURE.items() if name.endswith("_harmonics")]
    assert all(f"up to order {HIGHEST_ORDER}" in term.meaning for term in said)
    assert len(said) == 6


@pytest.mark.slow
def test_every_series_of_an_orbit_is_said_by_the_table(solved):
    dataset = solved.orbit.dataset
    assert [*dataset.variables] == [*dict.fromkeys([*dataset.variables])]
    assert {*dataset.variables} == {term.name for term in SERIES}
    for name, variable in dataset.variables.items():
        term = NOMENCLATURE[str(name)]
        assert variable.attrs.get("units", "") == term.unit, name
        assert variable.attrs["long_name"] == term.label, name
        assert variable.attrs.get("symbol", "") == term.symbol, name


def test_every_number_of_an_orbit_record_is_in_the_table(solved):
    for path, value in flat(solved.orbit.record()):
        term = find(path)
        assert term is not None, path
        assert term.unit or not isinstance(value, int | float), path
        assert label_of(path) != path, path


def test_every_column_of_a_glide_polar_is_said_by_the_table():
    polar = wb.glide_polar(wb.load_species("pigeon"), angles_of_attack=np.radians([4.0, 6.0]))
    for name, variable in polar.dataset.variables.items():
        term = find(f"glide.{name}")
        assert term is not None, name
        assert variable.attrs == {"units": term.unit, "long_name": term.label}, name
    assert {term.name.removeprefix("glide.") for term in GLIDE} <= {*polar.dataset.variables}


def test_every_quantity_has_the_unit_of_the_table():
    for name, quantity in QUANTITIES.items():
        assert quantity.unit == plain(NOMENCLATURE[name].unit), name
    assert Frequency().unit == NOMENCLATURE["frequency"].unit
    for quantity, name in (
        (wb.objectives.PowerCost(0.5), "power_cost"),
        (wb.objectives.SpringPower(0.5), "spring_power"),
    ):
        assert quantity.unit == NOMENCLATURE[name].unit


def test_every_number_of_a_species_file_has_the_unit_of_the_table():
    for key in (*KEYS, *PATH, *FREE, *PLAUSIBLE, *LOOKS, *SHAPE):
        term = find(key.path)
        assert term is not None, key.path
        assert (key.unit, key.meaning) == (plain(term.unit), term.definition), key.path
    assert {name for name in PARAMETER_NAMES if name not in NOMENCLATURE} == set()


@pytest.mark.parametrize("aero", [SuFan(), BladeElement(SuFan(), force_point="centre-of-pressure"), "feathered"])
def test_every_parameter_is_in_the_table(aero):
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=6.0, aero=aero)
    for parameter in parameters_of(problem):
        term = find(parameter.path)
        assert term is not None, parameter.path
        assert parameter.unit == plain(term.unit), parameter.path


def test_an_angle_in_degrees_takes_its_unit_from_its_entry_in_radians():
    assert find("wing.stroke_plane_angle_deg").unit == "deg"
    assert find("mass_deg") is None
    assert find("nothing.of.the.kind") is None


def _lists_of_units(tree):
    """Yield the line of each outermost dict, tuple, list or set that holds two different units, or more."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.Dict | ast.Tuple | ast.List | ast.Set):
            held = {n.value for n in ast.walk(node) if isinstance(n, ast.Constant) and isinstance(n.value, str)}
            found = held & SPELLED
            # Letters alone are markers of figures or names of variables as often as units.
            if len(found) > 1 and any(len(unit) > 1 for unit in found):
                yield node.lineno, sorted(found)
                continue
        yield from _lists_of_units(node)


def test_no_other_module_keeps_a_list_of_units():
    found = {}
    for path in sorted(SOURCE.rglob("*.py")):
        if path.name != "nomenclature.py" and (lists := [*_lists_of_units(ast.parse(path.read_text()))]):
            found[str(path.relative_to(SOURCE))] = lists
    assert found.keys() == EXCEPTIONS


def test_a_list_of_units_would_be_found():
    assert [*_lists_of_units(ast.parse('LABELS = {"u": ("m/s", "speed"), "mass": ("kg", "mass")}'))]
    assert not [*_lists_of_units(ast.parse('MARKS = ("o", "s", "W")'))]


def test_the_table_loads_nothing_heavy():
    heavy = "{'jax', 'numpy', 'xarray', 'pandas'}"
    code = f"import sys, wingbeat._base.nomenclature; print(sorted({heavy} & {{*sys.modules}}))"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"
