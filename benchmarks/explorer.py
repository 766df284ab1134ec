"""How soon the explorer draws the picture of a move beyond the solver's time, and what its processes hold.

``python benchmarks/explorer.py [--moves 30]``: needs the extra ``app``, Playwright and Chromium; two workers.

Each move is split at two moments: the server has the answer, and the page has all of it. What comes before the
first, less the solver's time, is the server's. What lies between them is the transfer, with all that the page does
before it fetches the answer. The rest is the browser's, until the picture is drawn. On a busy machine the time for
which the page's own thread computes tells more than the clock.
"""

import argparse
import shutil
import socket
import statistics
import threading
import time
from pathlib import Path
from typing import Any, NamedTuple

import uvicorn
from playwright.sync_api import Page, sync_playwright

from wingbeat_explorer.app.face_element import Face
from wingbeat_explorer.app.pages import House
from wingbeat_explorer.app.server import build

FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--enable-unsafe-swiftshader"]
PATIENCE = 120_000  # ms

MOVE = """async (speed) => {
    const { face } = wingbeatPage, what = document.querySelector('.what');
    const at = (time) => (performance.timeOrigin + time) / 1000;
    performance.clearResourceTimings();
    const begun = performance.now();
    face.ask({ at: speed });
    const isDrawn = () => face.answer?.speed === speed && what.textContent.includes(` ${speed} m/s`)
        && face.viewer.stage.due === undefined;
    while (!isDrawn()) {
        await new Promise((done) => setTimeout(done, 2));
        if (performance.now() - begun > 60000) throw new Error('no answer');
    }
    const drawn = performance.now();
    const answers = performance.getEntriesByType('resource').filter(({ name }) => name.includes('/downloads/'));
    return { begun: at(begun), arrived: answers.map(({ responseEnd }) => at(responseEnd)), drawn: at(drawn) };
}"""
READY = "wingbeatPage.face?.viewer && wingbeatPage.face.answer"
SOLVED = """(what) => document.querySelector('.what')?.textContent.includes(what)
    && document.querySelector('.state')?.textContent.startsWith('Solved')"""


def resident(pid: str | int) -> float:
    """Return a process's memory [MB]."""
    status = Path(f"/proc/{pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


class Move(NamedTuple):
    """Seconds of one move: the solver's; beyond them in all and in parts; and of all, what the page computed."""

    solver: float
    whole: float
    server: float
    transfer: float
    browser: float
    computing: float


def listen() -> list[tuple[float, float]]:
    """Return a list that will hold when the server had each answer, and the solver's time [s]."""
    answered: list[tuple[float, float]] = []
    show = Face.show

    def noted(self: Face, answer: dict[str, Any]) -> None:
        answered.append((time.time(), answer["solver_seconds"]))
        show(self, answer)

    Face.show = noted
    return answered


class Flight(NamedTuple):
    """What is flown: the animal, the query of the page's address, and the speed to begin with [m/s]."""

    animal: str
    query: str
    speed: float


FLIGHTS = {
    "pigeon, model of Su et al.": Flight("pigeon", "?species=pigeon&speed=8&starts=1", 8.0),
    "bat, model of Su et al.": Flight("bat", "?species=bat&speed=8&starts=1", 8.0),
    "pigeon within plausible ranges, the first page": Flight("pigeon", "", 12.0),
}


def slide(page: Page, address: str, flight: Flight, moves: int, answered: list[tuple[float, float]]) -> list[Move]:
    """Return what so many moves of the point on the curve take; `answered` is from `listen`."""
    animal, query, first = flight
    page.goto(f"{address}/{query}")
    page.wait_for_function(SOLVED, arg=f"{animal} at {first:g} m/s", timeout=PATIENCE)
    page.wait_for_function(READY)
    page.evaluate(MOVE, first + 1)  # what is compiled for a first move is not measured
    page.wait_for_function(SOLVED, arg=f"{animal} at {first + 1:g} m/s", timeout=PATIENCE)
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def computed() -> float:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return next(one["value"] for one in metrics if one["name"] == "ThreadTime")

    found = []
    for move in range(moves):
        speed = round(first + 0.1 * (1 + move % 40), 1)
        answered.clear()
        before = computed()
        at = page.evaluate(MOVE, speed)
        computing = computed() - before
        known, solver = answered[0]
        server, whole = known - at["begun"] - solver, at["drawn"] - at["begun"] - solver
        arrived = min(time for time in at["arrived"] if time > known)  # others belong to the move before
        found.append(Move(solver, whole, server, arrived - known, at["drawn"] - arrived, computing))
        page.wait_for_function(SOLVED, arg=f"{animal} at {speed:g} m/s", timeout=PATIENCE)
        page.wait_for_timeout(400)
    return found


def tell(name: str, moves: list[Move]) -> None:
    """Print what the moves took: of each part the least, the median and the most."""
    late = sum(move.whole > 0.3 for move in moves)
    print(f"{name}: {late} of {len(moves)} moves over 0.3 s beyond the solver; least / median / most [s]:")
    for part, values in zip(Move._fields, zip(*moves, strict=True), strict=True):
        print(f"    {part:9} {min(values):.3f} / {statistics.median(values):.3f} / {max(values):.3f}")


def main() -> None:
    """Serve, slide, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, default=30, help="moves of the point, for each flight")
    moves = parser.parse_args().moves
    house, answered = House(2), listen()
    listening = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(uvicorn.Config(build(house, "127.0.0.1"), log_level="warning"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    while not server.started:
        time.sleep(0.05)
    address = f"http://127.0.0.1:{listening.getsockname()[1]}"
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS, timeout=PATIENCE)
        page = browser.new_page(reduced_motion="reduce")
        page.set_default_timeout(PATIENCE)
        for name, flight in FLIGHTS.items():
            tell(name, slide(page, address, flight, moves, answered))
            workers = ", ".join(f"{resident(pid):.0f}" for pid in house.pool.workers)
            print(f"    after it the server holds {resident('self'):.0f} MB, the workers {workers} MB")
        browser.close()
    server.should_exit = True
    house.close()
    thread.join(20.0)


if __name__ == "__main__":
    main()
