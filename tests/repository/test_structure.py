"""How deep and how wide the house is: files, lines, floors, arrows and circles of the core, from its imports."""

import ast
import functools
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.helpers.places import ROOT

SRC = ROOT / "src"
MOST_FILES, MOST_LINES, MOST_FLOORS = 300, 57_950, 21
parse = functools.cache(ast.parse)
# What a worker process runs comes by name, through a pipe.
BY_NAME = {"wingbeat._workers.process"}


def modules_of(package: Path) -> dict[str, Path]:
    """Return the files of a package by dotted name."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(tree: ast.AST, inner: bool) -> Iterator[tuple[str, bool]]:
    """Yield each name that a module imports, and whether for type hints only; `inner`: in functions too."""
    stack: list[tuple[ast.AST, bool]] = [(tree, False)]
    while stack:
        node, hints = stack.pop()
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.Import):
                yield from ((alias.name, hints) for alias in child.names)
            elif isinstance(child, ast.ImportFrom):
                assert child.level == 0, "imports are absolute"
                yield from ((f"{child.module}.{alias.name}", hints) for alias in child.names)
            elif inner or not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
                check = isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING"
                stack.append((child, hints or check))


def arrows(modules: dict[str, str], *, inner: bool, hints: bool) -> dict[str, set[str]]:
    """Return which modules each one imports; a name that is no module counts for the module that holds it."""
    graph = {}
    for module, text in modules.items():
        graph[module] = set()
        for name, only_hints in imports(parse(text), inner):
            while name and name not in modules:
                name = name.rpartition(".")[0]
            if name and name != module and (hints or not only_hints):
                graph[module].add(name)
    return graph


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Return the sets of modules that import each other, in one way or another."""

    def reached(start: str) -> set[str]:
        found, stack = set(), [start]
        while stack:
            for name in graph[stack.pop()] - found:
                found.add(name)
                stack.append(name)
        return found

    within = {name: reached(name) for name in graph}
    found = {frozenset(n for n in within[name] if name in within[n]) for name in graph if name in within[name]}
    return sorted(sorted(circle) for circle in found)


def tower(graph: dict[str, set[str]]) -> list[str]:
    """Return the longest chain of modules, each of which imports the next; the graph has no circle."""
    chains: dict[str, list[str]] = {}

    def chain(name: str) -> list[str]:
        if name not in chains:
            chains[name] = [name, *max((chain(other) for other in graph[name]), key=len, default=[])]
        return chains[name]

    return max((chain(name) for name in graph), key=len)


@pytest.fixture(scope="module")
def core() -> dict[str, str]:
    """The text of each module of the core."""
    return {name: path.read_text(encoding="utf-8") for name, path in modules_of(SRC / "wingbeat").items()}


def test_the_core_is_small_enough_to_hold_in_the_head(core: dict[str, str]) -> None:
    lines = sum(text.count("\n") for text in core.values())
    graph = arrows(core, inner=False, hints=True)
    print(f"{len(core)} files, {lines} lines, {sum(map(len, graph.values())) / len(core):.2f} arrows a file")
    assert len(core) <= MOST_FILES
    assert lines <= MOST_LINES


def test_no_module_imports_itself_through_others(core: dict[str, str]) -> None:
    """Imports for type hints count, and those inside functions: whoever reads has to follow them as well."""
    assert circles(arrows(core, inner=True, hints=True)) == []


def test_the_tower_has_few_floors(core: dict[str, str]) -> None:
    chain = tower(arrows(core, inner=False, hints=False))
    print(f"{len(chain)} floors")
    assert len(chain) <= MOST_FLOORS, "\n".join(chain)


def test_no_module_is_looked_up_by_its_name(core: dict[str, str]) -> None:
    """Editors, type checkers and the contracts of imports would not see it."""
    looked_up = ("import_module", "__import__", "resolve_name")
    names = {
        module
        for module, text in core.items()
        for node in ast.walk(parse(text))
        if isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in looked_up
    }
    assert names == BY_NAME


def test_what_is_wrong_is_found() -> None:
    texts = {
        "a": "import b",
        "b": "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from c import thing",
        "c": "def draw():\n    import a",
        "d": "import b",
    }
    assert circles(arrows(texts, inner=True, hints=True)) == [["a", "b", "c"]]
    assert circles(arrows(texts, inner=True, hints=False)) == []
    assert circles(arrows(texts, inner=False, hints=True)) == []
    assert tower(arrows(texts, inner=False, hints=False)) == ["a", "b"]
    assert tower(arrows(texts, inner=False, hints=True)) == ["a", "b", "c"]
