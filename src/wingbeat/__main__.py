"""``python -m wingbeat``: the command line."""

import sys

from wingbeat.cli import program

if __name__ == "__main__":  # not in the worker processes, which import this too
    sys.exit(program())
