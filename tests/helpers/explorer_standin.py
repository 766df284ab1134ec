"""Cheap work for pools of workers."""

import os
import sys
import time


def do(what, hand):
    """Do as told: echo, wait in steps, wait deaf, fail, die, outgrow the memory, or ask for more than there is."""
    kind, value = what
    if kind == "steps":
        for step in range(value):
            hand.progress(step, value)
            time.sleep(0.02)
    elif kind == "deaf":
        time.sleep(value)
    elif kind == "fail":
        raise ValueError(value)
    elif kind == "die":
        os._exit(value)
    elif kind == "outgrow":
        sys.modules["__main__"]._MOST_MEMORY = value  # of the worker
    elif kind == "hoard":
        return {"echo": len(bytearray(value))}
    return {"echo": value, "pid": os.getpid()}
