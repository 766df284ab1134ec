"""Angles from tracked points: files of programs, directions and units, and wings that are known exactly."""

import json
import math
import re

import numpy as np
import pytest

import wingbeat as wb
from tests.experiment.points_truth import TURNS, a_beat, csv_of, points_of, tracked
from tests.helpers.places import ROOT
from wingbeat.cli.app import main
from wingbeat.experiment import TrackedPoints, angles_from_points, fit_film, read_film, read_points
from wingbeat.experiment.point_names import _role

CASES = ROOT / "tests/cases/points"
TIME = np.arange(120) / 240
BEAT = a_beat(3) | {"frequency": 8.2, "climb": 0.0}
LIMITS = {"flap_mean_deg": 1, "flap_amplitude_deg": 1, "pitch_mean_deg": 2, "pitch_amplitude_deg": 2}


def made(at, name="a clip", **more):
    frames = np.arange(len(next(iter(at.values()))), dtype=float)
    return TrackedPoints(name, "made", at, None, frames, **({"rate": 240.0} | more))


def refused(source, *words, **options):
    with pytest.raises(wb.WingbeatError) as caught:
        angles_from_points(source, **options)
    for word in words:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("dltdv_xyzpts.csv", {"points": "shoulder,wrist,tip", "frame_rate": 240.0}),
        ("anipose.csv", {"frame_rate": 240.0}),
        ("opensim.trc", {}),
    ],
)
def test_the_files_that_were_refused_give_their_angles(name, options):
    told = angles_from_points(CASES / name, **options).record()
    assert told["frequency"] == pytest.approx(8.2, abs=0.02)
    assert (told["flap_mean_deg"], told["flap_amplitude_deg"]) == pytest.approx((5.0, 40.0), abs=0.15)
    # In these wings the tip lies 0.03 m behind the shoulder, always.
    assert told["sweep_mean_deg"] == pytest.approx(-5.5, abs=0.2)
    assert told["pitch_mean_deg"] == pytest.approx(0.0, abs=1.0)
    assert told["semi_span"] == pytest.approx(0.3115, abs=0.001)
    assert told["speed"] == pytest.approx(2.0, abs=0.01)
    assert told["sides"] == ["left"]
    assert told["warnings"] == []


def test_the_command_writes_a_film_that_can_be_read(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = CASES / "dltdv_xyzpts.csv"
    words = ["film", str(path), "-o", "film.csv", "--points", "shoulder,wrist,tip", "--frame-rate", "240"]
    assert main([*words, "--side", "left", "--json"]) == 0
    caught = capsys.readouterr()
    told = json.loads(caught.out)
    assert told["frames"] == 60
    assert told["gaps"] == {"shoulder": 0, "wrist": 0, "tip": 6}
    assert told["frames_used"] == 54
    assert "note: dltdv_xyzpts.csv: lengths seem to be in m" in caught.err
    film = read_film("film.csv")
    assert np.isnan(film.columns["flap_deg"]).sum() == 6
    assert film.shows_body
    law = fit_film(film).laws["flap_deg"]
    assert law.coefficients[0] == pytest.approx(told["flap_mean_deg"], abs=1e-3)


def test_what_is_missing_is_asked_for_with_the_option_that_states_it():
    path = CASES / "dltdv_xyzpts.csv"
    refused(path, "has the points pt1, pt2, pt3", "--points shoulder,wrist,tip", frame_rate=240.0)
    refused(path, "give --frame-rate", points="shoulder,wrist,tip")
    refused(CASES / "deeplabcut.csv", "two coordinates only", "triangulate", frame_rate=240.0)
    refused(path, "did you mean", points="shoulder=pt1,tip=pt33", frame_rate=240.0)
    refused(path, "is no point of an animal", points="shoulder,elbow,tip", frame_rate=240.0)
    refused(path, "needs both wings", points="shoulder,wrist,tip", frame_rate=240.0, side="both")


def test_a_side_that_contradicts_right_handed_axes_is_refused_with_both_ways_out():
    path, options = CASES / "dltdv_xyzpts.csv", {"points": "shoulder,wrist,tip", "frame_rate": 240.0}
    refused(path, "the wing lies on the left", "give --up -z", "give --up +z", side="right", **options)
    below = angles_from_points(path, side="right", up="-z", **options).record()
    assert below["flap_mean_deg"] == pytest.approx(-5.0, abs=0.15)
    above = angles_from_points(path, side="right", up="z", **options).record()
    assert above["flap_mean_deg"] == pytest.approx(5.0, abs=0.15)
    assert "left-handed, or the side is wrong" in above["warnings"][0]


def truths(beat):
    return {name: beat[name.removesuffix("_deg")] for name in LIMITS}


def judged(seeds, noise):
    """Return how many errors were within two standard errors, and all errors that exceed the limits."""
    inside, count, large = dict.fromkeys([*LIMITS, "frequency"], 0), 0, []
    for seed in seeds:
        random, beat = np.random.default_rng(1000 + seed), a_beat(seed)
        time = np.arange(int(random.uniform(2.5, 6.0) / beat["frequency"] * 240)) / 240
        side, axes = random.choice(["left", "right"]), random.choice(list(TURNS))
        at = tracked(points_of(beat, time, side), axes, noise * 0.3, random.choice([0, 0.1, 0.2]), seed)
        told = angles_from_points(made(at), side=str(side) if seed % 2 else None).record()
        for name, true in (truths(beat) | {"frequency": beat["frequency"]}).items():
            limit = LIMITS.get(name, 0.01 * beat["frequency"])
            if not abs(told[name] - true) < limit:
                large.append((seed, name, told[name], true))
            inside[name] += abs(told[name] - true) < 1.96 * told[f"{name}_se"]
        count += 1
    return {name: number / count for name, number in inside.items()}, large


@pytest.mark.slow
def test_forty_random_wingbeats_are_found_in_any_axes_with_one_per_cent_of_noise():
    inside, large = judged(range(40), 0.01)
    assert large == []
    # 160 wingbeats: 0.91 to 0.96.
    assert all(0.84 < share <= 1.0 for share in inside.values()), inside


@pytest.mark.parametrize("axes", TURNS)
@pytest.mark.parametrize("side", ["left", "right"])
def test_without_noise_the_angles_are_exact(axes, side):
    told = angles_from_points(made(tracked(points_of(BEAT, TIME, side), axes)), side=side).record()
    for name, true in truths(BEAT).items():
        assert told[name] == pytest.approx(true, abs=0.02), name
    assert told["stroke_plane_deg"] == pytest.approx(BEAT["stroke_plane"], abs=0.02)
    assert told["sides"] == [side]
    assert told["span_fraction_mean"] == pytest.approx(1 - BEAT["retraction"] / 2, abs=0.002)


def test_both_wings_remove_roll_and_body_points_give_the_body_axis():
    roll = math.radians(6)
    turn = np.array([[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]])
    left, right = (points_of(BEAT, TIME, side) for side in ("left", "right"))
    at = {f"left_{role}": one @ turn.T for role, one in left.items()}
    at |= {f"right_{role}": one @ turn.T for role, one in right.items()}
    middle = 0.5 * (at["left_shoulder"] + at["right_shoulder"])
    nose = np.array([math.cos(0.2), 0, math.sin(0.2)])
    at |= {"beak": middle + 0.1 * nose, "tail_base": middle - 0.1 * nose}
    told = angles_from_points(made(at)).record()
    assert told["sides"] == ["left", "right"]
    for name, true in truths(BEAT).items():
        assert told[name] == pytest.approx(true, abs=0.5), name
    # The stroke plane is now counted from an axis that points up by 0.2 rad.
    assert told["stroke_plane_deg"] == pytest.approx(BEAT["stroke_plane"] + math.degrees(0.2), abs=0.5)
    assert any("left and the right wing differ" in one for one in told["warnings"])


def test_a_fold_becomes_a_column_and_flap_is_the_arms():
    beat = BEAT | {"fold": 20.0, "retraction": 0.0}
    found = angles_from_points(made(tracked(points_of(beat, TIME), noise=0.001)))
    told = found.record()
    assert told["flap_amplitude_deg"] == pytest.approx(beat["flap_amplitude"], abs=0.5)
    assert told["flap_mean_deg"] == pytest.approx(beat["flap_mean"], abs=0.5)
    assert told["pitch_amplitude_deg"] == pytest.approx(beat["pitch_amplitude"], abs=1.0)
    assert math.degrees(found.beat.numbers["fold_amplitude"]) == pytest.approx(20.0, abs=1.0)
    flat = angles_from_points(made(tracked(points_of(BEAT, TIME), noise=0.001)))
    assert "fold_deg" not in flat.film.columns


def test_units_are_found_or_asked_for():
    at = points_of(BEAT, TIME)
    sizes = {"m": 1.0, "mm": 1000.0}
    for unit, size in sizes.items():
        found = angles_from_points(made({role: size * one for role, one in at.items()}))
        assert (found.unit, found.semi_span) == (unit, pytest.approx(0.3, abs=1e-3))
    small = made({role: 100 * one for role, one in at.items()})
    told = angles_from_points(small)
    assert told.unit is None
    assert not told.film.shows_body
    assert "cm (0.3 m) or mm (0.03 m)" in "".join(told.warnings)
    assert angles_from_points(small, units="cm").record()["speed"] == pytest.approx(0.3 * BEAT["speed"], rel=0.01)
    refused(small, "as that of no animal", units="m")
    refused(made(at, unit="mm"), "give the unit of the numbers")


def test_an_animal_that_does_not_travel_needs_a_chord_and_draws_a_warning():
    at = points_of(BEAT | {"speed": 0.0}, TIME)
    told = angles_from_points(made(at)).record()
    assert told["flap_amplitude_deg"] == pytest.approx(BEAT["flap_amplitude"], abs=0.1)
    assert "if it hovers with a horizontal stroke, give --up" in told["warnings"][0]
    bare = {role: at[role] for role in ("shoulder", "tip")}
    refused(made(bare), "give --forward")
    assert angles_from_points(made(bare), up="z", forward="x").record()["warnings"] == []


def test_exchanged_points_are_refused():
    at = points_of(BEAT, TIME)
    order = list(at.values())
    for names, words in {
        ("tip", "wrist", "shoulder", "trailing"): "are two names exchanged",
        ("shoulder", "tip", "wrist", "trailing"): "distance from shoulder to wrist",
        ("shoulder", "trailing", "tip", "wrist"): "points backward",
    }.items():
        refused(made(dict(zip(names, order, strict=True))), words)


def test_a_short_clip_and_one_without_a_beat_are_refused():
    at = points_of(BEAT, TIME[:40])
    refused(made(at), "two beats that are alike are needed")
    noise = np.random.default_rng(0).normal(size=(120, 3))
    path = np.outer(TIME, [3.0, 0, 0])
    still = {"shoulder": path, "tip": path + [0, 0.3, 0] + 0.01 * noise}
    refused(made(still), "", up="z")


def test_a_wrist_close_to_the_line_gives_no_pitch():
    at = points_of(BEAT, TIME, trailing=False)
    at["wrist"] = at["shoulder"] + 0.45 * (at["tip"] - at["shoulder"])
    told = angles_from_points(made(tracked(at, noise=0.002))).record()
    assert told["pitch_mean_deg"] is None
    assert "pitch is left out; track a point at the trailing edge" in told["warnings"][0]


HEADS = {
    "{}_{}": ("tip", "x"),
    "{} {}": ("tip", "X"),
    "{}.{}": ("tip", "x"),
    "{}{} (mm)": ("tip", "X"),
    "{1}_{0}": ("tip", "x"),
}


@pytest.mark.parametrize("head", HEADS)
@pytest.mark.parametrize("sign", [",", ";", "\t"])
def test_tables_of_many_spellings_are_read(head, sign, tmp_path):
    at = {role: np.round(1000 * one, 2) for role, one in points_of(BEAT, TIME).items()}
    text = csv_of(at, sign=sign, head=head)
    if HEADS[head][1] == "X":
        first, rest = text.split("\n", 1)
        text = re.sub(r"([xyz])(?=[,;\t\n ])", lambda one: one[1].upper(), first + "\n") + rest
    if sign == ";":
        text = text.replace(".", ",") if head != "{}.{}" else text
    path = tmp_path / "points.csv"
    path.write_text(text)
    points = read_points(path)
    assert list(points.positions) == list(at)
    assert np.allclose(points.positions["tip"], at["tip"])
    assert points.unit == ("mm" if "mm" in head else None)


def test_usual_names_are_known():
    assert _role("LeftWingTip") == ("left", "tip")
    assert _role("wing_tip_r") == ("right", "tip")
    assert _role("Trailing edge") == ("", "trailing")
    assert _role("tip2") is None
