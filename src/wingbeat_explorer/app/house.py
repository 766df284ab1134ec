"""What all visitors share: the pool of workers, the downloads, and the open pages."""

from __future__ import annotations

import secrets
import tempfile

from nicegui import Client

from wingbeat._workers.pool import Event
from wingbeat_explorer.app.downloads import Downloads
from wingbeat_explorer.app.face import animals
from wingbeat_explorer.app.fair_pool import FairPool
from wingbeat_explorer.app.first import read_first
from wingbeat_explorer.app.links import to_plain
from wingbeat_explorer.app.page import Page

_WORK = "wingbeat_explorer.app.jobs:do"
# Most pages that were fetched and wait for their browser to connect. Browsers connect within a second. Programs
# that only fetch pages never do, and each page takes 3.2 MB of memory until NiceGUI drops it after a minute. A
# browser whose page was dropped loads it again by itself.
MOST_WAITING = 20


class House:
    """What all visitors share.

    Parameters
    ----------
    processes : worker processes of the pool.
    """

    def __init__(self, processes: int) -> None:
        self._is_warm = False
        self.pool = FairPool(_WORK, processes)
        self.downloads = Downloads()
        self.first = read_first()
        animals()  # now, so that the first visitor need not wait for it
        self.pages: dict[str, Page] = {}
        self.folder = tempfile.TemporaryDirectory(prefix="wingbeat-")

    def warm_up(self) -> None:
        """Solve the first flight in one worker, then in another, so that a move need not wait for its compilation.

        Only the first call does anything.
        """
        if self._is_warm:
            return
        self._is_warm = True
        near = self.first.answer["near"]
        what = {"do": "orbit", "scenario": to_plain(self.first.scenario), "near": near}

        def go_on(event: Event) -> None:
            if event.ends:  # in the background, which takes another worker
                self.pool.submit("warm-up", what, lambda event: None, background=True)

        self.pool.submit("warm-up", what, go_on)

    def open_page(self, client: Client, query: str) -> None:
        """Build a page for a new visitor; of pages to which nobody has connected, only the latest are kept."""
        waiting = [page for page in self.pages.values() if page.waits]
        for page in waiting[: max(len(waiting) - MOST_WAITING + 1, 0)]:
            page.drop()
        name = secrets.token_urlsafe(12)
        page = self.pages[name] = Page(name, self, query)

        def leave() -> None:
            del self.pages[name]
            page.leave()

        client.on_delete(leave)

    def close(self) -> None:
        """End the workers and delete all temporary files."""
        self.pool.close()
        self.folder.cleanup()
