"""C3D files, read back by the library of their format."""

import sys

import numpy as np
import pytest

import wingbeat as wb

ezc3d = pytest.importorskip("ezc3d")

SAMPLES = 48
SINGLE = 2e-7  # of a number in single precision


def turned(vector, angle):
    """Turn a vector of body axes nose up."""
    x, y, z = vector
    return np.stack(
        [np.cos(angle) * x - np.sin(angle) * z, np.full_like(angle, y), np.sin(angle) * x + np.cos(angle) * z], -1
    )


@pytest.mark.slow
def test_points_are_those_of_the_orbit(orbit, tmp_path):
    wb.export(orbit, tmp_path / "gait.c3d", samples=SAMPLES)
    file = ezc3d.c3d(str(tmp_path / "gait.c3d"))
    about, found = file["parameters"]["POINT"], file["data"]["points"]
    series = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, samples=SAMPLES).dataset
    series = series.isel(phase=slice(0, SAMPLES))
    strips, reach = series.sizes["station"], np.abs(found[:3]).max()
    assert about["UNITS"]["value"] == ["m"]
    assert about["RATE"]["value"][0] == pytest.approx(SAMPLES * orbit.wingbeat.frequency, rel=SINGLE)
    assert found.shape == (4, 5 + 4 * strips, SAMPLES)
    labels = about["LABELS"]["value"]
    assert len(set(labels)) == found.shape[1]
    points = {label: found[:3, i].T for i, label in enumerate(labels)}

    def same(label, wanted):
        np.testing.assert_allclose(points[label], wanted, rtol=0, atol=2 * SINGLE * reach, err_msg=label)

    body = np.stack([series["x"], 0 * series["x"], series["z"]], axis=-1)
    same("body", body)
    wing, pitch = orbit.problem.vehicle.wing, series["body_pitch"].values
    same("left_shoulder", body + turned(wing.shoulder, pitch))
    corner = series["strip_corner"].values
    for i in range(strips):
        same(f"left_leading_{i + 1}", corner[:, i, :2].mean(axis=1))
        same(f"left_trailing_{i + 1}", corner[:, i, 2:].mean(axis=1))
    leading, trailing = corner[:, -1, 1], corner[:, -1, 2]
    if orbit.wingbeat.twist_ratio == 1.0 and not orbit.wingbeat.twist_mean:
        tapered = wing.chord if isinstance(wing.chord, float) else None
        quarter = 0.75 * leading + 0.25 * trailing
        assert np.abs(points["left_tip"] - quarter).max() < (
            2 * SINGLE * reach if tapered else 0.1 * wing.semi_span
        )
    for label in labels:
        if label.startswith("left"):
            same(label.replace("left", "right"), points[label] * [1.0, -1.0, 1.0])


def test_without_the_library_the_extra_is_named(rigid_orbit, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezc3d", None)
    with pytest.raises(wb.FileError, match=r"ezc3d, which writes \.c3d, is not installed here: .*--extra c3d"):
        wb.export(rigid_orbit, tmp_path / "gait.c3d")
    assert not list(tmp_path.iterdir())
