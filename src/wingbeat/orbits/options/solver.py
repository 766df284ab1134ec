"""All options of the solvers in one value."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Any

from wingbeat.orbits.options.certificate import CertificateOptions
from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.continuation import ContinuationOptions, SensitivityOptions
from wingbeat.orbits.options.diagnosis import ChangeOptions, DiagnosisOptions
from wingbeat.orbits.options.search import SearchOptions


@dataclass(frozen=True, repr=False)
class SolverOptions:
    """Every tuning number of the solvers, each with its default. Printed, it shows those that are not the default.

    Parameters
    ----------
    search : options of the starts and the local searches.
    certificate : options of the correction of an optimum, and of the flight that certifies it.
    continuation : options of the continuation of orbits along speed, and from problem to problem.
    diagnosis : options of the diagnosis of the balance that fails if there is no orbit.
    changes : options of the changes that are tried if there is no orbit.
    sensitivity : options of the derivatives of an optimum.

    Raises
    ------
    InvalidInputError : a value of another class.

    >>> from wingbeat.orbits.options.search import SearchOptions
    >>> SolverOptions(search=SearchOptions(iterations=100)).changed()
    {'search': {'iterations': 100}}
    >>> SolverOptions(), SolverOptions(search=SearchOptions(iterations=100))
    (SolverOptions(), SolverOptions(search=SearchOptions(iterations=100)))
    """

    search: SearchOptions = field(default_factory=SearchOptions)
    certificate: CertificateOptions = field(default_factory=CertificateOptions)
    continuation: ContinuationOptions = field(default_factory=ContinuationOptions)
    diagnosis: DiagnosisOptions = field(default_factory=DiagnosisOptions)
    changes: ChangeOptions = field(default_factory=ChangeOptions)
    sensitivity: SensitivityOptions = field(default_factory=SensitivityOptions)

    def __post_init__(self) -> None:
        check_options(self)

    def __repr__(self) -> str:  # not every number: this is the default that `help` shows of each solver
        return _shown(self, SolverOptions())

    def changed(self) -> dict[str, Any]:
        """Return the options that are not the defaults, as a nested dictionary that JSON can hold."""
        return _differences(self, DEFAULTS)


def _shown(options: Any, usual: Any) -> str:
    """Return options as Python writes them, without those that are the default."""
    shown = []
    for each in dataclasses.fields(options):
        value, default = getattr(options, each.name), getattr(usual, each.name)
        if value != default:
            nested = dataclasses.is_dataclass(value)
            shown.append(f"{each.name}={_shown(value, default) if nested else repr(value)}")
    return f"{type(options).__name__}({', '.join(shown)})"


def _differences(options: Any, usual: Any) -> dict[str, Any]:
    found = {}
    for each in dataclasses.fields(options):
        value, default = getattr(options, each.name), getattr(usual, each.name)
        if value != default:
            nested = dataclasses.is_dataclass(value)
            found[each.name] = _differences(value, default) if nested else value
    return found


DEFAULTS = SolverOptions()
