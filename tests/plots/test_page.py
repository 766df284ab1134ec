"""The page of a wingbeat: what is on it, that it can be read, and how figures are saved."""

import dataclasses
import itertools
import json
import re

import numpy as np
import pytest
from matplotlib import rcParams
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.image import imread

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat._base.style import ALARM
from wingbeat.plots import save_figure, wingbeat_page

TIME_PANELS = (0, 1, 2, 6, 7, 8)
SIGNATURES = {"png": b"\x89PNG\r\n\x1a\n", "pdf": b"%PDF-", "svg": b"<?xml"}


@pytest.fixture(scope="module")
def orbit():
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)


@pytest.fixture(scope="module")
def page(orbit):
    return wingbeat_page(orbit.dataset)


@pytest.fixture(scope="module")
def flight(orbit):
    """Four beats of the bat, whose hand folds, from a start that it does not keep."""
    bat = wb.load_species("bat")
    model = wb.FlightModel(bat.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    return wb.simulate(model, bat.wingbeat, wb.State(u=4.0), beats=4, samples=64).dataset


def uncertified(dataset):
    words = "at the nearest one the forward speed does not return; widen the bounds, change the speed; "
    return dataset.assign_attrs(status="infeasible", message=3 * words + "or lighten the vehicle")


def tumbled(dataset, reached):
    """Return the flight with everything lost from one sample on, except what is prescribed."""
    lost = dataset.copy(deep=True)
    for name in lost.data_vars:
        if name not in ("flap", "flap_rate", "wing_pitch", "wing_pitch_rate", "fold", "span_ratio", "time"):
            lost[name].values[reached:] = np.nan
    return lost


def scaled(dataset, factor):
    """Return a dataset whose places, speeds and powers have other sizes, for the widths of their labels."""
    names = ("x", "z", "u", "w", "pitch_rate", "hinge_power", "actuator_power", "strip_force")
    return dataset.assign({name: dataset[name] * factor for name in names})


def texts_of(figure):
    """Return every text that is printed with its box in dots."""
    figure.draw_without_rendering()
    found = list(figure.texts)
    for axes in figure.axes:
        found += [axes.xaxis.label, axes.yaxis.label, *axes.texts]
        found += axes.get_legend().get_texts() if axes.get_legend() else []
        for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
            ticks = zip(axis.get_majorticklocs(), axis.get_majorticklabels(), strict=True)
            # matplotlib keeps labels beyond the limits but does not print them
            found += [label for place, label in ticks if min(limits) <= place <= max(limits)]
            found.append(axis.get_offset_text())
    hidden = [axes.xaxis for axes in figure.axes if not axes.xaxis.get_visible()]  # of the twin
    found = [text for text in found if not any(text in axis.findobj() for axis in hidden)]
    visible = [text for text in found if text.get_visible() and text.get_text()]
    return [(text.get_text(), text.get_window_extent()) for text in visible]


def panels(figure):
    return [axes for axes in figure.axes if axes.texts]  # each panel carries its letter, the twin does not


def test_panels_have_letters_and_units(page):
    assert [axes.texts[0].get_text() for axes in panels(page)] == list("abcdefghi")
    for axes in panels(page):
        assert re.search(r"\[.+\]$", axes.get_xlabel()), axes.get_xlabel()
        assert re.search(r"\[.+\]$", axes.get_ylabel()), axes.get_ylabel()
    assert 25.4 * page.get_figwidth() == pytest.approx(183.0)


def test_fonts_are_readable(page):
    page.draw_without_rendering()
    printed = {text.get_fontsize() for axes in page.axes for text in (axes.xaxis.label, axes.yaxis.label)}
    assert printed == {7.0}
    for axes in page.axes:
        assert {label.get_fontsize() for label in (*axes.get_xticklabels(), *axes.get_yticklabels())} == {7.0}


@pytest.mark.parametrize("which", ["orbit", "flight"])
def test_every_downstroke_is_shaded_over_phase(orbit, flight, which):
    dataset = orbit.dataset if which == "orbit" else flight
    beats = 1 if which == "orbit" else 4
    for place, axes in enumerate(panels(wingbeat_page(dataset))):
        shades = [c for c in axes.collections if isinstance(c, PolyCollection) and c.get_gid() == "downstroke"]
        assert len(shades) == (place in TIME_PANELS)
        for shade in shades:
            ends = [(path.vertices[:, 0].min(), path.vertices[:, 0].max()) for path in shade.get_paths()]
            assert ends == [(beat, beat + 0.5) for beat in range(beats)]
            assert axes.get_xlim() == (0, beats)


@pytest.mark.slow
def test_a_long_downstroke_is_shaded_to_its_end_and_marked_there():
    species = wb.load_species("pigeon")
    beat = dataclasses.replace(species.wingbeat, downstroke_fraction=0.625)
    model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    flight = wb.simulate(model, beat, wb.State(u=10.0), beats=1, samples=64)
    page = panels(wingbeat_page(flight.dataset))
    for place in TIME_PANELS:
        (shade,) = (c for c in page[place].collections if c.get_gid() == "downstroke")
        vertices = np.concatenate([path.vertices[:, 0] for path in shade.get_paths()])
        assert vertices.min() == 0.0
        assert np.unique(vertices) == pytest.approx([0.0, 0.625], abs=0.01)
    tops, bottoms = (line.get_xdata() for line in page[3].get_lines()[-3:-1])
    x, phase = flight.dataset["x"].values, flight.dataset["phase"].values
    assert tops == pytest.approx(np.interp([0.0, 1.0], phase, x))
    assert bottoms == pytest.approx(np.interp([0.625], phase, x), rel=0.02)


def test_the_title_says_what_flies(orbit, page):
    text = "\n".join(each.get_text() for each in page.texts)
    beat = orbit.record()["wingbeat"]["frequency"]
    for part in ("Pigeon at 10 m/s", f"{beat:.4g} Hz", "Su-Fan", "mirrored", "Certified: closes to"):
        assert part in text
    assert "NOT CERTIFIED" not in text
    assert "Given, not predicted" not in text


def test_the_title_says_that_a_frequency_was_given(orbit):
    beat = orbit.record()["wingbeat"]["frequency"]
    for basis, words in {
        "measured": "measured on the animal",
        "law": "by a law of its kind",
        "given": "as asked",
    }.items():
        given = orbit.dataset.assign_attrs(frequency_basis=basis)
        texts = [each.get_text() for each in wingbeat_page(given).texts]
        (said,) = [text for text in texts if text.startswith("Given, not predicted: ")]
        assert f"frequency {beat:.4g} Hz, {words}" in said


def test_an_orbit_that_is_not_certified_says_so_in_red(orbit):
    red = [t.get_text() for t in wingbeat_page(uncertified(orbit.dataset)).texts if t.get_color() == ALARM]
    assert red[0].startswith("NOT CERTIFIED (infeasible): at the nearest one")
    assert red[-1].endswith("or lighten the vehicle")


def test_a_flight_that_was_lost_says_so_in_red(flight):
    red = [t.get_text() for t in wingbeat_page(tumbled(flight, 97)).texts if t.get_color() == ALARM]
    assert red == ["NOT FINISHED: the vehicle tumbled after 1.5 beats"]


def test_the_curves_are_the_data_in_the_units_of_the_axes(orbit, page):
    data, shown = orbit.dataset, panels(page)
    lines = {line.get_label(): line for axes in page.axes for line in axes.get_lines()}
    np.testing.assert_array_equal(lines["flap φ"].get_ydata(), np.degrees(data["flap"]))
    np.testing.assert_array_equal(lines["span"].get_ydata(), data["span_ratio"])
    np.testing.assert_array_equal(lines["actuator"].get_ydata(), data["actuator_power"])
    assert f"mean hinge power {orbit.record()['mean_power']:.3g} W" in page.texts[0].get_text()
    advance = float(data["x"][-1] - data["x"][0])
    assert f"mean 10 m/s, {advance:.3g} m a beat" in lines
    alpha = shown[6].get_lines()[2].get_ydata()
    wanted = np.degrees(orbit.record()["alpha_three_quarter_span"])
    np.testing.assert_allclose([alpha.min(), alpha.max()], wanted, rtol=1e-12)
    record = orbit.record()["vehicle"]
    weight = 9.81 * (record["body"]["mass"] + 2 * record["wing"]["mass"])
    vertical = 2 * data["strip_force"].isel(station=2).sel(axis="z") / weight
    np.testing.assert_allclose(shown[8].get_lines()[1].get_ydata(), vertical, rtol=1e-12, atol=1e-15)


def test_strokes_begin_at_the_marks(orbit, page):
    data = orbit.dataset
    for axes, place, speed in zip(
        panels(page)[3:6], ("x", "z", "body_pitch"), ("u", "w", "pitch_rate"), strict=True
    ):
        scale = {"x": (1, 1), "z": (1e3, 1), "body_pitch": (180 / np.pi, 180 / np.pi)}[place]
        star, dot = (line for line in axes.get_lines() if line.get_linestyle() == "None")
        np.testing.assert_allclose(star.get_xdata(), scale[0] * data[place].values[[0, -1]], atol=1e-12)
        np.testing.assert_allclose(dot.get_ydata(), scale[1] * data[speed].values[[128]], rtol=1e-12)
        assert (star.get_marker(), dot.get_marker()) == ((8, 2, 0), "o")


@pytest.mark.parametrize(
    "change",
    [
        lambda orbit, flight: orbit,
        lambda orbit, flight: flight,
        lambda orbit, flight: uncertified(orbit),
        lambda orbit, flight: tumbled(flight, 97),
        lambda orbit, flight: tumbled(flight, 1),
        lambda orbit, flight: tumbled(flight, 0),
        lambda orbit, flight: scaled(orbit, 1e-3),
        lambda orbit, flight: scaled(orbit, -1e3),
        lambda orbit, flight: orbit.assign(x=orbit["x"] + 1e2),
        lambda orbit, flight: orbit.assign_attrs(species="a$b_{c"),
    ],
    ids=["orbit", "flight", "uncertified", "tumbled", "one", "none", "small", "large", "far", "dollar"],
)
def test_no_text_is_clipped_or_covered(orbit, flight, change):
    figure = wingbeat_page(change(orbit.dataset, flight))
    check_legends(figure, most=7)
    found = texts_of(figure)
    width, height = figure.get_size_inches() * figure.dpi
    for text, box in found:
        inside = box.x0 >= 0 and box.y0 >= 0 and box.x1 <= width and box.y1 <= height
        assert inside, f"{text!r} leaves the page"
    for (one, first), (other, second) in itertools.combinations(found, 2):
        assert not first.overlaps(second), f"{one!r} meets {other!r}"


def test_alpha_of_a_tumbling_wing_stays_within_half_a_turn(flight):
    turning = flight.assign(alpha=flight["alpha"] + 2 * np.pi * flight["phase"])
    for line in panels(wingbeat_page(turning))[6].get_lines()[1:]:
        assert np.nanmax(np.abs(line.get_ydata())) <= 180.0


def test_one_strip_is_enough(orbit):
    figure = wingbeat_page(orbit.dataset.isel(station=[4]))
    quarter, three = (line.get_ydata() for line in panels(figure)[7].get_lines()[1:])
    np.testing.assert_array_equal(quarter, three)


def test_a_dataset_of_another_origin_is_refused(orbit):
    for dataset, part in (
        (orbit.dataset.assign_attrs(wingbeat_kind="sweep"), "is neither an orbit nor a flight"),
        (orbit.dataset.drop_vars(["alpha"]), "dataset = ['alpha']: is missing from the dataset"),
        (orbit.dataset.assign_attrs(vehicle="{"), "cannot be understood"),
        (orbit.dataset.assign_attrs(aero="[]"), "cannot be understood"),
        (orbit.dataset.assign_attrs(air=json.dumps({})), "attributes = \"'gravity'\": cannot be understood"),
    ):
        with pytest.raises(wb.InvalidInputError, match=re.escape(part)):
            wingbeat_page(dataset)


@pytest.mark.parametrize("name", ["page.png", "page.pdf", "page.svg", "PAGE.SVG", "a.b.Pdf"])
def test_saved_by_suffix(tmp_path, page, name):
    save_figure(page, tmp_path / name)
    kind = name.rsplit(".", 1)[1].lower()
    assert (tmp_path / name).read_bytes().startswith(SIGNATURES[kind])
    assert [file.name for file in tmp_path.iterdir()] == [name]


def test_the_picture_is_of_print_quality(tmp_path, page):
    save_figure(page, tmp_path / "page.png")
    pixels = imread(tmp_path / "page.png")
    assert pixels.shape[1] == pytest.approx(183 / 25.4 * 300, abs=1)
    assert 0.02 < (pixels[..., :3] < 0.5).any(axis=-1).mean() < 0.3


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["svg", "pdf", "png"])
def test_the_same_orbit_gives_the_same_bytes(tmp_path, orbit, kind):
    for name in ("one", "two"):
        save_figure(wingbeat_page(orbit.dataset), tmp_path / f"{name}.{kind}")
    one, two = ((tmp_path / f"{name}.{kind}").read_bytes() for name in ("one", "two"))
    assert one == two
    assert b"dc:date" not in one
    assert b"CreationDate" not in one


def test_text_in_a_pdf_stays_text(tmp_path, page):
    save_figure(page, tmp_path / "page.pdf")
    content = (tmp_path / "page.pdf").read_bytes()
    assert b"/Type3" not in content
    assert b"/CIDFontType2" in content


def test_the_users_own_style_is_left_alone(tmp_path, orbit):
    before = dict(rcParams)
    save_figure(wingbeat_page(orbit.dataset), tmp_path / "page.svg")
    assert dict(rcParams) == before


@pytest.mark.parametrize("name", ["page.jpg", "page", ".png", "page.png ", "page.svgz"])
def test_another_suffix_is_refused(tmp_path, name):
    with pytest.raises(wb.InvalidInputError, match=r"is not a figure format; end it in \.png, \.pdf, \.svg"):
        save_figure(Figure(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_failed_save_leaves_what_was_there(tmp_path, monkeypatch):
    path = tmp_path / "page.svg"
    path.write_text("before")

    def full(*args, **options):
        raise OSError(28, "No space left on device")

    figure = Figure()
    monkeypatch.setattr(figure, "savefig", full)
    with pytest.raises(wb.FileError, match="no space left on device"):
        save_figure(figure, path)
    assert path.read_text() == "before"
    assert [file.name for file in tmp_path.iterdir()] == ["page.svg"]


def test_unwritable_places_are_told(tmp_path):
    (tmp_path / "folder.png").mkdir()
    for path in (tmp_path / "missing" / "page.png", tmp_path / "folder.png"):
        with pytest.raises(wb.FileError, match=re.escape(f"cannot write {str(path)!r}")):
            save_figure(Figure(), path)
    assert [file.name for file in tmp_path.iterdir()] == ["folder.png"]
