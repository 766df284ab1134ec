"""Programs forked from one process that has imported what they need, where every start would import for seconds.

Each is a process of its own, with the arguments, environment and streams that it was given, and ends by itself.
Only what is in ``/proc/PID/environ`` is not its own.
"""

import json
import os
import select
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress

from tests.helpers.places import ROOT

# What has no threads yet may be forked. A nurse between the two says which process it is and how it ended.
SERVER = """
import gc, importlib, json, os, signal, socket, sys

line, *modules = sys.argv[1:]
for module in modules:
    importlib.import_module(module)
assert len(os.listdir("/proc/self/task")) == 1, "what was imported has started threads"
line = socket.socket(fileno=int(line))
nurses = []
gc.freeze()
while True:
    asked, fds, *_ = socket.recv_fds(line, 1 << 20, 3)
    nurses = [nurse for nurse in nurses if os.waitpid(nurse, 0 if not asked else os.WNOHANG)[0] == 0]
    if not asked:
        sys.exit()
    if not (nurse := os.fork()):
        break
    nurses.append(nurse)
    for fd in fds:
        os.close(fd)
line.close()
out, err, status = fds
pid = os.fork()
if pid:
    os.close(out)
    os.close(err)
    os.write(status, b"%d\\n" % pid)
    ended = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    os.write(status, b"%d\\n" % ended)
    os._exit(0)
os.close(status)
os.dup2(out, 1)
os.dup2(err, 2)
os.close(out)
os.close(err)
# As at a terminal: a run of the tests in the background ignores Ctrl-C, and all that it starts would.
signal.signal(signal.SIGINT, signal.default_int_handler)
asked = json.loads(asked)
os.chdir(asked["folder"])
os.environ.clear()
os.environ.update(asked["environment"])
sys.argv[:] = ["-c", *asked["words"]]
exec(asked["program"])
"""


class ForkServer:
    """The process that is forked: started when it is first needed, it leaves with its owner.

    Parameters
    ----------
    modules : that it imports, and with them what they import.
    """

    def __init__(self, *modules):
        self.modules = modules
        self.line, self.process = None, None

    def start(self, program, words, *, stdout, stderr, env=None, cwd=None, text=True):
        """Start a program as ``python -c PROGRAM WORDS`` would, and return what is like its `Popen`."""
        assert text, "pipes hold text"
        if self.process is None:
            self.line, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            place, paths = theirs.fileno(), os.pathsep.join([str(ROOT), *sys.path])
            with theirs:
                self.process = subprocess.Popen(
                    [sys.executable, "-c", SERVER, str(place), *self.modules],
                    pass_fds=[place],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    env=os.environ | {"PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"},
                )
        asked = {"program": program, "words": [str(word) for word in words], "folder": str(cwd or os.getcwd())}
        return Forked(self.line, asked | {"environment": dict(env or os.environ)}, stdout, stderr)

    def close(self):
        """Have it end."""
        if self.process is not None:
            self.line.close()
            self.process.wait()


class Forked:
    """A program that was forked, with what tests use of `subprocess.Popen`."""

    def __init__(self, line, asked, stdout, stderr):
        self.returncode = None
        reading, status = os.pipe()
        self._status = os.fdopen(reading)
        self.stdout, out = self._opened(stdout)
        self.stderr, err = self._opened(stderr)
        socket.send_fds(line, [json.dumps(asked).encode()], [out, err, status])
        for own in (out, err, status):
            os.close(own)
        self.pid = int(self._status.readline())

    @staticmethod
    def _opened(given):
        """Return what is read here, if it is a pipe, and what is written there."""
        if given == subprocess.DEVNULL:
            return None, os.open(os.devnull, os.O_WRONLY)
        if given != subprocess.PIPE:
            return None, os.dup(given if isinstance(given, int) else given.fileno())
        reading, writing = os.pipe()
        return os.fdopen(reading), writing

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for pipe in filter(None, (self.stdout, self.stderr)):
            pipe.close()
        self.wait()

    def wait(self, timeout=None):
        """Return the exit code, once there is one."""
        if self.returncode is None:
            if not select.select([self._status], [], [], timeout)[0]:
                raise subprocess.TimeoutExpired(f"process {self.pid}", timeout)
            self.returncode = int(self._status.readline())
            self._status.close()
        return self.returncode

    def poll(self):
        """Return the exit code, or None if it still runs."""
        try:
            return self.wait(0)
        except subprocess.TimeoutExpired:
            return None

    def communicate(self, timeout=None):
        """Return what it writes until it ends."""
        told = {}

        def read(name, pipe):
            with pipe:
                told[name] = pipe.read()

        pipes = {name: pipe for name in ("out", "err") if (pipe := getattr(self, f"std{name}"))}
        readers = [threading.Thread(target=read, args=item, daemon=True) for item in pipes.items()]
        for reader in readers:
            reader.start()
        self.wait(timeout)
        for reader in readers:
            reader.join(timeout)
        return told.get("out"), told.get("err")

    def send_signal(self, number):
        """Send it a signal unless it has ended."""
        if self.poll() is None:
            with suppress(ProcessLookupError):  # it ended in between
                os.kill(self.pid, number)

    def kill(self):
        """End it now."""
        self.send_signal(signal.SIGKILL)
