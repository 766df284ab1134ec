"""How the tests start a real browser, and what they look for in it."""

import pytest

from tests.helpers.places import ROOT

FLAGS = (
    *("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--enable-unsafe-swiftshader"),
)
PATIENCE = 60_000  # ms; a browser on a busy machine starts slowly
# What the viewer's bundler and the accessibility tests bring, where somebody has run npm.
NODE_MODULES = ROOT / "viewer" / "node_modules"
AXE = NODE_MODULES / "axe-core" / "axe.min.js"


def until(page, script):
    """Wait until a script is true; the viewer's pages forbid what Playwright's own waiting needs."""
    for _ in range(200):
        if page.evaluate(script):
            return
        page.wait_for_timeout(100)
    pytest.fail(f"never true: {script}")
