"""The web application and its server: the page, its few files, uploads and downloads, and where it listens."""

from __future__ import annotations

import asyncio
import contextlib
import json
import secrets
import socket
import sys
import threading
import webbrowser
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

import uvicorn
from fastapi import FastAPI, Request, Response
from nicegui import Client, core, ui
from starlette.requests import ClientDisconnect

from wingbeat._base import Fault, InvalidInputError, system_reason
from wingbeat._leftovers import Leftover
from wingbeat_explorer.app.door import Door, guard_events, is_loopback
from wingbeat_explorer.app.face_element import BUNDLE, DOWNLOADS, READY
from wingbeat_explorer.app.first import First
from wingbeat_explorer.app.jobs import MOST_BYTES, clean_label
from wingbeat_explorer.app.pages import House
from wingbeat_explorer.app.speed_curve import drawn
from wingbeat_explorer.folder import explorer_script

_HEADERS = {
    # Nothing is fetched from elsewhere, and no page of another site frames this page.
    "content-security-policy": "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'; object-src 'none'",
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
}
_HEAD = """<link rel="stylesheet" href="/wingbeat/page.css"><script src="/wingbeat/page.js"></script>
<script src="/wingbeat/explorer.js" defer></script>"""
_ICON = "🐦"
# Seconds that a page may be silent, on a busy machine or a train, before it is taken to be gone.
_PATIENCE = 30.0
_LOOPBACK = "127.0.0.1"
# Most bytes of the head of a request. A longer head is cut off without an answer; a shorter one gets an answer,
# even if its link is too long.
_LONGEST_HEAD = 1 << 20
# Seconds that browsers have to close their connections when the server ends; a suspended one never closes its own.
_FAREWELL = 0.2


def build(house: House, host: str) -> Any:
    """Return the web application."""

    @contextlib.asynccontextmanager
    async def life(_: FastAPI) -> AsyncIterator[None]:
        yield

    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None, lifespan=life)
    _add_files(app, house)

    @app.post("/wingbeat/upload/{session}")
    async def upload(session: str, request: Request) -> Response:
        return await _take(house, session, request)

    @ui.page("/", title="wingbeat explorer")
    def page(request: Request, client: Client) -> None:
        ui.add_head_html(_HEAD)
        house.open_page(client, request.url.query)

    guard_events()
    core.app.config.socket_io_js_transports = ["websocket"]  # what the door lets in
    ui.run_with(
        app,
        title="wingbeat explorer",
        favicon=_ICON,
        dark=None,
        language="en-US",
        tailwind=False,
        reconnect_timeout=_PATIENCE,
    )

    @app.middleware("http")
    async def with_headers(request: Request, call_next: Any) -> Response:
        response = await call_next(request)
        response.headers.update(_HEADERS)
        return response

    app.add_middleware(Door, host=host)
    return app


def _add_files(app: FastAPI, house: House) -> None:
    """Serve the page's own few files and the downloads."""
    here = Path(__file__).parent
    script, style = ((here / name).read_bytes() for name in ("page.js", "page.css"))
    fixed = {
        "/wingbeat/page.js": (script, "text/javascript"),
        "/wingbeat/page.css": (style, "text/css"),
        BUNDLE: (explorer_script(), "text/javascript"),
        READY: (_face_of(house.first), "application/json"),
    }
    for path, (content, kind) in fixed.items():
        app.add_api_route(path, _fixed(content, kind))

    @app.get(DOWNLOADS + "{name}")
    def fetch(name: str) -> Response:
        download = house.downloads.get(name)
        if download is None:
            return Response("This is no longer available; request it again.", 404, media_type="text/plain")
        headers = {"cache-control": "no-store"}
        if download.name:
            headers["content-disposition"] = f'attachment; filename="{download.name}"'
        return Response(download.content, media_type=download.kind, headers=headers)


def _fixed(content: bytes, kind: str) -> Callable[[], Response]:
    # Not a lambda with defaults: FastAPI takes those for parameters of the address.
    return lambda: Response(content, media_type=kind)


def _face_of(first: First) -> bytes:
    """Return what the browser shows of the first flight: its face and its curve."""
    curve = json.dumps(drawn(first.scenario, first.points, first.answer, first.answer["measured"]))
    return f'{{"answer": {first.answer["face"]}, "curve": {curve}}}'.encode()


async def _take(house: House, session: str, request: Request) -> Response:
    """Receive a file from a connected visitor, piece by piece, up to the size limit."""
    page = house.pages.get(session)
    label = clean_label(request.query_params.get("name", ""))
    rule = f"{label} was refused: a file may have at most {MOST_BYTES // 1_000_000} million bytes."
    if page is None or not page.is_open:
        return Response("This page is closed; load it again.", 404, media_type="text/plain")
    told = request.headers.get("content-length", "0")
    if not told.isdecimal() or int(told) > MOST_BYTES:
        return Response(rule, 413, media_type="text/plain", headers={"connection": "close"})
    # The file gets a name of our own; the visitor's name for it is only shown.
    path = Path(house.folder.name) / secrets.token_hex(12)
    size = 0
    try:
        with open(path, "xb") as file:
            async for piece in request.stream():
                size += len(piece)
                if size > MOST_BYTES:
                    path.unlink()
                    return Response(rule, 413, media_type="text/plain", headers={"connection": "close"})
                file.write(piece)
    except (ClientDisconnect, OSError):
        path.unlink(missing_ok=True)
        return Response("The file did not arrive completely; send it again.", 400, media_type="text/plain")

    def remove() -> None:
        with contextlib.suppress(OSError):
            path.unlink()

    page.read_file(str(path), label, remove)
    return Response(status_code=204)


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
