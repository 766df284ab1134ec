"""The glossary: terms in alphabetical order, spelled as in the nomenclature where they stand there."""

import re
from pathlib import Path

from wingbeat._base import NOMENCLATURE, RUN

# Names of a plate in a water channel, such as its span, are not terms of flight.
PLATE = {term.name for term in RUN}
PAGE = (Path(__file__).parents[2] / "docs" / "glossary.md").read_text(encoding="utf-8")
ENTRY = re.compile(r"^- \*\*(?P<term>[^*]+)\*\*(?: \(`(?P<name>\w+)`\))?: ", re.MULTILINE)


def spellings(name):
    """Return the spellings of a quantity: its name, its label or its short label."""
    term = NOMENCLATURE[name]
    return {name.replace("_", " "), term.label, term.short_label, term.label.removesuffix(" of the orbit")}


def misspelt(page):
    """Return the entries that are not spelled as in the nomenclature, or omit their name there."""
    faults = []
    for entry in ENTRY.finditer(page):
        term, name = entry["term"], entry["name"]
        if name is None:
            if term.replace(" ", "_") in NOMENCLATURE.keys() - PLATE:
                faults.append(f"{term}: gives no name")
        elif name not in NOMENCLATURE or term not in spellings(name):
            faults.append(f"{term}: {name}")
    return faults


def test_terms_are_in_alphabetical_order_and_explained_once():
    terms = [entry["term"].lower() for entry in ENTRY.finditer(PAGE)]
    assert len(terms) == len(re.findall(r"^- ", PAGE, re.MULTILINE)) > 40
    assert terms == sorted(set(terms))


def test_terms_are_spelled_as_in_the_nomenclature():
    assert misspelt(PAGE) == []


def test_a_misspelt_term_is_found():
    planted = "- **mean plus power** (`mean_positive_power`): x.\n- **cost of transport**: x.\n"
    assert misspelt(planted) == ["mean plus power: mean_positive_power", "cost of transport: gives no name"]
