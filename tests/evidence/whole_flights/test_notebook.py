"""A prediction of whole flights in a notebook."""

import wingbeat_evidence as evidence
from tests.helpers.notebooks import check_figure, check_table
from wingbeat_evidence.whole_flights.prediction import Flown


def test_a_prediction_shows_flights_and_measurements():
    flights = evidence.read_measured_flights("pigeon")
    values = {"frequency": 6.25, "flap_amplitude_deg": 41.5, "positive_power_per_mass": 33.0, "strouhal": 0.2}
    flown = [Flown(speed, "converged", "", values) for speed in flights.speeds[1:]]
    none = Flown(flights.speeds[0], "infeasible", "", {})
    found = evidence.Prediction(flights, "animal", "positive_power", (none, *flown))
    shown = check_table(found)
    assert f"{flights.speeds[1]:g} 6.25 41.5 33 0.2" in shown
    assert "infeasible" in shown
    assert flights.measurements[0].basis in shown
    table = found.to_dataframe()
    assert table["values.frequency"].tolist()[1:] == [6.25] * len(flown)
    check_figure(found.plot())
