"""What every page of figures keeps to: it names each thing once."""


def check_legends(figure, most=1):
    """Check that a page has at most so many legends, and that no two entries of them are the same; return these."""
    legends = [*figure.legends, *(axes.get_legend() for axes in figure.axes if axes.get_legend())]
    entries = [text.get_text() for legend in legends for text in legend.get_texts()]
    assert len(legends) <= most, entries
    assert len(entries) == len(set(entries)), entries
    return entries
