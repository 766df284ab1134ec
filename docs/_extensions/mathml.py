"""Mathematics as MathML, which browsers draw themselves: pages need no script and no other host."""

from __future__ import annotations

import re
import unicodedata
from typing import Any

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util.math import get_node_equation_number

_BOLD = re.compile(r'<mi mathvariant="bold">(\w)</mi>')


def formula(latex: str, display: str = "inline") -> str:
    """Return a formula as MathML, with vectors as bold letters: browsers no longer read the attribute for bold."""
    return _BOLD.sub(
        lambda letter: f"<mi>{unicodedata.lookup(f'MATHEMATICAL BOLD {_name(letter[1])}')}</mi>",
        convert(latex, display=display),
    )


def _name(letter: str) -> str:
    """Return the end of a letter's name in Unicode, such as ``SMALL R`` or ``CAPITAL OMEGA``."""
    name = unicodedata.name(letter)
    return name.replace("LATIN ", "").replace("GREEK ", "").replace("LETTER ", "")


def inline(translator: Any, node: nodes.math) -> None:
    """Write a formula within a line."""
    translator.body.append(formula(node.astext()))
    raise nodes.SkipNode


def displayed(translator: Any, node: nodes.math_block) -> None:
    """Write a formula on its own line; a labelled one has its number and a link to itself beside it."""
    translator.body.append(translator.starttag(node, "div", CLASS="math notranslate"))
    translator.body.append(formula(node.astext(), "block"))
    if node.get("number"):
        number = get_node_equation_number(translator, node)
        translator.body.append(f'<span class="eqno">({number})')
        translator.add_permalink_ref(node, "Link to this equation")
        translator.body.append("</span>")
    translator.body.append("</div>")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer."""
    app.add_html_math_renderer("mathml", inline_renderers=(inline, None), block_renderers=(displayed, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
