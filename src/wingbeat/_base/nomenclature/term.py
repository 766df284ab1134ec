"""An entry of the table of names."""

from __future__ import annotations

from typing import NamedTuple


class Term(NamedTuple):
    """One quantity.

    Parameters
    ----------
    name : as in records, data sets and species files.
    unit : SI, as the CF conventions write it; ``1`` for a plain number, empty for a text.
    label : what to call it; the ``long_name`` in data sets.
    symbol : as in the theory, empty if it has none.
    meaning : definition, as species files say it; if none is given, the label.
    short : label where there is little room, in rows and on axes; if none is given, the label.
    """

    name: str
    unit: str
    label: str
    symbol: str = ""
    meaning: str = ""
    short: str = ""

    @property
    def definition(self) -> str:
        """The meaning, or the label if no meaning is given."""
        return self.meaning or self.label

    @property
    def short_label(self) -> str:
        """The short label, or the label if no short one is given."""
        return self.short or self.label
