"""The answer is printed first, then files are written: what fails at one costs nothing of the other."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from wingbeat._base import FileError
from wingbeat.cli import main
from wingbeat.cli.process import StdoutError
from wingbeat.cli.terminal import Answer

TABLE = "alpha_deg,C_L,C_D\n" + "".join(
    f"{a},{0.0004 * a * (90 - a):.3f},{0.1 + 0.01 * a:.3f}\n" for a in range(0, 90, 6)
)
# Command lines that write two files, the function that writes the first one, and what they print.
LINES = {
    "glide pigeon --alpha 4:6:1 -o first.csv --plot second.png": (
        "wingbeat.results.glide.GlidePolar.save",
        "slowest sink",
    ),
    "polar su-fan --csv -o first.png": ("wingbeat.cli.terminal.save_figure", "alpha_deg,c_l"),
    "fit table.csv -o first.toml --plot second.png": ("wingbeat.experiment.wing_fit.WingFit.save", "su-fan"),
    "simulate pigeon --beats 1 --samples 8 -o first.nc": ("wingbeat.results.flight.Flight.save", "mean u [m/s]"),
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "table.csv").write_text(TABLE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("error", "told"),
    [
        (FileError("cannot write 'first': no space left on device"), "error: cannot write 'first': no space left"),
        (
            ValueError("[1, 2] is no text"),
            "error: cannot write 'first.*ValueError: .1, 2. is no text; this is a fault",
        ),
    ],
)
@pytest.mark.parametrize("line", LINES)
def test_a_file_that_cannot_be_written_costs_neither_the_answer_nor_other_files(
    line: str,
    error: Exception,
    told: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    place, printed = LINES[line]

    def fail(*_: object) -> None:
        assert printed in capsys.readouterr().out  # before the file is written
        raise error

    monkeypatch.setattr(place, fail)
    assert main(line.split()) == 2
    assert [path.name for path in folder.glob("second*")] == ["second.png"] * ("second" in line)
    assert re.search(told, capsys.readouterr().err)


@pytest.mark.slow
def test_a_reader_that_has_seen_enough_does_not_cost_the_file(folder: Path) -> None:
    """`head` closes the pipe before the table is printed."""
    words = "polar su-fan --alpha=-180:180:0.02 --csv -o page.png | head -1; exit ${PIPESTATUS[0]}"
    line = ["bash", "-c", f"{sys.executable} -m wingbeat {words}"]
    ended = subprocess.run(line, capture_output=True, text=True, check=False)
    assert ended.returncode == 141
    assert ended.stderr == "wrote page.png\n"
    assert (folder / "page.png").stat().st_size > 1000


def test_all_that_went_wrong_is_told_at_the_end():
    def refuse(path: Path) -> None:
        raise FileError(f"cannot write {path}")

    written: list[Path] = []
    given = Answer()
    for name, write in (("a", refuse), ("b", written.append), ("c", refuse)):
        given.save(Path(name), write)
    with pytest.raises(FileError, match="cannot write a\ncannot write c"):
        given.end()
    assert written == [Path("b")]


def test_files_are_written_although_nothing_can_be_printed():
    def full() -> None:
        raise StdoutError(OSError(28, "No space left on device"))

    written: list[Path] = []
    given = Answer()
    given.show(full)
    given.show(lambda: pytest.fail("printed on"))
    given.save(Path("a"), written.append)
    with pytest.raises(StdoutError):
        given.end()
    assert written == [Path("a")]
