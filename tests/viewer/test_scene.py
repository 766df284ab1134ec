"""What is handed to the viewer, and what is refused."""

import base64
import json

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat.errors import FileError, InvalidInputError
from wingbeat.viewer.scene import MOST_SAMPLES, scene, strip_loads


def unpacked(packed):
    return np.frombuffer(base64.b64decode(packed["data"]), dtype=f"<{packed['kind']}")


@pytest.fixture(scope="module")
def pigeon_model():
    pigeon = wb.load_species("pigeon")
    return pigeon, wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))


def test_arrays_are_those_of_the_data_set(bats):
    data = bats["su-fan"].dataset
    shown = scene([("bat", data)])["flights"][0]
    arrays = {name: unpacked(packed) for name, packed in shown["arrays"].items()}
    place = np.stack([arrays["x"], 0 * arrays["x"], arrays["z"]], axis=-1)
    corners = arrays["corners"].reshape(data["strip_corner"].shape) + place[:, None, None]
    np.testing.assert_allclose(corners, data["strip_corner"], rtol=0, atol=1e-7)
    weight = bats["su-fan"].problem.species.vehicle.mass * 9.81
    assert shown["weight"] == pytest.approx(weight, rel=1e-12)
    # The mean load carries the weight.
    assert abs(np.trapezoid(arrays["force_z"], arrays["phase"]) / shown["weight"] - 1) < 1e-3
    assert shown["downstrokes"] == [[0.0, 0.5]]
    assert shown["periodic"]
    assert shown["strips"] == 10
    json.dumps(scene([("bat", data)]), allow_nan=False)


def test_the_series_are_all_those_along_the_beat_each_held_once(bats):
    data = bats["su-fan"].dataset
    shown = scene([("bat", data)])
    arrays, series = shown["flights"][0]["arrays"], {one["name"]: one for one in shown["series"]}
    along = {name for name, values in data.data_vars.items() if values.dims == ("phase",)}
    assert along <= set(series)
    assert set(series) - along == {"thrust", "support", "alpha_arm", "alpha_hand"}
    assert {one["array"] for one in series.values()} <= set(arrays)
    for name in along:
        np.testing.assert_allclose(unpacked(arrays[name]), data[name], rtol=1e-6, atol=1e-9)
    assert (series["flap"]["unit"], series["flap"]["scale"]) == ("deg", pytest.approx(180 / np.pi))
    assert (series["hinge_power"]["label"], series["hinge_power"]["unit"]) == ("hinge power, both wings", "W")
    assert {name for panel in shown["panels"] for name in panel} <= set(series)


@pytest.mark.parametrize("model", ["su-fan", "dickinson"])
def test_lift_and_drag_vectors_have_their_sizes_and_right_angles(bats, model):
    data = bats[model].dataset
    lift, drag = strip_loads(data)
    np.testing.assert_allclose(np.linalg.norm(drag, axis=-1), np.abs(data["drag"]), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(lift, axis=-1), np.abs(data["lift"]), rtol=1e-9, atol=1e-12)
    assert np.abs(np.sum(lift * drag, axis=-1)).max() < 1e-12
    # Drag takes power from the strip wherever its coefficient is positive, and lift none.
    power = np.sum(lift * data["strip_velocity"].values, axis=-1)
    assert np.abs(power).max() < 1e-10


def test_a_simulated_flight_is_shown_as_far_as_it_was_flown(pigeon_model):
    pigeon, model = pigeon_model
    data = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=3, samples=32).dataset
    whole = scene([("flight", data)])["flights"][0]
    assert not whole["periodic"]
    assert [round(end, 9) for _, end in whole["downstrokes"]] == [0.5, 1.5, 2.5]
    cut = data.copy(deep=True)
    cut["u"][40:] = np.nan
    assert unpacked(scene([("flight", cut)])["flights"][0]["arrays"]["phase"])[-1] == data["phase"].values[39]


def test_no_flight_too_many_and_too_long_are_refused(bats, pigeon_model):
    data = bats["su-fan"].dataset
    for flights in ([], [("bat", data)] * 3):
        with pytest.raises(InvalidInputError, match="give one, or two to compare"):
            scene(flights)
    pigeon, model = pigeon_model
    long = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1, samples=64).dataset
    long = xr.concat([long] * (MOST_SAMPLES // 65 + 1), "phase", data_vars="minimal", coords="minimal")
    with pytest.raises(InvalidInputError, match="simulate fewer beats"):
        scene([("long", long)])


def test_what_holds_no_flight_is_refused(bats):
    data = bats["su-fan"].dataset
    for other in (xr.Dataset(), data.drop_vars("strip_corner")):
        with pytest.raises(FileError, match="cannot show 'other'"):
            scene([("other", other)])
    fallen = data.copy(deep=True)
    fallen["u"][:] = np.nan
    with pytest.raises(FileError, match="fewer than two samples before the vehicle tumbled"):
        scene([("other", fallen)])
