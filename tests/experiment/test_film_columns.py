"""Films of sweep, twist, stroke plane and area, and angles that wrap; all films are synthetic."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import chord_ratio, pitch_angle, span_ratio, sweep_angle, tip_twist
from wingbeat.cli.filmed import film_lines
from wingbeat.experiment import Film, fit_film, read_film, synthetic_film
from wingbeat.experiment.film import FILMED
from wingbeat.orbits.problem.filmed import filmed_species, trim_of
from wingbeat.plots import film_page

PHASES = np.linspace(0.0, 1.0, 50)
RICH = wb.Wingbeat(
    *(8.0, 0.1, 0.9, -0.1, 0.5, 0.3),
    sweep_mean=0.05,
    sweep_amplitude=0.2,
    sweep_phase=0.4,
    sweep_harmonics=(0.03, -0.05),
    chord_retraction=0.3,
    chord_harmonics=(0.1, -0.05, 0.03, 0.0),
    twist_mean=-0.1,
    twist_harmonics=(0.2, -0.15, 0.0, 0.05),
    stroke_plane_tilt=0.25,
)
PIGEON = wb.load_species("pigeon")
PLANE = PIGEON.vehicle.wing.stroke_plane_angle
LAWS = (pitch_angle, span_ratio, sweep_angle, chord_ratio, tip_twist)


def film_of(wingbeat=RICH, frames=80, noise_deg=0.0, seed=0, columns=tuple(FILMED), start=0.0):
    return synthetic_film(wingbeat, frames, noise_deg, seed, columns, start, PLANE)


def test_a_film_without_noise_gives_every_law_back_wherever_it_began():
    found = filmed_species(fit_film(film_of(start=0.37)), PIGEON).wingbeat
    for law in LAWS:
        np.testing.assert_allclose(law(found, PHASES), law(RICH, PHASES), atol=2e-6, err_msg=law.__name__)
    assert found.stroke_plane_tilt == pytest.approx(0.25, abs=1e-9)
    assert found.twist_ratio == 1.0


def test_area_without_a_film_of_the_span_is_divided_by_the_species_span():
    film = film_of(dataclasses.replace(RICH, span_retraction=0.2), columns=("flap_deg", "area_fraction"))
    species = PIGEON.with_values({"wingbeat.span_retraction": 0.2, "wingbeat.downstroke_fraction": 0.4})
    found = filmed_species(fit_film(film), species).wingbeat
    np.testing.assert_allclose(chord_ratio(found, PHASES), chord_ratio(RICH, PHASES), atol=2e-6)
    assert "chord_retraction" not in fit_film(film).numbers


@pytest.mark.slow
def test_noisy_laws_are_recovered_within_their_spread():
    """Of ten noisy films, two standard deviations of the draws hold the truth nearly always."""
    within = {law.__name__: [] for law in LAWS}
    tilts = []
    for seed in range(10):
        beat = fit_film(film_of(noise_deg=1.5, seed=seed))
        found = filmed_species(beat, PIGEON).wingbeat
        draws = beat.draws(found, 30, seed)
        for law in LAWS:
            spread = np.std([law(draw, PHASES) for draw in draws], axis=0)
            miss = np.abs(np.asarray(law(found, PHASES)) - np.asarray(law(RICH, PHASES)))
            within[law.__name__].append(miss <= 2 * spread)
        error = np.std([draw.stroke_plane_tilt for draw in draws])
        assert np.mean([draw.stroke_plane_tilt for draw in draws]) == pytest.approx(
            found.stroke_plane_tilt, abs=error
        )
        tilts.append(abs(found.stroke_plane_tilt - 0.25) <= 2 * error)
    shares = {name: float(np.mean(hits)) for name, hits in within.items()}
    assert all(share >= 0.85 for share in shares.values()), shares
    assert np.mean(tilts) >= 0.8


def test_what_was_filmed_is_not_free():
    free = ("chord_sin_1", "twist_ratio", "twist_cos_2", "sweep_phase", "stroke_plane_tilt", "pitch_mean")
    held = fit_film(film_of()).held
    assert held >= set(free)
    assert not fit_film(film_of(columns=("flap_deg",))).held & set(free)
    few = fit_film(film_of(columns=("flap_deg", "sweep_deg")))
    assert trim_of(few, PIGEON)[0] == ("pitch_mean", "pitch_amplitude")


@pytest.mark.parametrize("around", [175.0, -179.0, 360.0])
def test_angles_that_wrap_are_fitted_as_if_they_did_not(around):
    plain = film_of(noise_deg=0.5, columns=("flap_deg", "pitch_deg", "tip_pitch_deg"))
    wrapped = {
        name: values if name == "flap_deg" else (values + around + 180.0) % 360.0 - 180.0
        for name, values in plain.columns.items()
    }
    film = Film("wraps", plain.phase, wrapped, 8.0)
    jumps = sum("moved by whole turns" in note for note in film.notes)
    assert jumps == (0 if around == 360.0 else 2)
    found, wanted = (fit_film(one).numbers for one in (film, plain))
    assert found["twist_mean"] == pytest.approx(wanted["twist_mean"], abs=1e-9)
    assert found["pitch_harmonics"] == pytest.approx(wanted["pitch_harmonics"], abs=1e-9)
    gone = math.remainder(found["pitch_mean"] - wanted["pitch_mean"] - math.radians(around), 2 * math.pi)
    assert gone == pytest.approx(0.0, abs=1e-9)
    assert abs(found["pitch_mean"]) < 1.5 * math.pi


def test_an_angle_that_does_not_wrap_keeps_every_digit():
    values = film_of(noise_deg=2.0, columns=("pitch_deg",)).columns["pitch_deg"]
    assert np.array_equal(Film("same", np.arange(80) / 80, {"pitch_deg": values}).columns["pitch_deg"], values)


def test_an_angle_that_turns_on_is_refused():
    phase = np.arange(40) / 40
    with pytest.raises(wb.InvalidInputError, match="in one beat and does not come back"):
        Film("spins", phase, {"pitch_deg": 360.0 * phase - 180.0})


def test_a_stroke_plane_that_varies_is_said_to():
    phase, noise = np.arange(60) / 60, np.random.default_rng(3).normal(scale=1.0, size=60)
    still = fit_film(Film("still", phase, {"stroke_plane_deg": 80.0 + noise}))
    assert still.notes == ()
    swinging = fit_film(Film("swings", phase, {"stroke_plane_deg": 80.0 + 3 * np.cos(2 * math.pi * phase) + noise}))
    (note,) = swinging.notes
    assert "the mean angle is used" in note
    assert any(note in line for line in film_lines(swinging))


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("phase,tip_pitch_deg\n", ["needs pitch_deg", "add the column pitch_deg"]),
        ("phase,sweep\n", ["write degrees, with a name such as"]),
        ("phase,area_fraction\n", ["not a fraction of the full area", "seem to be per cent; divide by 100"]),
    ],
)
def test_faults_of_the_new_columns(tmp_path, text, faults):
    path = tmp_path / "beat.csv"
    path.write_text(text + "\n".join(f"{i / 20},{50 + i}" for i in range(20)))
    with pytest.raises(wb.InvalidInputError) as caught:
        read_film(path)
    for fault in faults:
        assert fault in str(caught.value)


def test_an_area_of_another_wing_is_refused():
    small = Film("small", np.arange(20) / 20, {"area_fraction": np.full(20, 0.3)})
    with pytest.raises(wb.InvalidInputError, match="mean ratio of area fraction to span fraction"):
        filmed_species(fit_film(small), PIGEON)


def test_eight_columns_are_drawn_in_two_blocks():
    figure = film_page(fit_film(film_of(noise_deg=1.0)))
    assert len(figure.axes) == 16


def test_the_fold_of_a_film_is_that_of_its_wingbeat():
    folded = dataclasses.replace(RICH, fold_amplitude=0.2)
    beat = fit_film(film_of(folded, noise_deg=0.5, columns=("flap_deg", "fold_deg"), start=0.2))
    assert beat.numbers["fold_amplitude"] == pytest.approx(0.2, abs=0.01)
    assert "fold_amplitude" in beat.held
