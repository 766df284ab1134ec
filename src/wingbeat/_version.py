"""The one place where the version stands."""

__version__ = "0.1.0"

NUMERICAL_VERSION = 8
"""Which numbers this package gives; a part of the key of every point of a study.

Raise it by one whenever the numbers of any record may change by more than rounding: equations, defaults, solver,
certificate, what a number of the record means. Stores of another version are then refused, not mixed. A test
compares a few records with committed digits and fails when it is due.
"""
