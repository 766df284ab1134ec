"""Programs on disk: what is damaged, planted or open to others is not run, and nothing is lost but time."""

import os
import pickle
import random
import shlex
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from wingbeat._jax import config
from wingbeat._jax.config import keep_program, kept_program, program_folder

pytestmark = pytest.mark.skipif(os.name != "posix", reason="owners and modes of POSIX")
NOT_KEPT = "warning: compiled programs are not kept ("


# Traces and compiles a little, twice, the second time without what the process itself remembers.
LITTLE = """
import os, sys, jax
from wingbeat._jax.exported import exported
from wingbeat._jax.config import cache_folder
def cube(x):
    return x * x * x
def held():
    paths = sorted(cache_folder().glob("programs-*/*"))
    return [(path.name, path.read_bytes()) for path in paths]
print(float(exported(cube)(1.7)))
after = held()
jax.clear_caches()
print(float(exported(cube)(1.7)), held() == after)
"""
OF_LITTLE = "4.912999999999999\n4.912999999999999 True\n"


def little(cache: Path | str) -> tuple[str, str]:
    """Run a program that traces and compiles a little, with its cache there; return stdout and stderr."""
    return run(cache, "-c", LITTLE)


def run(cache: Path | str, *words: str) -> tuple[str, str]:
    command = f"umask 0; exec {shlex.join([sys.executable, '-W', 'error', *words])}"
    ended = subprocess.run(
        ["bash", "-c", command],
        env={**os.environ, "WINGBEAT_CACHE": str(cache)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr
    return ended.stdout, ended.stderr


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A cache that was filled, and what was printed."""
    cache = tmp_path_factory.mktemp("cache")
    out, err = little(cache)
    assert (out, err) == (OF_LITTLE, "")
    return cache / f"programs-{os.geteuid()}", out


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_it_is_the_users_own_whatever_the_umask(first: tuple[Path, str]) -> None:
    found = os.stat(first[0])
    assert stat.S_IMODE(found.st_mode) == 0o700
    assert found.st_uid == os.geteuid()
    assert {name.partition("-")[0] for name in contents(first[0])} == {"traced", "compiled"}


@pytest.mark.slow
@pytest.mark.parametrize("damage", ["bits", "short", "swapped", "pickles"])
def test_what_is_damaged_is_made_anew(first: tuple[Path, str], damage: str, tmp_path: Path) -> None:
    folder, out = first
    whole = contents(folder)
    chance = random.Random(damage)
    names = sorted(whole)
    mark = tmp_path / "executed"
    for name, other in zip(names, names[1:] + names[:1], strict=True):
        content = bytearray(whole[name])
        if damage == "bits":
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
        elif damage == "short":
            del content[chance.randrange(len(content)) :]
        elif damage == "swapped":  # whole, but of another program
            content[:] = whole[other]
        else:
            content[:] = pickle.dumps(_Executes(mark))
        (folder / name).write_bytes(content)
    assert little(folder.parent) == (out, "")  # the second time all was read: nothing was written again
    assert not mark.exists()
    now = contents(folder)
    assert sorted(now) == names
    assert all(now[name][:19] == b"wingbeat program 1\n" for name in names)


class _Executes:
    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self):
        return os.mkdir, (str(self.mark),)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can plant files of others")
def test_what_another_user_planted_is_not_read(first: tuple[Path, str], tmp_path: Path) -> None:
    folder, out = first
    place = tmp_path / folder.name
    place.mkdir()
    for name, content in contents(folder).items():
        (place / name).write_bytes(content)
        os.utime(place / name, (1, 1))
        os.chown(place / name, 12345, -1)
    assert little(tmp_path) == (out, "")  # the folder is the user's, its files are not: all made anew
    assert {path.name for path in place.iterdir() if path.stat().st_mtime <= 1} == set()
    os.chown(place, 12345, -1)
    before = contents(place)
    told = little(tmp_path)
    assert told[0] == out
    assert told[1].startswith(
        f"{NOT_KEPT}{str(place)!r} belongs to another user), so every start takes longer; set "
    )
    assert contents(place) == before


def test_a_folder_that_was_open_to_others_is_moved_aside(first: tuple[Path, str], tmp_path: Path) -> None:
    place = tmp_path / first[0].name
    place.mkdir()
    (place / "planted").write_bytes(b"")
    place.chmod(0o777)
    assert little(tmp_path) == (first[1], "")
    assert stat.S_IMODE(place.stat().st_mode) == 0o700
    assert not (place / "planted").exists()
    (aside,) = (path for path in tmp_path.iterdir() if path != place)
    assert [path.name for path in aside.iterdir()] == ["planted"]


@pytest.mark.slow
@pytest.mark.parametrize("trouble", ["no folder can be made", "a file", "a link"])
def test_without_a_folder_it_works_and_says_so(first: tuple[Path, str], trouble: str, tmp_path: Path) -> None:
    place = tmp_path / first[0].name
    if trouble == "a file":
        place.write_text("")
    elif trouble == "a link":
        place.symlink_to(first[0])
    out, err = little("/proc/nowhere" if trouble == "no folder can be made" else tmp_path)
    assert out == first[1]
    (line,) = err.splitlines()
    assert line.startswith(NOT_KEPT)
    assert line.endswith("set WINGBEAT_CACHE to a folder of your own")


def test_who_has_no_home_has_no_folder(monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture) -> None:
    def nobody(number: int) -> None:
        raise KeyError(number)

    for name in ("WINGBEAT_CACHE", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("pwd.getpwuid", nobody)
    assert program_folder() is None
    keep_program("compiled-x", b"x")
    assert kept_program("compiled-x") is None
    (told,) = caplog.messages
    assert told.startswith(NOT_KEPT)


def aged(folder: Path, ages: dict[str, float], size: int = 1000) -> None:
    """Put files into a folder that were last used so many days ago."""
    for name, days in ages.items():
        (folder / name).write_bytes(bytes(size))
        used = time.time() - 86400 * days
        os.utime(folder / name, times=(used, used))


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of an empty cache; every written program has the folder looked through."""
    monkeypatch.setenv("WINGBEAT_CACHE", str(tmp_path))
    monkeypatch.setattr(config, "_written", iter([0] * 100))
    folder = program_folder()
    assert folder is not None
    return folder


def test_programs_that_nobody_uses_are_deleted_and_other_files_stay(cache: Path) -> None:
    aged(
        cache,
        {"traced-old": 91, "compiled-old": 200, "compiled-new": 89, "notes.txt": 400, ".0123456789ab.part": 2},
    )
    (cache / "compiled-folder").mkdir()
    (cache / "compiled-link").symlink_to(cache / "notes.txt")
    os.utime(cache / "compiled-link", times=(0, 0), follow_symlinks=False)
    keep_program("traced-now", b"program")
    left = {"compiled-new", "notes.txt", "compiled-folder", "compiled-link", "traced-now"}
    assert {path.name for path in cache.iterdir()} == left


def test_a_large_cache_loses_what_was_used_longest_ago(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(config, "KEPT_BYTES", 4500)
    keep_program("traced-used", b"program")
    aged(cache, {f"compiled-{days}": days for days in range(2, 10)})
    os.utime(cache / "traced-used", times=(0, time.time() - 86400 * 20))
    assert kept_program("traced-used") == b"program"  # which is noted
    keep_program("traced-now", b"program")
    left = {"traced-used", "traced-now", "compiled-2", "compiled-3", "compiled-4", "compiled-5"}
    assert {path.name for path in cache.iterdir()} == left


def test_a_program_that_is_deleted_in_use_is_made_again(tmp_path: Path) -> None:
    """Processes fill, read and empty a cache of one byte at the same time."""
    program = "import wingbeat._jax.config as c; c.KEPT_BYTES, c._LOOKED = 1, 1" + LITTLE
    command = [sys.executable, "-W", "error", "-c", program.replace("held() == after", "True")]
    settings = {**os.environ, "WINGBEAT_CACHE": str(tmp_path)}
    several = [subprocess.Popen(command, env=settings, stdout=subprocess.PIPE, text=True) for _ in range(2)]
    assert [process.communicate(timeout=60)[0] for process in several] == [OF_LITTLE] * 2
    assert not list(tmp_path.glob("programs-*/*"))
