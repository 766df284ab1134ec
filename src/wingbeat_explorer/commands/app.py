"""``wingbeat app``: the explorer in the browser."""

from __future__ import annotations

import importlib.util
from typing import Annotated

from cyclopts import Parameter

from wingbeat._base import Fault, FaultList, InvalidInputError, install_extra
from wingbeat._workers.tuning import core_count
from wingbeat.cli.arguments import Whole
from wingbeat.cli.process import EXIT_GOOD

_MOST_PROCESSES = 64
_LONGEST_HOST = 253  # of a name in the domain name system


def app(
    *,
    host: Annotated[str, Parameter(help="Address to listen on; the explorer has no passwords.")] = "127.0.0.1",
    port: Annotated[Whole, Parameter(help="Port to listen on; 0 takes any free port.")] = 8080,
    processes: Annotated[
        Whole | None, Parameter(help="Solver processes; default: as many as cores, at most 4.")
    ] = None,
    open_: Annotated[bool, Parameter(name="--open", negative="--no-open", help="Open a browser.")] = True,
) -> int:
    """Open the explorer in a browser: choose an animal, drag its speed, and see it fly.

    Ctrl-C ends the explorer. It needs the extra app: uv run --extra app wingbeat app.

    Examples: wingbeat app; wingbeat app --port 0 --no-open
    """
    faults = FaultList()
    if len(host) > _LONGEST_HOST or not host.isprintable():
        faults.add("--host", host, "is not an address", "for example 127.0.0.1")
    faults.number("--port", port, at_least=0, at_most=65535)
    if processes is not None:
        faults.number("--processes", processes, at_least=1, at_most=_MOST_PROCESSES)
    faults.raise_if_any()
    if importlib.util.find_spec("nicegui") is None:
        rule, fix = "needs NiceGUI, which is not installed", install_extra("app")
        raise InvalidInputError([Fault("wingbeat app", "extra app", rule, fix)])
    from wingbeat_explorer.app.server import serve

    serve(host, port, processes or min(core_count(), 4), open_)
    return EXIT_GOOD
