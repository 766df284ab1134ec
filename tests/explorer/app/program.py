"""``wingbeat app`` as the real program, and pages of it that are no browser's."""

import contextlib
import http.client
import os
import re
import signal
import socket
import subprocess
import time
from pathlib import Path

from websockets.sync.client import connect

from tests.helpers.forks import ForkServer

RUN = "import sys; from wingbeat.cli import program; sys.exit(program())"
PATIENCE = 60.0


class Program:
    """A server of its own, with what it wrote.

    Parameters
    ----------
    forks : starts it.
    folder : for its stderr.
    words : further options.
    """

    def __init__(self, forks: ForkServer, folder: Path, *words: str) -> None:
        self.log = folder / "stderr"
        with open(self.log, "w") as log:
            every = ["app", "--port", "0", "--no-open", "--processes", "1", *words]
            self.process = forks.start(RUN, every, stdout=subprocess.PIPE, stderr=log)
        self.line = self.process.stdout.readline()
        found = re.search(r"http://(\S+):(\d+)", self.line)
        if found is None:
            self.end()
            raise AssertionError(self.line + self.log.read_text())
        self.host, self.port = found[1], int(found[2])

    def request(self, path, method="GET", body=None, **headers):
        """Return status and text of an answer."""
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        line.request(method, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
        answer = line.getresponse()
        text = answer.read().decode()
        line.close()
        return answer.status, text

    def open_page(self, query="species=pigeon&speed=10&starts=1"):
        """Fetch a page as curl does; return the names of its client and of its session."""
        status, text = self.request(f"/?{query}")
        assert status == 200
        return (
            re.search(r"'client_id': '([^']+)'", text)[1],
            re.search(r"upload\(event.target, \W+([\w-]{16})", text)[1],
        )

    @contextlib.contextmanager
    def connect(self, client, host="127.0.0.1", origin=None):
        """Open the socket of a page, as its script does."""
        query = f"client_id={client}&next_message_id=0&implicit_handshake=true&tab_id=t&document_id=d"
        address = f"ws://{host}:{self.port}/_nicegui_ws/socket.io/?{query}&EIO=4&transport=websocket"
        line = socket.create_connection(("127.0.0.1", self.port))  # whatever the name
        with connect(address, sock=line, origin=origin, max_size=None, open_timeout=PATIENCE) as page:
            assert page.recv(PATIENCE).startswith("0")
            page.send("40")
            assert page.recv(PATIENCE).startswith("40")
            yield page

    def workers(self):
        """Return the numbers of the processes that the server started."""
        own = []
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            except OSError:
                continue
            if int(parent) == self.process.pid and state != "Z":
                own.append(int(folder.name))
        return own

    def interrupt(self):
        """Send Ctrl-C; return the exit code and the seconds it took."""
        begun = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE), time.monotonic() - begun

    def end(self):
        """End it whatever it does."""
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


def is_gone(pid):
    """Return whether a process has ended, be it buried or not."""
    try:
        os.kill(pid, 0)
        return (Path("/proc") / str(pid) / "stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def wait_gone(pids):
    """Wait until these processes have ended."""
    until = time.monotonic() + PATIENCE
    while not all(map(is_gone, pids)):
        assert time.monotonic() < until, "processes were left behind"
        time.sleep(0.02)
