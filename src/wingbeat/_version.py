"""The version of the package; no other file states it."""

__version__ = "0.1.0"

NUMERICAL_VERSION = 10
"""The version of the numbers that this package computes. The key of every point of a study contains it.

Raise it by one whenever a change may alter the numbers of any record by more than rounding: a change of equations,
defaults, solver or certificate, or of the meaning of a number in the record. Studies then refuse stores of other
versions. A test compares a few records with stored digits; it fails if they have changed.
"""
