"""Access control: only pages of this server, under its own name, may send requests and messages."""

from __future__ import annotations

import inspect
import ipaddress
import logging
import re
import socket
from collections.abc import Awaitable, Callable, MutableMapping
from contextlib import suppress
from functools import wraps
from typing import Any
from urllib.parse import parse_qs, urlsplit

from nicegui import core, json
from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]

_SOCKET = "/_nicegui_ws/"
_SOCKET_ENDS = (f"{_SOCKET}socket.io", f"{_SOCKET}socket.io/")
# What a page may send, by Engine.IO 4 and Socket.IO 5: close, pong; connect, disconnect, event.
_FRAME = re.compile(r"1|3|40(?:\{.*\})?|41|42\d{0,9}(?P<event>\[.*\])", re.DOTALL)
_EVENTS = ("handshake", "event", "javascript_response", "ack", "log")
_POLICY_VIOLATION = 1008  # the close code of RFC 6455 for a message that breaks the server's rules
_LONGEST_PATH = 1000  # characters; those of our own have some hundred
_log = logging.getLogger("uvicorn.error")


def is_loopback(host: str) -> bool:
    """Return whether a host, as in a URL or an address, can be reached from this machine only.

    >>> is_loopback("localhost"), is_loopback("[::1]"), is_loopback("0.0.0.0"), is_loopback("localhost.evil.org")
    (True, True, False, False)
    """
    address = _address(host)
    return host.lower() == "localhost" if address is None else address.is_loopback


def _address(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(host.strip("[]").partition("%")[0])
    except ValueError:
        return None


class Door:
    """Refuses requests and socket messages that no page of this server sends, and says why.

    Browsers set the Host and Origin headers themselves; a page cannot forge them. If another site gives this
    machine a name of that site (DNS rebinding), the Host header shows this name. If a page of another site sends
    requests to this server, the Origin header shows that site.

    Parameters
    ----------
    app : the web application that is protected.
    host : the address or name that the server listens on.
    """

    def __init__(self, app: Callable[[Scope, Receive, Send], Awaitable[None]], host: str) -> None:
        self._app = app
        self._only_here = is_loopback(host)
        self._names = {"localhost", host.lower()}
        if not self._only_here:
            name = socket.gethostname().lower()
            self._names |= {name, name.partition(".")[0], f"{name.partition('.')[0]}.local"}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or answer why it is refused."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        status, why_not = self._refusal(scope)
        if why_not and scope["type"] == "websocket":
            _log.warning("A socket was refused. %s", why_not)
            await send({"type": "websocket.close"})  # answered with 403
        elif why_not:
            await PlainTextResponse(f"{why_not}\n", status)(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._app(scope, _checked(receive, send), send)
        else:
            await self._app(scope, receive, send)

    def _refusal(self, scope: Scope) -> tuple[int, str]:
        """Return the HTTP status and the reason why a request is refused; the reason is empty if it may pass."""
        headers, is_socket = Headers(scope=scope), scope["type"] == "websocket"
        host = headers.get("host", "")
        if not self._is_own(host):
            return 400, (
                f"The explorer does not answer under the name {host[:100]!r}. "
                "Open the address that it printed, or start it with this name as --host."
            )
        if is_socket or scope["method"] not in ("GET", "HEAD", "OPTIONS"):
            for origin in headers.getlist("origin"):
                if not _is_of(origin, host):
                    why = "The explorer accepts nothing from pages of another origin"
                    return 403, f"{why}; this request is from {origin[:100]!r}."
        if len(scope["path"]) > _LONGEST_PATH:
            return 414, f"The path of the address has more than {_LONGEST_PATH} characters."
        if not scope["path"].isprintable():
            return 400, "The address holds a character that cannot be printed."
        if is_socket != scope["path"].startswith(_SOCKET) or (is_socket and not _is_page_socket(scope)):
            return 400, "Only pages of the explorer connect here, by WebSocket."
        return 200, ""

    def _is_own(self, header: str) -> bool:
        """Return whether a Host header names this server; an IP address must be loopback if the server is local."""
        match = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[^:\[\]]+)(?::\d*)?", header)
        if match is None:
            return False
        host = match[1].lower()
        if _address(host) is not None:
            return is_loopback(host) or not self._only_here
        return host in self._names


def _is_of(origin: str, host: str) -> bool:
    """Return whether an Origin header belongs to pages from the server that this Host header names."""
    try:
        parts = urlsplit(origin)
    except ValueError:
        return False
    return parts.scheme in ("http", "https") and parts.netloc.lower() == host.lower()


def _is_page_socket(scope: Scope) -> bool:
    query = parse_qs(scope["query_string"].decode("latin-1"))
    asked = query.get("EIO") == ["4"] and query.get("transport") == ["websocket"]
    return scope["path"] in _SOCKET_ENDS and asked and not {"sid", "j"} & query.keys()


def _checked(receive: Receive, send: Send) -> Receive:
    """Return a `receive` that closes the socket, with the reason, at the first message that no page would send."""

    async def checked() -> MutableMapping[str, Any]:
        event = await receive()
        if event["type"] != "websocket.receive" or _is_understood(event.get("text")):
            return event
        await _close(send)
        return {"type": "websocket.disconnect", "code": _POLICY_VIOLATION}

    return checked


async def _close(send: Send) -> None:
    """Close a socket, and say why to both sides."""
    _log.warning("A socket was closed: a message was not understood.")
    why = "The message was not understood; load the page again."
    await send({"type": "websocket.close", "code": _POLICY_VIOLATION, "reason": why})


def _is_understood(text: str | None) -> bool:
    frame = _FRAME.fullmatch(text or "")
    if frame is None:
        return False
    if frame["event"] is None:
        return True
    try:
        name, *what = json.loads(frame["event"])
    except (ValueError, RecursionError):
        return False
    return name in _EVENTS and len(what) == 1 and isinstance(what[0], dict)


def guard_events() -> None:
    """Close a socket whose event makes NiceGUI's own handlers fail; the log then gets no traceback.

    Errors in this page's own handlers do not reach this function: NiceGUI reports them first.
    """
    for name in ("connect", *_EVENTS):
        core.sio.on(name, _guarded(inspect.unwrap(core.sio.handlers["/"][name])))


def _guarded(handler: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(handler)
    async def guarded(sid: str, *what: Any) -> Any:
        try:
            result = handler(sid, *what)
            return await result if inspect.isawaitable(result) else result
        except (LookupError, TypeError, ValueError, AttributeError):
            with suppress(LookupError, RuntimeError):  # it has gone already
                await _close((core.sio.get_environ(sid) or {})["asgi.send"])
            return False

    return guarded
