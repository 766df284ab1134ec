"""Free flights in PteraSoftware through our adapter: without air a body falls and turns as Newton says."""

import math

import numpy as np
import pytest

from tests.helpers.places import ROOT
from wingbeat_evidence.second_opinion.free_flight import REACTION, as_rigid_body
from wingbeat_evidence.second_opinion.vortex_lattice import fly_free


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of the many packages that PteraSoftware brings
def test_a_body_in_hardly_any_air_falls_and_turns_by_the_given_moment():
    pytest.importorskip("pterasoftware", reason="needs the extra uvlm: PteraSoftware is not installed")
    step, gravity, inertia, moment, drag = 0.01, 9.81, 0.002, 0.01, -0.3
    x, y = np.linspace(0.0, -0.1, 3), np.linspace(0.3, -0.3, 5)
    plate = np.stack(np.broadcast_arrays(x[:, None], y, 0.0), axis=-1)
    led = np.array([[10.0 * step * k, 0.0, 0.05, 10.0, 0.0, 0.0] for k in range(4)])
    seen = []

    def others(at, state):
        seen.append(at)
        return np.array([drag, 0.0, moment])

    flight = fly_free(np.tile(plate, (14, 1, 1, 1)), step, led, (0.5, inertia, gravity, 1e-9), others)
    time = step * np.arange(11)
    expected = np.stack(
        [
            10.0 * (3 * step + time) + 0.5 * drag / 0.5 * time**2,
            -0.5 * gravity * time**2,
            0.05 + 0.5 * moment / inertia * time**2,
            10.0 + drag / 0.5 * time,
            -gravity * time,
            moment / inertia * time,
        ],
        axis=-1,
    )
    assert flight.state[:4] == pytest.approx(led, abs=1e-9)
    assert flight.state[3:] == pytest.approx(expected, abs=1e-6)
    assert set(seen) == {0, *range(3, 14)}
    assert abs(flight.force).max() < 1e-6


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_body_that_pitches_past_85_degrees_ends_its_flight():
    pytest.importorskip("pterasoftware", reason="needs the extra uvlm: PteraSoftware is not installed")
    x, y = np.linspace(0.0, -0.1, 3), np.linspace(0.3, -0.3, 5)
    plate = np.stack(np.broadcast_arrays(x[:, None], y, 0.0), axis=-1)
    led = np.array([[0.1 * k, 0.0, 0.0, 10.0, 0.0, 20.0] for k in range(2)])
    flight = fly_free(np.tile(plate, (30, 1, 1, 1)), 0.01, led, (0.5, 0.002, 0.0, 1e-9))
    assert 6 <= len(flight.state) < 11
    assert flight.state[:, 2].max() < math.radians(85.0)


@pytest.mark.slow
def test_loads_of_a_glide_carry_its_weight_and_its_still_wings_react_with_nothing(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import free_flight

    model, aero, motion = free_flight.flight(free_flight.GLIDE)
    flown = as_rigid_body(model, aero, motion, 4)
    weight = flown.mass * model.air.gravity
    whole = sum(loads for name, loads in flown.loads.items() if name != REACTION)
    assert whole == pytest.approx(np.tile([0.0, weight, 0.0], (4, 1)), abs=1e-9 * weight)
    assert flown.loads[REACTION] == pytest.approx(np.zeros((4, 3)), abs=1e-9 * weight)
