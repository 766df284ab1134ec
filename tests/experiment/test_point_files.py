"""Files of tracking programs and libraries: read, or refused in words; mutilated ones give no wrong angle."""

import importlib.util
import math
import random

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.experiment.points_truth import a_beat, points_of
from tests.helpers.places import ROOT
from wingbeat.experiment import TrackedPoints, angles_from_points, read_points

CASES = ROOT / "tests/cases/points"
TIME = np.arange(90) / 240
BEAT = a_beat(3) | {"frequency": 8.2, "climb": 0.0}
AT = points_of(BEAT, TIME)


def refused(path, *words):
    with pytest.raises(wb.WingbeatError) as caught:
        read_points(path)
    for word in words:
        assert word in str(caught.value)


def flap_and_pitch(source, **options):
    told = angles_from_points(source, **options).record()
    return [told[f"{name}_deg"] for name in ("flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")]


TRUE = [BEAT[name] for name in ("flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")]


@pytest.mark.parametrize("name", ["movement.nc", "movement_deeplabcut.csv", "movement_sleap_3d.h5"])
def test_points_that_movement_wrote_in_three_dimensions_are_read(name):
    """movement 0.15 writes z into DeepLabCut's and SLEAP's forms, which have none."""
    points = read_points(CASES / name)
    assert list(points.positions) == list(AT)
    assert np.nanmax(abs(points.positions["shoulder"] - AT["shoulder"][:60])) < 0.003
    rate = None if name.endswith(".nc") else 240.0
    assert flap_and_pitch(CASES / name, frame_rate=rate) == pytest.approx(TRUE, abs=0.5)


def test_movement_s_confidence_makes_gaps_and_its_data_set_needs_no_file():
    """movement keeps points of low confidence until `filter_by_confidence`, whose own threshold is 0.6."""
    with xr.open_dataset(CASES / "movement.nc", engine="h5netcdf") as data:
        points = read_points(data.load())
        assert "3 of 60 frames have a confidence below 0.6" in points.notes[0]
        assert points.rate == 240.0
        flat = data.sel(space=["x", "y"])
        refused(flat, "two coordinates only")
        refused(data.drop_vars("position"), "is no data set of movement")


def test_points_of_one_camera_are_refused():
    refused(CASES / "movement_sleap_2d.h5", "two coordinates only", "triangulate")
    refused(CASES / "deeplabcut.csv", "two coordinates only")


def test_a_film_of_angles_is_sent_on():
    refused(ROOT / "tests/cases/films/good.csv", "these are angles already", "--kinematics")


def test_the_camera_points_of_dltdv_are_refused(tmp_path):
    path = tmp_path / "xypts.csv"
    path.write_text("pt1_cam1_X,pt1_cam1_Y,pt1_cam2_X,pt1_cam2_Y\n1,2,3,4\n1,2,3,4\n")
    refused(path, "two coordinates only")


def c3d_of(path, at, rate=240.0, unit="m", size=1.0):
    import ezc3d

    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [rate]
    file["parameters"]["POINT"]["LABELS"]["value"] = tuple(at)
    file.add_parameter("POINT", "UNITS", [unit])
    file["data"]["points"] = np.stack([np.vstack([size * one.T, np.ones(len(one))]) for one in at.values()], axis=1)
    file.write(str(path))


def test_c3d_is_read_with_its_rate_unit_and_gaps(tmp_path):
    assert importlib.util.find_spec("ezc3d"), "a library of the group dev"
    at = {role: one.copy() for role, one in AT.items()}
    at["tip"][20:25] = np.nan
    c3d_of(tmp_path / "clip.c3d", at, unit="mm", size=1000.0)
    points = read_points(tmp_path / "clip.c3d")
    assert (points.rate, points.unit) == (240.0, "mm")
    assert np.isnan(points.positions["tip"]).all(axis=1).sum() == 5
    assert flap_and_pitch(tmp_path / "clip.c3d") == pytest.approx(TRUE, abs=0.05)
    (tmp_path / "cut.c3d").write_bytes((tmp_path / "clip.c3d").read_bytes()[:300])
    refused(tmp_path / "cut.c3d", "cannot read 'cut.c3d'")


def test_angles_written_as_points_to_c3d_come_back(tmp_path):
    """Points to angles to C3D to angles, each frame within 0.2 degrees."""
    first = angles_from_points(CASES / "dltdv_xyzpts.csv", "shoulder,wrist,tip", frame_rate=240.0)
    columns, plane = first.film.columns, math.radians(first.stroke_plane_deg)
    flap, sweep, pitch = (np.radians(columns[f"{name}_deg"]) for name in ("flap", "sweep", "pitch"))
    ahead, up = np.array([math.sin(plane), 0, math.cos(plane)]), np.array([-math.cos(plane), 0, math.sin(plane)])
    along = np.cos(flap)[:, None] * [0, 1, 0] + np.sin(flap)[:, None] * up
    normal = -np.sin(flap)[:, None] * [0, 1, 0] + np.cos(flap)[:, None] * up
    span = np.sin(sweep)[:, None] * ahead + np.cos(sweep)[:, None] * along
    flat = np.cos(sweep)[:, None] * ahead - np.sin(sweep)[:, None] * along
    chord = np.cos(pitch)[:, None] * flat + np.sin(pitch)[:, None] * normal
    shoulder = np.outer(first.time, [2.0, 0, 0]) + np.array([0, 0.03, 1])
    length = 0.31 * columns["span_fraction"][:, None]
    at = {"shoulder": shoulder, "tip": shoulder + length * span, "leading": shoulder + 0.1 * span + 0.05 * chord}
    c3d_of(tmp_path / "again.c3d", at)
    again = angles_from_points(tmp_path / "again.c3d").film.columns
    for name in ("flap_deg", "pitch_deg", "sweep_deg"):
        assert np.nanmax(abs(again[name] - columns[name])) < 0.2, name


def test_a_missing_ezc3d_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "ezc3d", None)
    (tmp_path / "clip.c3d").write_bytes(b"\x02\x50")
    refused(tmp_path / "clip.c3d", "ezc3d, which reads .c3d, is not installed here", "c3d")


def qualisys(gap="0.000"):
    """Return the documented form of Qualisys Track Manager's export: mm, and 0 for a marker that was not seen."""
    names = "\t".join(AT)
    lines = [f"NO_OF_FRAMES\t{len(TIME)}", "NO_OF_CAMERAS\t8", "NO_OF_MARKERS\t4", "FREQUENCY\t240"]
    lines += ["NO_OF_ANALOG\t0", "DATA_INCLUDED\t3D", f"MARKER_NAMES\t{names}"]
    for k in range(len(TIME)):
        cells = [f"{1000 * cell:.3f}" for one in AT.values() for cell in one[k]]
        if 30 <= k < 34:
            cells[6:9] = [gap] * 3
        lines.append("\t".join(cells))
    return "\n".join(lines) + "\n"


def vicon():
    """Return the documented form of Vicon Nexus' ASCII export."""
    lines = ["Trajectories", "240", ",," + ",,,".join(f"Bird:{name}" for name in AT) + ",,"]
    lines += ["Frame,Sub Frame," + ",".join(["X,Y,Z"] * 4), ",," + ",".join(["mm"] * 12)]
    for k in range(len(TIME)):
        cells = [f"{1000 * cell:.3f}" for one in AT.values() for cell in one[k]]
        lines.append(",".join([str(k + 1), "0", *cells]))
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("name", "text"), [("clip.tsv", qualisys()), ("clip.tsv", qualisys("")), ("c.csv", vicon())]
)
def test_exports_of_motion_capture_are_read(name, text, tmp_path):
    path = tmp_path / name
    path.write_text(text)
    points = read_points(path)
    assert (points.rate, points.unit, list(points.positions)) == (240.0, "mm", list(AT))
    assert flap_and_pitch(path) == pytest.approx(TRUE, abs=0.05)
    if name == "clip.tsv":
        assert np.isnan(points.positions["tip"]).all(axis=1).sum() == 4


def test_anipose_s_further_columns_are_no_points(tmp_path):
    """Anipose writes rotation M_00 .. M_22 and centre in each row; movement 0.15 refuses files without them."""
    head, *rows = (CASES / "anipose.csv").read_text().splitlines()
    more = [f"M_{i}{j}" for i in range(3) for j in range(3)] + [f"center_{i}" for i in range(3)]
    path = tmp_path / "anipose.csv"
    lines = [f"{head},{','.join(more)}", *(f"{row},1,0,0,0,1,0,0,0,1,0,0,0" for row in rows)]
    lines[5] = lines[5].replace(",1.2,4,0.97", ",1.2,1,0.97", 1)
    path.write_text("\n".join(lines))
    points = read_points(path)
    assert list(points.positions) == ["shoulder", "wrist", "tip"]
    assert "1 of 60 frames were seen by fewer than two cameras" in points.notes[0]


def mutilated(text, seed):
    """Return a text with one fault of those that files suffer, and what it is."""
    dice = random.Random(seed)
    lines = text.splitlines()
    row = dice.randrange(1, len(lines))
    sign = "\t" if "\t" in lines[-1] else ","
    kind = dice.choice(
        ["cut", "doubled", "dropped", "emptied", "letters", "merged", "exchanged", "huge", "no head"]
    )
    if kind == "cut":
        return text[: dice.randrange(len(text))], kind
    if kind == "doubled":
        lines.insert(row, lines[row])
    elif kind == "dropped":
        del lines[row]
    elif kind in ("emptied", "letters", "huge"):
        cells = lines[row].split(sign)
        cells[dice.randrange(len(cells))] = {"emptied": "", "letters": "x7", "huge": "1e30"}[kind]
        lines[row] = sign.join(cells)
    elif kind == "merged":
        cells = lines[row].split(sign)
        lines[row] = sign.join([cells[0] + cells[-1], *cells[1:-1]])
    elif kind == "exchanged":
        other = dice.randrange(1, len(lines))
        lines[row], lines[other] = lines[other], lines[row]
    else:
        lines = lines[1:]
    return "\n".join(lines) + "\n", kind


@pytest.mark.slow
@pytest.mark.parametrize("name", ["dltdv_xyzpts.csv", "anipose.csv", "opensim.trc"])
def test_mutilated_files_give_a_right_angle_a_warning_or_a_refusal(name, tmp_path):
    text, path, outcomes = (CASES / name).read_text(), tmp_path / name, {}
    for seed in range(100):
        damaged, kind = mutilated(text, seed)
        path.write_text(damaged)
        points = "shoulder,wrist,tip" if name.startswith("dltdv") else None
        try:
            told = angles_from_points(path, points, frame_rate=None if name.endswith("trc") else 240.0).record()
        except wb.WingbeatError as error:
            outcomes[kind] = str(error)
            continue
        near = abs(told["flap_mean_deg"] - 5) < 0.7 and abs(told["flap_amplitude_deg"] - 40) < 0.7
        near &= abs(told["frequency"] - 8.2) < 0.08
        assert near or told["warnings"], (seed, kind, told)
    assert "is not a coordinate" in outcomes["letters"]


def test_a_table_that_counts_frames_needs_no_flag_for_gaps_in_the_count():
    frames = np.concatenate([np.arange(40), np.arange(44, 94)]).astype(float)
    time = frames / 240
    at = points_of(BEAT, time)
    found = angles_from_points(TrackedPoints("clip", "made", at, None, frames, 240.0))
    assert found.record()["frequency"] == pytest.approx(8.2, abs=0.01)
    assert "1 times frames are missing between two rows" in found.warnings[0]


def test_a_rate_with_a_decimal_comma_or_none_is_read_as_it_is_meant(tmp_path):
    """Such rates passed the check of a number, and then `float` raised a ValueError; nan gave angles of NaN."""
    path = tmp_path / "clip.tsv"
    for text in (
        qualisys().replace("FREQUENCY\t240", "FREQUENCY\t240,0"),
        vicon().replace("\n240\n", '\n"240,0"\n'),
    ):
        path.write_text(text)
        assert read_points(path).rate == 240.0
    path.write_text((CASES / "opensim.trc").read_text().replace("240", "240,0", 1))
    assert read_points(path).rate == 240.0
    path.write_text(qualisys().replace("FREQUENCY\t240", "FREQUENCY\tnan"))
    assert read_points(path).rate is None
    path.write_text(vicon().replace("\n240\n", "\nnan\n"))
    refused(path, "is not followed by a rate")


def test_points_of_one_name_are_refused_and_two_animals_keep_their_names(tmp_path):
    """The later of two points replaced the earlier one: a wing with the tip of another bird."""
    path = tmp_path / "clip.csv"
    path.write_text((CASES / "anipose.csv").read_text().replace("wrist_", "tip_"))
    refused(path, "tip", "names more than one point", "give each point its own name")
    path.write_text(vicon().replace("Bird:shoulder", "Bird1:tip").replace("Bird:tip", "Bird2:tip"))
    assert list(read_points(path).positions) == ["Bird1:tip", "Bird:wrist", "Bird2:tip", "Bird:trailing"]
    path.write_text(vicon().replace("Bird:shoulder", "Bird:tip"))
    refused(path, "= 'tip': names more than one point")
    c3d_of(
        tmp_path / "clip.c3d", {"Bird1:tip": AT["tip"], "Bird2:tip": AT["wrist"], "Bird1:shoulder": AT["shoulder"]}
    )
    assert list(read_points(tmp_path / "clip.c3d").positions) == ["Bird1:tip", "Bird2:tip", "Bird1:shoulder"]
    with xr.open_dataset(CASES / "movement.nc", engine="h5netcdf") as data:
        names = ["tip", "tip", *data["keypoints"].values[2:]]
        refused(data.load().assign_coords(keypoints=names), "names more than one point")
