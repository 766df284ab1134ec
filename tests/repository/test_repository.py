"""The repository itself: what its files may not name, how long they are, what is pinned and documented."""

import ast
import importlib.util
import re
import shutil
import subprocess
import tomllib
from pathlib import Path
from types import ModuleType

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import wingbeat
import wingbeat_evidence
from tests.helpers.places import ROOT
from tests.helpers.public import public_names

MAX_LINES = 450

# Joined from pieces, so that this file does not name what it looks for.
REGISTRY_HOSTS = [
    "py" + "pi.org",
    "python" + "hosted.org",
    "npm" + "js.org",
    "npm" + "js.com",
    "yarn" + "pkg.com",
]
LOCAL_FOLDERS = ["work", "tmp", "root", "home"]


@pytest.fixture(scope="module")
def tracked() -> list[Path]:
    """Every file that git tracks, relative to the root."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("needs git and a clone of the repository")
    listing = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    names = [Path(name) for name in listing.stdout.split("\0") if name]
    if not names:
        pytest.skip("git tracks no file yet")
    return names


def lines_that_match(pattern: re.Pattern[str], files: list[Path]) -> list[str]:
    """Return ``file:line: text`` for each line of a text file that the pattern is found in."""
    found = []
    for file in files:
        content = (ROOT / file).read_bytes() if (ROOT / file).is_file() else b""
        if b"\0" in content:
            continue
        for number, line in enumerate(content.decode(errors="replace").splitlines(), start=1):
            if match := pattern.search(line):
                start = max(match.start() - 40, 0)
                found.append(f"{file}:{number}: {line[start : match.end() + 40]}")
    return found


def host_pattern() -> re.Pattern[str]:
    return re.compile("|".join(re.escape(host) for host in REGISTRY_HOSTS), re.IGNORECASE)


def path_pattern() -> re.Pattern[str]:
    return re.compile(rf"(?<![\w.])/(?:{'|'.join(LOCAL_FOLDERS)})/")


def test_no_tracked_file_names_a_package_registry(tracked: list[Path]) -> None:
    assert lines_that_match(host_pattern(), tracked) == []


def test_no_tracked_file_names_a_local_path(tracked: list[Path]) -> None:
    assert lines_that_match(path_pattern(), tracked) == []


@pytest.mark.parametrize("host", REGISTRY_HOSTS)
def test_a_planted_registry_host_is_found(host: str, tmp_path: Path) -> None:
    planted = tmp_path / "planted.lock"
    planted.write_text(f'source = "https://files.{host}/simple"\n')
    assert len(lines_that_match(host_pattern(), [planted])) == 1


@pytest.mark.parametrize("folder", LOCAL_FOLDERS)
def test_a_planted_local_path_is_found(folder: str, tmp_path: Path) -> None:
    planted = tmp_path / "planted.toml"
    planted.write_text(f'a = "/{folder}/main"\nb = "https://example.org/{folder}/"\nc = "./{folder}/"\n')
    assert len(lines_that_match(path_pattern(), [planted])) == 1


def test_no_python_file_is_too_long(tracked: list[Path]) -> None:
    files = [file for file in tracked if file.suffix == ".py" and (ROOT / file).is_file()]
    lengths = {str(file): len((ROOT / file).read_text(encoding="utf-8").splitlines()) for file in files}
    assert {file: length for file, length in lengths.items() if length > MAX_LINES} == {}


def test_benchmarks_and_validation_import_what_there_is(tracked: list[Path]) -> None:
    """Nobody runs them in CI, and the type checker sees the package only."""
    asked = [
        (str(file), node.module, alias.name)
        for file in tracked
        if file.suffix == ".py" and file.parts[0] in ("benchmarks", "validation") and (ROOT / file).is_file()
        for node in ast.walk(ast.parse((ROOT / file).read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("wingbeat")
        for alias in node.names
    ]
    assert len(asked) > 50
    missing = []
    for file, module, name in asked:
        if not hasattr(importlib.import_module(module), name) and not importlib.util.find_spec(f"{module}.{name}"):
            missing.append(f"{file}: {module}.{name}")
    assert missing == []


def test_uv_lock_is_not_tracked(tracked: list[Path]) -> None:
    assert Path("uv.lock") not in tracked


def has_own_docstring(package: ModuleType, name: str) -> bool:
    """Say whether a public name is documented; what `dataclass` writes of itself does not count."""
    thing = getattr(package, name)
    text = (vars(thing).get("__doc__") if isinstance(thing, type) else thing.__doc__) or ""
    return bool(text.strip()) and not text.startswith(f"{name}(")


@pytest.mark.parametrize("package", [wingbeat, wingbeat_evidence], ids=lambda package: package.__name__)
def test_every_public_name_has_a_docstring(package: ModuleType) -> None:
    public = public_names(package)
    assert public
    assert [name for name in public if not has_own_docstring(package, name)] == []


def test_what_users_need_first_is_listed_and_all_of_it_is_there() -> None:
    listed = dir(wingbeat)
    assert 35 <= len(listed) <= 55
    assert {*listed} - {"__version__"} <= {*public_names(wingbeat)}
    assert [name for name in public_names(wingbeat) if not hasattr(wingbeat, name)] == []


@pytest.mark.parametrize(
    "command", ["pip install uv && uv run wingbeat orbit pigeon --speed 12", "uv run --group dev pytest"]
)
def test_readme_gives_the_two_commands(command: str) -> None:
    assert command in (ROOT / "README.md").read_text(encoding="utf-8")


def constraint_lines() -> list[str]:
    return (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()


def direct_requirements() -> list[Requirement]:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    groups = [
        project["project"]["dependencies"],
        *project["project"].get("optional-dependencies", {}).values(),
        *project.get("dependency-groups", {}).values(),
    ]
    return [Requirement(line) for group in groups for line in group if isinstance(line, str)]


def test_constraints_are_bare_pins() -> None:
    bare_pin = re.compile(r"[a-z0-9-]+==[^\s;@]+( ; [^@#]+)?")
    assert [line for line in constraint_lines() if not bare_pin.fullmatch(line)] == []


def test_constraints_pin_every_direct_dependency() -> None:
    pins: dict[str, list[str]] = {}
    for line in constraint_lines():
        pin = Requirement(line)
        pins.setdefault(canonicalize_name(pin.name), []).append(str(pin.specifier).removeprefix("=="))
    requirements = direct_requirements()
    assert requirements
    for wanted in requirements:
        versions = pins.get(canonicalize_name(wanted.name), [])
        assert versions, f"{wanted.name} is not pinned: refresh constraints.txt"
        assert all(wanted.specifier.contains(version) for version in versions), f"{wanted} against {versions}"


def test_a_user_gets_no_tool_of_development() -> None:
    """`uv run` installs the default groups, of which there are none; CI types what README and CONTRIBUTING say."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["tool"]["uv"]["default-groups"] == []
    page = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    said = re.findall(r"^uv run --group .*$", page.split("## What CI runs")[1].split("##")[0], re.MULTILINE)
    ran = re.findall(r"^uv run .*$", (ROOT / ".ci" / "run").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(said) == 7
    assert ran == said
    hooks = re.findall(r"entry: (uv run .*)$", (ROOT / ".pre-commit-config.yaml").read_text("utf-8"), re.MULTILINE)
    assert hooks == said[:4]


# What once stood in several modules, each able to drift from the others, and the one module that now holds it.
ONCE = {
    '"must be a whole number': "_base/errors.py",
    'f"did you mean': "_base/errors.py",
    r"get_close_matches\(": "_base/errors.py",
    r"quarter-chord\W+(or )?centre-of-pressure[\".]": "aero/blade_element.py",
    r"FASTEST_CLIMB = 100|at_most\W+100(\.0)?, .*m/s": "orbits/problem/quantities.py",
    r"\bexp\(-[^)]*decay_rate\W* \*": "aero/formula_terms.py",
    r"\b1\.19, .*1\.74\b": "aero/formula_models.py",
    r"[\"']#[0-9A-Fa-f]{6}[\"']|font\.size|axes\.spines\.": "_base/style.py",
}


@pytest.mark.parametrize("pattern", ONCE)
def test_what_several_modules_need_is_written_in_one(pattern: str, tracked: list[Path]) -> None:
    files = [file for file in tracked if file.suffix == ".py" and file.parts[:2] == ("src", "wingbeat")]
    lines = lines_that_match(re.compile(pattern), files)
    assert {line.split(":")[0] for line in lines} == {f"src/wingbeat/{ONCE[pattern]}"}, "\n".join(lines)
