"""What a notebook asks of a result: well-formed, no requests, right on dark pages, with the words of the text."""

import re
from collections import Counter
from html.parser import HTMLParser

from matplotlib.figure import Figure

_MARKS = {"✓", "△", "✗", "-"}
_LOADS = {"src", "href", "srcset", "data", "action", "background", "onload", "onclick"}

_FIXED = r"url\(|@import|rgb|#[0-9a-f]{3}|(?<![\w-])(color|background):(?!inherit|trans)"


class _Page(HTMLParser):
    """The texts of a piece of HTML; every element must end before the one around it."""

    def __init__(self, page):
        super().__init__(convert_charrefs=True)
        self.open, self.texts = [], []
        self.feed(page)
        self.close()
        assert not self.open, f"left open: {self.open}"

    def handle_starttag(self, tag, attrs):
        assert tag in {"div", "span", "ul", "li", "table", "thead", "tbody", "tr", "th", "td", "br"}, tag
        for name, value in attrs:
            assert name not in _LOADS, name
            assert not re.search(_FIXED, value)
        if tag == "br":
            self.texts.append(" ")
        else:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag
        if tag != "span":
            self.texts.append(" ")

    def handle_data(self, data):
        self.texts.append(data)


def words_of(text):
    """Return how often each word stands in a text, without the marks that only one of text and table has."""
    return Counter(word for word in text.split() if word not in _MARKS)


def check_table(result):
    """Check the table that a notebook shows of a result, and return its words."""
    page = _Page(result._repr_html_())
    assert words_of("".join(page.texts)) == words_of(result.summary(10_000))
    return " ".join("".join(page.texts).split())


def check_figure(figure):
    """Check that a notebook shows a figure without magic words."""
    assert isinstance(figure, Figure)
    assert figure._repr_png_().startswith(b"\x89PNG\r\n\x1a\n")
