"""Files of one known flight that programs and libraries wrote themselves: what they do otherwise than guessed."""

import json

import numpy as np
import pytest

from tests.experiment.test_point_files import CASES, TRUE, flap_and_pitch
from wingbeat.cli import main
from wingbeat.experiment import angles_from_points, read_points

ROLES = "shoulder,wrist,tip,trailing"


@pytest.mark.parametrize(
    ("name", "options", "within"),
    [
        ("opensim_written.trc", {}, 0.001),
        ("pose2sim.trc", {}, 0.001),
        ("kinetics_toolkit.trc", {}, 0.001),
        ("kinetics_toolkit.c3d", {}, 0.001),
        ("dltdv8_xyzpts.csv", {"frame_rate": 240.0}, 0.001),
        ("dltdv8_xyzpts.tsv", {"frame_rate": 240.0, "points": ROLES}, 0.001),
        ("argus_unpaired.csv", {"frame_rate": 240.0, "points": ROLES}, 0.001),
        ("anipose_plain.csv", {"frame_rate": 240.0}, 0.05),
        ("anipose_optimised.csv", {"frame_rate": 240.0}, 0.1),
    ],
)
def test_every_program_s_file_of_one_flight_gives_its_angles(name, options, within):
    """The tip was hidden in frames 10 to 13; all of them keep or are given that gap."""
    assert flap_and_pitch(CASES / name, **options) == pytest.approx(TRUE, abs=within)
    tip = list(read_points(CASES / name).positions.values())[2]
    assert np.isnan(tip[10:14]).all()
    assert np.isfinite(tip[24:]).all()
    assert angles_from_points(CASES / name, **options).record()["frequency"] == pytest.approx(8.2, abs=0.002)


def test_dltdv_8_writes_the_names_of_points_where_version_5_wrote_pt1():
    """DLTdv 8.4.1 has names of points, spaces included; the sparse format keeps them in another file."""
    assert list(read_points(CASES / "dltdv8_xyzpts.csv").positions) == ["shoulder", "wrist", "tip", "trailing edge"]
    assert list(read_points(CASES / "dltdv8_xyzpts.tsv").positions) == ["pt1", "pt2", "pt3", "pt4"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Sparse format camera coordinates file\n60\t24\t1\n1\t1\t4.0\n", "without 3D points"),
        ("Sparse format 3D coordinates file\n60\t12\t2\n1\t1\t4.0\n", "rows do not fit the size in row 2"),
        ("Sparse format 3D coordinates file\n60\t12\t1\n61\t1\t4.0\n", "rows do not fit the size in row 2"),
        ("Sparse format 3D coordinates file\n60\t12\t1\n1\t1\n", "rows do not fit the size in row 2"),
        ("Sparse format 3D coordinates file\n300000\t3\t2\n1\t1\t4.0\n300000\t1\t4\n", "are more than 100000"),
    ],
)
def test_a_sparse_file_that_is_cut_or_of_another_kind_is_refused(text, words, tmp_path):
    path = tmp_path / "xyzpts.tsv"
    path.write_text(text)
    with pytest.raises(ValueError, match=words):
        read_points(path)


def test_kinetics_toolkit_states_the_number_of_frames_times_the_rate():
    """Version 0.17 divides the number of frames by the first step, and rounds times to a millisecond."""
    points = read_points(CASES / "kinetics_toolkit.trc")
    assert points.rate == pytest.approx(240.0)
    assert points.times == pytest.approx(2.0 + np.arange(60) / 240, abs=1e-9)
    assert "14400 frames a second are the number of frames times the rate" in points.warnings[0]
    assert "rounded to a millisecond" in points.notes[0]


def test_times_in_milliseconds_of_another_rate_stay(tmp_path):
    """A rate that fits neither the times nor the number of frames is refused, as before."""
    text = (CASES / "kinetics_toolkit.trc").read_text().replace("14399.999999999283", "14000")
    path = tmp_path / "other.trc"
    path.write_text(text)
    with pytest.raises(ValueError, match="does not fit the times"):
        angles_from_points(path)


def test_anipose_s_optimisation_fills_frames_that_no_camera_saw_and_counts_the_cameras():
    """Version 1.1.24: coordinates stand there, the error is empty and ncams is 0; these frames are left out."""
    points = read_points(CASES / "anipose_optimised.csv")
    assert "tip: 7 of 60 frames were seen by fewer than two cameras" in points.notes[0]


def test_sleap_anipose_fills_frames_that_no_camera_saw_and_marks_none():
    """Version 0.1.8 has no names and no counts of cameras, and smooths: an amplitude is 1.4 degrees too small."""
    points = read_points(CASES / "sleap_anipose.h5")
    assert list(points.positions) == ["node0", "node1", "node2", "node3"]
    assert np.isfinite(points.positions["node2"]).all()
    assert "fills frames that no camera saw" in points.warnings[0]
    found = flap_and_pitch(CASES / "sleap_anipose.h5", frame_rate=240.0, points=ROLES)
    assert found[1] - TRUE[1] == pytest.approx(-1.36, abs=0.05)


def test_pose2sim_turns_the_axes_and_counts_frames_of_the_video():
    """Version 0.10.49 writes y up, whatever the cameras had, and frames and times from the start of the video."""
    points = read_points(CASES / "pose2sim.trc")
    assert points.frames[0] == 100
    assert points.times is not None
    assert points.times[0] == pytest.approx(100 / 240)
    assert "up is +y" in " ".join(angles_from_points(CASES / "pose2sim.trc").record()["notes"])


def test_deeplabcut_s_axes_are_those_of_its_first_camera():
    """DeepLabCut 3.0.2: y is down and z away from the camera, which looks 17 degrees down; amplitudes hold."""
    path = CASES / "deeplabcut_3d.csv"
    points = read_points(path)
    assert "in the axes of its first camera, x right, y down, z away" in points.warnings[0]
    assert np.isnan(points.positions["tip"][10:14]).all()
    found = flap_and_pitch(path, frame_rate=240.0, up="-y")
    assert found[1:] == pytest.approx(TRUE[1:], abs=0.1)
    assert found[0] - TRUE[0] == pytest.approx(-12.9, abs=0.1)
    # The camera stands 0.3 of its distance above the flight; with the true vertical the mean is right too.
    assert flap_and_pitch(path, frame_rate=240.0, up="0,-1,-0.3") == pytest.approx(TRUE, abs=0.1)
    movements = read_points(CASES / "movement_deeplabcut.csv")
    assert movements.warnings == ()


@pytest.mark.parametrize("word", ["w", "0,0,0", "1,2", "nan,1,2", "1,2,x", "", "1e999,0,1"])
def test_a_direction_is_an_axis_or_three_numbers(word):
    with pytest.raises(ValueError, match=r"is no axis; write x, y or z.* or three numbers, such as 0.1,-0.99,0.05"):
        angles_from_points(CASES / "deeplabcut_3d.csv", frame_rate=240.0, up=word)


@pytest.mark.parametrize("word", ["0 -1 -0.3", "(0, -10, -3)", "0;-1;-0.3"])
def test_a_direction_may_have_any_length_and_is_said(word):
    found = angles_from_points(CASES / "deeplabcut_3d.csv", frame_rate=240.0, up=word)
    assert any("up is 0,-0.958,-0.287, from --up" in one for one in found.notes)


@pytest.mark.parametrize("words", [["--up", "-y"], ["--up", "-0,-1,-0.3", "--forward", "-x"]])
def test_the_command_takes_the_axes_as_its_messages_write_them(words, capsys):
    """An option's value that begins with a minus was taken for another option: "--up requires an argument"."""
    assert main(["film", str(CASES / "deeplabcut_3d.csv"), "--frame-rate", "240", *words, "--json"]) == 0
    up = json.loads(capsys.readouterr().out)["axes"]["up"]
    assert up == pytest.approx([0, -1, 0] if words[1] == "-y" else [0, -0.958, -0.287], abs=1e-3)
