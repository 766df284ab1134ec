"""A second opinion on the air loads of an orbit: the same motion in an unsteady vortex lattice."""

from wingbeat_evidence.second_opinion.comparison import SecondOpinion as SecondOpinion
from wingbeat_evidence.second_opinion.comparison import compare_with_lattice as compare_with_lattice
from wingbeat_evidence.second_opinion.lattice import LatticeOptions as LatticeOptions

__all__ = ["LatticeOptions", "SecondOpinion", "compare_with_lattice"]


def __dir__() -> list[str]:
    return sorted(__all__)
