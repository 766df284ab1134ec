"""Cheap work for pools of workers."""

import os
import time


def do(what, hand):
    """Do as told: echo, wait in steps, wait deaf, fail, die, or fill memory and let it go."""
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
    return {"echo": value, "pid": os.getpid()}
