"""Flights from an initial state: sampling, closing, tumbling, refusing; and flights driven by hinge torques."""

import dataclasses
import math

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import CubicSpline

import wingbeat as wb
from tests.helpers.driven import BETWEEN, KNOTS, spline_torques
from wingbeat.mechanics.flights import fly_beats
from wingbeat.records.flight_dataset import evaluate
from wingbeat.records.result_files import load_dataset

SAMPLES = 128  # two beats of it are 257 phases, as an orbit has: JAX compiles once


def pigeon():
    species = wb.load_species("pigeon")
    return wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan()), species.air), species.wingbeat


def test_a_flight_has_a_sample_for_each_phase():
    model, beat = pigeon()
    start = wb.State(1.0, 2.0, 0.1, 10.0, -0.5, 0.3)
    flight = wb.simulate(model, beat, start, beats=2, samples=SAMPLES)
    assert flight.completed
    assert flight.states.shape == (2 * SAMPLES + 1, 6)
    np.testing.assert_allclose(flight.phase, np.arange(2 * SAMPLES + 1) / SAMPLES, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(flight.states[0], start)
    series = flight.dataset
    assert series.sizes["phase"] == 2 * SAMPLES + 1
    np.testing.assert_allclose(series["time"], flight.phase / beat.frequency, rtol=1e-15)
    # Place is the integral of velocity: by Simpson over each beat, to the fineness of the samples.
    u = flight.states[:, 3]
    weights = np.r_[1, np.tile([4, 2], SAMPLES)[:-1], 1] / (3 * SAMPLES * beat.frequency)
    assert flight.states[-1, 0] - 1.0 == pytest.approx(weights @ u, rel=1e-5)


def test_a_flight_of_beats_is_a_chain_of_flights():
    model, beat = pigeon()
    whole = wb.simulate(model, beat, wb.State(u=10.0), beats=2, samples=SAMPLES)
    first = wb.simulate(model, beat, wb.State(u=10.0), beats=1, samples=SAMPLES)
    second = wb.simulate(model, beat, wb.State(*first.states[-1]), beats=1, samples=SAMPLES)
    np.testing.assert_array_equal(whole.states, np.concatenate([first.states, second.states[1:]]))


def test_an_orbit_flown_for_a_beat_returns(solved):
    flight = wb.simulate(solved.model, solved.wingbeat, wb.State(*solved.start), beats=1, samples=SAMPLES)
    assert np.abs(flight.states[-1] - solved.start - solved.travelled).max() <= 1e-6
    # The certifier stood at the same places on the way.
    np.testing.assert_allclose(flight.states, solved.certificate.states[::2], rtol=0, atol=1e-6)
    displaced = wb.State(*solved.start)._replace(pitch_rate=solved.start[5] + 1e-3)
    other = wb.simulate(solved.model, solved.wingbeat, displaced, beats=1, samples=SAMPLES)
    assert np.abs(other.states[-1] - displaced - solved.travelled).max() > 1e-6


def test_scipy_closes_the_orbit_too(solved, reflight):
    """A second integrator, DOP853 at rtol 1e-11, in (m, m, rad, m/s, m/s, rad/s)."""
    assert np.abs(reflight.end - solved.start - solved.travelled).max() <= 1e-6
    recorded = np.array(list(solved.orbit.record()["closure"].values()))
    own = solved.certificate.end - solved.start - solved.travelled
    np.testing.assert_allclose(own, recorded, rtol=0, atol=1e-12)


def test_a_tumbling_flight_is_reported_not_raised(tmp_path):
    """A beat of 100 s is a long fall: the integrator gives up before its end."""
    model, beat = pigeon()
    slow = dataclasses.replace(beat, frequency=0.01)
    flight = wb.simulate(model, slow, wb.State(u=8.0, pitch_rate=20.0), beats=2, samples=SAMPLES)
    assert flight.completed is False
    finite = np.isfinite(flight.states).all(axis=1)
    flown = int(finite.sum())
    assert 1 <= flown < finite.size
    assert finite[:flown].all()  # from where it gave up there is nothing more
    flight.save(tmp_path / "tumbled.nc")
    series = xr.load_dataset(tmp_path / "tumbled.nc", engine="h5netcdf")
    assert np.isnan(series["hinge_power"].values[-1])
    assert np.isfinite(series["hinge_power"].values[:flown]).all()


def test_samples_between_the_steps_are_those_of_a_flight_that_steps_onto_them(solved):
    """Every fourth sample is stepped onto: of 2 048 all those of 256, of 256 every fourth."""
    start = wb.State(*solved.start)
    few, many = (fly_beats(solved.model, solved.wingbeat, start, 1, count)[1] for count in (256, KNOTS))
    apart = np.abs(few - many[::8]).max(axis=1)
    assert apart.max() <= 1e-7
    assert np.abs(many[4::8] - 0.5 * (few[1:] + few[:-1])).max() > 1e-5  # the comparison sees straight lines


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf, "fast", None, True, 1j])
@pytest.mark.parametrize("name", ["x", "z", "body_pitch", "u", "w", "pitch_rate"])
def test_a_state_that_is_no_number_is_refused(name, wrong):
    model, beat = pigeon()
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.simulate(model, beat, wb.State(**{name: wrong}))
    assert [fault.where for fault in refused.value.faults] == [f"initial_state.{name}"]


def test_all_faults_of_a_state_are_told_at_once():
    model, beat = pigeon()
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.simulate(model, beat, wb.State(x=math.nan, w="up", pitch_rate=math.inf))
    assert len(refused.value.faults) == 3


@pytest.mark.parametrize("count", [0, -1, 1.0, True, "3", 10**9])
@pytest.mark.parametrize("name", ["beats", "samples"])
def test_counts_that_are_no_whole_numbers_are_refused(name, count):
    model, beat = pigeon()
    with pytest.raises(wb.InvalidInputError, match=f"{name} = .*must be a whole number"):
        wb.simulate(model, beat, wb.State(), **{name: count})


def test_a_saved_flight_reads_back(tmp_path):
    model, beat = pigeon()
    flight = wb.simulate(model, beat, wb.State(u=10.0), beats=2, samples=SAMPLES)
    flight.save(tmp_path / "flight.nc")
    xr.testing.assert_identical(load_dataset(tmp_path / "flight.nc", "flight"), flight.dataset)
    with pytest.raises(wb.FileError, match="as an orbit: it holds another kind of result, 'flight'"):
        wb.load_orbit(tmp_path / "flight.nc")


def finely_flown(solved, samples):
    """Return times, q, q' and the hinge torques along an orbit, `samples` + 1 rows each."""
    phase, states = fly_beats(solved.model, solved.wingbeat, wb.State(*solved.start), 1, samples)[:2]
    found = evaluate(solved.model, solved.wingbeat, phase, states)
    places = np.column_stack([states[:, :3], found.flap, found.wing_pitch])
    rates = np.column_stack([states[:, 3:], found.flap_rate, found.wing_pitch_rate])
    return (
        phase / solved.wingbeat.frequency,
        places,
        rates,
        np.column_stack([found.flap_torque, found.pitch_torque]),
    )


def test_torques_drive_the_wing_along_its_prescribed_flight(solved):
    """Half a beat comes back to 5e-5 (m, rad; rates over their peaks): samples are not the function."""
    time, q, rates, torques = finely_flown(solved, KNOTS)

    def miss(scale):
        spline = CubicSpline(time, scale * torques)
        found = wb.simulate_torque_driven(
            solved.model, solved.wingbeat, q[0], rates[0], spline_torques, time[::BETWEEN], (spline.x, spline.c)
        )
        by_rates = np.abs(found.rates - rates[::BETWEEN]) / np.abs(rates).max(axis=0)
        return np.maximum(np.abs(found.coordinates - q[::BETWEEN]), by_rates).max(axis=1)

    assert miss(1.0)[:9].max() <= 5e-5
    # And the comparison would see torques that are off by a thousandth.
    assert miss(1 + 1e-3)[:9].max() > 5e-4


@pytest.mark.parametrize(
    ("changed", "where"),
    [
        ({"coordinates": np.zeros(4)}, "coordinates"),
        ({"rates": [0, 0, 0, 0, math.nan]}, "rates"),
        ({"times": [0.0]}, "times"),
        ({"times": [0.0, 0.1, 0.1]}, "times"),
        ({"times": [0.0, math.inf]}, "times"),
    ],
)
def test_a_torque_driven_flight_refuses_wrong_input(changed, where):
    model, beat = pigeon()
    good = {"coordinates": np.zeros(5), "rates": np.zeros(5), "times": [0.0, 0.1]}
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.simulate_torque_driven(model, beat, torques=spline_torques, **(good | changed))
    assert [fault.where for fault in refused.value.faults] == [where]
