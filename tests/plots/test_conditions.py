"""Titles name a load and air that is not that at sea level."""

import pytest

import wingbeat as wb
from wingbeat.plots.draw_curve import curve_title
from wingbeat.records.inputs import inputs_of, problem_from
from wingbeat.records.judgements import conditions_of

PIGEON = wb.load_species("pigeon")


def test_a_species_knows_what_was_added_to_its_own_mass():
    assert PIGEON.carried_mass == 0.0
    loaded = PIGEON.with_payload(0.03)
    assert loaded.carried_mass == pytest.approx(0.03)
    assert loaded.with_payload(0.01).carried_mass == pytest.approx(0.04)
    assert PIGEON.with_values({"body.mass": 0.256}).carried_mass == pytest.approx(-0.02)
    assert PIGEON.with_values({"wing.mass": 0.022}).carried_mass == pytest.approx(0.004)
    assert PIGEON.with_values({"wing.semi_span": 0.28}).own_mass is None
    again = problem_from(inputs_of(wb.OrbitProblem(loaded, speed=12.0), 1, 0)).species
    assert again.own_mass == loaded.own_mass == PIGEON.vehicle.mass
    assert "own_mass" not in inputs_of(wb.OrbitProblem(PIGEON, speed=12.0), 1, 0)["species"]


@pytest.mark.parametrize(
    ("about", "words"),
    [
        ({}, ""),
        ({"air": vars(wb.Air()), "carried_mass": 0.0}, ""),
        ({"air": vars(wb.Air.at_altitude(3000.0))}, ", in air of 0.9093 kg/m3"),
        ({"air": '{"density": 1.1}', "carried_mass": 0.0305}, ", with 30.5 g added, in air of 1.1 kg/m3"),
        ({"carried_mass": -0.02}, ", with 20 g taken off"),
    ],
)
def test_conditions_are_read_off_records_and_attributes(about, words):
    assert conditions_of(about) == words


def test_titles_name_the_conditions():
    high = PIGEON.at_altitude(3000.0).with_payload(0.03)
    about = {"aero": '{"coefficients": "su-fan", "extension": "mirrored"}', "constraints": "[]"}
    about |= {"species": "pigeon", "climb": 0.0, "objective": "frequency"}
    assert "Pigeon: wingbeats of minimum frequency" in curve_title(about).replace("\n", " ")
    title = curve_title(about | {"air": '{"density": 0.9093}', "carried_mass": high.carried_mass})
    assert title.startswith("Pigeon, with 30 g added, in air of 0.9093 kg/m3: wingbeats of")
    title = wb.plots.glide_page(wb.glide_polar(high).dataset).get_suptitle()
    assert title.startswith("Pigeon gliding, with 30 g added, in air of 0.9093 kg/m3, wings held still")
