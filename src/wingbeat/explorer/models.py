"""The models of the explorer: those of `wingbeat.models`, and that of Su et al. 2023 with a fruit fly's wing."""

from __future__ import annotations

# What each is called on the page, in the order of the menu.
MODEL_TITLES = {"paper": "Su et al. 2023", "animal": "live animal", "dickinson": "Su et al. 2023, as a fruit fly"}
LATTICE_MODELS = tuple(MODEL_TITLES)
# Models whose coefficients are not their own. Dickinson et al. 1999 measured theirs on a fruit fly's wing.
_WITH_OTHERS = {"dickinson": ("paper", "dickinson")}


def parts_of(name: str) -> tuple[str, str | None]:
    """Return a model's name in `wingbeat.models`, and the coefficients that replace the model's own, or None.

    Parameters
    ----------
    name : one of `LATTICE_MODELS`.

    >>> parts_of("animal"), parts_of("dickinson")
    (('animal', None), ('paper', 'dickinson'))
    """
    return _WITH_OTHERS.get(name, (name, None))


def name_of(model: str, coefficients: str) -> str:
    """Return the explorer's name of a model.

    Parameters
    ----------
    model : its name in `wingbeat.models`.
    coefficients : name of the coefficients that it is flown with.

    >>> name_of("paper", "su-fan"), name_of("paper", "dickinson")
    ('paper', 'dickinson')
    """
    return next((name for name, parts in _WITH_OTHERS.items() if parts == (model, coefficients)), model)
