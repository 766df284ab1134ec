"""Certified orbits of wings of all kinds: rigid, with a changing span, folding and twisting, with all air loads."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb

RIGID = {"wingbeat.span_retraction": 0.0, "wingbeat.fold_amplitude": 0.0, "wingbeat.twist_ratio": 1.0}


def solved(problem):
    orbit = wb.solve_orbit(problem, starts=2)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    return orbit


@pytest.fixture(scope="session")
def rigid_orbit():
    """Nothing symmetric that need not be: a shoulder off the centre, a tilted stroke plane."""
    changes = {"wing.shoulder": (0.002, 0.035, 0.004), "wing.stroke_plane_angle": np.radians(85.0)}
    return solved(wb.OrbitProblem(wb.load_species("pigeon").with_values(RIGID | changes), speed=12.0))


@pytest.fixture(scope="session")
def animal_orbit():
    """Unsteady terms, a tail, body drag, a span that changes."""
    pigeon = wb.load_species("pigeon")
    return solved(wb.models.animal(pigeon).problem(pigeon, speed=12.0))


@pytest.fixture(scope="session")
def swept_orbit(rigid_orbit):
    """Sweep, and a twist by its own law; a wingbeat that was not solved for, so the beat does not close."""
    record = rigid_orbit.record()
    record["wingbeat"] |= {"sweep_mean": 0.05, "sweep_amplitude": 0.1, "twist_mean": 0.05}
    return wb.Orbit.of_record(record, rigid_orbit.problem, starts=2)


@pytest.fixture(scope="session")
def off_axis_orbit(pigeon_orbit):
    """Strips that slide and turn about another axis; a wing that was not solved for, so the beat does not close."""
    orbit = pigeon_orbit.orbit
    changes = {"wing.pitch_axis": 0.35, "wing.mass_axis": 0.45, "wing.mass_gyration": 0.2}
    problem = dataclasses.replace(orbit.problem, species=orbit.problem.species.with_values(changes))
    return wb.Orbit.of_record(orbit.record(), problem, starts=2)


@pytest.fixture(scope="session")
def uncertified_orbit(pigeon_orbit):
    """An orbit whose record says that it was not certified."""
    record = pigeon_orbit.orbit.record() | {
        "status": "not-converged",
        "message": "the search ended too early",
        "stable": None,
    }
    return wb.Orbit.of_record(record, pigeon_orbit.problem, starts=1)


@pytest.fixture(params=["rigid", "pigeon", "bat", pytest.param("animal", marks=pytest.mark.slow)])
def orbit(request):
    """Each of the orbits in turn."""
    found = request.getfixturevalue(f"{request.param}_orbit")
    return getattr(found, "orbit", found)


def derivative(values, period):
    """Return the time derivative of smooth periodic samples, axis 0, by their Fourier series."""
    count = len(values)
    waves = np.fft.fft(values, axis=0)
    order = np.fft.fftfreq(count, 1.0 / count) * (2j * np.pi / period)
    order[count // 2] = 0.0
    return np.fft.ifft(waves * order.reshape(-1, *[1] * (np.ndim(values) - 1)), axis=0).real
