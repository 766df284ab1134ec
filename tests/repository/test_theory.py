"""The pages of theory, the docstrings and the oracle of the tests name the same equations."""

import functools
import importlib
import inspect
import re

import pytest

from tests.helpers.places import ROOT
from wingbeat.aero.library import WING_ESTIMATES

PAGES = sorted((ROOT / "docs" / "theory").glob("*.md"))
ORACLE = [
    ROOT / "tests" / "helpers" / f"{name}.py"
    for name in ("oracle", "oracle_coefficients", "oracle_laws", "unsteady_oracle", "tail_oracle")
]
EQUATION = re.compile(r"^\$\$ \(([a-z0-9-]+)\)$", re.MULTILINE)
LINK = re.compile(r"^\$\$ \(([a-z0-9-]+)\)\n\nComputed by (.+?)(?:\n\n|\Z)", re.MULTILINE | re.DOTALL)
OBJECT = re.compile(r"`(wingbeat(?:_\w+)?\.[\w.]+)`")
CITED = re.compile(r"Theory: equations? ([^.]+)\.")
LABEL = re.compile(r"``([a-z0-9-]+)``")
# What the oracle must cite: all that makes the right-hand side of a flight.
CENTRAL = """
body-axes stroke-axes strip-axes quarter-turn phase stroke-phase recovery-law harmonics flap-law pitch-law
span-law fold-law sweep-law twist-law chord-law strip-angles strip-place strip-chord strip-mass mass-points
su-fan dickinson mirrored-extension strip-velocity angle-of-attack lift-drag strip-force force-point
chord-turning rotation-force added-mass unsteady-couple induced-flow body-drag crossflow-force
tail-velocity tail-coefficients
generalised-air-loads body-balance partial-velocities equations-of-motion mass-matrix velocity-matrix
time-force gravity-force frozen-motion hinge-torques hinge-power actuator-power air-power energies
"""


def text_of(path):
    return path.read_text(encoding="utf-8")


def labels_in(text):
    return [label for cited in CITED.findall(text) for label in LABEL.findall(cited)]


@functools.cache
def links():
    """Return the paths of the objects that compute each equation, by label."""
    return {label: OBJECT.findall(by) for page in PAGES for label, by in LINK.findall(text_of(page))}


@functools.cache
def named():
    """Return all labels of the pages."""
    return [label for page in PAGES for label in EQUATION.findall(text_of(page))]


def resolved(path):
    """Return the object at a dotted path; raise AttributeError if there is none."""
    parts = path.split(".")
    for count in range(len(parts), 0, -1):
        try:
            thing = importlib.import_module(".".join(parts[:count]))
        except ModuleNotFoundError:
            continue
        for name in parts[count:]:
            thing = inspect.getattr_static(thing, name) if isinstance(thing, type) else getattr(thing, name)
        return thing.__func__ if isinstance(thing, classmethod | staticmethod) else thing
    raise AttributeError(path)


def test_labels_are_unique_and_every_equation_says_what_computes_it():
    assert len(named()) > 100
    assert sorted(named()) == sorted(set(named()))
    assert [label for label in named() if not links().get(label)] == []


def test_references_between_pages_lead_to_equations():
    cited = {label for page in PAGES for label in re.findall(r"\{eq\}`([^`]+)`", text_of(page))}
    assert cited
    assert sorted(cited - set(named())) == []


@pytest.mark.parametrize("label", sorted(set(named())))
def test_docstring_of_what_computes_an_equation_names_it(label):
    for path in links()[label]:
        assert label in labels_in(resolved(path).__doc__ or ""), f"the docstring of {path} does not name {label}"


def test_a_docstring_that_names_no_equation_is_found():
    with pytest.raises(AttributeError):
        resolved("wingbeat.animal.kinematics.flap_angel")
    assert "pitch-law" not in labels_in(resolved("wingbeat.animal.kinematics.flap_angle").__doc__)


def test_the_source_names_every_equation_and_no_other():
    cited = {label for path in (ROOT / "src").rglob("*.py") for label in labels_in(text_of(path))}
    assert cited == set(named())


def test_oracle_cites_equations_of_the_pages_and_all_central_ones():
    cited = {label for path in ORACLE for label in labels_in(text_of(path))}
    assert sorted(cited - set(named())) == []
    assert sorted(set(CENTRAL.split()) - cited) == []


def test_table_of_symbols_is_that_of_the_nomenclature(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    from theory_symbols import page

    on_disk = text_of(ROOT / "docs" / "theory" / "symbols.md")
    assert on_disk == page(), "run: uv run python validation/theory_symbols.py"
    # It has no symbol of its own.
    assert "`flap_amplitude`" not in on_disk.partition("## Symbols of the pages")[0]


def test_table_of_animal_wings_has_the_numbers_of_the_code():
    table = text_of(ROOT / "docs" / "theory" / "coefficients.md")
    names = ["feathered", "feathered-flapping", "feathered-revolving", "membrane"]
    assert f"| symbol | term | {' | '.join(names)} |" in table
    for term in WING_ESTIMATES["feathered"]:
        (row,) = re.findall(rf"^\|[^|]*\| `{term}` \|(.*)\|$", table, re.MULTILINE)
        assert [float(cell) for cell in row.split("|")] == [WING_ESTIMATES[name][term].value for name in names]
