"""Studies: many orbit problems planned, solved in pieces that survive, and kept in one file."""

from wingbeat.studies.study import Study as Study
from wingbeat.studies.study import Summary as Summary
from wingbeat.studies.study import study as study

__all__ = ["Study", "Summary", "study"]
