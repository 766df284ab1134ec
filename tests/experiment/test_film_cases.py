"""Films that went wrong without a word: what is fitted, refused or warned of now."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from wingbeat.cli.app import main
from wingbeat.cli.filmed import film_lines, film_record
from wingbeat.experiment import Film, fit_film, read_film
from wingbeat.experiment.film_file import MAX_FRAMES
from wingbeat.experiment.periodic import clip_rate
from wingbeat.orbits.problem.filmed import filmed_species

CASES = ROOT / "tests/cases/films"
AT = np.arange(90) / 240
FLAP = 40 * np.cos(2 * math.pi * 8 * AT)


def film(tmp_path, head="# frequency = 8\n", clock=AT, name="time", **columns):
    columns = columns or {"flap_deg": FLAP}
    rows = [",".join(f"{cell:.7g}" for cell in row) for row in zip(clock, *columns.values(), strict=True)]
    path = tmp_path / "film.csv"
    path.write_text("\n".join([head + ",".join([name, *columns]), *rows]) + "\n")
    return path


def refused(path, **options):
    with pytest.raises(wb.InvalidInputError) as caught:
        fit_film(read_film(path, **options))
    return str(caught.value)


@pytest.mark.parametrize("name", ["good", "nan_gaps", "nan_in_pitch", "left_right"])
def test_good_films_give_their_frequency_and_amplitude(name):
    beat = fit_film(read_film(CASES / f"{name}.csv"))
    assert beat.film.frequency == pytest.approx(8.2, abs=4 * beat.film.frequency_se)
    assert 0.002 < beat.film.frequency_se < 0.02
    assert math.degrees(beat.numbers["flap_amplitude"]) == pytest.approx(40.0, abs=0.6)
    assert beat.warnings == ()
    assert "fitted to the" in film_lines(beat)[0]


def test_a_header_that_disagrees_with_its_clip_is_refused(capsys):
    words = ["orbit", "pigeon", "--speed", "10", "--kinematics", str(CASES / "frequency_wrong.csv")]
    assert main(words) == 2
    said = capsys.readouterr().err
    assert "the clip itself beats at 8.201 +- 0.008 Hz; the header says 10.1; correct the line or the times" in said


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        ("16", "the header says 16; a beat is a downstroke and an upstroke"),
        ("4.0", "the header says 4.0"),
        ("8.5", "8.5"),
    ],
)
def test_harmonics_and_small_differences_are_seen(stated, words, tmp_path):
    assert words in refused(film(tmp_path, f"# frequency = {stated}\n"))


def test_a_header_with_few_digits_is_no_fault_and_a_long_clip_needs_none(tmp_path):
    rounded = film(tmp_path, "# frequency = 8\n", flap_deg=40 * np.cos(2 * math.pi * 8.3 * AT))
    assert read_film(rounded).frequency == pytest.approx(8.3)
    assert "its file says 8 Hz" in film_lines(fit_film(read_film(rounded)))[0]
    assert read_film(film(tmp_path, "")).frequency == pytest.approx(8.0)
    known = read_film(film(tmp_path, "# frequency = 8.1\n# frequency_se = 0.00000001\n", flap_deg=FLAP + 1e-3 * AT))
    assert known.frequency == 8.1
    assert "a clip of 1.3 beats does not show it" in refused(film(tmp_path, "", clock=AT[:40], flap_deg=FLAP[:40]))


def test_a_span_may_repeat_twice_a_beat_but_a_flap_may_not(tmp_path):
    span = 0.9 + 0.05 * np.cos(2 * math.pi * 16 * AT)
    assert read_film(film(tmp_path, span_fraction=span)).frequency == 8.0


def test_a_frequency_that_drifts_is_a_warning_everywhere():
    words = "the frequency falls from 8.83 to 7.6 Hz within the clip"
    path = CASES / "frequency_falls.csv"
    beat = fit_film(read_film(path))
    assert words in beat.warnings[0]
    assert words in film_record(beat)["warnings"][0]
    animal = filmed_species(beat, wb.load_species("pigeon"))
    assert words in animal.warnings[-1]  # and so in the record of each orbit and flight


def test_a_large_residual_and_swapped_points_are_warnings(tmp_path):
    noise = np.random.default_rng(1).normal(size=90)
    loose = fit_film(read_film(film(tmp_path, flap_deg=0.3 * FLAP + 4 * noise)))
    assert "degrees from the fitted wingbeat, whose amplitude is 1" in loose.warnings[0]
    swapped = FLAP + noise
    swapped[30] -= 60.0
    assert (
        "1 of 90 frames are far from the fitted curve, by up to"
        in fit_film(read_film(film(tmp_path, flap_deg=swapped))).warnings[0]
    )
    wild = film(tmp_path, flap_deg=30 * noise)
    assert "these frames are not of one wingbeat" in refused(wild)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"flap_deg": np.radians(FLAP)}, "these seem to be radians, not degrees"),
        ({"flap_deg": np.linspace(-40, 40, 90)}, "rises from frame to frame and never turns back"),
        ({"flap_deg": (360 * 8 * AT) % 360 - 180}, "never turns back: it seems to be a phase"),
        ({"flap_deg": -360 * 8 * AT}, "falls from frame to frame and never turns back"),
        ({"flap_deg": np.full(90, 20.0)}, "hardly swings"),
        ({"span_fraction": 300 + 0.3 * FLAP}, "seem to be a length or an area; divide by the semi-span"),
        ({"span_fraction": 90 + 0.1 * FLAP}, "seem to be per cent; divide by 100"),
        ({"clock": 1e3 * AT}, "the times seem to be milliseconds: write seconds"),
        ({"clock": np.arange(90)}, "count frames, about 240 a second: add the line '# frame rate [Hz] = ..'"),
        ({"clock": np.arange(90), "head": ""}, "the times seem to count frames: add the line '# frame rate"),
        ({"clock": np.arange(90), "name": "frame"}, "frame rate = '': is missing: the rows count frames"),
        ({"clock": 1e3 * AT, "head": ""}, "the times seem to be milliseconds: write seconds"),
        ({"clock": np.tile(AT[:45], 2)}, "row 48, column time = 0.0: must be above the time before it"),
        ({"clock": 2880 * AT % 360, "name": "phase"}, "the phases seem to be degrees; divide them by 360"),
        ({"clock": 800 * AT % 100, "name": "phase"}, "the phases seem to be per cent of a beat"),
        ({"clock": 2 * math.pi * 8 * AT, "name": "phase"}, "the phases seem to be radians"),
        ({"clock": np.arange(90), "name": "phase"}, "the phases seem to be numbers of frames; divide them by 30"),
        ({"head": "# fps = 480\n"}, "which step by 0.004167 s: 240 frames a second"),
        ({"head": "# frequency = 8\n# Frequency [Hz] = 8.1\n"}, "appears twice (above as frequency)"),
        ({"left_flap_deg": FLAP, "right_flap_deg": -FLAP}, "it seems to have the other sign"),
        ({"flap_deg": FLAP, "left_flap_deg": FLAP}, "has flap_deg for both wings together and for one"),
    ],
)
def test_what_the_numbers_seem_to_be_is_said_in_words(change, words, tmp_path):
    assert words in refused(film(tmp_path, **change))


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"pitch_deg": np.radians(20 * np.sin(50 * AT))}, "if these are radians, multiply them by 57.29578"),
        ({"span_fraction": 0.55 + 0.001 * FLAP}, "the wing never spreads to more than 0.5"),
    ],
)
def test_what_may_be_another_unit_is_a_warning(columns, words, tmp_path):
    noise = np.random.default_rng(2).normal(size=90)
    beat = fit_film(read_film(film(tmp_path, flap_deg=FLAP + noise, **columns)))
    assert words in " ".join(beat.warnings)


def test_frames_are_read_with_a_frame_rate(tmp_path):
    text = (CASES / "frames.csv").read_text()
    for name in ("time", "frame"):
        path = tmp_path / "frames.csv"
        path.write_text("# frame rate [Hz] = 240\n" + text.replace("time,", f"{name},"))
        assert read_film(path).frequency == pytest.approx(8.2, abs=0.03)
    assert "about 240 a second" in refused(CASES / "frames.csv")


def test_both_wings_are_their_mean_or_one_of_them(tmp_path, capsys):
    path = CASES / "left_right.csv"
    both, left, right = (read_film(path, side) for side in ("both", "left", "right"))
    assert "the mean of both wings; left minus right is 0.34 +- 0.23 deg on average" in both.notes[0]
    assert both.columns["flap_deg"] == pytest.approx(0.5 * (left.columns["flap_deg"] + right.columns["flap_deg"]))
    apart = film(tmp_path, left_flap_deg=FLAP + 4, right_flap_deg=FLAP - 4)
    assert "differ by 8 deg on average" in read_film(apart).warnings[0]
    wider = film(tmp_path, left_flap_deg=1.2 * FLAP, right_flap_deg=0.8 * FLAP)
    assert "deg in amplitude" in read_film(wider).warnings[0]
    turned = film(tmp_path, flap_deg=FLAP, left_pitch_deg=179 + 0.05 * FLAP, right_pitch_deg=-179 + 0.05 * FLAP)
    assert np.abs(read_film(turned).columns["pitch_deg"]).min() > 170
    assert "has no column right_flap_deg" in refused(film(tmp_path, left_flap_deg=FLAP), side="right")
    assert main(["simulate", "pigeon", "--side", "left"]) == 2
    assert "chooses a wing of a film, but there is none" in capsys.readouterr().err


def test_a_wing_that_was_hidden_is_replaced_by_the_other(tmp_path):
    path = film(tmp_path, left_flap_deg=FLAP + 1, right_flap_deg=FLAP - 1)
    lines = path.read_text().splitlines()
    lines[10] = ",".join([lines[10].split(",")[0], "NA", lines[10].split(",")[2]])
    path.write_text("\n".join(lines))
    assert read_film(path).columns["flap_deg"] == pytest.approx(FLAP, abs=0.03)


def test_a_film_has_a_limit_on_its_rows(tmp_path):
    path = tmp_path / "long.csv"
    path.write_text("# frequency = 8\ntime,flap_deg\n" + "0,1\n" * (MAX_FRAMES + 1))
    said = refused(path)
    assert "has more than 100000 rows" in said
    assert len(said.splitlines()) == 1


def test_a_film_with_semicolons_and_decimal_commas_is_read_and_said():
    film = read_film(CASES / "semicolon.csv")
    assert film.notes[0] == "read with semicolons between the columns and decimal commas"
    assert film.columns["flap_deg"][:2].tolist() == [44.744, 44.593]
    assert film.stated == 8.2


def test_a_column_of_zeros_is_a_rigid_wing():
    rigid = fit_film(Film("rigid", 8 * AT, {"flap_deg": FLAP, "pitch_deg": np.zeros(90)}, 8.0))
    assert rigid.numbers["pitch_amplitude"] == pytest.approx(0.0, abs=1e-9)


def test_the_error_of_the_frequency_is_that_of_many_clips():
    """Of 60 clips, fitted frequencies and drifts scatter as their standard errors say."""
    random, off, drifts = np.random.default_rng(0), [], []
    for _ in range(60):
        clip = clip_rate(AT, {"flap_deg": FLAP + random.normal(scale=2.0, size=90)})
        assert clip is not None
        off.append((clip.rate - 8.0) / clip.rate_se)
        drifts.append(clip.change / clip.change_se)
    assert 0.75 < np.std(off) < 1.3
    assert 0.75 < np.std(drifts) < 1.3
    assert not any(dataclasses.replace(Film("f", 8 * AT, {"flap_deg": FLAP}, 8.0)).warnings)


def test_times_closer_together_than_any_cameras_are_refused(tmp_path):
    """The square of so short a clip is 0, and its rate was divided by it."""
    assert "shorter than any camera's" in refused(film(tmp_path, clock=AT * 1e-300))


def test_few_frames_with_phases_in_radians_are_no_beat(tmp_path):
    """Harmonics pass through all of ten frames, so there is no scatter to see it by."""
    phase = 2 * math.pi * np.arange(10) / 10
    path = film(tmp_path, "", phase, "phase", flap_deg=40 * np.cos(phase) + 0.5 * np.cos(9 * np.arange(10) ** 2))
    assert "is the part of the flap that repeats once a beat" in refused(path)
    assert fit_film(read_film(film(tmp_path, "", phase / (2 * math.pi), "phase", flap_deg=40 * np.cos(phase))))
