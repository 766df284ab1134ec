"""The command line: ``wingbeat COMMAND ...``. Nothing heavy is imported before a command runs."""

from __future__ import annotations

from wingbeat.cli.process import end_on_signals

TYPE_CHECKING = False  # `typing` takes longer to import than all that must be ready for Ctrl-C
if TYPE_CHECKING:
    from wingbeat.cli.app import main as main

__all__ = ["main", "program"]


def __getattr__(name: str) -> object:
    if name == "main":
        from wingbeat.cli.app import main

        return main
    raise AttributeError(f"module 'wingbeat.cli' has no attribute {name!r}")


def program() -> int:
    """Run the command line and end the process at once: the operating system frees the memory, not Python."""
    end_on_signals()  # before all else: imports take a second
    import gc

    from wingbeat._workers.tuning import tune_process
    from wingbeat.cli.app import main
    from wingbeat.cli.process import prepare_streams

    prepare_streams()
    tune_process()
    code = main()
    gc.freeze()  # or the interpreter spends half a second at exit looking for garbage in what JAX holds
    return code
