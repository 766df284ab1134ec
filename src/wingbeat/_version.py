"""The version of the package; no other file states it."""

__version__ = "0.1.0"

NUMERICAL_VERSION = 8
"""The version of the numbers that this package computes; it is part of the key of every point of a study.

Raise it by one whenever the numbers of any record may change by more than rounding, because equations, defaults,
solver, certificate or the meaning of a number in the record changed. Studies then refuse stores of other versions.
A test compares a few records with committed digits; it fails if they changed.
"""
