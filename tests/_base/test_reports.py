"""Reports as text and as HTML: widths, tones, escapes; and figures that notebooks show by themselves."""

import pytest

from tests.helpers.notebooks import check_figure, check_table
from wingbeat._base import Line, Notes, Reported, Row, Table, grouped, lines_of, text_of
from wingbeat._base.style import new_figure

NASTY = "<script>alert('&amp;')</script> \"quoted\""


class Told(Reported):
    def __init__(self, *blocks):
        self.blocks = blocks

    def _report(self):
        return self.blocks


def test_every_text_is_escaped_wherever_it_stands():
    table = Table((Row((NASTY, NASTY)), Row((NASTY,), "title")), (NASTY, NASTY), "lr")
    told = Told(Line(NASTY), Line(NASTY, NASTY, "bad"), Notes((NASTY,)), table)
    page = told._repr_html_()
    assert "<script" not in page
    assert page.count("&lt;script&gt;alert(&#x27;&amp;amp;&#x27;)") == 9
    check_table(told)


@pytest.mark.parametrize("width", [30, 41, 80])
def test_no_line_is_wider_than_the_page_and_no_word_is_lost(width):
    words = [f"word{i}" for i in range(40)]
    text = " ".join(words)
    groups = grouped({"first": [("label", text), (text, "1.5 Hz")], "empty": []})
    shown = text_of([Line(text), Line(f": {text}", "head", "bad"), Notes((text,)), groups], width)
    assert max(map(len, shown.splitlines())) <= width
    assert shown.split().count("word17") == 5
    assert "empty" not in shown


def test_a_tone_covers_the_head_also_where_it_wraps():
    lines = list(lines_of([Line(": and what it means", "a head of words", "bad")], 10))
    toned = "".join(line.text[: line.toned] for line in lines)
    assert [line.tone for line in lines if line.toned] == ["bad"] * sum(bool(line.toned) for line in lines)
    assert toned.replace(" ", "") == "aheadofwords"


def test_numbers_stand_in_columns_that_end_together():
    table = Table(
        (Row(("a", "1.5", "few words")), Row(("bcd", "10.25", "more"))), ("name", "x\n[m]", "note"), "lrl"
    )
    assert text_of([table]).splitlines() == [
        "name      x  note",
        "        [m]",
        "a       1.5  few words",
        "bcd   10.25  more",
    ]


def test_a_line_that_does_not_wrap_stays_whole():
    assert text_of([Line("one two three", wraps=False)], 5) == "one two three"


def test_a_figure_shows_itself_and_keeps_its_settings(tmp_path):
    figure = new_figure(50.0, 40.0)
    figure.subplots().plot([0.0, 1.0])
    before = figure.dpi
    check_figure(figure)
    assert figure.dpi == before
    figure.savefig(tmp_path / "own.pdf")
