"""What theme and gallery leave out for readers who use a keyboard, a screen reader or a phone."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_PICTURE = re.compile(r'<img [^>]*src="((?:\.\./)*_images/([^"]+)(?<!_thumb)\.png)"[^>]*>')
_UNNAMED = re.compile(r'alt="plot \d\d [^"]*"')
# Pixels: a picture of the gallery that is wider than the first has several panels; figures as wide as a page of a
# journal have more than the last, and those of one column lie between.
_PANELS, _COLUMN, _WIDE = 700, 1000, 1100
_SCROLLS = '<span class="scrolls">Scroll the figure sideways, or tap it to see it whole.</span>'
_THUMBNAIL = re.compile(r'<a (class="reference internal" href="plot_[^"]+")>(<span class="doc">(.*?)</span>)')


def _mend(app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """Name what has no name, let the keyboard reach what scrolls, and link pictures to themselves."""
    tree = context.get("furo_navigation_tree")
    if tree:
        context["furo_navigation_tree"] = tree.replace('role="heading"', 'role="heading" aria-level="2"')
    body = context.get("body")
    if body:
        body = body.replace("<pre>", '<pre tabindex="0">')
        body = body.replace('<div class="math notranslate', '<div tabindex="0" class="math notranslate')
        body = body.replace('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper')
        body = _UNNAMED.sub(f'alt="{_plain(context["title"])}"', body)
        body = _PICTURE.sub(lambda picture: _linked(app, picture), body)
        context["body"] = _THUMBNAIL.sub(
            lambda link: f'<a {link[1]} aria-label="{_plain(link[3])}">{link[2]}', body
        )


def _linked(app: Sphinx, picture: re.Match[str]) -> str:
    """Return a picture inside a link to its file, so that a phone can show it large, with a class for its width."""
    files = {name: file for file, name in app.builder.images.items()}
    file = Path(app.srcdir) / files.get(f"{picture[2]}.png", f"gallery/images/{picture[2]}.png")
    # A PNG file says its width in bytes 16 to 19.
    width = int.from_bytes(file.read_bytes()[16:20], "big") if file.is_file() else 0
    kind = "wide" if width > _WIDE else "column" if width > _COLUMN else "panels" if width > _PANELS else "one"
    link = f'<a class="picture {kind}" href="{picture[1]}">{picture[0]}</a>'
    return link + _SCROLLS if kind in ("wide", "panels") else link


def _plain(title: str) -> str:
    """Return a title without its markup, for an attribute."""
    return re.sub(r"<[^>]*>", "", title).replace('"', "&quot;")


def setup(app: Sphinx) -> dict[str, Any]:
    """Run after the theme has made its navigation."""
    app.connect("html-page-context", _mend, priority=900)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
