"""The words, lights and gauges of an orbit."""

import copy
import math
from types import SimpleNamespace

import pytest

import wingbeat as wb
from wingbeat._base import FileError
from wingbeat_explorer import face_data as face
from wingbeat_explorer.face_data import gauges_of, is_plausible, lights_of, sentence_of

pytestmark = pytest.mark.slow


@pytest.fixture
def record(orbits):
    """A plausible flight: the pigeon's at 12 m/s, with its judged numbers put inside their ranges."""
    found = copy.deepcopy(orbits["pigeon"][2].record())
    found["mean_positive_power"] = 9.14
    found["wingbeat"]["frequency"] = 5.62
    for one in found["plausibility"]:
        one["value"] = one["low"] if one["high"] is None else one["high"]
        one["within"] = True
    return found


def judged(record, name):
    return next(one for one in record["plausibility"] if one["name"] == name)


def test_the_sentence_of_a_plausible_flight(record):
    told = "A rock pigeon at 12 m/s beats 5.6 times a second{} and needs 9.1 W, within what its muscle gives."
    # Its amplitude is at a bound, and the least frequency follows from that.
    assert record["active_bounds"] == ["flap_amplitude"]
    assert sentence_of(record, "rock pigeon") == told.format(" (set by a limit)")
    assert sentence_of(record | {"active_bounds": []}, "rock pigeon") == told.format("")
    assert [(light["good"], light["known"]) for light in lights_of(record)] == [(True, True), (True, True)]


@pytest.mark.parametrize(
    ("basis", "why"),
    [("free", ""), ("law", " (given: by a law of its kind)"), ("measured", " (given: measured on the animal)")],
)
def test_a_frequency_that_was_not_searched_for_is_called_given(record, basis, why):
    record |= {"active_bounds": [], "frequency_basis": basis}
    assert f"beats 5.6 times a second{why} and needs" in sentence_of(record, "rock pigeon")
    assert [one["name"] for one in gauges_of(record) if one["given"]] == (["frequency"] if why else [])


@pytest.mark.parametrize(
    ("share", "words"),
    [(1.02, "more than what its muscle gives."), (2.0, "twice what"), (3.14, "3.1 times what")],
)
def test_the_sentence_says_how_much_is_more_than_the_muscle_gives(record, share, words):
    power = judged(record, "positive_power_per_mass")
    power |= {"value": share * power["high"], "within": False}
    assert words in sentence_of(record, "rock pigeon")
    assert [light["good"] for light in lights_of(record)] == [True, False]


def test_the_sentence_names_what_else_is_not_plausible(record):
    amplitude = judged(record, "flap_amplitude")
    amplitude |= {"value": 1.5, "within": False}
    assert sentence_of(record, "rock pigeon").endswith(
        "within what its muscle gives, but its flap amplitude is implausible."
    )
    assert lights_of(record)[1]["text"] == "Flap amplitude 85.9 above 61 deg."


@pytest.mark.parametrize(
    ("status", "words"),
    [
        ("infeasible", "In this model, a rock pigeon at 12 m/s has no wingbeat that closes."),
        ("not-converged", "No wingbeat that closes was found for a rock pigeon at 12 m/s."),
    ],
)
def test_a_flight_without_a_certificate_has_no_numbers_in_its_sentence(record, status, words):
    record |= {"status": status, "message": "the lift fails"}
    assert sentence_of(record, "rock pigeon") == words
    closes, plausible = lights_of(record)
    assert not closes["good"]
    assert "The lift fails." in closes["text"]
    assert (plausible["good"], plausible["known"]) == (False, False)


def test_a_flight_with_limits_is_missed_within_them(record):
    record |= {"status": "infeasible", "message": "the lift fails", "constraints": {"strouhal<=0.4": 0.5}}
    told = "In this model, a rock pigeon at 12 m/s has no wingbeat that closes within its limits."
    assert sentence_of(record, "rock pigeon") == told


def test_of_derived_numbers_the_face_says_how_many_there_are():
    flown = wb.models.animal(wb.load_species("pigeon")).species(wb.load_species("pigeon"))
    shorter = [face._shorter(text) for text in (*flown.warnings, "the speed is odd")]
    assert shorter == [
        "numbers from scaling laws, not measured: 1 of the body, 4 of the tail, 8 of the muscle",
        "the speed is odd",
    ]


def test_what_is_not_known_is_neither_good_nor_a_fault(record):
    for one in record["plausibility"]:
        one |= {"low": None, "high": None}
    assert lights_of(record)[1] == {
        "name": "plausible",
        "good": False,
        "known": False,
        "text": "No range is known for power per mass, frequency, flap amplitude, peak force over weight, "
        "mean body pitch, range of body pitch, Strouhal number and Reynolds number.",
    }
    assert "muscle" not in sentence_of(record, "RoboFalcon2.0 robot")
    assert {gauge["inside"] for gauge in gauges_of(record)} == {None}


def test_too_little_known_is_neither_plausible_nor_implausible(record):
    assert is_plausible(lights_of(record)) is True
    open_ = [one | {"low": None, "high": None, "within": None} for one in record["plausibility"]]
    assert is_plausible(lights_of(record | {"plausibility": open_})) is None
    judged(record, "frequency")["within"] = False
    assert is_plausible(lights_of(record)) is False
    assert is_plausible(lights_of(record | {"status": "infeasible"})) is False


@pytest.mark.parametrize(
    ("title", "speed", "climb", "start"),
    [
        ("Anna's hummingbird", 0.0, 0.0, "An Anna's hummingbird in hover beats"),
        ("European herring gull", 9.5, 0.0, "A European herring gull at 9.5 m/s beats"),
        ("common swift", 8.0, -1.0, "A common swift at 8 m/s, sinking 1 m/s, beats"),
    ],
)
def test_who_flies_and_how(record, title, speed, climb, start):
    assert sentence_of(record | {"speed": speed, "climb": climb}, title).startswith(start)


def test_a_flight_that_tumbles_at_once_has_no_picture(monkeypatch):
    def refuse(flights):
        raise FileError("fewer than two samples")

    monkeypatch.setattr(face, "scene", refuse)
    flight = SimpleNamespace(status=wb.Status.NOT_CONVERGED, dataset=None)
    assert face._scene_of(flight, "rock pigeon") is None
    flight.status = wb.Status.CONVERGED
    with pytest.raises(FileError, match="fewer than two"):
        face._scene_of(flight, "rock pigeon")


def test_the_face_has_the_record_s_numbers_in_the_units_of_readers(orbits, answers):
    record, answer = orbits["pigeon"][2].record(), answers["pigeon"][2]
    gauges = {gauge["name"]: gauge for gauge in answer["gauges"]}
    assert list(gauges) == [one["name"] for one in record["plausibility"]]
    assert gauges["frequency"]["label"] == "Wingbeat frequency"
    assert gauges["mean_body_pitch"]["label"] == "Mean body pitch"
    assert [name for name, gauge in gauges.items() if gauge["limited"]] == [
        "frequency",
        "flap_amplitude",
        "strouhal",
    ]
    assert gauges["frequency"]["value"] == answer["frequency"] == record["wingbeat"]["frequency"]
    amplitude = gauges["flap_amplitude"]
    assert amplitude["value"] == pytest.approx(math.degrees(record["wingbeat"]["flap_amplitude"]))
    assert (amplitude["unit"], amplitude["inside"]) == ("deg", False)
    assert answer["power"] == record["mean_positive_power"]
    assert answer["warnings"][0].startswith("Set by limits, not predicted: flap amplitude 70 deg, and with it")
    assert len(answer["warnings"]) == 1 + len(record["warnings"])
    assert ["mass", "316", "g"] in answer["numbers"]
    assert answer["title"] == wb.load_species("pigeon").common_name
