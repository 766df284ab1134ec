"""The Python of the documentation runs, and prints what it says; its commands can be typed in a fresh clone.

Fences say what they hold: `sh` is typed, line by line, in the root of a clone; `bash` is a script to be saved, for
an environment that has wingbeat; `text` is printed. Of inline code, what begins with `uv run` is typed as well.
"""

import itertools
import re
import shlex
import subprocess
import tomllib

import pytest
from cyclopts import CycloptsError

from tests.helpers.engines import Here
from tests.helpers.places import ROOT
from wingbeat.cli.app import build_app

DOCS = ROOT / "docs"


def kept(*folders):
    """Return the files of the folders that are not written when the site is built, as Git knows."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", *folders]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    return [ROOT / name for name in sorted(names) if (ROOT / name).is_file()]


DOCS_PAGES = [page for page in kept("docs") if page.suffix == ".md"]
TYPED_PAGES = [*sorted(ROOT.glob("*.md")), ROOT / "data" / "README.md", *DOCS_PAGES]
PAGES = [page for page in (ROOT / "README.md", *DOCS_PAGES) if "```python" in page.read_text(encoding="utf-8")]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
EXTRAS = set(PROJECT["project"]["optional-dependencies"])
GROUPS = set(PROJECT["dependency-groups"])

LANGUAGES = {"sh", "bash", "text", "python", "py", "toml", "csv", "matlab"}
FILE = re.compile(r"[\w./-]+\.(toml|csv|nc|json|jsonl|html|gif|png|pdf|mat|parquet|sqlite|py)")
WRITES = {"-o", "--output", "--plot", "--tornado", "--plot-kinematics"}
TOOLS = {"pytest", "ruff", "pyright", "lint-imports", "pre-commit"}  # of the group dev
# Of pages, pictures, and what the site is made with.
SUFFIXES = {".css", ".gif", ".html", ".md", ".png", ".py", ".rst", ".svg", ".txt", ".woff2"}


def page_name(page):
    return str(page.relative_to(ROOT))


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_python_of_a_page_runs(page, capsys, monkeypatch):
    # Studies of a page are solved here: processes would take longer to start than to solve their few points.
    monkeypatch.setattr("wingbeat.studies.study.LocalProcesses", lambda *given: Here())
    code = "\n".join(re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL))
    exec(compile(code, page.name, "exec"), {"__name__": "docs"})
    printed = capsys.readouterr().out.splitlines()
    assert printed
    assert all(line.startswith("converged ") for line in printed)


def commands(text):
    """Return the commands of a page in their order, as words, and whether each stands in a script to be saved."""
    found = []
    text = re.sub(r"^(:{3,}|```)\{.*?^\1$", "", text, flags=re.DOTALL | re.MULTILINE)  # what only the site reads
    fenced = re.compile(r"^```(\w*)\n(.*?)^```", re.DOTALL | re.MULTILINE)
    inline = re.compile(r"`(uv run [^`]+)`")
    for match in re.finditer(rf"{fenced.pattern}|{inline.pattern}", text, re.DOTALL | re.MULTILINE):
        language, block, command = match.groups()
        if command:
            found += [(shlex.split(command), False)]
        else:
            assert language in LANGUAGES, f"a fence says {language!r}, none of {sorted(LANGUAGES)}"
            if language in ("sh", "bash"):
                lines = [part for line in block.replace("\\\n", " ").splitlines() for part in line.split(" && ")]
                found += [
                    (words, language == "bash") for line in lines if (words := shlex.split(line, comments=True))
                ]
    return found


def parse(words):
    """Parse the words after `wingbeat`, without running them; raise where one is unknown or missing."""
    _, bound, *_ = build_app().parse_args(words, exit_on_error=False, print_error=False)
    assert {name for name, p in bound.signature.parameters.items() if p.default is p.empty} <= set(bound.arguments)


def faults_of_uv_run(words, made):
    """Return what hinders `uv run ...`, and note the files that it writes."""
    chosen = {"--extra": set(), "--group": set(), "--with": set()}
    while words[0] in chosen:
        chosen[words[0]].add(words[1])
        words = words[2:]
    program, *rest = words
    faults = [f"no extra {name}" for name in chosen["--extra"] - EXTRAS]
    faults += [f"no group {name}" for name in chosen["--group"] - GROUPS]
    developer = "dev" in chosen["--group"]
    needed = set()
    if program == "wingbeat":
        try:
            parse(rest)
        except (CycloptsError, AssertionError) as error:
            faults.append(f"not understood: {error}")
        needed = {"app"} & set(rest[:1]) | ({"cluster"} if "--dask" in rest else set())
        needed |= {"pareto"} if rest[:2] == ["study", "front"] else set()
        needed |= {ending for ending in ("parquet", "c3d") if any(word.endswith(f".{ending}") for word in rest)}
    elif program == "python":
        source = (ROOT / rest[0]).read_text(encoding="utf-8") if (ROOT / rest[0]).is_file() else ""
        faults += [
            f"{rest[0]} has no {word}" for word in rest[1:] if word[:2] == "--" and f'"{word}"' not in source
        ]
        faults += ["needs the group dev"] if "playwright" in source and not developer else []
        needed = {"cluster"} if "dask_engine" in source else set()
    elif program in TOOLS:
        faults += [] if developer else [f"{program} needs --group dev"]
    elif program == "sphinx-build":
        faults += [] if "docs" in chosen["--group"] else ["needs the group docs"]
    elif program == "jupyter":
        needed = {"notebook"}
        faults += [] if "jupyterlab" in chosen["--with"] else ["no Jupyter is installed"]
    else:
        faults.append(f"{program} is no program of the environment")
    faults += [] if developer else [f"needs the extra {name}" for name in needed - chosen["--extra"]]
    return faults + faults_of_files(words, made)


def faults_of_files(words, made):
    """Return the files that are read and not there, and note those that are written."""
    faults = []
    if words[1:3] == ["species", "new"]:
        made.add(words[3])
    for before, word in zip(["", *words], words, strict=False):
        for name in [word] if FILE.fullmatch(word) else []:
            if before in WRITES:
                made.add(name)
            elif name not in made and not (ROOT / name).is_file():
                faults.append(f"no file {name}")
    return faults


def faults_of_page(text):
    """Return why a page's commands cannot be typed as they stand, in the root of a fresh clone."""
    faults, made = [], set()
    for words, script in commands(text):
        if words[:2] == ["uv", "run"]:
            found = faults_of_uv_run(words[2:], made)
        elif words[0] == "wingbeat" and script:
            words = [word for word in words if word != "&"]
            found = faults_of_uv_run([*(["--extra", "cluster"] if "--dask" in words else []), *words], made)
        elif words[:2] == ["uv", "sync"]:
            known = {"--group": GROUPS, "--extra": EXTRAS}
            pairs = itertools.pairwise(words)
            found = [f"no {option[2:]} {name}" for option, name in pairs if name not in known.get(option, {name})]
        elif words[:2] == ["uv", "pip"]:
            found = faults_of_files(words, made)
        elif words[:3] == ["pip", "install", "uv"] or words[:3] == ["python3", "-m", "venv"]:
            found = []
        elif words[0].endswith("/bin/pip") and words[1] == "install":
            extras = re.fullmatch(r"\.\[(\w+)\]", words[2])
            found = [] if extras and extras[1] in EXTRAS else [f"installs {words[2]}"]
        elif script:
            found = []
        else:
            found = ["is no command of a fresh clone"]
        faults += [f"{shlex.join(words)}: {fault}" for fault in found]
    return faults


@pytest.mark.parametrize("page", TYPED_PAGES, ids=page_name)
def test_commands_can_be_typed_in_a_fresh_clone(page):
    assert faults_of_page(page.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ("wingbeat orbit pigeon --speed 12", "is no command"),
        ("pip install 'wingbeat[app]'", "is no command"),
        ("uv run wingbeat app", "needs the extra app"),
        ("uv run --extra lunch wingbeat app", "no extra lunch"),
        ("uv run wingbeat orbit pigeon --sped 12", "not understood"),
        ("uv run wingbeat orbit pigeon --speed 12 --kinematics mine.csv", "no file mine.csv"),
        ("uv run wingbeat study run examples/wings.toml --dask local:2", "needs the extra cluster"),
        ("uv run wingbeat study export examples/wings.toml -o table.parquet", "needs the extra parquet"),
        ("uv run wingbeat orbit bat -o o.nc\nuv run wingbeat export o.nc -o bat.c3d", "needs the extra c3d"),
        ("uv run wingbeat view orbit.nc -o orbit.html\nuv run wingbeat orbit bat -o orbit.nc", "no file orbit.nc"),
        ("uv run wingbeat hop pigeon", "not understood"),
        ("uv run pytest", "pytest needs --group dev"),
        ("uv run python benchmarks/fuzz.py --never", "has no --never"),
        ("uv run python benchmarks/explorer.py", "needs the group dev"),
    ],
)
def test_a_planted_command_that_cannot_be_typed_is_found(line, fault):
    found = faults_of_page(f"```sh\n{line}\n```\n")
    assert len(found) >= 1
    assert fault in found[0]


@pytest.mark.parametrize("page", TYPED_PAGES, ids=page_name)
def test_links_lead_to_files(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    links = re.findall(r"\]\(([^)#]+)[^)]*\)", text)
    assert [link for link in links if "://" not in link and not (page.parent / link).exists()] == []
    named = re.findall(r"`((?:src|tests|data|examples|benchmarks|validation)/[\w./-]+)`", text)
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_docs_hold_pages_and_pictures_and_the_data_are_described():
    assert {path.suffix for path in kept("docs")} == SUFFIXES
    described = (ROOT / "data" / "README.md").read_text(encoding="utf-8")
    tables = [path for path in (ROOT / "data").iterdir() if path.name != "README.md"]
    assert tables
    assert [path.name for path in tables if f"`{path.name}{'/' * path.is_dir()}`" not in described] == []


def test_the_example_study_is_the_one_on_its_page():
    shown = re.search(
        r"`examples/wings.toml`:\n\n```toml\n(.*?)```",
        (DOCS / "guide" / "studies.md").read_text("utf-8"),
        re.DOTALL,
    )
    assert shown is not None
    assert (ROOT / "examples" / "wings.toml").read_text(encoding="utf-8") == shown[1]
