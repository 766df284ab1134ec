"""How soon the explorer answers a move of its point beyond the solver's time, and what its processes hold.

``python benchmarks/explorer.py [--moves 30]``: needs the extra ``app``, Playwright and Chromium; two workers.
"""

import argparse
import shutil
import socket
import statistics
import threading
import time
from pathlib import Path

import uvicorn
from playwright.sync_api import Page, sync_playwright

from wingbeat.app.house import House
from wingbeat.app.site import build

FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--enable-unsafe-swiftshader"]
PATIENCE = 120_000  # ms

MOVE = """async (speed) => {
    const { face } = wingbeatPage, what = document.querySelector('.what');
    const begun = performance.now();
    face.ask({ speed });
    while (face.answer?.speed !== speed || !what.textContent.includes(` ${speed} m/s`)) {
        await new Promise((done) => setTimeout(done, 2));
        if (performance.now() - begun > 60000) throw new Error('no answer');
    }
    return (performance.now() - begun) / 1000 - Number(what.getAttribute('data-solver-seconds'));
}"""
SOLVED = """(what) => document.querySelector('.what')?.textContent.includes(what)
    && document.querySelector('.state')?.textContent.startsWith('Solved')"""


def resident(pid: str | int) -> float:
    """Return a process's memory [MB]."""
    status = Path(f"/proc/{pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) / 1024


def slide(page: Page, address: str, animal: str, moves: int) -> list[float]:
    """Return the seconds beyond the solver's own of so many moves of the point on the curve."""
    page.goto(f"{address}/?species={animal}&speed=8&starts=1")
    page.wait_for_function(SOLVED, arg=f"{animal} at 8 m/s", timeout=PATIENCE)
    beyond = []
    for move in range(moves):
        speed = round(8 + 0.1 * (1 + move % 40), 1)
        beyond.append(page.evaluate(MOVE, speed))
        page.wait_for_function(SOLVED, arg=f"{animal} at {speed:g} m/s", timeout=PATIENCE)
        page.wait_for_timeout(400)
    return beyond


def main() -> None:
    """Serve, slide, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, default=30, help="moves of the point, for each animal")
    moves = parser.parse_args().moves
    house = House(2)
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
        for animal in ("pigeon", "bat"):
            beyond = slide(page, address, animal, moves)
            late = sum(one > 0.3 for one in beyond)
            spread = f"{min(beyond):.3f} / {statistics.median(beyond):.3f} / {max(beyond):.3f}"
            print(f"{animal}: {spread} s beyond the solver (least, median, most), {late} of {moves} over .3 s")
            workers = ", ".join(f"{resident(pid):.0f}" for pid in house.pool.workers)
            print(f"    after it the server holds {resident('self'):.0f} MB, the workers {workers} MB")
        browser.close()
    server.should_exit = True
    house.close()
    thread.join(20.0)


if __name__ == "__main__":
    main()
