"""Numbers as a page prints them, and the numbers of a page that no phrase contains."""

import re

import numpy as np

SMALL = "none one two three four five six seven eight nine ten"
TEENS = "thir four fif six seven eigh nine"
WORDS = dict(enumerate([*SMALL.split(" "), "eleven", "twelve", *(f"{n}teen" for n in TEENS.split(" "))]))
# Digits, and numbers in words but for one, which is a pronoun as well, and for shares such as half.
NUMBER = re.compile(
    r"\d+|\b(?:two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|thirteen|fourteen|fifteen|sixteen"
    r"|seventeen|eighteen|nineteen|twenty|thirty|forty|fifty|hundred|thousand|twice)\b",
    re.IGNORECASE,
)


def spaced(count):
    return f"{count:,}".replace(",", " ")


def worded(count):
    return WORDS.get(int(count), spaced(int(count)))


def percent(share):
    return f"{100 * share:.0f}"


def short(number, digits=2):
    return f"{number:.{digits}f}"


def uncounted(page, phrases):
    """Return the sentences of a page with a number that lies in none of the phrases."""
    covered = np.zeros(len(page), dtype=bool)
    for phrase in phrases:
        for at in (match.start() for match in re.finditer(re.escape(phrase), page)):
            covered[at : at + len(phrase)] = True
    missed = [match for match in NUMBER.finditer(page) if not covered[match.start() : match.end()].all()]
    return sorted({page[max(m.start() - 60, 0) : m.end() + 40] for m in missed})
