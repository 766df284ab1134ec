"""A docstring says what it is of, the parameters with units, the fields of a record, and what is refused.

Each public name has an example, which pytest runs.
"""

import ast
import dataclasses
import doctest
import inspect
import re
import sys
import textwrap

import pytest

import wingbeat as wb
import wingbeat_evidence as evidence
from tests.helpers.public import public_names
from wingbeat._base import FaultList

# An example would need the other code, which is an extra.
BY_OTHERS = {"SecondOpinion", "compare_with_lattice"}
# Users catch errors and never make them.
ELSEWHERE = "wingbeat._base.errors"
# A number that has no unit says what it is.
NO_UNIT = re.compile(
    r"\[|\b(share|shares|fraction|ratio|over (the|that)|exponent|chords|number|between 0 and 1|tolerance|weight|"
    r"coefficient|phase|multiples?|optimiser's scale|the unit of|as (in|of) `)"
)
SECTION = re.compile(r"(?m)^(\w+)\n-{3,}\n")


def reachable():
    """Return everything that a user can reach by a public name, methods included, by that name."""
    found = {}
    faces = [(package, public_names(package)) for package in (wb, evidence)]
    inner = (wb.aero, wb.experiment, wb.objectives, wb.options, wb.plots, wb.stability, wb.studies, wb.viewer)
    for package, names in (*faces, *((package, dir(package)) for package in inner)):
        for name in names:
            thing = getattr(package, name)
            if not (inspect.isfunction(inspect.unwrap(thing)) or isinstance(thing, type)):
                continue
            if not thing.__module__.startswith("wingbeat") or thing.__module__.startswith(ELSEWHERE):
                continue
            found[name] = thing
            own = [
                base for base in reversed(getattr(thing, "__mro__", ())) if base.__module__.startswith("wingbeat")
            ]
            for key, member in [item for base in own for item in vars(base).items()]:
                member = member.__func__ if isinstance(member, classmethod | staticmethod) else member
                if not key.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                    found[f"{name}.{key}"] = member
    return found


REACHABLE = reachable()


def own_text(thing):
    """Return a docstring, empty where there is only what `dataclass` or a base class wrote."""
    text = vars(thing).get("__doc__") if isinstance(thing, type) else thing.__doc__
    return "" if not text or text.startswith(f"{getattr(thing, '__name__', '')}(") else inspect.cleandoc(text)


def sections(text):
    """Return the text of each section by its heading, the summary and what follows it under the empty one."""
    parts = SECTION.split(text)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def entries(section):
    """Return what a section says of each name."""
    found = {}
    for entry in re.split(r"\n(?=\S)", section):
        names, colon, meaning = entry.partition(" : ")
        if colon:
            found |= {name.strip().lstrip("*"): meaning for name in names.split(",")}
    return found


def refuses(function):
    """Say whether a function collects faults or raises what we raise; not if the faults are the caller's."""
    if "faults" in inspect.signature(function).parameters:
        return False
    tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    called = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    names = {getattr(f, "id", getattr(f, "attr", "")) for f in called}
    return bool(names & {FaultList.__name__, "InvalidInputError", "FileError", "raise_if_any"})


def faults_of(name, thing):
    """Yield what a docstring lacks."""
    text = own_text(thing)
    if not text:
        yield "has none"
        return
    first = text.split("\n\n")[0]
    if "\n" in first or not first.endswith((".", "?")):
        yield f"its first line is no sentence: {first!r}"
    parts = sections(text)
    said = entries(parts.get("Parameters", ""))
    if isinstance(thing, property):
        return
    if isinstance(thing, type):
        fields = {f.name for f in dataclasses.fields(thing)} if dataclasses.is_dataclass(thing) else set()
        fields |= set(getattr(thing, "_fields", ()))
        told = said | entries(parts.get("Attributes", ""))
        if missing := fields - told.keys():
            yield f"says nothing of the fields {sorted(missing)}"
        if (
            not fields
            and "__init__" in vars(thing)
            and "Attributes" not in parts
            and not issubclass(thing, Exception)
        ):
            yield "has no section Attributes"
        checks = vars(thing).get("__post_init__")
        if checks is not None and refuses(checks) and "Raises" not in parts:
            yield "does not say what it refuses"
        kinds = {k: v for base in reversed(thing.__mro__) for k, v in vars(base).get("__annotations__", {}).items()}
    else:
        function = inspect.unwrap(thing)
        parameters = inspect.signature(function).parameters.keys() - {"self", "cls"}
        if missing := parameters - said.keys():
            yield f"says nothing of the parameters {sorted(missing)}"
        if unknown := said.keys() - parameters:
            yield f"speaks of parameters that it does not take: {sorted(unknown)}"
        if refuses(function) and "Raises" not in parts:
            yield "does not say what it refuses"
        told, kinds = said, function.__annotations__
    for key, kind in kinds.items():
        if re.match(r"(<class '|ForwardRef\(')?float", str(kind)) and key in told and not NO_UNIT.search(told[key]):
            yield f"gives no unit of {key}"


@pytest.mark.parametrize("name", REACHABLE)
def test_every_public_docstring_is_complete(name):
    assert list(faults_of(name, REACHABLE[name])) == []


def examples_of(thing):
    """Return the examples of a thing that pytest finds in the module that defines it."""
    module = thing if inspect.ismodule(thing) else sys.modules[thing.__module__]
    own = module.__name__ if thing is module else f"{module.__name__}.{thing.__name__}"
    return [one for test in doctest.DocTestFinder().find(module) if test.name == own for one in test.examples]


@pytest.mark.parametrize(
    ("package", "name"),
    [(package, name) for package in (wb, evidence) for name in public_names(package) if name not in BY_OTHERS],
    ids=lambda value: value if isinstance(value, str) else value.__name__,
)
def test_every_public_name_has_an_example_that_runs(package, name):
    examples = examples_of(getattr(package, name))
    assert any(example.want for example in examples), "show what a user gets"
    assert not any(doctest.SKIP in example.options for example in examples)


def test_there_are_many():
    assert len(REACHABLE) > 150
    assert {"Orbit.save", "solve_curve", "SuFan", "CurveFit.band", "Wing", "wingbeat_page"} <= REACHABLE.keys()


class _Poor:
    """What it is"""

    def __init__(self, mass):
        self.mass = mass


@dataclasses.dataclass
class _Silent:
    """A wing.

    Parameters
    ----------
    mass : of it.
    """

    mass: float
    span: float = 1.0

    def __post_init__(self):
        FaultList().raise_if_any()


class _Rich:
    """What it is.

    >>> 1 + 1
    2
    """


def _careless(mass, span):
    """Return nothing.

    Parameters
    ----------
    mass : [kg].
    area : [m2].
    """
    FaultList().raise_if_any()


def test_what_is_missing_is_found():
    assert len(list(faults_of("_Poor", _Poor))) == 2
    assert list(faults_of("_Silent", _Silent)) == [
        "says nothing of the fields ['span']",
        "does not say what it refuses",
        "gives no unit of mass",
    ]
    assert list(faults_of("_careless", _careless)) == [
        "says nothing of the parameters ['span']",
        "speaks of parameters that it does not take: ['area']",
        "does not say what it refuses",
    ]


def test_a_docstring_without_an_example_is_found():
    assert examples_of(_Poor) == []
    assert [example.source for example in examples_of(_Rich)] == ["1 + 1\n"]


def test_help_of_an_orbit_says_what_can_be_done_with_one():
    text = sections(own_text(wb.Orbit))[""]
    for word in ("status", "record()", "dataset", "save(", "view()", "problem", "power_account", "sensitivities"):
        assert word in text, word
    named = re.findall(r"(?<!\")\borbit\.(\w+)", text)
    assert all(hasattr(wb.Orbit, word) for word in named)
    assert all(hasattr(wb, word) for word in re.findall(r"\bwb\.(\w+)", text))


@pytest.mark.parametrize("package", [wb.aero, wb.experiment, wb.plots, wb.viewer], ids=lambda p: p.__name__)
def test_a_package_shows_its_own_names_and_no_others(package):
    """No module, no `annotations`, no class of another library, nor what its files import for themselves."""
    assert {"Path", "FaultList", "annotations", "np"}.isdisjoint(dir(package))
    for name in dir(package):
        thing = getattr(package, name)
        if name == "winds":
            continue
        assert not inspect.ismodule(thing), name
        home = getattr(thing, "__module__", package.__name__)
        assert home.startswith(package.__name__), f"{name} is of {home}"
