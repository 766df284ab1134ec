"""The files of the built-in species, and the template to start from."""

from __future__ import annotations

from importlib import resources

_TEMPLATE = "template"


def packaged_text(name: str) -> str:
    """Return the text of a TOML file that the package contains."""
    return resources.files("wingbeat").joinpath("data", f"{name}.toml").read_text(encoding="utf-8")


def template() -> str:
    """Return a complete, commented species file to start from; it can be loaded without changes.

    >>> "semi_span" in template()
    True
    """
    return packaged_text(_TEMPLATE)


def species_names() -> tuple[str, ...]:
    """Return the names of the built-in species.

    >>> species_names()[:3]
    ('annas-hummingbird', 'barn-swallow', 'bat')
    """
    files = (entry.name for entry in resources.files("wingbeat").joinpath("data").iterdir())
    names = {name.removesuffix(".toml") for name in files if name.endswith(".toml")}
    return tuple(sorted(names - {_TEMPLATE}))
