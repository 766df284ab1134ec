"""The air around the animal: trails, the scale of the arrows, the ground and the sketch of the wake."""

import json
import time

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.browsers import until
from tests.viewer.test_browser import VIEWER
from wingbeat.viewer.scene import wake_of

ANIMAL = f"{VIEWER}.stage.animals[0]"
GROUND = f"{VIEWER}.stage.ground"


@pytest.fixture
def bat(bats):
    return bats["su-fan"].dataset


@pytest.fixture(scope="module")
def in_induced_flow(bats):
    """The bat's orbit as if its record named induced flow; what the page reads of it is the record alone."""
    found = bats["su-fan"].dataset.copy(deep=True)
    found.attrs["aero"] = json.dumps(
        json.loads(found.attrs["aero"]) | {"inflow": "momentum", "induced_factor": 1.2}
    )
    return found


def ribbon_of(page, ribbon, attribute="position"):
    """Return one vertex of each pair across a ribbon."""
    values = page.evaluate(f"Array.from({ribbon}.mesh.geometry.getAttribute('{attribute}').array)")
    return np.array(values)


@pytest.mark.slow
@pytest.mark.parametrize(("side", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_trail_is_the_path_of_the_tip(show, page_of_one, bat, side, sign):
    page = show(page_of_one).page
    corner = bat["strip_corner"].values[:, -1]
    path = (0.75 * corner[:, 1] + 0.25 * corner[:, 2]) * [1.0, sign, 1.0]
    x, z = bat["x"].values, bat["z"].values
    before = path - [x[-1] - x[0], 0.0, z[-1] - z[0]]
    drawn = ribbon_of(page, f"{ANIMAL}.trails.{side}").reshape(-1, 2, 3)
    assert (drawn[:, 0] == drawn[:, 1]).all()  # both edges start from the path
    np.testing.assert_allclose(drawn[:, 0], np.concatenate([before, path[1:]]), rtol=0, atol=1e-6)


@pytest.mark.slow
def test_a_trail_is_drawn_for_the_last_beat_and_coloured_by_the_force_near_the_tip(show, page_of_one, bat):
    page = show(page_of_one).page
    page.evaluate(f"{VIEWER}.set(0.5)")
    first, count = page.evaluate(f"Object.values({ANIMAL}.trails.left.mesh.geometry.drawRange)")
    shed = ribbon_of(page, f"{ANIMAL}.trails.left", "shed")[::2]
    step = shed[1] - shed[0]
    assert shed[first // 6] == pytest.approx(-0.5, abs=2 * step)
    assert shed[(first + count) // 6] == pytest.approx(0.5, abs=2 * step)
    force = np.linalg.norm(bat["strip_force"].values[:, -2:].sum(axis=1), axis=-1)
    legend = page.locator(".wb-measures").inner_text()
    assert "trails: force on 2 outer strips [N]" in legend
    assert f"{force.max():.3g}" in legend
    shades = ribbon_of(page, f"{ANIMAL}.trails.left", "shade").reshape(-1, 2, 3)[-len(force) :, 0]
    np.testing.assert_allclose(shades[force.argmax()], [0.98, 0.66, 0.15], rtol=0, atol=1e-6)
    # From much to little, blue takes the place of yellow.
    yellowness = shades[:, 0] - shades[:, 2]
    assert np.corrcoef(yellowness, force)[0, 1] > 0.95


def projected(page, points):
    """Return where points of the picture's space lie in it, in pixels of the page."""
    camera = f"{VIEWER}.stage.camera"
    view, picture = (
        np.array(page.evaluate(f"{camera}.{name}.elements")).reshape(4, 4).T
        for name in ("matrixWorldInverse", "projectionMatrix")
    )
    size = page.evaluate(
        f"(({VIEWER}.canvas.clientWidth), [{VIEWER}.canvas.clientWidth, {VIEWER}.canvas.clientHeight])"
    )
    seen = np.column_stack([points, np.ones(len(points))]) @ (picture @ view).T
    return seen[:, :2] / seen[:, 3:] * np.array(size) / 2, view


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1280])
@pytest.mark.parametrize("camera", ["oblique", "top"])
def test_the_scale_bar_is_as_long_as_the_arrow_of_its_force(show, page_of_one, bat, width, camera):
    page = show(page_of_one, width=width).page
    page.evaluate(f"{VIEWER}.setCamera('{camera}')")
    until(page, f"{VIEWER}.stage.due === undefined")
    force, scale = page.evaluate(f"[{VIEWER}.measures.bar.force, {VIEWER}.look.scale]")
    target = np.array(page.evaluate(f"{VIEWER}.stage.controls.target.toArray()"))
    _, view = projected(page, target[None])
    right = view[0, :3]
    (start, end), _ = projected(page, np.stack([target, target + force * scale * right]))
    bar = page.locator(".wb-bar-line").bounding_box()["width"]
    assert bar == pytest.approx(np.linalg.norm(end - start), abs=0.1)
    assert 40 < bar <= 111
    weight = 9.81 * wb.load_species("bat").vehicle.mass
    text = page.locator(".wb-force-bar").inner_text()
    assert f"force {force:g} N ({force / weight:.2g} × weight)" in text


@pytest.mark.slow
def test_without_arrows_there_is_no_scale_bar(show, page_of_one):
    page = show(page_of_one).page
    page.locator(".wb-force-bar").wait_for()
    page.get_by_label("resultant", exact=True).uncheck()
    page.locator(".wb-force-bar").wait_for(state="hidden")


@pytest.mark.slow
def test_the_ground_passes_at_the_speed_of_the_flight_from_beat_to_beat(show, page_of_one, bat):
    page = show(page_of_one, reduced_motion="no-preference").page
    page.evaluate(f"{VIEWER}.pause()")
    frequency = json.loads(bat.attrs["wingbeat"])["frequency"]
    start = page.evaluate(f"({VIEWER}.look.laps = 0, {VIEWER}.set(0), {GROUND}.passed)")
    for phase in (0.2, 0.75, 1.0):
        passed = page.evaluate(f"({VIEWER}.set({phase}), {GROUND}.passed)") - start
        assert passed == pytest.approx(8.0 * phase / frequency, abs=1e-5)
    page.evaluate(f"({VIEWER}.set(0.9), {VIEWER}.rate = 1, {VIEWER}.play())")
    until = time.monotonic() + 60
    while page.evaluate(f"{VIEWER}.look.laps") < 2:
        assert time.monotonic() < until, "no beat comes to its end"
        page.wait_for_timeout(20)
    page.evaluate(f"{VIEWER}.pause()")
    laps, phase, passed = page.evaluate(f"[{VIEWER}.look.laps, {VIEWER}.phase, {GROUND}.passed]")
    assert passed - start == pytest.approx(8.0 * (laps + phase) / frequency, abs=1e-4)
    cell, reach = 0.1, 24
    shown = page.evaluate(f"{GROUND}.lines.material.uniforms.passed.value * {GROUND}.cell")
    assert page.evaluate(f"{GROUND}.cell") == cell
    assert shown == pytest.approx(passed % (2 * reach * cell), abs=1e-6)
    assert f"squares of {cell} m" in page.locator(".wb-measures").inner_text()


@pytest.mark.slow
def test_the_ground_stands_where_less_motion_is_asked_for(show, page_of_one):
    page = show(page_of_one).page
    assert page.evaluate(f"({VIEWER}.set(0.2), {GROUND}.passed)") == 0
    assert page.evaluate(f"({VIEWER}.set(0.7), {GROUND}.passed)") == 0


@pytest.mark.slow
def test_trails_and_ground_can_be_left_out(show, page_of_one):
    page = show(page_of_one).page
    parts = f"[{ANIMAL}.trails.group.visible, {GROUND}.group.visible]"
    assert page.evaluate(parts) == [True, True]
    page.get_by_label("trails", exact=True).uncheck()
    page.get_by_label("ground", exact=True).uncheck()
    assert page.evaluate(parts) == [False, False]
    legend = page.locator(".wb-measures").inner_text()
    assert "trails" not in legend
    assert "squares" not in legend


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_sky_is_above_the_horizon_and_the_ground_below(show, page_of_one, theme):
    page = show(page_of_one, color_scheme=theme).page
    page.get_by_label("trails", exact=True).uncheck()
    page.evaluate(f"{VIEWER}.setCamera('side')")
    # Along the left edge of the picture nothing flies.
    colours = page.evaluate(
        f"""(() => {{
          const stage = {VIEWER}.stage;
          stage.renderer.render(stage.scene, stage.camera);
          const gl = stage.renderer.getContext();
          const column = new Uint8Array(4 * gl.drawingBufferHeight);
          gl.readPixels(1, 0, 1, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, column);
          return Array.from(column);
        }})()"""
    )
    column = np.array(colours).reshape(-1, 4)[:, :3].astype(float)
    blueness = column[:, 2] - column[:, 0]
    middle = len(column) // 2
    assert (blueness[middle + 8 :] > blueness[: middle - 8].max()).mean() > 0.95
    jump = np.abs(np.diff(column.sum(axis=1)))[middle - 4 : middle + 4].max()
    assert jump > 8  # the horizon is at the height of the eye


def test_the_velocity_of_the_wake_is_the_induced_flow_of_the_model(bats, in_induced_flow):
    assert wake_of(bats["su-fan"].dataset) is None
    vehicle = bats["su-fan"].problem.species.vehicle
    aero = wb.aero.BladeElement(wb.aero.SuFan(), inflow="momentum")
    model = wb.FlightModel(vehicle, aero, velocity=(8.0, 0.0))
    assert wake_of(in_induced_flow)["induced"] == pytest.approx(model.induced_flow, rel=1e-12)
    assert wake_of(in_induced_flow)["induced"][1] < 0


@pytest.mark.slow
def test_a_wake_is_offered_only_where_the_flight_has_one(show, page_of_one, in_induced_flow, tmp_path):
    label = "wake (a sketch, not computed)"
    page = show(page_of_one).page
    assert page.get_by_label(label).is_hidden()
    assert page.evaluate(f"{ANIMAL}.wake.ribbons.length") == 0
    wb.viewer.write_page([("bat", in_induced_flow)], tmp_path / "wake.html")
    page = show(tmp_path / "wake.html").page
    box = page.get_by_label(label)
    assert box.is_visible()
    assert not box.is_checked()
    assert page.evaluate(f"{ANIMAL}.wake.group.visible") is False
    box.check()
    assert page.evaluate(f"{ANIMAL}.wake.group.visible") is True
    assert "wake: a sketch, not computed" in page.locator(".wb-measures").inner_text()
    frequency = json.loads(in_induced_flow.attrs["wingbeat"])["frequency"]
    forward, up = wake_of(in_induced_flow)["induced"]
    drift = page.evaluate(f"{ANIMAL}.wake.ribbons.map((each) => each.mesh.material.uniforms.drift.value.toArray())")
    np.testing.assert_allclose(
        drift, [[forward / frequency, 0.0, up / frequency]] * len(drift), rtol=1e-6, atol=1e-12
    )
    # It begins at the wing tips, and at every end of a downstroke a ribbon leaves the wings.
    path = ribbon_of(page, f"{ANIMAL}.wake.ribbons[0]").reshape(-1, 2, 3)[-257:, 0]
    corner = in_induced_flow["strip_corner"].values[:, -1]
    np.testing.assert_allclose(path, 0.75 * corner[:, 1] + 0.25 * corner[:, 2], rtol=0, atol=1e-6)
    assert len(drift) == 2 + 2 * 4
