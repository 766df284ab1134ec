"""Strips for ``wingbeat validate`` from tracked points, and what of a wing its points do not show."""

import math

import numpy as np
import pytest

import wingbeat as wb
import wingbeat_evidence as evidence
from tests.experiment.points_truth import a_beat, csv_of, points_of
from wingbeat.cli.app import main
from wingbeat.experiment import TrackedPoints, angles_from_points
from wingbeat.experiment.point_strips import save_strips

TIME = np.arange(150) / 240
# The phase of the top of the stroke is 0, so that times of the case are those of the points.
BEAT = a_beat(3) | {"frequency": 8.0, "climb": 3.0, "fold": 0.0, "phase": 0.0, "speed": 30.0}


def points(time=TIME, twist=None):
    at = points_of(BEAT, time)
    if twist is not None:
        # The chord at the tip, of half the length, turned by `twist` about the span.
        span = at["tip"] - at["shoulder"]
        span = span / np.linalg.norm(span, axis=1)[:, None]
        chord = at["wrist"] - at["trailing"]
        beside = np.cross(chord, span)
        at["tip_trailing"] = at["tip"] - 0.5 * (math.cos(twist) * chord + math.sin(twist) * beside)
    return at


def found_in(at):
    return angles_from_points(TrackedPoints("a clip", "made", at, TIME, np.arange(150.0), unit="m"))


def turn_between(one, other):
    """Return the angle between two vectors at each time [deg]."""
    share = (one * other).sum(axis=1) / np.linalg.norm(one, axis=1) / np.linalg.norm(other, axis=1)
    return np.degrees(np.arccos(np.clip(share, -1.0, 1.0)))


def test_the_strips_move_as_the_points_do(tmp_path):
    assumed = save_strips(found_in(points()), tmp_path / "case.toml", 0.3)
    case = evidence.read_strip_case(tmp_path / "case.toml")
    assert case.period == pytest.approx(1 / 8.0, rel=1e-3)
    assert case.mean_force == pytest.approx((0.0, 0.3 * 9.81), abs=0.05)
    step, here = 1e-5, points(case.times)
    at = [points(case.times + move) for move in (-step, step)]
    chord = here["wrist"] - here["trailing"]
    span = here["tip"] - here["shoulder"]
    assert case.area.sum(axis=1) == pytest.approx(0.09 * np.linalg.norm(span, axis=1), rel=5e-3)
    for k in range(12):
        eta = (k + 0.5) / 12
        assert np.abs(case.position[:, k] - eta * span).max() < 1e-3, k
        assert np.abs(case.chord[:, k] - chord).max() < 1e-3, k
        place = [one["shoulder"] + eta * (one["tip"] - one["shoulder"]) for one in at]
        true = (place[1] - place[0]) / (2 * step)
        assert np.abs(case.velocity[:, k] - true).max() < 0.02 * np.linalg.norm(true, axis=1).max(), k
    rear = [one["trailing"] - 0.25 * (one["trailing"] - one["wrist"]) for one in at]
    three_quarters = (rear[1] - rear[0]) / (2 * step)
    front = [one["wrist"] - 0.25 * (one["wrist"] - one["trailing"]) for one in at]
    quarter = (front[1] - front[0]) / (2 * step)
    turning = (case.velocity - case.rear_velocity)[:, 5]
    assert np.abs(turning - (quarter - three_quarters)).max() < 0.03 * np.abs(turning).max()
    assert "no twist: no point tip_trailing" in assumed


def test_the_hand_of_the_strips_folds_at_the_wrist_as_the_points_do(tmp_path):
    folded = BEAT | {"fold": 30.0}
    found = angles_from_points(
        TrackedPoints("a clip", "made", points_of(folded, TIME), TIME, np.arange(150.0), unit="m")
    )
    save_strips(found, tmp_path / "case.toml", 0.3)
    case = evidence.read_strip_case(tmp_path / "case.toml")
    here = points_of(folded, case.times)
    hand = case.position[:, -1] - case.position[:, -2]
    fold = 30.0 * (1 - np.sin(2 * np.pi * 8.0 * case.times)) / 2
    assert turn_between(case.position[:, 0], hand) == pytest.approx(fold, abs=0.5)
    assert np.abs(case.position[:, -1] + 0.5 * hand - (here["tip"] - here["shoulder"])).max() < 2e-3


def test_names_with_quotes_give_a_case_that_can_be_read(tmp_path):
    found = found_in(points())
    save_strips(found, tmp_path / 'bird "7".toml', np.float64(0.3))
    case = evidence.read_strip_case(tmp_path / 'bird "7".toml')
    assert (case.name, case.mass) == ('bird "7"', 0.3)


def test_a_second_trailing_point_gives_twist_and_taper(tmp_path):
    found = found_in(points(twist=math.radians(-12)))
    told = found.record()
    assert told["tip_pitch_mean_deg"] - told["pitch_mean_deg"] == pytest.approx(-12, abs=0.2)
    assumed = save_strips(found, tmp_path / "case.toml", 0.3)
    case = evidence.read_strip_case(tmp_path / "case.toml")
    size = np.linalg.norm(case.chord, axis=2)[0]
    assert (size[0], size[-1]) == pytest.approx((0.09, 0.048), abs=0.002)
    # From shoulder to tip the chord turns by -12 deg; the first and last strip lie half a strip from these.
    here = points(case.times, math.radians(-12))
    ends = {0: here["wrist"] - here["trailing"], -1: here["tip"] - here["tip_trailing"]}
    for k, end in ends.items():
        assert turn_between(case.chord[:, k], end) == pytest.approx(0.5, abs=0.2), k
    assert turn_between(case.chord[:, 0], case.chord[:, -1]) == pytest.approx(11.0, abs=0.2)
    assert "the pitch at the tip is measured" in assumed


def test_what_is_not_measured_is_refused(tmp_path):
    at = points()
    at.pop("trailing")
    with pytest.raises(wb.InvalidInputError, match="name a trailing point"):
        save_strips(found_in(at), tmp_path / "case.toml", 0.3)
    still = {role: one - points()["shoulder"] + 1.0 for role, one in points().items()}
    with pytest.raises(wb.InvalidInputError, match="need the path of the body"):
        save_strips(
            angles_from_points(
                TrackedPoints("a clip", "made", still, TIME, np.arange(150.0), unit="m"), up="z", forward="x"
            ),
            tmp_path / "case.toml",
            0.3,
        )


@pytest.mark.slow
def test_the_command_writes_a_case_that_validate_reads(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    at = csv_of(points()).splitlines()
    # An unnamed column of row numbers, as pandas writes it, is not a clock.
    (tmp_path / "at.csv").write_text("\n".join(f"{i - 1 if i else ''},{row}" for i, row in enumerate(at)))
    words = ["film", "at.csv", "--frame-rate", "240", "-o", "film.csv"]
    assert main([*words, "--strips", "case.toml"]) == 2
    assert "give --strips and --mass together" in capsys.readouterr().err
    assert main([*words, "--strips", "case.toml", "--mass", "0.3"]) == 0
    caught = capsys.readouterr()
    assert "note: case.toml: the line of quarter chords is that from shoulder to tip" in caught.err
    assert "wingbeat simulate SPECIES --kinematics film.csv" in caught.out
    assert main(["validate", "case.toml", "--aero", "feathered-flapping"]) == 0
    assert "feathered-flapping" in capsys.readouterr().out
