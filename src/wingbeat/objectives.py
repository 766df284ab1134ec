"""Quantities of a beat that can be minimised or kept within limits, in one place.

>>> import wingbeat as wb
>>> cost = wb.objectives.PowerCost(returned=0.5)
>>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, minimise=cost).minimise.name
'power_cost(0.5)'
"""

from wingbeat.orbits.problem.quantities import QUANTITIES as QUANTITIES
from wingbeat.orbits.problem.quantities import Frequency as Frequency
from wingbeat.orbits.problem.quantities import PowerCost as PowerCost
from wingbeat.orbits.problem.quantities import SpringPower as SpringPower
from wingbeat.orbits.problem.quantities import named_objective as named_objective
from wingbeat.orbits.problem.quantities import named_quantity as named_quantity
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES as MAP_QUANTITIES
from wingbeat.orbits.problem.quantity import MapQuantity as MapQuantity
from wingbeat.orbits.problem.quantity import Quantity as Quantity
