"""The process: streams that are closed or full, Ctrl-C, forks, too little memory, arguments of any length."""

import os
import random
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from typing import Any

import pytest
from interrupts import COMMANDS, interrupt, of_python, wingbeat, write_texts

from wingbeat import __version__
from wingbeat.cli import main

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals and limits of POSIX")
PROGRAM = f"{sys.executable} -W error -m wingbeat"


def shell(line: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """Run a line of the shell, in which WB is the program."""
    return subprocess.run(
        ["bash", "-c", line.replace("WB", PROGRAM)], capture_output=True, text=True, check=False, **options
    )


def script(tmp_path: Path, text: str) -> list[str]:
    """Return the command that runs a script."""
    path = tmp_path / "script.py"
    path.write_text(textwrap.dedent(text))
    return [sys.executable, str(path)]


def test_python_m_is_the_program():
    ended = shell("WB --version; WB specis")
    assert ended.stdout.strip() == __version__
    assert ended.stderr.startswith("error: unknown command 'specis'")


# --- streams ---


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "code", "err"),
    [
        ("WB species >/dev/full", 1, "error: cannot write to standard output: no space left on device\n"),
        ("WB --help >/dev/full", 1, "error: cannot write to standard output: no space left on device\n"),
        ("WB species --json >&-", 1, "error: cannot write to standard output: bad file descriptor\n"),
        ("WB species pigon >&-", 2, "error: species = 'pigon': is not a built-in species; did you mean pigeon; or"),
        ("WB species 2>&- | tail -1; exit ${PIPESTATUS[0]}", 0, ""),
        ("WB specis 2>&-", 2, ""),
        ("WB specis 2>/dev/full", 2, ""),
        ("WB specis <&- >&- 2>&-", 2, ""),
        ("WB species --json | :; exit ${PIPESTATUS[0]}", 141, ""),
    ],
)
def test_streams_that_take_nothing(line: str, code: int, err: str) -> None:
    ended = shell(line)
    assert ended.returncode == code, ended
    assert ended.stderr.startswith(err)
    assert len(ended.stderr.splitlines()) == bool(err)


def test_what_is_read_does_not_land_in_a_closed_stream(tmp_path: Path) -> None:
    """The first file opened would else become standard output and hold what is printed."""
    ended = shell("WB species new mine.toml >&-", cwd=tmp_path)
    assert "wrote" not in (tmp_path / "mine.toml").read_text()
    assert shell("WB species mine.toml", cwd=tmp_path).returncode == 0
    assert "Traceback" not in ended.stderr


# --- signals ---


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, pigeon_orbit: Any) -> Path:
    path = tmp_path_factory.mktemp("interrupted")
    write_texts(path)
    pigeon_orbit.orbit.save(path / "flight.nc")
    return path


@pytest.mark.slow
@pytest.mark.parametrize("command", ["orbit", "curve", "study", "view"])
def test_one_interrupt_ends_it_at_any_time(folder: Path, command: str) -> None:
    """In its imports, and at work; benchmarks/interrupts.py tries every command a hundred times."""
    words, horizon = COMMANDS[command]
    chance = random.Random(command)
    for soonest, latest in ((0.3, 2.0), (2.0, 0.7 * horizon)):
        ending = interrupt(wingbeat(words), folder, chance.uniform(soonest, latest))
        if ending.code is None or of_python(ending):
            continue
        assert (ending.code, ending.fault) == (130, "")
        assert ending.seconds < 2.0


HOOK = """
import os, signal, sys
class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupt())
from wingbeat.cli import program
sys.argv[1:] = ["orbit", "pigeon", "--speed", "12"]
sys.exit(program())
"""


@pytest.mark.slow
@pytest.mark.parametrize("module", ["cyclopts", "numpy", "jaxlib", "scipy.optimize", "wingbeat.orbits.solve"])
def test_an_interrupt_within_an_import(tmp_path: Path, module: str) -> None:
    ended = subprocess.run(
        script(tmp_path, HOOK.format(module=module)), capture_output=True, text=True, check=False
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "error: interrupted\n")


PROBE = """
import ctypes, os, signal, sys, time, weakref
import wingbeat.cli.app
from wingbeat.cli import program
from wingbeat._base import writing

class Thing: pass

def in_a_callback(argv, app):
    thing = Thing()
    weakref.finalize(thing, os.kill, os.getpid(), signal.SIGINT)
    del thing
    time.sleep(20)

def in_compiled_code(argv, app):
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # another thread hears it
    os.kill(os.getpid(), signal.SIGINT)
    ctypes.CDLL(None).sleep(20)

def while_writing(argv, app):
    with writing("out.nc") as beside:
        beside.write_text("half")
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(20)

def twice(argv, app):
    os.kill(os.getpid(), signal.SIGINT)
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(20)

wingbeat.cli.app._run = globals()[sys.argv[1]]
sys.exit(program())
"""


@pytest.mark.parametrize(
    ("place", "code", "word"),
    [
        ("in_a_callback", 130, "interrupted"),
        ("in_compiled_code", 130, "interrupted"),
        ("while_writing", 143, "terminated"),
        ("twice", 130, "interrupted"),
    ],
)
def test_a_signal_in_odd_places(tmp_path: Path, place: str, code: int, word: str) -> None:
    command = [*script(tmp_path, PROBE), place]
    begun = time.perf_counter()
    ended = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (code, "", f"error: {word}\n")
    assert time.perf_counter() - begun < 15.0
    assert [path.name for path in tmp_path.iterdir()] == ["script.py"]


POOL = """
import time
from wingbeat.cli.process import end_on_signals

if __name__ == "__main__":
    end_on_signals()
    from wingbeat._workers.pool import in_processes

    list(in_processes(time.sleep, [60.0, 60.0], 2))
"""


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("after", [1.0, 5.0])
def test_processes_of_a_pool_leave_with_it(tmp_path: Path, number: int, after: float) -> None:
    """In their imports, and at work; nothing is printed by them nor by Python's tracker of semaphores."""
    command = script(tmp_path, POOL)
    ending = interrupt(command, tmp_path, after, number)
    assert ending.code == (-number if number == signal.SIGKILL else 128 + number)
    if number != signal.SIGKILL:  # which leaves the parent no time to tidy up
        assert ending.fault == ""
        assert ending.seconds < 2.0
    assert "left processes" not in ending.fault


def test_who_was_started_deaf_to_interrupts_stays_so(tmp_path: Path) -> None:
    text = "import signal, sys\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\n" + HOOK.format(module="cyclopts")
    command = script(tmp_path, text.replace('["orbit", "pigeon", "--speed", "12"]', '["--version"]'))
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout.strip()) == (0, __version__)


# --- forks ---

FORK = """
import multiprocessing, warnings
import wingbeat as wb

def solve(speed):
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=speed), starts=1).status.value

if __name__ == "__main__":
    warnings.simplefilter("ignore")  # JAX's own, at the fork
    with multiprocessing.get_context("fork").Pool(1) as pool:
        if {before}:
            print(pool.apply_async(solve, [12.0]).get(300))
    print(solve(12.0))
    with multiprocessing.get_context("fork").Pool(1) as pool:
        try:
            print(pool.apply_async(solve, [11.0]).get(60))
        except wb.ForkError as error:
            print(error)
    print(solve(11.0))
"""


@pytest.mark.slow
def test_a_fork_after_a_solve_is_refused_with_the_cure(tmp_path: Path) -> None:
    ended = subprocess.run(script(tmp_path, FORK.format(before=False)), capture_output=True, text=True, check=False)
    lines = ended.stdout.splitlines()
    assert lines[::2] == ["converged", "converged"], ended.stderr
    assert "forked from one that had run JAX" in lines[1]
    for cure in ("'spawn'", "'forkserver'", "wb.solve_orbits(problems, processes=N)"):
        assert cure in lines[1]


# --- memory ---


@pytest.mark.skipif(sys.platform != "linux", reason="no limit on address space")
@pytest.mark.parametrize(
    ("limit", "words", "needs"),
    [
        (300_000, "orbit pigeon --speed 12", "orbit needs"),
        (1_000_000, "orbit pigeon --speed 12", "orbit needs"),
        (1_600_000, "curve pigeon --speeds 8:10:1", "curve needs"),
        (250_000, "species", "species needs"),
    ],
)
def test_too_little_memory_is_one_line(limit: int, words: str, needs: str) -> None:
    ended = shell(f"ulimit -v {limit}; WB {words}", timeout=60)
    assert (ended.returncode, ended.stdout) == (1, "")
    (line,) = ended.stderr.splitlines()
    assert line.startswith(f"error: memory is limited to {limit * 1024 / 1e9:.2g} GB of address space")
    assert needs in line
    assert "raise the limit with `ulimit -v " in line


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="no limit on address space")
def test_the_memory_that_is_asked_for_is_enough() -> None:
    line = shell("ulimit -v 1000000; WB orbit pigeon --speed 12").stderr
    limit = line.rpartition("ulimit -v ")[2].strip("`\n")
    ended = shell(f"ulimit -v {limit}; WB orbit pigeon --speed 12")
    assert (ended.returncode, ended.stderr) == (0, "")


def test_running_out_of_memory_is_one_line(monkeypatch: pytest.MonkeyPatch, capsys: Any) -> None:
    def run(*_: Any) -> int:
        raise MemoryError

    monkeypatch.setattr("wingbeat.cli.app._run", run)
    assert main(["orbit"]) == 1
    assert (
        capsys.readouterr().err
        == "error: there is not enough memory; close other programs or choose a smaller problem\n"
    )


# --- arguments ---


@pytest.mark.parametrize(
    "words",
    [
        "orbit pigeon --speed 12 -o",
        "orbit pigeon --speed 12 --plot",
        "orbit pigeon --speed 12 --aero",
        "orbit pigeon --speed 12 --set",
        "curve pigeon --speeds",
        "simulate pigeon -o",
        "glide pigeon -o",
        "fit table.csv -o",
        "paper -o",
        "study",
        "species",
        "show",
        "app --no-open --host",
    ],
)
@pytest.mark.parametrize("value", ["a\0b.nc", "a\0b.toml", "x" * 9_000 + ".csv", "7" * 70_000, "[" * 9_000])
def test_nuls_and_long_values_are_refused_in_a_line(
    words: str, value: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    code = main([*words.split(), value])
    told = capsys.readouterr()
    (line,) = told.err.splitlines()
    assert (code, told.out) == (2, "")
    assert line.startswith("error: ")
    assert line.isprintable()
    assert len(line) < 650
    assert list(tmp_path.iterdir()) == []
