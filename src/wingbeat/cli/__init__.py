"""The command line: ``wingbeat COMMAND ...``. Nothing heavy is imported before a command runs."""

from wingbeat.cli.app import main, program

__all__ = ["main", "program"]
