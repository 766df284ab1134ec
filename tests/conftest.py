"""Solved orbits shared by the tests, and re-flights of them by SciPy, no relation of the package's own."""

import dataclasses
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import wingbeat as wb
from wingbeat.flights import state_rates
from wingbeat.jax64 import jax, jnp
from wingbeat.loads import flight_loads
from wingbeat.orbits.certify import Certificate, certify

ORBITS = {
    "pigeon": (10.0, wb.aero.SuFan()),
    "bat": (8.0, wb.aero.Dickinson()),
}
INTEGRALS = ("force_x", "force_z", "actuator_power", "air_power", "hinge_power")


class Reflight(NamedTuple):
    """One period flown by SciPy: state at the end, and time integrals over the period of what `INTEGRALS` names."""

    end: np.ndarray
    integrals: dict[str, float]


def pytest_configure(config):
    # Two workers share JAX's cache on disk, which it does not write whole or not at all.
    race = "ignore:Error (reading|writing) persistent compilation cache entry:UserWarning"
    config.addinivalue_line("filterwarnings", race)


@dataclasses.dataclass(frozen=True)
class Solved:
    """A certified orbit with what the tests ask of it."""

    orbit: wb.Orbit
    problem: wb.OrbitProblem
    model: wb.FlightModel
    wingbeat: wb.Wingbeat
    start: np.ndarray
    certificate: Certificate

    @property
    def travelled(self):
        """The closed orbit's change of state over one period."""
        return np.array([self.problem.speed, self.problem.climb, 0, 0, 0, 0]) / self.wingbeat.frequency

    @property
    def samples(self):
        """State and phase at the certifier's samples, as `flight_loads` takes them."""
        return wb.State(*self.certificate.states.T), self.certificate.phase


def dop853(rates, phases, start, rtol=1e-11):
    """Integrate with SciPy's DOP853 from one phase to another and return the end."""
    atol = 0.1 * rtol
    found = solve_ivp(lambda p, y: np.asarray(rates(p, y)), phases, start, "DOP853", rtol=rtol, atol=atol)
    assert found.success, found.message
    return found.y[:, -1]


@jax.jit
def _rates_and_integrands(model, wingbeat, phase, state):
    now = flight_loads(model, wingbeat, wb.State(*state[:, None]), phase[None])
    power = jnp.stack([now.actuator_power, now.air_power, now.hinge_power])
    rates = state_rates(model, wingbeat, phase, state)
    return jnp.concatenate([rates, now.air_force[0, :2], power[:, 0]]) / wingbeat.frequency


def refly(model, wingbeat, start):
    """Fly one period with DOP853, the integrals as extra states."""
    first = np.concatenate([start, np.zeros(len(INTEGRALS))])
    end = dop853(lambda p, y: _rates_and_integrands(model, wingbeat, np.asarray(p), y[:6]), (0.0, 1.0), first)
    return Reflight(end[:6], dict(zip(INTEGRALS, end[6:], strict=True)))


@jax.jit
def _many_rates(model, wingbeat, phase, states):
    return jax.vmap(lambda s: state_rates(model, wingbeat, phase, s))(states) / wingbeat.frequency


def refly_many(model, wingbeat, starts):
    """Fly one period from several states at once, shape (K, 6): all share the same steps.

    So small a tolerance because differences of such flights magnify their errors ten-thousandfold.
    """
    shape = np.shape(starts)

    def rates(phase, y):
        return np.asarray(_many_rates(model, wingbeat, np.asarray(phase), y.reshape(shape))).ravel()

    return dop853(rates, (0.0, 1.0), np.ravel(starts), rtol=1e-13).reshape(shape)


def solve(name, **search: Any):
    """Solve one of `ORBITS`."""
    speed, coefficients = ORBITS[name]
    problem = wb.OrbitProblem(wb.load_species(name), speed=speed, aero=coefficients)
    orbit = wb.solve_orbit(problem, **{"starts": 2, **search})
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    start = np.array(orbit.initial_state)
    certificate = certify(problem.model, orbit.wingbeat, start[2:], problem.free)
    return Solved(orbit, problem, problem.model, orbit.wingbeat, start, certificate)


@pytest.fixture(scope="session")
def pigeon_orbit() -> Solved:
    return solve("pigeon")


@pytest.fixture(scope="session")
def bat_orbit() -> Solved:
    return solve("bat")


@pytest.fixture(scope="session", params=ORBITS)
def solved(request) -> Solved:
    """Each of the certified orbits in turn."""
    return request.getfixturevalue(f"{request.param}_orbit")


@pytest.fixture(scope="session")
def reflight(solved) -> Reflight:
    """The same orbit flown by SciPy."""
    return refly(solved.model, solved.wingbeat, solved.start)
