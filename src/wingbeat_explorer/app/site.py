"""The web application: its page, its few files, uploads and downloads, and the headers of all answers."""

from __future__ import annotations

import contextlib
import json
import os
import secrets
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

from fastapi import FastAPI, Request, Response
from nicegui import Client, core, ui
from starlette.requests import ClientDisconnect

from wingbeat_explorer.app.curve import drawn
from wingbeat_explorer.app.door import Door, guard_events
from wingbeat_explorer.app.downloads import DOWNLOADS
from wingbeat_explorer.app.face import BUNDLE, READY
from wingbeat_explorer.app.first import First
from wingbeat_explorer.app.house import House
from wingbeat_explorer.app.uploads import MOST_BYTES, clean_label
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
    page.read_file(str(path), label, lambda: _remove(path))
    return Response(status_code=204)


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        os.unlink(path)
