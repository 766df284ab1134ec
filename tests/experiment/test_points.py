"""Angles from tracked points: files of programs, directions and units, and wings that are known exactly."""

import io
import json
import math
import re

import numpy as np
import pytest

import wingbeat as wb
from tests.experiment.points_truth import TURNS, a_beat, csv_of, points_of, tracked
from tests.helpers.figures import check_legends
from tests.helpers.places import ROOT
from wingbeat._base.style import BLUE, VERMILION
from wingbeat.cli.app import main
from wingbeat.experiment import TrackedPoints, angles_from_points, fit_film, read_film, read_points
from wingbeat.experiment.point_names import _role
from wingbeat.plots import points_page

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


def judged(seeds, trailing):
    """Return the share of errors within 1.96 standard errors of each number, and the errors beyond the limits."""
    inside, missed = {}, []
    for seed in seeds:
        random, beat = np.random.default_rng(1000 + seed), a_beat(seed)
        time = np.arange(int(random.uniform(2.5, 6.0) / beat["frequency"] * 240)) / 240
        side, axes = random.choice(["left", "right"]), random.choice(list(TURNS))
        gaps = random.choice([0, 0.1, 0.2])
        at = tracked(points_of(beat, time, side, trailing=trailing), axes, 0.003, gaps, seed)
        told = angles_from_points(made(at), side=str(side) if seed % 2 else None).record()
        for name, true in (truths(beat) | {"frequency": beat["frequency"]}).items():
            limit = LIMITS.get(name, 0.01 * beat["frequency"])
            if not abs(told[name] - true) < limit:
                missed.append((seed, name, told[name], true, " ".join(told["warnings"])))
            inside.setdefault(name, []).append(abs(told[name] - true) < 1.96 * told[f"{name}_se"])
    return {name: float(np.mean(hits)) for name, hits in inside.items()}, missed


@pytest.mark.slow
@pytest.mark.parametrize(("count", "trailing"), [(160, True), (120, False)])
def test_random_wingbeats_are_found_in_any_axes_with_one_per_cent_of_noise(count, trailing):
    """Without a trailing point the chord is a tenth of the wing, so that such noise turns it by 7 deg a frame."""
    told, missed = judged(range(count), trailing)
    assert all(name.startswith("pitch") and "pitch is uncertain by" in said for _, name, _, _, said in missed)
    assert not trailing or all(seed >= 40 for seed, *_ in missed)
    # 600 other wingbeats: 0.94 to 0.96 of each number; 400 without a trailing point: 0.93 to 0.96.
    assert all(0.90 <= share <= 0.99 for share in told.values()), told


def test_a_shoulder_that_is_the_origin_of_the_axes_is_no_gap():
    at = tracked(points_of(BEAT, TIME))
    fixed = {role: one - at["shoulder"] for role, one in at.items()}
    told = angles_from_points(made(fixed), up="z", forward="x", side="left").record()
    assert told["gaps"]["shoulder"] == 0
    for name, true in truths(BEAT).items():
        assert told[name] == pytest.approx(true, abs=0.05), name


@pytest.mark.parametrize("kind", ["made", "DLTdv", "Qualisys .tsv", "OpenSim .trc", "C3D"])
def test_zeros_are_gaps_where_the_program_means_them_so_and_else_a_warning(kind):
    at = tracked(points_of(BEAT, TIME))
    at["tip"][10:13] = 0.0
    seen = TrackedPoints("a clip", kind, at, None, np.arange(120.0), 240.0)
    said = "a clip, tip: 3 frames at exactly (0, 0, 0) are taken"
    assert np.isnan(seen.positions["tip"]).all(axis=1).sum() == (0 if kind == "made" else 3)
    assert [one.startswith(said) for one in seen.warnings] == [True] * (kind == "made")
    assert [one.startswith(said) for one in seen.notes] == [True] * (kind != "made")


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
    for source, stated in ((small, {"units": "m"}), (made(at, unit="mm"), {})):
        assert "as that of no animal" in "".join(angles_from_points(source, **stated).warnings)


def test_the_unit_of_a_small_wing_is_asked_for_and_then_believed():
    """A fruit fly's wing of 2.5 mm was read as one of 2.5 cm without a word, and --units mm was refused."""
    time = np.arange(150) / 5000
    fly = {role: 2.5 / 0.3 * one for role, one in points_of(BEAT | {"frequency": 200.0}, time).items()}
    asked = angles_from_points(made(fly, rate=5000.0))
    assert asked.unit is None
    assert "cm (0.025 m) or mm (0.0025 m)" in "".join(asked.warnings)
    told = angles_from_points(made(fly, rate=5000.0), units="mm")
    assert told.semi_span == pytest.approx(0.0025, rel=0.01)
    assert "no animal" not in "".join(told.notes)


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
    refused(made(still), "show no beat", up="z")


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


def test_a_frame_rate_that_contradicts_the_files_own_times_is_refused():
    """It was left aside in silence where a file had times and a rate of its own."""
    refused(CASES / "opensim.trc", "--frame-rate", "does not fit the times", frame_rate=480.0)
    assert angles_from_points(CASES / "opensim.trc", frame_rate=240.0).warnings == ()


def test_the_film_never_overwrites_the_points_by_another_spelling_of_their_path(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    text = (CASES / "anipose.csv").read_text()
    (tmp_path / "points.csv").write_text(text)
    for spelling in (str(tmp_path / "points.csv"), f"../{tmp_path.name}/points.csv"):
        assert main(["film", "points.csv", "-o", spelling, "--frame-rate", "240"]) == 2
        assert "is a file that the command reads" in capsys.readouterr().err
    (tmp_path / "case_strips.csv").write_text(text)
    (tmp_path / "names.toml").write_text('tip = "left_tip"')
    for strips, why in {
        "points.csv --strips names.toml --points names.toml": "--strips = 'names.toml': is a file that the command",
        "case_strips.csv --strips case.toml": "--strips = 'case_strips.csv': is a file that the command reads",
        "points.csv -o case_strips.csv --strips case.toml": "is also the file of --output",
    }.items():
        assert main(["film", *strips.split(), "--mass", "0.3"]) == 2
        assert why in capsys.readouterr().err
    assert [(tmp_path / f"{name}.csv").read_text() for name in ("points", "case_strips")] == [text] * 2


def test_points_seen_too_rarely_are_refused_and_json_never_holds_nan():
    """Points of 8 to 11 frames had a noise of NaN, so that no check of the pitch's noise was left."""
    for count in (8, 11):
        at = tracked(points_of(BEAT, TIME), noise=0.001)
        at["trailing"][count:] = np.nan
        refused(made(at), "trailing", f"{count} frames", "must be seen in at least 12 frames")
    at = tracked(points_of(BEAT, TIME), noise=0.001)
    at["shoulder"][:60] = np.nan
    at["tip"][60:] = np.nan
    refused(made(at), "0 frames", "must be seen together in at least 12 frames")
    told = angles_from_points(made(tracked(points_of(BEAT, TIME), noise=0.001, gaps=0.2))).record()
    assert "NaN" not in json.dumps(told)


def test_what_is_named_and_not_used_is_said():
    """Wings without a tip, lone body points and the pitch of one wing were dropped, and the record listed them."""
    left, right = (points_of(BEAT, TIME, side) for side in ("left", "right"))
    at = {f"left_{role}": one for role, one in left.items()}
    at |= {"right_wrist": right["wrist"], "beak": left["shoulder"] + [0.1, 0, 0]}
    found = angles_from_points(made(at))
    assert any("not used: right wrist = right_wrist, front = beak" in one for one in found.notes)
    assert any("the body axis needs the points front and rear" in one for one in found.notes)
    assert set(found.record()["points"]) == {f"left_{role}" for role in left}
    at |= {f"right_{role}": right[role] for role in ("shoulder", "tip")}
    del at["right_wrist"]
    found = angles_from_points(made(at))
    assert found.record()["pitch_mean_deg"] is None
    assert any("left wing: pitch_deg is left out, because the other wing has none" in one for one in found.notes)


def test_times_that_count_frames_show_the_gaps_in_their_count():
    """Steps were taken from the numbers of the rows, before the times took their place."""
    times = np.concatenate([np.arange(60), np.arange(64, 124)]).astype(float)
    at = points_of(BEAT, times / 240)
    source = TrackedPoints("clip", "made", at, times, np.arange(120.0), 240.0)
    found = angles_from_points(source)
    assert found.record()["frequency"] == pytest.approx(8.2, abs=0.01)
    assert "1 times frames are missing between two rows" in "".join(found.warnings)


def test_a_toml_of_points_that_is_no_table_is_refused_in_words(tmp_path):
    path = tmp_path / "points.toml"
    path.write_text('points = "shoulder,wrist,tip"\n')
    refused(CASES / "dltdv_xyzpts.csv", "is no table of pairs", "[points]", points=path, frame_rate=240.0)


def test_the_note_says_what_gives_forward():
    """A flag's sign and the path's direction were told as the flag's direction."""
    turned = {role: one @ [[0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]] for role, one in points_of(BEAT, TIME).items()}
    notes = angles_from_points(made(turned), forward="x", up="z").notes
    assert any("forward is [0.8, 0.6, 0.0], from the path, with the sign of --forward" in one for one in notes)
    still = points_of(BEAT | {"speed": 0.0}, TIME)
    notes = angles_from_points(made(still), forward="x", up="z").notes
    assert any("forward is [1.0, 0.0, 0.0], from --forward" in one for one in notes)


def test_points_made_in_python_are_checked():
    at = points_of(BEAT, TIME)
    frames = np.arange(120.0)
    wrong = {
        "give (120, 3)": {"positions": at | {"tip": at["tip"][:50]}},
        "must be above the time before it": {"times": np.r_[0.0, 0.0, frames[2:]]},
        "must be above the frame before it": {"frames": frames[::-1]},
        "must be finite": {"times": np.r_[frames[:-1], np.inf]},
        "is not a known choice": {"unit": "ft"},
        "use one of +x": {"up": "north"},
        "frame rate": {"rate": -240.0},
    }
    for words, given in wrong.items():
        with pytest.raises(wb.InvalidInputError, match=re.escape(words)):
            TrackedPoints(
                **({"name": "clip", "kind": "made", "positions": at, "times": None, "frames": frames} | given)
            )
    at["tip"][3, 0] = np.nan  # seen in part
    points = TrackedPoints("clip", "made", at, None, frames)
    assert np.isnan(points.positions["tip"][3]).all()
    assert np.isfinite(at["tip"][3, 1:]).all(), "the caller's own points stay as they are"


def test_a_gap_in_the_middle_does_not_halve_the_frequency():
    """Straight lines across gaps had power at half the rate: 2 of 600 random wingbeats were refused for it."""
    beat = a_beat(6106)
    random = np.random.default_rng(7106)
    time = np.arange(int(random.uniform(2.5, 6.0) / beat["frequency"] * 240)) / 240
    side, axes = random.choice(["left", "right"]), random.choice(list(TURNS))
    at = tracked(points_of(beat, time, side), axes, 0.003, random.choice([0, 0.1, 0.2]), 6106)
    assert angles_from_points(made(at)).record()["frequency"] == pytest.approx(beat["frequency"], rel=0.01)


def test_the_page_of_points_shows_the_fitted_wing_where_the_points_are():
    """A folded hand and a body axis that is tilted in still air left the fitted line beside the tips."""
    beat, tilt = BEAT | {"fold": 40.0, "retraction": 0.0, "speed": 0.0}, 0.3
    turn = np.array([[math.cos(tilt), 0, -math.sin(tilt)], [0, 1, 0], [math.sin(tilt), 0, math.cos(tilt)]])
    at = {role: one @ turn.T for role, one in points_of(beat, TIME).items()}
    nose = 0.1 * np.array([math.cos(tilt), 0, math.sin(tilt)])
    at |= {"beak": at["shoulder"] + nose, "tail_base": at["shoulder"] - nose}
    found = angles_from_points(made(tracked(at, noise=0.0005), name="a_bat_$1$.csv"), up="z")
    figure = points_page(found)
    for axes in figure.axes[:2]:
        tips = next(line.get_xydata() for line in axes.lines if line.get_color() == BLUE)
        ends = [line.get_xydata()[-1] for line in axes.lines if line.get_color() == VERMILION]
        assert len(ends) == 8
        for end in ends:
            assert np.nanmin(np.hypot(*(tips - end).T)) < 0.05
    entries = [entry for part in figure.subfigs for entry in check_legends(part)]
    assert {"tip", "fitted span", "periodic spline", "frames, ±1 s.e."} <= set(entries)
    assert figure.get_suptitle() == "A bat $1$.csv"
    figure.savefig(io.BytesIO())
