"""Flight models that differ in one thing."""

from wingbeat import FlightModel
from wingbeat._jax.arrays import unchecked


def changed(model, **fields):
    """Return a flight model with other fields; its constructor takes air loads, not what it keeps of them."""
    return unchecked(FlightModel, vars(model) | fields)
