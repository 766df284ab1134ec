"""A stand-in for the work of the assumption study: each point at once a made-up orbit, or none, by its key.

It is loaded by worker processes, which have the repository on their path, and imports nothing heavy.
"""

import json
import os
import time

from wingbeat.studies.units import Outcome


def solve(units, context):
    """Report the records of some units."""
    for unit in units:
        for outcome in outcomes(unit):
            context.report(outcome)


def outcomes(unit):
    """Yield records with what the claims look at; they depend on the points' keys alone."""
    stock = json.loads(unit.recipe)["stock_wingbeat"]
    for task in unit.tasks:
        time.sleep(float(os.environ.get("STANDIN_SECONDS", "0")))
        one, other = (int(task.key[i : i + 4], 16) / 0xFFFF for i in (0, 4))
        status = "converged" if one < 0.9 else "infeasible"
        record = {
            "status": status,
            "message": "made up",
            "wingbeat": stock | {"frequency": 4.0 + 6.0 * other},
            "initial_state": dict(x=0.0, z=0.0, body_pitch=0.1, u=task.changes["speed"], w=0.0, pitch_rate=0.0),
            **dict.fromkeys(("peak_power", "mean_positive_power", "body_pitch_range"), 1.0 + one),
        }
        yield Outcome(task.key, status, json.dumps(record), 1e-9, "", 0.25)
