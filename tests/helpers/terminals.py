"""Programs whose stderr is a terminal, for what is shown there alone."""

import os
import subprocess
from collections.abc import Callable
from typing import Any

import pytest

needs_terminal = pytest.mark.skipif(not hasattr(os, "openpty"), reason="no terminals to be had on this system")


def on_terminal(start: Callable[..., Any], columns: int = 80) -> tuple[int, str, str]:
    """Run a program with a terminal for its stderr; return exit code, stdout, and what the terminal was sent.

    Parameters
    ----------
    start : starts it, given keywords of `Popen`.
    columns : that the terminal is wide.
    """
    mine, terminal = os.openpty()
    environment = os.environ | {"TERM": "xterm", "COLUMNS": str(columns), "NO_COLOR": ""}
    with start(stdout=subprocess.PIPE, stderr=terminal, text=True, env=environment) as process:
        os.close(terminal)
        shown = b""
        try:
            while part := os.read(mine, 4096):
                shown += part
        except OSError:
            pass  # so Linux tells that the other end is closed
        os.close(mine)
        assert process.stdout is not None
        out = process.stdout.read()
    return process.returncode, out, shown.decode()
