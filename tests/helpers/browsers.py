"""How the tests start a real browser and open pages in it, and what they look for there."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from tests.helpers.places import ROOT

FLAGS = (
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader"),
)
PATIENCE = 60_000  # ms; a browser on a busy machine starts slowly
# Drops a file, given as name and text, on the page; returns false if the page took it.
DROP = """([name, text]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], name));
    const about = { bubbles: true, cancelable: true, dataTransfer: transfer };
    document.body.dispatchEvent(new DragEvent("dragover", about));
    return document.body.dispatchEvent(new DragEvent("drop", about));
}"""
# What the viewer's bundler and the accessibility tests bring, where somebody has run npm.
NODE_MODULES = ROOT / "viewer" / "node_modules"
AXE = NODE_MODULES / "axe-core" / "axe.min.js"


def until(page, script):
    """Wait until a script is true; the viewer's pages forbid what Playwright's own waiting needs."""
    for _ in range(PATIENCE // 100):
        if page.evaluate(script):
            return
        page.wait_for_timeout(100)
    pytest.fail(f"never true: {script}")


class Shown(NamedTuple):
    """A page with what it complained of and what it asked for."""

    page: Any
    complaints: list[str]
    requests: list[str]


@contextmanager
def shown_files(browser, ready: str, width: int, height: int) -> Iterator[Callable[..., Shown]]:
    """Give a function that opens a file from disk in a page of its own; still, for software draws slowly.

    Parameters
    ----------
    browser : in which each page has a context of its own, closed in the end.
    ready : what the page shows once it may be used, as a selector.
    width, height : of the window, unless the function is given others.
    """
    contexts = []
    size = width, height

    def opened(path: Path, width: int = size[0], height: int = size[1], fragment: str = "", **options) -> Shown:
        options = {"viewport": {"width": width, "height": height}, "reduced_motion": "reduce"} | options
        context = browser.new_context(**options)
        contexts.append(context)
        page, complaints, requests = context.new_page(), [], []
        page.set_default_timeout(PATIENCE)
        # What software rendering says of reading pixels back is about screenshots.
        page.on("console", lambda m: complaints.append(m.text) if "GL Driver Message" not in m.text else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        page.goto(f"{path.as_uri()}{fragment}")
        page.wait_for_selector(ready)
        return Shown(page, complaints, requests)

    yield opened
    for context in contexts:
        context.close()
