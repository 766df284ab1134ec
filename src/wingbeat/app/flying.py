"""The flying animal on the page: this module mounts the viewer and sends it scenes."""

from __future__ import annotations

import json
from typing import Any

from wingbeat.app.downloads import Download, Downloads
from wingbeat.app.widgets import run_script, tag
from wingbeat.viewer import bundle_path

BUNDLE = "/wingbeat/viewer.js"
# Each scene has its own request; a scene that arrives after a later one is not shown.
SCRIPT = f"""
window.wingbeatFlying = {{
  handle: null, asked: 0, shown: 0, theme: "system",
  async show(place, url) {{
    const mine = ++this.asked;
    const [scene, viewer] = await Promise.all([fetch(url).then((r) => r.ok ? r.json() : null), import("{BUNDLE}")]);
    if (!scene || mine < this.shown) return;
    this.shown = mine;
    if (this.handle) this.handle.replace(scene);
    else {{
      const element = document.getElementById(place);
      element.textContent = "";
      this.handle = viewer.mount(element, scene, {{ theme: this.theme }});
      if (this.handle.theme) this.handle.theme.hidden = true; // the page has one for itself and the viewer
    }}
  }},
  setTheme(theme) {{
    this.theme = theme;
    this.handle?.setTheme?.(theme);
  }},
}};
"""


def bundle() -> bytes:
    """Return the viewer's module."""
    return bundle_path().read_bytes()


class Flying:
    """The element of a page that holds the viewer.

    Parameters
    ----------
    downloads, session : the browser fetches scenes from `downloads`, which keeps them for this session.
    """

    def __init__(self, downloads: Downloads, session: str) -> None:
        self._downloads, self._session = downloads, session
        self._place: Any = tag("div", classes="flying", role="region", aria_label="The flying animal")
        self._place.props["id"] = self._place.html_id
        with self._place:
            tag(
                "p",
                "The first wingbeat is being solved. The first solve after the server starts takes some seconds.",
                "empty",
            )

    def show(self, scene: str) -> None:
        """Show a scene, given as the viewer's JSON text; without a scene, the view does not change."""
        if not scene:
            return
        address = self._downloads.put(self._session, Download(scene.encode(), "application/json"))
        run_script(f"wingbeatFlying.show({json.dumps(self._place.html_id)}, {json.dumps(address)})")

    def set_theme(self, theme: str) -> None:
        """Set the viewer's theme: ``system``, ``light`` or ``dark``."""
        run_script(f"wingbeatFlying.setTheme({json.dumps(theme)})")
