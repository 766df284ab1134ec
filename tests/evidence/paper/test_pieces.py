"""The assumption study in pieces: stopped, killed, moved, resumed it says the same; another sample is refused."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time

import pytest

from tests.helpers.places import ROOT
from wingbeat._base import NUMERICAL_VERSION
from wingbeat.cli import main
from wingbeat.studies.engine import LocalProcesses
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS

pytestmark = pytest.mark.slow

PROGRAM = (
    "import sys; from wingbeat.studies.engine import LocalProcesses; "
    "LocalProcesses.work = 'tests.helpers.assumption_standin:solve'; "
    "from wingbeat.cli import main; sys.exit(main(sys.argv[1:]))"
)
# Seconds that a driver gets for what takes it a few on an idle machine: it starts a process for each study.
PATIENCE = 300
SAMPLE = ["paper", "assumptions", "--sets", "3", "--seed", "4", "--piece", "2", "--processes", "1"]


@pytest.fixture(autouse=True)
def cheap(monkeypatch):
    monkeypatch.setattr(LocalProcesses, "work", "tests.helpers.assumption_standin:solve")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), *sys.path]))


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(LocalProcesses, "work", "tests.helpers.assumption_standin:solve")
        patch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), *sys.path]))
        folder = tmp_path_factory.mktemp("whole")
        assert main([*SAMPLE, "-o", str(folder)]) == 0
    return folder


@pytest.fixture
def without_figure(monkeypatch):
    """Leave out the figure where another run of the same sample has drawn it and nothing is asked about it."""
    monkeypatch.setattr("wingbeat_evidence.paper.assumption_page.draw", lambda *given: None)
    monkeypatch.setattr("wingbeat_evidence.paper.assumption_page.save_figure", lambda *given: None)


@pytest.fixture
def start(forks):
    """Return what starts a driver, forked from a process that has imported it."""

    def started(folder, seconds):
        environment = os.environ | {"STANDIN_SECONDS": str(seconds)}
        pipes = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE}
        return forks.start(PROGRAM, [*SAMPLE, "-o", folder], env=environment, **pipes)

    return started


def wait_for(driver, folder, pattern):
    until = time.monotonic() + PATIENCE
    while not list(folder.glob(pattern)):
        assert driver.poll() is None, driver.communicate()[1]
        assert time.monotonic() < until
        time.sleep(0.02)


def test_a_run_writes_page_table_figure_and_pieces(whole):
    names = {path.name for path in whole.iterdir()}
    assert names == {"assumptions.md", "assumptions.csv", "assumptions.png", "assumptions.pdf", "pieces"}
    assert len(list((whole / "pieces").iterdir())) == 3  # two pieces, what they are of; no stores
    head, *rows = (whole / "pieces" / "piece-0001-of-0002.csv").read_text().splitlines()
    about = json.loads(head.removeprefix("# "))
    told = {key: about[key] for key in ("sets", "seed", "piece", "number", "numerical_version", "core_seconds")}
    expected = {"sets": 3, "seed": 4, "piece": 2, "number": 1, "core_seconds": 2 * 14 * 0.25}
    assert told == expected | {"numerical_version": NUMERICAL_VERSION}
    joined = (whole / "assumptions.csv").read_text().splitlines()
    assert joined[:3] == rows
    assert len(joined) == 4
    page = " ".join((whole / "assumptions.md").read_text().split())
    assert (
        f"`wingbeat paper assumptions --sets 3 --seed 4 --piece 2` (numerical version {NUMERICAL_VERSION})" in page
    )
    assert "The orbits took 0.0 core-hours, 3.50 s per set." in page
    certified = sum(int(row.split(",")[len(ASSUMPTIONS)]) for row in joined[1:])
    assert f"Of these orbits, {100 * certified / 42:.0f} % were found and certified" in page


@pytest.mark.usefixtures("without_figure")
def test_killed_interrupted_and_resumed_it_says_the_same(whole, tmp_path, start):
    driver = start(tmp_path, 0.1)
    wait_for(driver, tmp_path, "pieces/piece-0001-of-0002/bat-*.sqlite")
    driver.kill()
    driver.communicate()
    driver = start(tmp_path, 0.05)
    wait_for(driver, tmp_path, "pieces/piece-0001-of-0002.csv")
    wait_for(driver, tmp_path, "pieces/piece-0002-of-0002/*.sqlite")
    driver.send_signal(signal.SIGINT)
    _, err = driver.communicate(timeout=PATIENCE)
    assert driver.returncode == 130
    assert "stopping within a second" in err or err.endswith("error: interrupted\n")
    assert not (tmp_path / "assumptions.csv").exists()
    written = (tmp_path / "pieces" / "piece-0001-of-0002.csv").stat().st_mtime_ns
    assert not list(tmp_path.glob("pieces/*/*.sqlite-wal"))
    driver = start(tmp_path, 0.5)
    wait_for(driver, tmp_path, "pieces/*/*.sqlite-wal")  # it is at work again
    driver.send_signal(signal.SIGTERM)
    driver.communicate(timeout=PATIENCE)
    assert driver.returncode == 143
    assert main([*SAMPLE, "-o", str(tmp_path)]) == 0
    assert (tmp_path / "pieces" / "piece-0001-of-0002.csv").stat().st_mtime_ns == written
    for name in ("assumptions.csv", "assumptions.md"):
        assert (tmp_path / name).read_text() == (whole / name).read_text()


@pytest.mark.usefixtures("without_figure")
def test_pieces_of_two_machines_are_put_together(whole, tmp_path, capsys):
    assert main([*SAMPLE, "--only", "2", "-o", str(tmp_path)]) == 0
    assert "1 of 2 pieces are done; the page covers these" in " ".join(capsys.readouterr().err.split())
    page = (tmp_path / "assumptions.md").read_text()
    assert "s per set. So far, 1 of 2 pieces are done." in page
    assert "angles of attack. 1 sets of assumptions fill the ranges" in " ".join(page.split())
    assert "s per set." in page
    last = (whole / "assumptions.csv").read_text().splitlines()
    assert (tmp_path / "assumptions.csv").read_text().splitlines() == [last[0], last[-1]]
    shutil.copy(whole / "pieces" / "piece-0001-of-0002.csv", tmp_path / "pieces")
    assert main([*SAMPLE, "-o", str(tmp_path)]) == 0
    assert (tmp_path / "assumptions.csv").read_text() == (whole / "assumptions.csv").read_text()


@pytest.mark.parametrize("change", [("--seed", "5"), ("--sets", "4"), ("--piece", "3"), None])
def test_another_sample_in_the_folder_is_refused(whole, tmp_path, monkeypatch, capsys, change):
    folder = tmp_path / "here"
    shutil.copytree(whole, folder)
    words = [*SAMPLE, "-o", str(folder)]
    if change is None:
        monkeypatch.setattr("wingbeat_evidence.paper.pieces.NUMERICAL_VERSION", NUMERICAL_VERSION + 1)
    else:
        words[words.index(change[0]) + 1] = change[1]
    assert main(words) == 2
    err = capsys.readouterr().err
    assert "sample.json' belongs to another sample (--sets 3 --seed 4 --piece 2" in err
    assert (folder / "assumptions.csv").read_text() == (whole / "assumptions.csv").read_text()


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda text: text[: len(text) // 2], "remove the file to run the piece again"),
        (lambda text: "", "remove the file to run the piece again"),
        (lambda text: text.replace('"seed": 4', '"seed": 5'), "belongs to another sample"),
        (lambda text: text.replace('"number": 1', '"number": 2'), "another piece"),
        (lambda text: text.replace("wing_mass_share", "share"), "its columns do not match"),
    ],
)
def test_a_spoilt_or_foreign_piece_is_refused(whole, tmp_path, capsys, spoil, said):
    folder = tmp_path / "here"
    shutil.copytree(whole, folder)
    path = folder / "pieces" / "piece-0001-of-0002.csv"
    path.write_text(spoil(path.read_text()))
    assert main([*SAMPLE, "-o", str(folder)]) == 2
    assert said in capsys.readouterr().err
