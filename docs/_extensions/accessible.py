"""What theme and gallery leave out for readers who use a keyboard or a screen reader."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_THUMBNAIL = re.compile(r'<a (class="reference internal" href="plot_[^"]+")>(<span class="doc">(.*?)</span>)')


def _mend(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """Name the level of captions and the links of thumbnails, and let the keyboard reach code that scrolls."""
    tree = context.get("furo_navigation_tree")
    if tree:
        context["furo_navigation_tree"] = tree.replace('role="heading"', 'role="heading" aria-level="2"')
    body = context.get("body")
    if body:
        body = body.replace("<pre>", '<pre tabindex="0">')
        context["body"] = _THUMBNAIL.sub(
            lambda link: f'<a {link[1]} aria-label="{_plain(link[3])}">{link[2]}', body
        )


def _plain(title: str) -> str:
    """Return a title without its markup, for an attribute."""
    return re.sub(r"<[^>]*>", "", title).replace('"', "&quot;")


def setup(app: Sphinx) -> dict[str, Any]:
    """Run after the theme has made its navigation."""
    app.connect("html-page-context", _mend, priority=900)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
