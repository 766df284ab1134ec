"""The folder of the static explorer: its files, what they hold, and the command that writes it."""

import itertools
import re

import numpy as np
import pytest

import wingbeat as wb
import wingbeat_evidence as evidence
from tests.explorer.conftest import read_script
from wingbeat._base import InvalidInputError
from wingbeat.cli.app import main
from wingbeat_explorer import default_speeds, measured_points, solve_lattice, write_explorer
from wingbeat_explorer.folder import check_names
from wingbeat_explorer.lattice import SPEEDS, in_16_bits, pushes_of, thinned, unpacked

pytestmark = pytest.mark.slow


def test_the_folder_holds_all_it_needs_and_names_no_other_host(folder):
    names = sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    data = [f"data/{name}.js" for name in ("bat-dickinson", "bat-paper", "pigeon-paper-pushes", "pigeon-paper")]
    assert names == ["catalogue.js", *data, "explorer.js", "index.html"]
    page = (folder / "index.html").read_text("utf-8")
    assert "default-src 'none'" in page
    for text in (page, (folder / "catalogue.js").read_text("utf-8")):
        assert "//" not in text


def test_all_animals_by_both_models_and_with_gusts_fit_into_15_megabytes(folder):
    """All flyers, two models, nine speeds; each flight takes the room of those in the pigeon's file of four.

    Files with fewer flights say less: what a file holds once counts for more in them.
    """
    pushes, lattice = (folder / "data" / f"pigeon-paper{end}.js" for end in ("-pushes", ""))
    each = lattice.stat().st_size / len(read_script(lattice)[1]["answers"])
    animals = len(wb.species_names()) * (2 * SPEEDS * each + pushes.stat().st_size)
    assert animals + (folder / "explorer.js").stat().st_size < 15e6


def test_the_gusts_are_those_of_fly_pushes_from_two_sides(folder, orbits):
    name, pushes = read_script(folder / "data" / "pigeon-paper-pushes.js")
    assert name == "pigeon-paper"
    assert [(push["direction"], push["size"], push["feedback"]) for push in pushes] == [
        (direction, 1.0, feedback) for direction in ("upward", "tail") for feedback in (False, True)
    ]
    cheapest = min(orbits["pigeon"], key=lambda orbit: orbit.record()["mean_positive_power"])
    flown = wb.fly_pushes(cheapest, delay=None, beats=12, directions=("tail",), sizes=(1.0,))
    assert [push.outcome for push in flown] == [pushes[2]["outcome"]]
    shown = unpacked(pushes[2]["scene"]["flights"][0]["arrays"]["pitch_away"])
    np.testing.assert_allclose(shown, flown[0].pitch, rtol=0, atol=1e-4)


def test_an_orbit_that_is_not_certified_has_no_gusts():
    heavy = wb.load_species("pigeon").with_values({"body.mass": 3.0})
    assert pushes_of(wb.solve_orbit(wb.OrbitProblem(heavy, 3.0), starts=1)) == []


def test_the_fruit_fly_s_coefficients_are_those_of_the_paper_s_model(plates_and_flies):
    bat = wb.load_species("bat")
    lattice = solve_lattice(bat, "dickinson", [6.0], starts=1)
    assert lattice["model"] == "dickinson"
    found = plates_and_flies["dickinson"][0].record()["mean_positive_power"]
    assert lattice["answers"][0]["power"] == pytest.approx(found, rel=1e-6)


def test_a_data_file_holds_the_answers_and_the_curve(folder, answers):
    name, lattice = read_script(folder / "data" / "pigeon-paper.js")
    assert (name, lattice["species"], lattice["model"]) == ("pigeon-paper", "pigeon", "paper")
    assert lattice["axis"] == {"name": "speed", "unit": "m/s", "label": "speed"}
    assert [one["sentence"] for one in lattice["answers"]] == [one["sentence"] for one in answers["pigeon"]]
    for point, answer in zip(lattice["curve"]["points"], answers["pigeon"], strict=True):
        assert (point["speed"], point["power"]) == (answer["speed"], answer["power"])
        assert (point["certified"], point["plausible"]) == (True, False)
    cheapest = min(answers["pigeon"], key=lambda answer: answer["power"])
    assert lattice["first"] == cheapest["speed"]


def test_thinning_keeps_the_flight(answers):
    whole = answers["pigeon"][0]["scene"]["flights"][0]["arrays"]
    small = thinned(answers["pigeon"][0]["scene"])["flights"][0]["arrays"]
    count = len(unpacked(whole["phase"]))
    assert len(unpacked(small["phase"])) == 65
    assert set(whole) - set(small) == {"lift", "drag"}
    for name, packed in small.items():
        exact = unpacked(whole[name]).reshape(count, -1)[:: (count - 1) // 64].ravel()
        if name == "corners":
            corner = np.moveaxis(exact.reshape(-1, 4, 3), 1, 0)
            np.testing.assert_allclose(corner[3], corner[0] - corner[1] + corner[2], rtol=0, atol=1e-6)
            exact = np.moveaxis(corner[:3], 0, 1).ravel()
        np.testing.assert_allclose(unpacked(packed), exact, rtol=1e-6, atol=2e-5 * np.abs(exact).max())


def test_packing_keeps_steps_across_the_whole_range():
    values = np.array([[-1.0, 0.0], [1.0, 1e-9], [-1.0, 0.5], [1.0, -1.0]])
    np.testing.assert_allclose(unpacked(in_16_bits(values)), values.ravel(), rtol=0, atol=1 / 65000)


def test_measured_points_are_those_of_the_package():
    pigeon = wb.load_species("pigeon")
    points = measured_points(pigeon)
    measured = evidence.read_measured_flights("pigeon").measurements
    power = next(one for one in measured if one.quantity == "positive_power_per_mass")
    shown = next(one for one in points if "power" in one)
    assert shown["power"] == [pigeon.vehicle.mass * value for value in power.values]
    assert shown["source"] == power.source
    assert {one["basis"] for one in points} == {"measured", "law", "estimated"}
    assert measured_points(wb.load_species("robofalcon2")) == []


def test_default_speeds_begin_in_hover_for_light_flyers_only():
    for name in wb.species_names():
        speeds = default_speeds(wb.load_species(name))
        assert len(speeds) == SPEEDS
        assert (speeds[0] == 0.0) == (wb.load_species(name).vehicle.mass < 0.02)
        assert all(low < high for low, high in itertools.pairwise(speeds))


def test_the_command_writes_a_folder(tmp_path, capsys):
    words = ["--animals", "pigeon", "--models", "paper", "--speeds", "11", "12", "--starts", "1"]
    assert main(["explore", "--static", str(tmp_path / "new"), *words]) == 0
    assert re.search(r"index.html and 3 other files, \d\.\d MB", capsys.readouterr().err)
    assert [one["speed"] for one in read_script(tmp_path / "new" / "data" / "pigeon-paper.js")[1]["answers"]] == [
        11,
        12,
    ]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--models", "bird"], "--models = 'bird'"),
        (["--animals", ","], "names nothing"),
        (["--animals", "pigeo"], "pigeon"),
        (["--speeds", "9:4:1"], "reverse the sign"),
        (["--along", "wing.chord"], "names no values"),
        (["--along", "body.mass", "0.3", "0.4"], "must be one speed: only body.mass changes"),
        (["--animals", "pigeon", "--speeds", "9", "--along", "body.mas", "0.3"], "body.mass"),
        (["--animals", "pigeon", "--set", "wing.mass=-1"], "wing.mass"),
    ],
)
def test_the_command_says_what_is_wrong_before_it_solves(tmp_path, capsys, words, told):
    assert main(["explore", "--static", str(tmp_path / "new"), *words]) == 2
    assert told in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_a_file_is_no_folder(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["explore", "--static", str(tmp_path / "file")]) == 2
    assert "is not a folder" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("flyers", "told"),
    [
        ([("../../x", "paper", "speed")], "species = '../../x': cannot name a file"),
        ([("my bird", "paper", "speed")], "cannot name a file"),
        (2 * [("pigeon", "paper", "speed")], "comes twice with the model paper"),
    ],
)
def test_names_that_cannot_be_those_of_files_are_refused(flyers, told):
    with pytest.raises(InvalidInputError, match=re.escape(told)):
        check_names(flyers)


def test_nothing_to_show_is_refused(tmp_path):
    with pytest.raises(InvalidInputError, match="nothing to show"):
        write_explorer(tmp_path, [])
