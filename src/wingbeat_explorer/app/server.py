"""The server: where it listens, and how it begins and ends."""

from __future__ import annotations

import asyncio
import socket
import sys
import threading
import webbrowser

import uvicorn

from wingbeat._base import Fault, InvalidInputError, system_reason
from wingbeat._leftovers import Leftover
from wingbeat_explorer.app.door import is_loopback
from wingbeat_explorer.app.house import House
from wingbeat_explorer.app.site import build

_LOOPBACK = "127.0.0.1"
# Most bytes of the head of a request. A longer head is cut off without an answer; a shorter one gets an answer,
# even if its link is too long.
_LONGEST_HEAD = 1 << 20
# Seconds that browsers have to close their connections when the server ends; a suspended one never closes its own.
_FAREWELL = 0.2


class _Server(uvicorn.Server):
    """A server that does not wait for open connections when it ends."""

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Close the connection to every browser; drop those that browsers still leave open shortly afterwards."""
        asyncio.get_running_loop().call_later(_FAREWELL, self._hang_up)
        await super().shutdown(sockets)

    def _hang_up(self) -> None:
        for connection in list(self.server_state.connections):
            if (transport := getattr(connection, "transport", None)) is not None:
                transport.abort()


def serve(host: str, port: int, processes: int, opens: bool) -> None:
    """Serve the explorer until it is interrupted.

    Parameters
    ----------
    host, port : where to listen. An empty host accepts this machine only; port 0 takes any free port.
    processes : worker processes.
    opens : whether a browser is opened.

    Raises
    ------
    InvalidInputError : the address cannot be opened.
    KeyboardInterrupt : it was interrupted.
    """
    host = host.strip() or _LOOPBACK  # to the system, an empty host means every address
    try:
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        listening = socket.create_server((host, port), family=family)
    except (OSError, TypeError, UnicodeError, ValueError) as error:  # the last three: impossible host names
        rule = f"cannot be opened: {system_reason(error)}"
        raise InvalidInputError([Fault("--host, --port", f"{host}:{port}", rule, "try --port 0")]) from None
    house = House(processes)
    with Leftover(house.close):  # the server ends by raising the signal again that stopped it
        try:
            address = _announce(host, listening)
            if opens:
                clock = threading.Timer(1.0, webbrowser.open, [address])
                clock.daemon = True
                clock.start()
            _Server(configure(house, host)).run(sockets=[listening])
        finally:
            house.close()
    # Only a signal ends the server, which then raises this signal again. On a busy machine the signal is sometimes
    # lost.
    raise KeyboardInterrupt


def _announce(host: str, listening: socket.socket) -> str:
    """Print where the server listens, and warn if other machines can reach it; return the address to open."""
    bound, port = listening.getsockname()[:2]
    # A browser cannot open "every address"; it can open this machine's own address.
    shown = {"0.0.0.0": _LOOPBACK, "::": "::1"}.get(bound, host)
    address = f"http://[{shown}]:{port}" if ":" in shown else f"http://{shown}:{port}"
    print(f"wingbeat explorer: {address} (Ctrl-C ends it)", flush=True)
    if not is_loopback(bound):
        where = "every address of this machine" if shown != host else f"{host}, a public address"
        print(
            f"warning: the explorer listens on {where}. Anyone who reaches it can use this machine's processors: "
            "there are no passwords. Without --host, only this machine can reach it.",
            file=sys.stderr,
            flush=True,
        )
    return address


def configure(house: House, host: str) -> uvicorn.Config:
    """Return the configuration with which the web application is served."""
    return uvicorn.Config(
        build(house, host),
        http="h11",
        h11_max_incomplete_event_size=_LONGEST_HEAD,
        log_level="warning",
        ws_max_size=1 << 20,
        timeout_graceful_shutdown=1,
    )
