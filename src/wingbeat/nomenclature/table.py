"""The table of names. A name whose last part means several things has the part before it too, as ``wing.mass``."""

from __future__ import annotations

from wingbeat.nomenclature.answers import ANSWER, BEAT, STUDY
from wingbeat.nomenclature.given import AERO, GIVEN, RUN, WINGBEAT
from wingbeat.nomenclature.series import GLIDE, SERIES
from wingbeat.nomenclature.term import Term

__all__ = ["NOMENCLATURE"]

NOMENCLATURE: dict[str, Term] = {
    term.name: term for term in (*SERIES, *GLIDE, *GIVEN, *WINGBEAT, *BEAT, *AERO, *RUN, *ANSWER, *STUDY)
}
