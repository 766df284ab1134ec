"""The model with which a problem was made, and the model's choices, each with its reason."""

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
    """The model with which a problem was made.

    Attributes
    ----------
    name : of the model, ``"paper"`` or ``"animal"``.
    choices : all its choices.
    changed : names of the air loads and of the parameters of `OrbitProblem` that the user chose differently. The
        list omits changed numbers of the species; their sources name the change.
    """

    name: str
    choices: tuple[Choice, ...]
    changed: tuple[str, ...] = ()

    def record(self) -> dict[str, Any]:
        """Return the origin as lists and texts, for JSON.

        >>> Origin("paper", (Choice("coefficients", "su-fan", "measured"),)).record()["choices"]
        [{'what': 'coefficients', 'value': 'su-fan', 'reason': 'measured'}]
        """
        choices = [choice._asdict() for choice in self.choices]
        return {"name": self.name, "choices": choices, "changed": list(self.changed)}


def origin_from(record: dict[str, Any]) -> Origin:
    """Return the origin from its record.

    Parameters
    ----------
    record : name, choices and changes, as from `Origin.record`.

    Raises
    ------
    KeyError, TypeError : the dictionary was not made by `Origin.record`.
    """
    choices = tuple(Choice(**choice) for choice in record["choices"])
    return Origin(record["name"], choices, tuple(record["changed"]))
