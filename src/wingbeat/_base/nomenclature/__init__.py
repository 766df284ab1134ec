"""The one table of quantities: name, symbol, unit, label and meaning.

Records, data sets, studies, figures, pages and the explorer use it. Units are SI in CF form: ``m s-1``. For
readers, `plain` writes ``m/s`` and `for_people` converts to degrees.
"""

from wingbeat._base.nomenclature.lookup import (
    NOMENCLATURE,
    attributes_of,
    axis_label,
    find,
    label_of,
    plain_unit,
    readable_limit,
)
from wingbeat._base.nomenclature.term import Term
from wingbeat._base.nomenclature.units import cf, for_people, plain
from wingbeat._base.nomenclature.written import PRECISION, written, written_range

__all__ = [
    "NOMENCLATURE",
    "PRECISION",
    "Term",
    "attributes_of",
    "axis_label",
    "cf",
    "find",
    "for_people",
    "label_of",
    "plain",
    "plain_unit",
    "readable_limit",
    "written",
    "written_range",
]
