"""What is handed to the viewer, and what is refused."""

import base64
import dataclasses
import json

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat._base import FileError, InvalidInputError
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


def mean_chord(shape):
    chord = np.add(shape["leading"], shape["trailing"])
    return np.trapezoid(chord, dx=1 / (len(chord) - 1))


def test_the_shape_of_the_species_is_shown_in_metres(bats, pigeon_model):
    pigeon, model = pigeon_model
    flown = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), samples=16, species=pigeon)
    bat = bats["su-fan"]
    for data, species in ((bat.dataset, bat.problem.species), (flown.dataset, pigeon)):
        shown, own = scene([("one", data)])["flights"][0]["shape"], species.shape
        chord = species.vehicle.wing.mean_chord
        assert (shown["kind"], shown["cover"], shown["schematic"]) == (species.kind, own.cover, True)
        np.testing.assert_allclose(shown["leading"], chord * np.array(own.leading_edge), rtol=1e-12)
        np.testing.assert_allclose(shown["trailing"], chord * np.array(own.trailing_edge), rtol=1e-12)
        assert mean_chord(shown) == pytest.approx(chord, rel=2e-3)
        assert (shown["camber"], shown["thickness"]) == (own.camber, own.thickness)
        assert shown["wrist"] == species.wingbeat.wrist
        body = {name: getattr(own, f"body_{name}") for name in ("length", "width", "depth")}
        body |= {n: getattr(own, n) for n in ("head_length", "bill_length", "ear_length")}
        assert shown["body"] == body | {"tail_length": own.tail_length, "tail_width": own.tail_width}
        assert shown["colours"] == own.colours


def test_a_shape_without_a_guess_is_not_schematic(pigeon_model):
    pigeon, model = pigeon_model
    measured = dataclasses.replace(pigeon.shape, numbers={})
    species = dataclasses.replace(pigeon, shape=measured)
    data = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), samples=16, species=species).dataset
    assert not scene([("flight", data)])["flights"][0]["shape"]["schematic"]


@pytest.mark.parametrize("kind", ["bird", "bat", "robot", ""])
def test_a_species_without_a_shape_gets_a_schematic_one_of_its_kind_and_size(kind):
    size = {"mass": 0.3, "wing_span": 0.7, "wing_area": 0.08}
    species = dataclasses.replace(getattr(wb, kind or "bird")(**size), kind=kind)
    data = flight_of(species)
    shown = scene([("flight", data)])["flights"][0]["shape"]
    assert shown["schematic"]
    assert shown["kind"] == (kind or "bird")
    assert shown["cover"] == {"bat": "membrane", "robot": "film"}.get(kind, "feathers")
    assert mean_chord(shown) == pytest.approx(species.vehicle.wing.mean_chord, rel=1e-9)
    assert shown["leading"][-1] == shown["trailing"][-1] == 0
    assert shown["body"]["length"] > shown["body"]["width"] > 0
    whole = scene([("bat", flight_of(wb.load_species("bat")))])["flights"][0]["shape"]
    assert shown.keys() == whole.keys()
    assert shown["body"].keys() == whole["body"].keys()


@pytest.mark.slow
def test_a_schematic_bird_has_the_chords_and_the_tail_of_its_vehicle():
    species = wb.bird(mass=0.3, wing_span=0.7, wing_area=0.08, tail=True, chord=[0.12, 0.1, 0.05])
    shown = scene([("flight", flight_of(species))])["flights"][0]["shape"]
    chord = np.add(shown["leading"], shown["trailing"])
    np.testing.assert_allclose(chord[[0, 10, 20]], [0.12, 0.1, 0.05])
    np.testing.assert_allclose(shown["leading"], 0.25 * chord)
    assert tail_area(shown) == pytest.approx(species.vehicle.tail.area)


def tail_area(shown):
    return 0.5 * shown["body"]["tail_length"] * shown["body"]["tail_width"]


def test_a_tail_that_was_added_to_the_vehicle_is_drawn():
    tail = {"tail.area": 0.01, "tail.arm": 0.2, "tail.lift_slope": 3.0}
    robot = wb.load_species("robofalcon2")
    bare, tailed = (scene([("one", flight_of(s))])["flights"][0] for s in (robot, robot.with_values(tail)))
    assert tail_area(bare["shape"]) == 0
    assert tail_area(tailed["shape"]) == pytest.approx(0.01)
    pigeon = wb.load_species("pigeon").with_tail()  # its own tail has a length of its own
    shown = scene([("one", flight_of(pigeon))])["flights"][0]["shape"]
    assert shown["body"]["tail_length"] == pigeon.shape.tail_length


def test_files_of_versions_without_shapes_are_shown(bats, pigeon_model):
    pigeon, model = pigeon_model
    old = bats["su-fan"].dataset.copy()
    del old.attrs["shape"]
    shown = scene([("bat", old)])["flights"][0]["shape"]
    assert (shown["kind"], shown["cover"], shown["schematic"]) == ("bat", "membrane", True)
    flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), samples=16).dataset
    assert scene([("flight", flight)])["flights"][0]["shape"]["kind"] == "bird"


@pytest.mark.slow
def test_a_saved_orbit_flies_with_its_own_look_and_so_do_its_pushes(bats, tmp_path):
    bats["su-fan"].save(tmp_path / "bat.nc")
    again = wb.load_orbit(tmp_path / "bat.nc")
    own = scene([("bat", bats["su-fan"].dataset)])["flights"][0]["shape"]
    assert scene([("bat", again.dataset)])["flights"][0]["shape"] == own
    assert again.problem.species.shape == bats["su-fan"].problem.species.shape
    pushed = scene([("bat", again.dataset)], wb.fly_pushes(again, delay=None))["pushes"]
    assert all(push["scene"]["flights"][0]["shape"] == own for push in pushed)


def flight_of(species):
    model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    return wb.simulate(model, species.wingbeat, wb.State(u=10.0), samples=16, species=species).dataset
