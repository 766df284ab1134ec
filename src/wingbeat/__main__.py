"""``python -m wingbeat``: the command line."""

import sys

from wingbeat.cli import program

if __name__ == "__main__":
    sys.exit(program())
