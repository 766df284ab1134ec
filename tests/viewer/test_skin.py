"""The animal's skin: it moves exactly as the strips do, and its outline is that of the species."""

import io
import json

import numpy as np
import pytest
from PIL import Image

import wingbeat as wb

VIEWER = "document.querySelector('.wb-viewer').viewer"
SKINS = f"{VIEWER}.stage.animals[0].wings.skins"
CENTRES = (np.arange(10) + 0.5) / 10
MIRROR = np.array([1.0, -1.0, 1.0])


def skin_points(page, phase, points):
    """Stop at a phase; where are these points of the left wing, (span fraction, metres ahead), in the world?"""
    wanted = json.dumps([[float(value) for value in point] for point in points])
    return np.array(page.evaluate(f"({VIEWER}.pause(), {VIEWER}.set({phase}), {VIEWER}.skinPoints({wanted}))"))


def vertices(page, phase, part=0, side=0):
    """Return the points of a wing's skin about the body's centre of mass, shape (points, 3) [m]."""
    mesh = f"{SKINS}[{part}].skin.meshes[{side}].geometry.attributes.position.array"
    return np.array(page.evaluate(f"({VIEWER}.pause(), {VIEWER}.set({phase}), Array.from({mesh}))")).reshape(-1, 3)


def edges(shape, eta):
    """Return metres to the leading and trailing edge, ahead of and behind the pitch axis."""
    return (np.interp(eta, np.linspace(0, 1, len(shape[name])), shape[name]) for name in ("leading", "trailing"))


def scene_of(name):
    """A scene of one beat from a start that nobody trimmed: enough to look at."""
    species = wb.load_species(name)
    model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    flight = wb.simulate(model, species.wingbeat, wb.State(u=10.0), beats=1, samples=64, species=species)
    return species, flight.dataset, wb.viewer.scene([(name, flight.dataset)])


@pytest.fixture(scope="module")
def pigeon():
    return scene_of("pigeon")


@pytest.fixture
def page_of_pigeon(show, page_of_one, pigeon):
    page = show(page_of_one).page
    page.evaluate(f"(scene) => {VIEWER}.replace(scene)", pigeon[2])
    return page


def test_the_pitch_axis_goes_through_the_strips_of_the_data_set(show, page_of_one, bats):
    page, data = show(page_of_one).page, bats["su-fan"].dataset
    for index in (0, 64, 100, 192, 256):  # folded and retracted in the upstroke
        found = skin_points(page, float(data["phase"][index]), [(eta, 0.0) for eta in CENTRES])
        np.testing.assert_allclose(found, data["strip_position"].values[index], rtol=0, atol=1e-6)


def test_at_mid_downstroke_the_outline_is_the_planform(page_of_pigeon, pigeon):
    species, data, scene = pigeon
    wing, shape = species.vehicle.wing, scene["flights"][0]["shape"]
    index = int(np.argmin(np.abs(data["phase"].values - 0.25)))
    origin = np.array([float(data["x"][index]), 0.0, float(data["z"][index])])
    corner = data["strip_corner"].values[index]
    chordwise = corner[:, 0] - corner[:, 3]
    chordwise /= np.linalg.norm(chordwise, axis=-1, keepdims=True)
    axis = data["strip_position"].values[index]
    leading, trailing = edges(shape, CENTRES)
    for ahead in (leading, -trailing):
        found = skin_points(page_of_pigeon, 0.25, np.stack([CENTRES, ahead], axis=-1))
        np.testing.assert_allclose(found, axis + ahead[:, None] * chordwise, rtol=0, atol=1e-6)
    # The tip of the axis is a semi-span from the shoulder, and the skin's last point lies there, on the outline.
    root, tip = skin_points(page_of_pigeon, 0.25, [(0, 0.0), (1, 0.0)])
    assert np.linalg.norm(tip - root) == pytest.approx(wing.semi_span, abs=1e-6)
    end = tip + shape["leading"][-1] * chordwise[-1] - origin
    assert np.linalg.norm(vertices(page_of_pigeon, 0.25) - end, axis=-1).min() < 1e-6


def test_feather_tips_lie_on_the_outline_and_no_feather_leaves_it(page_of_pigeon, pigeon):
    shape = pigeon[2]["flights"][0]["shape"]
    semi_span = pigeon[0].vehicle.wing.semi_span
    # The pigeon's wing is not twisted, so that at mid-downstroke it has one frame.
    found = vertices(page_of_pigeon, 0.25)
    root, tip, fore = skin_points(page_of_pigeon, 0.25, [(0, 0.0), (1, 0.0), (0, 1.0)])
    body = root - np.array(page_of_pigeon.evaluate(f"{VIEWER}.stage.animals[0].still.position.toArray()"))
    along, chordwise = (tip - root) / semi_span, fore - root
    eta, ahead = (found - body) @ along / semi_span, (found - body) @ chordwise
    leading, trailing = edges(shape, eta)
    on_the_wing = (eta >= 0) & (eta <= 1)
    slack = 0.02 * semi_span  # of a rounded vane between two tips
    assert (ahead[on_the_wing] <= leading[on_the_wing] + slack).all()
    assert (ahead[on_the_wing] >= -trailing[on_the_wing] - slack).all()
    tips = on_the_wing & (np.abs(ahead + trailing) < 1e-6)
    assert len(np.unique(np.round(eta[tips], 4))) >= 20


def test_feathers_keep_their_width_where_the_span_is_retracted(page_of_pigeon):
    rows, vane = 7 * 20, slice(0, 3 * 7 * 20)
    out, back = (vertices(page_of_pigeon, phase)[vane].reshape(rows, 3, 3) for phase in (0.25, 0.75))
    widths = [np.linalg.norm(one[:, 0] - one[:, 2], axis=-1) for one in (out, back)]
    np.testing.assert_allclose(widths[1], widths[0], rtol=0, atol=1e-6)
    assert widths[0].max() > 0.01
    tips = [one.reshape(20, 7, 3, 3)[:, -1, 1] for one in (out, back)]
    apart = [np.linalg.norm(np.diff(one, axis=0), axis=-1)[3:].mean() for one in tips]
    assert apart[1] < 0.85 * apart[0]


def test_the_right_wing_is_the_mirror_image_of_the_left(show, page_of_one):
    page = show(page_of_one).page
    for part in (0, 1):  # membrane, and bones
        left, right = (vertices(page, 0.4, part, side) for side in (0, 1))
        np.testing.assert_allclose(right, left * MIRROR, rtol=0, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "parts"), [("common-swift", 1), ("annas-hummingbird", 1), ("robofalcon2", 2)])
def test_other_animals_are_drawn_without_complaint(show, page_of_one, name, parts):
    shown = show(page_of_one)
    scene = scene_of(name)[2]
    shown.page.evaluate(f"(scene) => {VIEWER}.replace(scene)", scene)
    assert shown.page.evaluate(f"{SKINS}.length") == parts
    for part in range(parts):
        assert np.isfinite(vertices(shown.page, 0.6, part)).all()
    finite = "(part) => part.geometry.attributes.position.array.every(Number.isFinite)"
    assert shown.page.evaluate(f"{VIEWER}.stage.animals[0].body.group.children.every({finite})") is True
    assert shown.complaints == []


@pytest.mark.slow
def test_strips_are_hidden_until_one_asks_for_them(show, page_of_one):
    page = show(page_of_one).page
    strips = f"{VIEWER}.stage.animals[0].strips.left.mesh.visible"
    skin = f"{SKINS}[0].skin.meshes[0].material.opacity"
    assert page.evaluate(strips) is False
    assert "angle of attack" not in page.locator(".wb-scale").inner_text()
    before = page.evaluate(skin)
    page.get_by_label("Strips").select_option("alpha")
    assert page.evaluate(strips) is True
    assert page.evaluate(skin) < 0.5 * before  # the strips are seen through it
    assert "effective angle of attack [deg]" in page.locator(".wb-scale").inner_text()
    page.get_by_label("Strips").select_option("off")
    assert page.evaluate(strips) is False
    assert page.evaluate(skin) == before


def test_the_legend_says_where_the_shape_is_schematic(show, page_of_one, pigeon):
    page = show(page_of_one).page
    for schematic in (True, False):
        scene = json.loads(json.dumps(pigeon[2]))
        scene["flights"][0]["shape"]["schematic"] = schematic
        page.evaluate(f"(scene) => {VIEWER}.replace(scene)", scene)
        assert ("schematic" in page.locator(".wb-scale").inner_text()) is schematic


@pytest.mark.slow
def test_the_first_animal_casts_a_shadow_and_a_ghost_does_not(show, page_of_two):
    page = show(page_of_two).page
    casting = (
        f"{VIEWER}.stage.animals.map((animal) => {{ let n = 0; animal.group.traverse((node) => {{"
        " if (node.isMesh && (node.layers.mask & 2)) n += 1; }); return n; })"
    )
    solid, ghost = page.evaluate(casting)
    assert solid == 3  # body, and the outline of both wings
    assert ghost == 0
    page.get_by_label("Two flights").select_option("beside")
    first, second = page.evaluate(casting)
    assert first == second == solid
    # Without the shadow the ground is lighter.
    page.evaluate(f"({VIEWER}.pause(), {VIEWER}.setCamera('oblique'), {VIEWER}.set(0.2))")
    dark = []
    for visible in ("true", "false"):
        page.evaluate(f"({VIEWER}.stage.shadow.ground.visible = {visible}, {VIEWER}.stage.draw())")
        page.wait_for_timeout(500)
        dark.append(page.locator(".wb-canvas").screenshot())
    assert brightness(dark[0]) < brightness(dark[1]) - 0.5


def brightness(png):
    """Return the mean grey of a picture, 0 to 255."""
    return float(np.asarray(Image.open(io.BytesIO(png)).convert("L"), dtype=float).mean())
