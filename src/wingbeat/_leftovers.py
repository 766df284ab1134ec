"""Clear what a process must not leave behind when it is ended: half-written files, workers, a hidden cursor."""

from __future__ import annotations

TYPE_CHECKING = False  # `typing` takes longer to import than all that must be ready for Ctrl-C
if TYPE_CHECKING:
    from collections.abc import Callable

_LEFTOVERS: list[Leftover] = []


class Leftover:
    """A block whose traces, such as temporary files, `clear` clears if the process is ended inside it.

    A block that ends by itself, or by an exception, clears its own traces. `clear` may be called in any thread, at
    any time within the block.
    """

    def __init__(self, clear: Callable[[], object]) -> None:
        self.clear = clear

    def __enter__(self) -> None:
        _LEFTOVERS.append(self)

    def __exit__(self, *_: object) -> None:
        _LEFTOVERS.remove(self)


def clear_leftovers() -> None:
    """Clear the traces of every open block, the innermost first."""
    for leftover in reversed(list(_LEFTOVERS)):
        try:
            leftover.clear()
        except Exception:  # the process ends in any case, and the others are to be cleared too
            continue
