"""Finite differences of high order."""

import numpy as np

from wingbeat import State

# Central differences of order 8: weight of each step.
ORDER_8 = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}


def differences(function, point, steps):
    """Return the derivative (outputs, inputs) of a function of a vector."""
    columns = []
    for i, step in enumerate(np.broadcast_to(steps, point.shape)):
        along = step * np.eye(point.size)[i]
        terms = [w * (function(point + k * along) - function(point - k * along)) for k, w in ORDER_8.items()]
        columns.append(sum(terms) / step)
    return np.stack(columns, axis=-1)


def flow_of(state, acceleration):
    """Return the rates of a state that has accelerations of shape (K, 3)."""
    return State(state.u, state.w, state.pitch_rate, *np.transpose(acceleration))


def rates_along(loads, held, model, beat, state, phase, acceleration):
    """Return the rates of what `held` reads off the loads, along a flight and over fractions of a millisecond.

    `loads` takes model, wingbeat, state and phase; these may be any states with their accelerations (K, 3).
    """
    now, flow, step = np.stack(state), np.stack(flow_of(state, acceleration)), 2e-4

    def after(time):
        return np.asarray(held(loads(model, beat, State(*(now + time * flow)), phase + time * beat.frequency)))

    return sum(w * (after(k * step) - after(-k * step)) for k, w in ORDER_8.items()) / step


def miss(exact, found):
    """Return the largest difference of two Jacobians, over the largest entry of its row."""
    exact, found = np.asarray(exact), np.asarray(found)
    rows = np.abs(found).max(axis=-1, keepdims=True)
    return float((np.abs(exact - found) / np.where(rows > 0, rows, 1.0)).max())
