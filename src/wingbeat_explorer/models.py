"""The models of the explorer: those of `wingbeat.models`, within plausible ranges or with other coefficients."""

from __future__ import annotations

from typing import Any, NamedTuple


class ExplorerModel(NamedTuple):
    """What a name in the explorer's menu of models stands for.

    Attributes
    ----------
    title : what the page calls it.
    model : its name in `wingbeat.models`.
    coefficients : name of the coefficients that replace the model's own, or None.
    within_plausible : whether the flights keep to the plausible ranges of the species.
    """

    title: str
    model: str
    coefficients: str | None = None
    within_plausible: bool = False

    @property
    def changes(self) -> dict[str, Any]:
        """What differs from the model's own choices, as `wingbeat.models.Model.problem` takes it."""
        loads = {} if self.coefficients is None else {"aero": self.coefficients}
        return loads | ({"bounds": "plausible"} if self.within_plausible else {})


# In the order of the menu. Dickinson et al. 1999 measured their coefficients on a model of a fruit fly's wing.
EXPLORER_MODELS = {
    "plausible": ExplorerModel("live animal", "animal", within_plausible=True),
    "animal": ExplorerModel("live animal, no limits", "animal"),
    "paper": ExplorerModel("Su et al. 2023", "paper"),
    "dickinson": ExplorerModel("Su et al. 2023, as a fruit fly", "paper", "dickinson"),
}
LATTICE_MODELS = tuple(EXPLORER_MODELS)
# Three starts find the flights of twenty, in 5 to 13 s in place of 27 to 55 s: the pigeon's at 12 and 13 m/s, and
# the bat's at 6 and 7 m/s.
_STARTS_WITHIN = 3


def search_starts(starts: int | None, within_plausible: bool) -> int | None:
    """Return the number of starts of a search, None for the solver's default.

    Within plausible ranges a start takes seconds, so that a reader who waits gets fewer of them.

    >>> search_starts(None, True), search_starts(8, True), search_starts(None, False)
    (3, 8, None)
    """
    return _STARTS_WITHIN if starts is None and within_plausible else starts


def name_of(model: str, coefficients: str, within_plausible: bool = False) -> str:
    """Return the explorer's name of a model of `wingbeat.models`, flown with these coefficients.

    >>> name_of("paper", "su-fan"), name_of("paper", "dickinson"), name_of("animal", "membrane", True)
    ('paper', 'dickinson', 'plausible')
    """
    for own in (coefficients, None):
        for name, one in EXPLORER_MODELS.items():
            if (one.model, one.coefficients, one.within_plausible) == (model, own, within_plausible):
                return name
    return model
