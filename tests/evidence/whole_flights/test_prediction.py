"""Flights predicted at measured speeds, with the paper's model, whose programs other tests compile too."""

import numpy as np
import pytest

import wingbeat as wb
from wingbeat_evidence.whole_flights import MeasuredFlights, Measurement, predict_flights

FREQUENCY = Measurement("frequency", "measured", (10.0, 10.0), (5.0, 9.0), "a bird", "a paper of 2001")


@pytest.fixture(scope="module")
def predicted():
    told = []
    flights = MeasuredFlights("pigeon", (10.0, 11.0), (FREQUENCY,))
    found = predict_flights(flights, model="paper", draws=10, progress=lambda *done: told.append(done))
    return found, told


@pytest.mark.slow
def test_flights_are_those_of_the_model(predicted):
    found, _ = predicted
    assert (found.model, found.objective) == ("paper", "frequency")
    species = wb.load_species("pigeon")
    orbit = wb.solve_orbit(wb.models.paper().problem(species, speed=10.0))
    first = found.flown[0]
    assert first.values["frequency"] == pytest.approx(orbit.wingbeat.frequency, rel=5e-3)
    power = orbit.record()["mean_positive_power"] / species.vehicle.mass
    assert first.values["positive_power_per_mass"] == pytest.approx(power, rel=0.02)
    assert "muscle_power_per_mass" not in first.values
    assert first.active_bounds == ("flap_amplitude",)


def test_the_band_is_that_of_the_certified_draws(predicted):
    found, _ = predicted
    for one in found.flown:
        assert one.drawn == 10
        assert one.certified <= 10
        for name in one.low:
            assert one.low[name] <= one.high[name]
    speeds, values, low, _ = found.series("frequency")
    np.testing.assert_array_equal(speeds, [10.0, 11.0])
    assert np.isfinite(values).all()
    assert np.isnan(low).sum() == sum(not one.low for one in found.flown)


def test_progress_ends_at_the_number_of_flights_and_draws(predicted):
    _, told = predicted
    assert told[-1] == (22, 22)
    assert [done for done, _ in told] == sorted(done for done, _ in told)


@pytest.mark.parametrize(("draws", "told"), [(3, "draws"), (-1, "draws"), (200_000, "draws")])
def test_too_few_draws_for_a_band_are_refused(draws, told):
    with pytest.raises(wb.InvalidInputError, match=told):
        predict_flights(MeasuredFlights("pigeon", (10.0,), (FREQUENCY,)), draws=draws)
