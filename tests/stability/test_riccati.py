"""Linear feedback against closed answers, sums of costs, and delayed loops that are rolled out beat by beat."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from wingbeat._base import FaultList
from wingbeat.stability.riccati import (
    check_reach,
    closed_loop,
    delayed,
    gains_along,
    linear_quadratic,
    periodic_linear_quadratic,
    reaches,
    sufficient,
)

ENTRIES = st.lists(st.floats(-1.5, 1.5), min_size=15, max_size=15)


def pair(numbers):
    """Return A (3, 3) and B (3, 2), which reaches everything."""
    return np.reshape(numbers[:9], (3, 3)), np.reshape(numbers[9:], (3, 2)) + 2.0 * np.eye(3, 2)


def test_a_single_state_has_the_closed_answer():
    a, b, q, r = 1.4, 0.5, 2.0, 3.0
    gains, cost = linear_quadratic(*(np.array([[number]]) for number in (a, b, q, r)))
    # b2 p2 + (r - a2 r - b2 q) p - q r = 0
    middle = r - a * a * r - b * b * q
    p = (-middle + math.sqrt(middle * middle + 4 * b * b * q * r)) / (2 * b * b)
    assert cost[0, 0] == pytest.approx(p)
    assert gains[0, 0] == pytest.approx(a * b * p / (r + b * b * p))


def spent(A, B, gains, start, beats=400):
    """Return the sum of the costs of all beats, with unit weights."""
    total, state = 0.0, start
    for _ in range(beats):
        taken = -gains @ state
        total += state @ state + taken @ taken
        state = A @ state + B @ taken
    return total


def test_the_cost_to_go_is_what_is_spent_and_other_gains_spend_more():
    A = np.array([[1.3, 0.2, 0.0], [0.1, 0.7, -0.3], [0.0, 0.4, 0.9]])
    B = np.array([[0.2, 0.0], [0.1, 0.5], [0.0, 0.3]])
    gains, cost = linear_quadratic(A, B, np.eye(3), np.eye(2))
    random = np.random.default_rng(0)
    for start in random.normal(size=(3, 3)):
        least = start @ cost @ start
        assert spent(A, B, gains, start) == pytest.approx(least, rel=1e-9)
        other = gains + 0.02 * random.normal(size=gains.shape)
        assert spent(A, B, other, start) > least


@given(ENTRIES, st.integers(0, 3), st.integers(0, 2))
def test_the_closed_loop_is_what_a_flight_with_late_inputs_does(numbers, delay, late):
    A, B = pair(numbers)
    gains = np.random.default_rng(1).normal(size=(2, 3 + 2 * delay))
    state, waiting = np.array([1.0, -0.5, 0.3]), [np.zeros(2) for _ in range(delay + late)]
    whole = np.concatenate([state, *waiting])
    loop = closed_loop(A, B, gains, delay, late)
    for _ in range(5):
        known = waiting[len(waiting) - delay :]
        waiting.append(-gains @ np.concatenate([state, *known]))
        state = A @ state + B @ waiting.pop(0)
        whole = loop @ whole
        assert np.allclose(whole, np.concatenate([state, *waiting]), rtol=1e-9, atol=1e-9 * np.abs(whole).max())


def test_gains_for_a_delay_hold_it_and_gains_without_do_not():
    A, B = np.array([[1.6]]), np.array([[1.0]])
    prompt, _ = linear_quadratic(A, B, np.eye(1), 0.01 * np.eye(1))
    later = delayed(A, B, 1)
    patient, _ = linear_quadratic(*later, np.diag([1.0, 0.0]), 0.01 * np.eye(1))
    assert np.abs(np.linalg.eigvals(closed_loop(A, B, prompt, 0))).max() < 0.1
    assert np.abs(np.linalg.eigvals(closed_loop(A, B, prompt, 0, late=1))).max() > 1
    assert np.abs(np.linalg.eigvals(closed_loop(A, B, patient, 1))).max() < 1


def test_what_no_input_reaches_is_named():
    A, B = np.diag([1.2, 0.5, 1.0]), np.array([[0.0, 0.0], [1.0, 0.0], [0.3, 0.2]])
    kinds = {1.2 + 0j: "divergence", 0.5 + 0j: "subsidence", 1.0 + 0j: "height"}
    modes = reaches(A, B, ("a", "b"), kinds)
    assert [(mode.kind, mode.persists) for mode in modes] == [
        ("divergence", True),
        ("height", True),
        ("subsidence", False),
    ]
    assert modes[1].effects == pytest.approx({"a": 0.3, "b": 0.2})
    faults = FaultList()
    check_reach(faults, modes, ("a", "b"), 1e-6)
    assert [str(fault) for fault in faults.faults] == [
        "inputs = ['a', 'b']: reach no divergence with multiplier 1.2+0j, which does not decay by itself; "
        "add an input such as pitch_mean"
    ]
    assert sufficient(modes, ("a", "b"), 1e-6) == ()
    B[0] = [0.0, 0.4]
    assert sufficient(reaches(A, B, ("a", "b"), kinds), ("a", "b"), 1e-6) == ("b",)


def test_a_pair_of_complex_multipliers_is_one_mode():
    turn = 1.1 * np.array([[math.cos(0.5), -math.sin(0.5)], [math.sin(0.5), math.cos(0.5)]])
    (mode,) = reaches(turn, np.array([[1.0], [0.0]]), ("a",), {complex(*turn[:, 0]): "oscillation"})
    assert mode.multiplier == pytest.approx(complex(turn[0, 0], turn[1, 0]))
    assert mode.effects["a"] == pytest.approx(math.sqrt(0.5))


def test_periodic_gains_of_equal_maps_are_those_of_one():
    A, B = pair([1.1, 0.2, 0, -0.3, 0.8, 0.5, 0, 0.1, 0.9, 0.1, 0, 0, 0.2, 0.3, 0.1])
    gains, _ = linear_quadratic(A, B, np.eye(3), np.eye(2))
    found = periodic_linear_quadratic(np.stack([A] * 3), np.stack([B] * 3), np.eye(3), np.eye(2))
    assert np.allclose(found, gains, rtol=0, atol=1e-9)


def test_other_periodic_gains_cost_more():
    random = np.random.default_rng(3)
    A, B = random.normal(size=(4, 3, 3)), random.normal(size=(4, 3, 2))
    gains = periodic_linear_quadratic(A, B, np.eye(3), np.eye(2))

    def whole(by):
        total, state = 0.0, np.array([1.0, -0.4, 0.2])
        for beat in range(400):
            taken = -by[beat % 4] @ state
            total += state @ state + taken @ taken
            state = A[beat % 4] @ state + B[beat % 4] @ taken
        return total

    least = whole(gains)
    for _ in range(3):
        assert whole(gains + 0.01 * random.normal(size=gains.shape)) > least


@pytest.mark.parametrize("delay", [0, 1])
def test_gains_along_equal_maps_are_the_steady_ones(delay):
    A, B = pair([0.9, 0.3, 0.0, -0.2, 1.2, 0.1, 0.4, 0.0, 0.8, 0.5, 0.1, 0.0, 0.3, 0.2, 0.7])
    found = gains_along([A] * 4, [B] * 4, np.eye(3), np.eye(2), delay)
    costs = np.diag([1.0] * 3 + [0.0] * 2 * delay)
    steady, _ = linear_quadratic(*delayed(A, B, delay), costs, np.eye(2))
    np.testing.assert_allclose(found, np.stack([steady] * 4), atol=1e-8)


def test_gains_along_cost_least():
    """Any other first command, with the best ones after it, costs more."""
    chain = [pair(np.random.default_rng(seed).uniform(-1.0, 1.0, 15)) for seed in range(4)]
    A, B = zip(*chain, strict=True)
    gains = gains_along(A, B, np.eye(3), np.eye(2))

    def cost(change):
        total, state = 0.0, np.array([1.0, -0.5, 0.3])
        for k in range(400):
            at = min(k, 3)
            taken = -gains[at] @ state + (change if k == 0 else 0.0)
            total += state @ state + taken @ taken
            state = A[at] @ state + B[at] @ taken
        return total

    for change in 0.01 * np.vstack([np.eye(2), -np.eye(2)]):
        assert cost(change) > cost(np.zeros(2))
        assert cost(change) + cost(-change) - 2 * cost(np.zeros(2)) > 0
    slope = (cost(np.array([1e-4, 0])) - cost(np.array([-1e-4, 0]))) / 2e-4
    assert abs(slope) < 1e-6
