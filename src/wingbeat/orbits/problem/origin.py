"""Where the choices of a problem come from: the model of its flight, each choice with its reason."""

from __future__ import annotations

from typing import Any, NamedTuple


class Choice(NamedTuple):
    """One choice of a model.

    Attributes
    ----------
    what : what is chosen, in words.
    value : the choice, in words or as a number with its unit.
    reason : why.
    """

    what: str
    value: str
    reason: str


class Origin(NamedTuple):
    """The model that a problem was made by.

    Attributes
    ----------
    name : of the model, ``"paper"`` or ``"animal"``.
    choices : all its choices.
    changed : air loads and parameters of `OrbitProblem` that were chosen otherwise than by the model. Numbers of
        the species that were changed are not among them; their sources say so.
    """

    name: str
    choices: tuple[Choice, ...]
    changed: tuple[str, ...] = ()

    def record(self) -> dict[str, Any]:
        """Return it as lists and texts, fit for JSON.

        >>> Origin("paper", (Choice("coefficients", "su-fan", "measured"),)).record()["choices"]
        [{'what': 'coefficients', 'value': 'su-fan', 'reason': 'measured'}]
        """
        choices = [choice._asdict() for choice in self.choices]
        return {"name": self.name, "choices": choices, "changed": list(self.changed)}


def origin_from(record: dict[str, Any]) -> Origin:
    """Return the origin that `Origin.record` described.

    Parameters
    ----------
    record : its name, choices and changes.

    Raises
    ------
    KeyError, TypeError : the dictionary was not made by `Origin.record`.
    """
    choices = tuple(Choice(**choice) for choice in record["choices"])
    return Origin(record["name"], choices, tuple(record["changed"]))
