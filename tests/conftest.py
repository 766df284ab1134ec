"""What tests share: solved orbits, re-flights of them by SciPy, no relation of the package's own, and a browser."""

import dataclasses
import os
import shutil
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.browsers import FLAGS, PATIENCE
from tests.helpers.forks import ForkServer
from tests.helpers.memory import MOST, forget_programs, resident
from tests.helpers.reflight import Reflight, refly
from wingbeat._workers.tuning import tune_process
from wingbeat.cli import terminal
from wingbeat.orbits.flight.certificate import Certificate, certify

# For the processes that pytest and the tests start. Those that share two cores wait for each other's threads: least
# squares of 1080 rows and 307 columns then take fifty times as long (2.2 in place of 0.04 s).
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# On a busy machine a command takes long enough to say so on stderr, which tests expect to be empty. Those of the
# lines set a time of their own.
terminal.FIRST_LINE = 1e6

# As wingbeat's own processes do: through what JAX holds, looks for garbage took 53 of 1260 core-seconds.
tune_process()

ORBITS = {
    "pigeon": (10.0, wb.aero.SuFan()),
    "bat": (8.0, wb.aero.Dickinson()),
}


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


def solve(name, **search: Any):
    """Solve one of `ORBITS`."""
    speed, coefficients = ORBITS[name]
    problem = wb.OrbitProblem(wb.load_species(name), speed=speed, aero=coefficients)
    orbit = wb.solve_orbit(problem, **{"starts": 2, **search})
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    start = np.array(orbit.initial_state)
    certificate = certify(problem.model, orbit.wingbeat, start[2:])
    return Solved(orbit, problem, problem.model, orbit.wingbeat, start, certificate)


@pytest.fixture(scope="module", autouse=True)
def bounded_memory() -> Iterator[None]:
    """Let a process start the next module without the programs of those before, once they are many."""
    yield
    if resident() > MOST:
        forget_programs()


@pytest.fixture(scope="session")
def passive_orbit() -> wb.Orbit:
    """A robot whose pitch hinges give way; no place on the chord is where it is by default."""
    changes = {"pitch_hinge.stiffness": 1.4, "pitch_hinge.damping": 0.0166}
    changes |= {"wing.pitch_axis": 0.3, "wing.mass_axis": 0.4, "wing.mass_gyration": 0.24}
    robot = wb.load_species("robofalcon2").with_values(changes)
    orbit = wb.solve_orbit(wb.OrbitProblem(robot, speed=8.0), starts=2)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    return orbit


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


@pytest.fixture(scope="session")
def forks() -> Iterator[ForkServer]:
    """What starts orbits, studies and those of assumptions without their imports."""
    needed = ("wingbeat.cli.orbit", "wingbeat.cli.study", "wingbeat.studies.study")
    paper = ("commands.paper", "paper.figures", "paper.assumption_page")
    server = ForkServer(*needed, *(f"wingbeat_evidence.{name}" for name in paper))
    yield server
    server.close()


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium, driven by Playwright."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("needs Chromium: apt-get install chromium")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=list(FLAGS), timeout=PATIENCE)
        yield browser
        browser.close()
