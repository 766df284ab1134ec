"""The one place that knows what a quantity is called: its name, symbol, unit, label and meaning.

The orbit record, the data sets, the studies, the figures, the pages and the explorer all look here. Units are SI,
written as the CF conventions do: ``m s-1``. People read ``m/s`` or degrees, which `plain` and `for_people` make.
"""

from wingbeat.nomenclature.lookup import attributes_of, axis_label, find, label_of, plain_unit
from wingbeat.nomenclature.table import NOMENCLATURE
from wingbeat.nomenclature.term import Term
from wingbeat.nomenclature.units import cf, for_people, plain

__all__ = [
    "NOMENCLATURE",
    "Term",
    "attributes_of",
    "axis_label",
    "cf",
    "find",
    "for_people",
    "label_of",
    "plain",
    "plain_unit",
]
