"""Engines of studies for tests that do not ask about processes."""

from wingbeat.studies.engine import Ended
from wingbeat.studies.work import solve_unit


class Here:
    """An engine that works where it is asked to, in this process."""

    workers = 1

    def __init__(self):
        self.batches = []

    @property
    def free(self):
        return 1 - len(self.batches)

    def submit(self, batch, units):
        self.batches.append((batch, units))

    def wait(self, seconds):
        batch, units = self.batches.pop()
        return Ended(batch, [outcome for unit in units for outcome in solve_unit(unit)], "here")

    def close(self):
        pass
