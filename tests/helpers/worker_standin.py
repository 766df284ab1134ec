"""Cheap work for worker processes."""

import os
import sys
import time


class OddError(Exception):
    """One that can be pickled, but not brought back."""

    def __init__(self, one, other):
        super().__init__(f"{one} {other}")


def do(what, context):
    """Do as told: echo, wait in steps, wait deaf, fail, die, exit, or ask for more memory than there is."""
    kind, value = what
    if kind == "steps":
        for step in range(value):
            context.progress(step, value)
            time.sleep(0.02)
    elif kind == "deaf":
        time.sleep(value)
    elif kind == "fail":
        raise ValueError(value)
    elif kind == "fail oddly":
        raise OddError(value, value)
    elif kind == "die":
        os._exit(value)
    elif kind == "exit":
        sys.exit(value)
    elif kind == "hoard":
        return {"echo": len(bytearray(value))}
    return {"echo": value, "pid": os.getpid()}
