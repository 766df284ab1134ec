"""A server of the explorer, a browser, and files that mean no good."""

import dataclasses
import socket
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

import wingbeat as wb
from tests.helpers.browsers import PATIENCE
from tests.helpers.forks import ForkServer


@dataclasses.dataclass
class Served:
    """A server that runs, and what it holds."""

    address: str
    house: Any


@pytest.fixture(scope="session")
def served() -> Iterator[Served]:
    """The explorer on a port of its own, in a thread, so that tests see its insides."""
    uvicorn = pytest.importorskip("uvicorn")
    pytest.importorskip("nicegui")
    from wingbeat_explorer.app.server import House, configure

    house = House(2)
    house._is_warm = True  # no test hears of a warm-up that another began
    listening = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(configure(house, "127.0.0.1"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    while not server.started:
        assert thread.is_alive()
        time.sleep(0.05)
    yield Served(f"http://127.0.0.1:{listening.getsockname()[1]}", house)
    server.should_exit = True
    house.close()
    thread.join(20.0)


@pytest.fixture(scope="session")
def explorers() -> Iterator[ForkServer]:
    """What starts explorers as programs of their own, without their imports."""
    server = ForkServer("wingbeat_explorer.commands.app", "wingbeat_explorer.app.server")
    yield server
    server.close()


@pytest.fixture
def visit(browser, served) -> Iterator:
    """Open pages of the explorer, and see in the end that nothing was complained of or asked for elsewhere."""
    contexts, complaints, requests = [], [], []

    def opened(query: str = "species=pigeon&speed=10&starts=1", **options: Any) -> Any:
        options = {"viewport": {"width": 1280, "height": 800}, "reduced_motion": "reduce"} | options
        context = browser.new_context(**options)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        page.on("console", lambda m: complaints.append(m.text) if "GL Driver Message" not in m.text else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        page.goto(f"{served.address}/?{query}")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert complaints == []
    own = (served.address, served.address.replace("http", "ws"), "data:", "blob:")
    assert [url for url in requests if not url.startswith(own)] == []


@pytest.fixture(scope="session")
def orbit_file(tmp_path_factory):
    """A file of ``orbit -o``."""
    path = tmp_path_factory.mktemp("orbit") / "pigeon.nc"
    wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), 10.0), starts=1).save(path)
    return path
