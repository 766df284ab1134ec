"""Studies of cheap points run by the real program, and ways to disturb it."""

import os
import sqlite3
import subprocess
import sys
import time
import uuid
from pathlib import Path

import pytest

from tests.helpers.places import ROOT
from wingbeat.cli import main
from wingbeat.studies.engine import LocalProcesses

PROGRAM = (
    "import sys; from wingbeat.studies.engine import LocalProcesses; "
    "LocalProcesses.work = 'tests.helpers.study_standin:solve'; "
    "from wingbeat.cli import main; sys.exit(main(['study', *sys.argv[1:]]))"
)
FORM = 'species = "pigeon"\nstarts = 1\n[vary]\nspeed = {{ grid = {speeds} }}\n'


class Cheap:
    """A study file in a folder of its own, of points that a stand-in solves in no time."""

    def __init__(self, folder, speeds, capsys, forks):
        self.capsys = capsys
        self.forks = forks
        self.folder = folder
        self.file = folder / "cheap.toml"
        self.store = folder / "cheap.study.sqlite"
        self.mark = uuid.uuid4().hex
        self.write(speeds)

    def write(self, speeds):
        self.file.write_text(FORM.format(speeds=[float(u) for u in speeds]))

    def start(self, *words, program=PROGRAM, seconds=0.0, log=None, env=None, **popen):
        """Start the program, forked from one that has imported it; its workers carry this study's mark."""
        environment = os.environ | (env or {}) | {"STANDIN_SECONDS": str(seconds), "STUDY_MARK": self.mark}
        environment["PYTHONPATH"] = os.pathsep.join([str(ROOT), *sys.path])
        if log is not None:
            environment["STANDIN_LOG"] = str(log)
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | popen
        return self.forks.start(program, words, env=environment, **streams)

    def run(self, *words):
        """Run the program to its end, in this process; return exit code, stdout and stderr, blanks as one."""
        self.capsys.readouterr()
        code = main(["study", *map(str, words or ("run", self.file, "-j", 1))])
        return code, *(" ".join(text.split()) for text in self.capsys.readouterr())

    def processes(self):
        """Return the ids of living processes with this study's mark."""
        found = []
        for entry in Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and f"STUDY_MARK={self.mark}".encode() in (entry / "environ").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                pass
        return found

    def wait_gone(self):
        """Wait until nothing of it runs any more."""
        until = time.monotonic() + 15
        while self.processes():
            assert time.monotonic() < until, "processes were left behind"
            time.sleep(0.02)

    def points(self):
        """Return everything that is kept of each point but bookkeeping, by key; empty before there is a store."""
        if not self.store.exists() or not self.store.stat().st_size:
            return {}
        connection = sqlite3.connect(self.store)
        try:
            question = "SELECT key, status, base, changes, record, certificate, error FROM points"
            return {key: row for key, *row in connection.execute(question)}
        except sqlite3.OperationalError:
            return {}
        finally:
            connection.close()


@pytest.fixture
def cheap(tmp_path, capsys, monkeypatch, forks):
    """Return a maker of cheap studies, each in a folder of its own."""
    monkeypatch.setattr(LocalProcesses, "work", "tests.helpers.study_standin:solve")

    def make(speeds, name="here"):
        folder = tmp_path / name
        folder.mkdir(exist_ok=True)
        return Cheap(folder, speeds, capsys, forks)

    return make
