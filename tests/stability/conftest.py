"""The pigeon in cruise, whose numbers the pages give."""

import pytest

import wingbeat as wb


@pytest.fixture(scope="session")
def cruise():
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)


@pytest.fixture(scope="session")
def held(cruise):
    """Feedback without delay."""
    return wb.feedback(cruise)


@pytest.fixture(scope="session")
def patient(cruise):
    """Feedback for one beat of delay."""
    return wb.feedback(cruise, delay=1)
