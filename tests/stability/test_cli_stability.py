"""``wingbeat stability``: what it prints, its JSON, its figure, and what it refuses."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat._jax.arrays import jnp
from wingbeat.cli import main
from wingbeat.plots import stability_page
from wingbeat.stability.reports import headline


@pytest.fixture(scope="module")
def saved(pigeon_orbit, tmp_path_factory):
    path = tmp_path_factory.mktemp("stability") / "pigeon.nc"
    pigeon_orbit.orbit.save(path)
    return str(path)


def test_a_saved_orbit_prints_its_verdict_modes_and_the_averaged_model(saved, capsys):
    assert main(["stability", saved]) == 0
    printed = capsys.readouterr().out
    assert "pigeon at 10 m/s" in printed
    assert "unstable, disturbances double in" in printed
    assert "divergence" in printed
    assert "averaged over the beat, spectral radius" in printed


def test_the_json_has_the_matrices_and_their_names(saved, pigeon_orbit, capsys):
    inputs = ["frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude"]
    asked = ["--inputs", *inputs, "--height", "--json"]
    assert main(["stability", saved, *asked]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["state"] == ["z", "body_pitch", "u", "w", "pitch_rate"]
    assert record["inputs"] == inputs
    assert record["dt"] == pytest.approx(1 / pigeon_orbit.wingbeat.frequency)
    assert np.shape(record["A"]) == (5, 5)
    assert np.shape(record["B"]) == (5, 5)
    assert np.shape(record["G"]) == (5, 2)
    assert record["compensation"]["pitch_mean"]["pitch_cos_2"] == pytest.approx(-1.0)
    found = wb.linearise(pigeon_orbit.orbit, height=True)
    assert np.allclose(record["A"], found.A, rtol=0, atol=1e-9)
    assert main(["stability", saved, *asked, "--jumps"]) == 0
    alone = json.loads(capsys.readouterr().out)
    assert alone["compensation"] == {name: {} for name in inputs}
    assert not np.allclose(alone["B"], record["B"], rtol=1e-3)


def test_a_row_of_speeds_is_a_root_locus(capsys, tmp_path):
    drawn = tmp_path / "locus.png"
    asked = ["stability", "pigeon", "--speed", "9:11:1", "--starts", "1", "--json", "--plot", str(drawn)]
    assert main(asked) == 0
    records = json.loads(capsys.readouterr().out)
    assert [record["speed"] for record in records] == [9.0, 10.0, 11.0]
    assert drawn.read_bytes().startswith(b"\x89PNG")
    figure = stability_page(records)
    plane, sizes, bars = figure.axes
    shown = sum(len(line.get_xdata()) for line in sizes.get_lines())
    assert shown == sum(len(record["modes"]) for record in records)
    assert len(bars.patches) == 4 * len(records[1]["modes"])
    assert "real part" in plane.get_xlabel()
    check_legends(figure)
    alone = stability_page(records[:1])
    check_legends(alone)
    assert alone.axes[1].get_xlabel() == "time [s]"


@pytest.mark.slow
def test_no_certified_orbit_is_said_and_ends_with_3(capsys):
    assert main(["stability", "pigeon", "--speed", "3", "--set", "body.mass=3", "--starts", "1", "--json"]) == 3
    found = capsys.readouterr()
    answer = json.loads(found.out)
    assert (answer["speed"], answer["status"]) == (3.0, "infeasible")
    assert "3 m/s: infeasible" in found.err


def test_a_gap_in_a_row_of_speeds_is_told(capsys, tmp_path):
    asked = ["stability", "pigeon", "--speed", "10:100:90", "--starts", "1", "--json"]
    assert main(asked) == 0
    found = capsys.readouterr()
    certified, missing = json.loads(found.out)
    assert certified["spectral_radius"] > 1
    assert set(missing) == {"speed", "status", "message"}
    assert found.err.startswith("100 m/s: ")


@pytest.mark.slow
def test_an_orbit_of_a_function_is_refused_in_words(capsys, tmp_path):
    def plate(alpha):
        return 2.0 * jnp.sin(alpha) * jnp.cos(alpha), 0.1 + 2.0 * jnp.sin(alpha) ** 2

    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=plate)
    wb.solve_orbit(problem, starts=1).save(tmp_path / "own.nc")
    assert main(["stability", str(tmp_path / "own.nc")]) == 2
    assert "in Python" in capsys.readouterr().err


def test_the_headline_tells_stable_from_unstable():
    record = {"species": "bat", "speed": 5.0, "frequency": 6.1, "stable": True, "spectral_radius": 0.97, "dt": 0.16}
    assert headline({**record, "modes": [{"time_to_double": None}]}).endswith("stable, spectral radius 0.970")
    record |= {"stable": False, "spectral_radius": 1.0}
    assert headline({**record, "modes": [{"time_to_double": None}]}).endswith("unstable, spectral radius 1.000")
    assert "double in 0.32 s (2 beats)" in headline({**record, "modes": [{"time_to_double": 0.32}]})


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (["pigeon"], "--speed = None: is missing"),
        (["pigeon", "--speed", "nan"], "must be finite"),
        (["pigeon", "--speed", "8", "--plot", "locus.txt"], "--plot"),
        (["none.nc"], "none.nc"),
        (["none.nc", "--speed", "8"], "comes with its own inputs; leave out --speed"),
    ],
)
def test_bad_input_gets_its_sentence(asked, said, capsys):
    assert main(["stability", *asked]) == 2
    assert said in capsys.readouterr().err


def test_an_unknown_input_gets_its_sentence(saved, capsys):
    for source in ([saved], ["pigeon", "--speed", "10"]):  # before anything is solved
        assert main(["stability", *source, "--inputs", "flaping"]) == 2
        assert "inputs = 'flaping': is not a parameter of the wingbeat" in capsys.readouterr().err


def test_a_mode_is_flown_and_can_be_viewed(saved, tmp_path, capsys):
    flown, page = tmp_path / "mode.nc", tmp_path / "mode.html"
    assert main(["stability", saved, "--mode", "0", "-o", str(flown)]) == 0
    assert main(["view", str(flown), "-o", str(page)]) == 0
    assert "simulated" in page.read_text("utf-8")
    assert main(["stability", saved, "--mode", "0"]) == 2
    assert "needs --output" in capsys.readouterr().err
    assert main(["stability", saved, "--mode", "9", "-o", str(flown)]) == 2
    assert "--mode = 9: must be a whole number from 0 to 3" in capsys.readouterr().err
