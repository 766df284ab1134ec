"""Quantities of a beat that can be minimised or kept within limits, in one place.

>>> import wingbeat as wb
>>> cost = wb.objectives.PowerCost(returned=0.5)
>>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, minimise=cost).minimise.name
'power_cost(0.5)'
"""

__all__ = [
    *("MAP_QUANTITIES", "QUANTITIES", "Frequency", "MapQuantity", "PowerCost", "Quantity", "SpringPower"),
    *("named_objective", "named_quantity"),
]
