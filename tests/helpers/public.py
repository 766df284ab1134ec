"""The public names of a package: those of its stub."""

from types import ModuleType

import lazy_loader


def public_names(package: ModuleType) -> list[str]:
    """Return the names that users and type checkers find in a package, without its version."""
    _, _, names = lazy_loader.attach_stub(package.__name__, str(package.__file__))
    return sorted({*names} - {"__version__"})
