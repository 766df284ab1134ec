"""How a command line must be refused: exit code 2, a line for each fault, and nothing left behind."""

import shlex
from pathlib import Path

import pytest

from wingbeat.cli import main


def contents(folder: Path) -> dict[str, bytes | None]:
    """Return what lies in a folder, files with their bytes."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")
    }


def check(code: int, out: str, err: str, parts: tuple[str, ...]) -> None:
    """Check that a command line was refused, with one line for each of `parts`, which holds all words of it."""
    lines = err.splitlines()
    assert "Traceback" not in err
    assert (code, out) == (2, ""), err
    assert len(lines) == len(parts), err
    for line, part in zip(lines, parts, strict=True):
        assert line.startswith("error: "), line
        for words in part.split("|"):
            assert words in line


def refuse(capsys: pytest.CaptureFixture[str], words: str, *parts: str) -> None:
    """Run a command line that must be refused, and leave everything as it was."""
    before = contents(Path.cwd())
    code = main(shlex.split(words))
    told = capsys.readouterr()
    check(code, told.out, told.err, parts)
    assert contents(Path.cwd()) == before
