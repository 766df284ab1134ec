"""A stand-in for the work of a study's processes: cheap points, some of which crash, hang or raise.

It is loaded by worker processes, which have the repository on their path, and imports nothing heavy.
"""

import json
import os
import signal
import sys
import time

from wingbeat.studies.units import Outcome, failed

# Speeds [m/s] at which something happens.
CRASHES, HANGS, RAISES, INFEASIBLE = 90.0, 91.0, 92.0, 93.0
# It takes along whoever started its process: never for a process whose parent is a test.
KILLS_PARENT = 94.0
# Its process gives up by itself.
LEAVES = 95.0
# What should tell of a point's fault has one itself.
BREAKS = 96.0


def solve(units, context):
    """Report the outcome of each point of some units."""
    for unit in units:
        for task in unit.tasks:
            if task.key not in unit.skip:
                context.report(outcome(task))


def outcome(task):
    """Return what a point's inputs alone determine, after some time; each solved point is noted in a log."""
    speed = task.changes["speed"]
    if speed == CRASHES:
        os.kill(os.getpid(), signal.SIGKILL)
    if speed == LEAVES:
        sys.exit(7)
    if speed == BREAKS:
        raise TypeError("no outcome")
    if speed == KILLS_PARENT:
        os.kill(os.getppid(), signal.SIGKILL)
    while speed == HANGS:
        time.sleep(1.0)
    time.sleep(float(os.environ.get("STANDIN_SECONDS", "0")))
    if log := os.environ.get("STANDIN_LOG"):
        with open(log, "a") as file:
            file.write(task.key + "\n")
    if speed == RAISES:
        return failed(task.key, "error", "ValueError: no such speed", 0.01)
    status = "infeasible" if speed == INFEASIBLE else "converged"
    record = {"status": status, "speed": speed, "mean_power": 1.0 / (1.0 + speed), "warnings": []}
    return Outcome(task.key, status, json.dumps(record), 1e-9, "" if status == "converged" else "too fast", 0.01)
