"""Filmed wingbeats: files and their faults, splines against known beats, and power within its error bar.

All films here are synthetic: known beats with noise of a random generator.
"""

import dataclasses
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.animal.kinematics import flap_angle, parameter, pitch_angle, span_ratio
from wingbeat.cli.app import main
from wingbeat.cli.filmed import plus_minus
from wingbeat.experiment import Film, fit_film, read_film, synthetic_film
from wingbeat.orbits.problem.filmed import trim_of
from wingbeat.plots import film_page

ALL = ("flap_deg", "pitch_deg", "span_fraction")
RICH = wb.Wingbeat(
    *(8.0, 0.1, 0.9, -0.1, 0.5, 0.3),
    pitch_phase=0.2,
    flap_harmonics=(0.08, -0.03),
    pitch_harmonics=(0.0, 0.06, 0.05, 0.0),
    span_harmonics=(0.03, 0.0),
)
PHASES = np.linspace(0.0, 1.0, 50)
LAWS = (flap_angle, pitch_angle, span_ratio)


def test_a_film_without_noise_gives_the_beat_back_wherever_it_began():
    beat = fit_film(synthetic_film(RICH, 80, noise_deg=0.0, columns=ALL, start=0.37))
    found = dataclasses.replace(wb.Wingbeat(1.0, 0.0, 0.1, 0.0, 0.1), **beat.numbers)
    # Harmonics of flap move its first one nowhere, so phase 0 is where it was.
    for law in LAWS:
        np.testing.assert_allclose(law(found, PHASES), law(RICH, PHASES), atol=2e-7)
    assert found.frequency == 8.0


def test_a_plain_beat_is_left_plain_by_noise():
    """The penalty spares mean and sine: of twenty noisy films nearly all spend three numbers, and none many."""
    plain = wb.Wingbeat(8.0, 0.1, 0.9, -0.1, 0.5)
    spent = [fit_film(synthetic_film(plain, 60, 1.5, seed)).laws["flap_deg"].degrees for seed in range(20)]
    assert np.median(spent) < 3.1
    assert max(spent) < 8


def test_errors_of_the_laws_cover_the_truth():
    """Over seeds and phases the beat that was filmed is within two standard errors as often as that should be."""
    within = {name: [] for name in ALL}
    for seed in range(20):
        beat = fit_film(synthetic_film(RICH, 60, 1.5, seed, ALL))
        for name, law in zip(ALL, LAWS, strict=True):
            value, error = beat.laws[name].curve(PHASES)
            true = np.asarray(law(RICH, PHASES))
            true = np.degrees(true) if name.endswith("_deg") else true
            within[name].append(np.abs(value - true) <= 2 * error)
    shares = {name: float(np.mean(hits)) for name, hits in within.items()}
    assert all(0.88 <= share <= 1.0 for share in shares.values()), shares


def test_draws_are_as_far_from_the_fit_as_the_errors_say():
    beat = fit_film(dataclasses.replace(synthetic_film(RICH, 60, 1.5, 3, ALL), frequency_se=0.1))
    draws = beat.draws(RICH, 400, seed=1)
    assert draws[:2] == beat.draws(RICH, 2, seed=1)
    errors = {name: math.sqrt(beat.laws[f"{name}_deg"].covariance[0, 0]) for name in ("flap", "pitch")}
    for name, error in errors.items():
        spread = np.degrees(np.std([parameter(draw, f"{name}_mean") for draw in draws]))
        assert spread == pytest.approx(error, rel=0.15)
    assert np.std([draw.frequency for draw in draws]) == pytest.approx(0.1, rel=0.15)


def test_what_was_filmed_is_held_and_two_are_free():
    pigeon = wb.load_species("pigeon")
    film = synthetic_film(RICH, 60, 1.0)
    unclocked = Film("film", film.phase, film.columns)
    both = synthetic_film(RICH, 60, 1.0, columns=("flap_deg", "pitch_deg"))
    pitch = synthetic_film(RICH, 60, 1.0, columns=("pitch_deg",))
    assert trim_of(fit_film(film), pigeon)[0] == ("pitch_mean", "pitch_amplitude")
    assert trim_of(fit_film(unclocked), pigeon)[0] == ("frequency", "pitch_mean", "pitch_amplitude")
    assert trim_of(fit_film(pitch), pigeon)[0] == ("flap_mean", "flap_amplitude")
    free, bounds = trim_of(fit_film(both), pigeon)
    assert free == ("pitch_mean", "pitch_amplitude")
    low, high = bounds["pitch_amplitude"]
    assert (low + high) / 2 == pytest.approx(fit_film(both).numbers["pitch_amplitude"])
    assert wb.filmed_problem(fit_film(film), pigeon, 10.0).minimise.name == "mean_positive_power"
    assert wb.filmed_problem(fit_film(unclocked), pigeon, 10.0).minimise.name == "frequency"


@pytest.fixture(scope="module")
def known():
    """An orbit within the range of what flies, not at its edge as those of least frequency are."""
    problem = wb.OrbitProblem(wb.load_species("pigeon"), 10.0, minimise="mean_positive_power")
    orbit = wb.solve_orbit(problem, starts=2)
    assert orbit.status is wb.Status.CONVERGED
    return orbit


@pytest.fixture(scope="module")
def refound(known):
    """The orbit of the first film."""
    film = synthetic_film(known.wingbeat, 60, 1.5, seed=1, start=0.3)
    orbit = wb.solve_orbit(wb.filmed_problem(fit_film(film), wb.load_species("pigeon"), 10.0))
    assert orbit.status is wb.Status.CONVERGED
    return orbit


@pytest.mark.slow
def test_a_synthetic_film_of_a_known_orbit_returns_its_power_within_its_error_bar(known, refound):
    """Of ten films of a known orbit, noise of 1.5 degrees, at least nine."""
    pigeon, true = wb.load_species("pigeon"), known.record()
    names = ("mean_power", "mean_positive_power")
    inside = {name: [] for name in names}
    for seed in range(10):
        beat = fit_film(synthetic_film(known.wingbeat, 60, 1.5, seed, start=0.1 * seed))
        own = wb.filmed_species(beat, pigeon).wingbeat
        fitted, spread = wb.orbit_spread(refound, [own]), wb.orbit_spread(refound, beat.draws(own, 16))
        assert fitted.certified == 1
        assert spread.certified >= 8
        for name in names:
            (value,) = fitted.values[name]
            error = math.sqrt(np.mean((spread.values[name] - value) ** 2))
            inside[name].append(abs(value - true[name]) <= 2 * error)
    assert all(np.mean(hits) >= 0.9 for hits in inside.values()), inside


@pytest.mark.slow
def test_the_spread_is_about_the_orbit(known, refound):
    wingbeat = refound.problem.species.wingbeat
    again = wb.orbit_spread(refound, [wingbeat] * 3)
    assert (again.certified, again.asked) == (3, 3)
    assert again.standard_error("mean_power") <= 1e-5 * refound.record()["mean_power"]
    louder = dataclasses.replace(wingbeat, flap_amplitude=wingbeat.flap_amplitude + 0.02)
    moved = wb.orbit_spread(refound, [louder] * 3)
    change = moved.values["wingbeat.pitch_amplitude"][0] - refound.wingbeat.pitch_amplitude
    assert moved.standard_error("wingbeat.pitch_amplitude") == pytest.approx(abs(change))
    impossible = wb.orbit_spread(refound, [dataclasses.replace(wingbeat, flap_amplitude=0.05)] * 3)
    assert impossible.certified == 0
    assert impossible.standard_error("mean_power") is None


def written(tmp_path, text):
    path = tmp_path / "beat.csv"
    path.write_text(text)
    return path


def rows(count=20, flap=40.0):
    return [(i / count, flap * math.cos(2 * math.pi * i / count)) for i in range(count)]


def test_a_film_is_written_and_read(tmp_path):
    film = synthetic_film(RICH, 40, 1.0, columns=ALL)
    film.columns["pitch_deg"][3] = np.nan
    film.save(tmp_path / "film.csv")
    back = read_film(tmp_path / "film.csv")
    assert (back.synthetic, back.frequency) == (True, 8.0)
    assert "synthetic" in back.notes[0]
    np.testing.assert_allclose(back.columns["pitch_deg"], film.columns["pitch_deg"], rtol=1e-7)
    assert len(back.seen("pitch_deg")[0]) == 39


def test_times_become_phases(tmp_path):
    lines = [f"{t / 5},{flap}" for t, flap in rows()]
    film = read_film(written(tmp_path, "# frequency [Hz] = 5\ntime [s],flap_deg [deg]\n" + "\n".join(lines)))
    np.testing.assert_allclose(film.phase, [phase for phase, _ in rows()])


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("phase,flap_deg\n0,1\n0.1,x\n0.2,2\n0.3\n", ["row 3, column flap_deg", "row 5"]),
        (
            "phase,flap_rad,speed\n0,1,2\n",
            ["flap_rad", "write degrees", "speed", "not a known column", "no filmed column"],
        ),
        ("phase,time,flap_deg\n0,0,1\n", ["exactly one of phase, time and frame"]),
        ("time,flap_deg\n0,10\n", ["frequency", "is missing"]),
        (
            "# frequency = fast\ntime,flap_deg [rad]\n0,1\n",
            ["row 1, frequency", "one number", "is not the expected unit"],
        ),
        ("# frequency = -5\ntime,flap_deg\n0,1\n", ["row 1, frequency", "must be > 0"]),
        ("phase,flap_deg\n" + "\n".join(f"{t},{f}" for t, f in rows(6)), ["at least 8"]),
        ("phase,flap_deg\n" + "\n".join(f"{t / 2},{f}" for t, f in rows()), ["no frame from phase 0.47 to 0.00"]),
        ("phase,flap_deg\n" + "\n".join(f"{t},{9 * f}" for t, f in rows()), ["between -180 and 180"]),
        (
            "phase,span_fraction\n" + "\n".join(f"{t},{90 + f / 10}" for t, f in rows()),
            ["not a fraction of the semi-span"],
        ),
    ],
)
def test_faults_of_a_file_are_told_all_at_once(tmp_path, text, faults):
    with pytest.raises(wb.InvalidInputError) as caught:
        read_film(written(tmp_path, text))
    for fault in faults:
        assert fault in str(caught.value)


def test_what_cannot_be_a_beat_is_refused():
    still = synthetic_film(wb.Wingbeat(8.0, 0.1, 0.0, 0.0, 0.1), 40, 0.1)
    with pytest.raises(wb.InvalidInputError, match="hardly swings"):
        fit_film(still)
    long = Film("long", np.arange(20) / 20, {"span_fraction": np.full(20, 1.3)})
    with pytest.raises(wb.InvalidInputError, match="semi_span"):
        fit_film(long)


def test_a_span_that_noise_puts_above_the_whole_is_the_whole():
    noise = np.random.default_rng(1).normal(scale=0.01, size=40)
    beat = fit_film(Film("rigid", np.arange(40) / 40, {"span_fraction": 1.0 + abs(noise.mean()) + noise}))
    assert 0.0 <= beat.numbers["span_retraction"] < 0.01


def test_the_page_shows_frames_spline_and_band():
    figure = film_page(fit_film(synthetic_film(RICH, 40, 1.0, columns=ALL)))
    assert len(figure.axes) == 6
    check_legends(figure)
    assert "not filmed" in figure.get_suptitle()
    assert figure.axes[0].get_ylabel() == "flap angle, wing up [deg]"


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [(25.1234, 0.812, "25.1 +- 0.8"), (183.4, 12.0, "183 +- 12"), (3.0, None, "3 +- ?")],
)
def test_a_value_is_shown_to_its_error(value, error, text):
    assert plus_minus(value, error) == text


@pytest.mark.slow
def test_the_command_flies_a_film(known, tmp_path, capsys):
    path = tmp_path / "beat.csv"
    synthetic_film(known.wingbeat, 60, 1.5, seed=1, start=0.3).save(path)
    assert main(["orbit", "pigeon", "--speed", "10", "--kinematics", str(path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["kinematics"]["synthetic"] is True
    assert record["kinematics"]["draws_certified"] >= 28
    error = record["kinematics"]["standard_errors"]["mean_positive_power"]
    assert abs(record["mean_positive_power"] - known.record()["mean_positive_power"]) <= 2 * error
    assert (
        main(["simulate", "pigeon", "--kinematics", str(path), "--beats", "1", "--plot-kinematics", "x.txt"]) == 2
    )
    assert "--plot-kinematics" in capsys.readouterr().err
    # A film of wings that cross is flown, with a warning.
    low = dataclasses.replace(known.wingbeat, flap_mean=-0.6, flap_amplitude=1.3)
    synthetic_film(low, 60, 25.0, seed=1).save(tmp_path / "low.csv")
    assert main(["simulate", "pigeon", "--kinematics", str(tmp_path / "low.csv"), "--beats", "1", "--json"]) == 0
    told = capsys.readouterr()
    for warning in ("each wing passes through the plane of symmetry", "degrees from the fitted wingbeat"):
        assert warning in told.err
        assert any(warning in one for one in json.loads(told.out)["warnings"])
    figure = tmp_path / "film.png"
    words = ["simulate", "pigeon", "--kinematics", str(path), "--beats", "1", "--plot-kinematics", str(figure)]
    assert main(words) == 0
    assert "+-" in capsys.readouterr().out
    assert figure.read_bytes()[:4] == b"\x89PNG"
