"""The paper's figures from our model: their tables are the orbits' own numbers, and what is missing is said."""

import copy
import csv
import itertools
import math

import numpy as np
import pytest
from matplotlib.image import imread

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.mechanics.wing_motion import strips_of
from wingbeat.plots.published import MEASURED_FREQUENCIES
from wingbeat_evidence.paper.figure_coefficients import coefficients_figure
from wingbeat_evidence.paper.figure_cycle import absence, forces_figure, pitch_figure, power_figure
from wingbeat_evidence.paper.figure_frequency import frequency_figure
from wingbeat_evidence.paper.figure_orbit import phase_figure
from wingbeat_evidence.paper.figure_vehicle import vehicle_figure
from wingbeat_evidence.paper.figures import FIGURES, csv_text, draw_figures
from wingbeat_evidence.paper.treatments import Case, solve_cases

BAT = Case("mirrored", "bat", "su-fan", 10.0)
BAT_DICKINSON = Case("mirrored", "bat", "dickinson", 10.0)
PIGEON = Case("mirrored", "pigeon", "su-fan", 10.0)


@pytest.fixture(scope="module")
def orbits():
    found = solve_cases([BAT, BAT_DICKINSON, PIGEON], starts=1)
    assert all(orbit.status is wb.Status.CONVERGED for orbit in found.values())
    # Figures ask no orbit which case it answers, so one may stand for others.
    others = [Case("mirrored", "pigeon", "su-fan", 12.0), Case("signed", "pigeon", "su-fan", 10.0)]
    return found | dict.fromkeys(others, found[PIGEON])


def failed(orbit):
    """Return the orbit as if its search had ended without a certificate."""
    other = copy.copy(orbit)
    other._summary = orbit._summary._replace(status=wb.Status.INFEASIBLE)
    return other


@pytest.fixture
def without_dickinson(orbits):
    return orbits | {BAT_DICKINSON: failed(orbits[BAT_DICKINSON])}


def column(table, name, **chosen):
    rows = [row for row in table if all(row.get(key) == value for key, value in chosen.items())]
    return np.array([row[name] for row in rows])


def words(figure):
    """Return all that is written in a figure, notes and panels alike."""
    return " ".join(text.get_text() for text in figure.findobj(lambda each: hasattr(each, "get_text")))


def lines(axes):
    return {line.get_label(): line for axes in np.atleast_1d(axes) for line in axes.get_lines()}


@pytest.mark.slow
@pytest.mark.parametrize("number", FIGURES)
@pytest.mark.parametrize("solved", [True, False], ids=["solved", "nothing"])
def test_every_axis_has_its_unit_and_no_text_is_lost(orbits, number, solved):
    figure, _, caption = FIGURES[number](orbits if solved else {}, "mirrored")
    sentences = [sentence for sentence in caption.split(". ") if sentence]
    assert sentences
    assert not any(sentence in words(figure) for sentence in sentences)  # a caption is text, not part of a picture
    figure.draw_without_rendering()
    for axes in figure.axes:
        shown = [axes.xaxis.label, axes.yaxis.label] if axes.axison else []
        assert all(label.get_text().endswith("]") for label in shown if label.get_text())
    width, height = figure.get_size_inches() * figure.dpi
    boxes = [(text.get_text(), text.get_window_extent()) for text in figure.texts]
    boxes += [(t.get_text(), t.get_window_extent()) for axes in figure.axes for t in axes.texts if t.get_text()]
    for text, box in boxes:
        assert min(box.x0, box.y0) >= -1, text
        assert box.x1 <= width + 1, text
        assert box.y1 <= height + 1, text
    labels = [
        (t.get_text(), t.get_window_extent()) for axes in figure.axes for t in (axes.xaxis.label, axes.yaxis.label)
    ]
    for (one, first), (other, second) in itertools.combinations([b for b in labels if b[0]], 2):
        assert not first.overlaps(second), f"{one!r} meets {other!r}"


def test_the_vehicle_is_the_models_own(orbits):
    _, table, _ = vehicle_figure(orbits)
    data, wing = orbits[PIGEON].dataset, orbits[PIGEON].problem.vehicle.wing
    body = data.isel(phase=64)
    assert float(body["phase"]) == 0.25
    drawn = np.stack(
        [column(table, f"{a}_m", animal="pigeon", phase=0.25, point="quarter chord") for a in "xyz"], 1
    )
    body_place = [float(body["x"]), 0.0, float(body["z"])]
    np.testing.assert_allclose(drawn, body["strip_position"].values - body_place, atol=1e-12)
    corners = {
        point: np.stack([column(table, f"{a}_m", animal="pigeon", phase=0.25, point=point) for a in "xyz"], 1)
        for point in ("leading inner", "leading outer", "trailing outer", "trailing inner")
    }
    chords = np.linalg.norm(corners["leading inner"] - corners["trailing inner"], axis=1)
    np.testing.assert_allclose(chords, np.asarray(strips_of(wing, 10).chord), rtol=1e-12)
    widths = np.linalg.norm(corners["leading outer"] - corners["leading inner"], axis=1)
    np.testing.assert_allclose(widths.sum(), wing.semi_span, rtol=1e-12)
    np.testing.assert_allclose(corners["leading outer"][:-1], corners["leading inner"][1:], atol=1e-12)


def test_the_bats_hand_hangs_below_its_arm_at_mid_upstroke(orbits):
    _, table, _ = vehicle_figure(orbits)
    place = [
        np.stack([column(table, f"{a}_m", animal="bat", phase=phase, point="quarter chord") for a in "xyz"], 1)
        for phase in (0.25, 0.75)
    ]
    bends = []
    for points in place:
        arm, hand = points[1] - points[0], points[-1] - points[-2]
        cosine = arm @ hand / np.linalg.norm(arm) / np.linalg.norm(hand)
        bends.append(math.degrees(math.acos(min(cosine, 1.0))))
    np.testing.assert_allclose(bends, [0.0, 10.0], atol=1e-5)


def test_coefficients_are_the_published_formulas():
    _, table, caption = coefficients_figure()
    at = {"model": "su-fan", "alpha_deg": 20.0}
    for name, value in (("C_L", 0.9724), ("C_D", 0.4579), ("x_cp_chords", 0.4012), ("C_M_mid_chord", 0.1058)):
        assert column(table, f"{name}_formula", **at)[0] == pytest.approx(value, abs=5e-5)
        assert column(table, f"{name}_simulated", **at)[0] == pytest.approx(value, abs=5e-5)
    beyond = column(table, "C_L_formula", model="su-fan", alpha_deg=110.0)[0]
    assert beyond == pytest.approx(-0.620, abs=5e-4)
    assert column(table, "C_L_simulated", model="su-fan", alpha_deg=110.0)[0] == pytest.approx(-0.736, abs=5e-4)
    assert math.isnan(column(table, "C_D_formula", model="dickinson", alpha_deg=100.0)[0])
    thin = column(table, "C_M_mid_chord_thin_aerofoil", **at)[0]
    assert thin == pytest.approx(math.pi / 2 * math.radians(20.0))
    assert "no points are drawn" in caption


def test_portraits_are_the_orbit_with_marks_where_strokes_begin(orbits):
    figure, table, caption = phase_figure(orbits)
    data = orbits[PIGEON].dataset
    np.testing.assert_array_equal(column(table, "x_m"), data["x"])
    np.testing.assert_array_equal(column(table, "w_m_per_s"), data["w"])
    np.testing.assert_array_equal(column(table, "pitch_rate_deg_per_s"), np.degrees(data["pitch_rate"]))
    for axes, (place, speed) in zip(
        figure.axes,
        (("x_m", "u_m_per_s"), ("z_mm", "w_m_per_s"), ("body_pitch_deg", "pitch_rate_deg_per_s")),
        strict=True,
    ):
        marks = {line.get_gid(): line for line in axes.get_lines() if line.get_gid()}
        asterisk, dot = marks["downstroke"], marks["upstroke"]
        assert (asterisk.get_marker(), dot.get_marker()) == ((8, 2, 0), "o")
        np.testing.assert_allclose(asterisk.get_xydata()[0], [table[0][place], table[0][speed]])
        np.testing.assert_allclose(dot.get_xydata(), [[table[128][place], table[128][speed]]])
        assert table[128]["phase"] == 0.5
    assert "our pigeon" in caption


def gids(axes):
    return {each.get_gid() for each in axes.get_children()}


def test_what_the_paper_prints_is_marked_and_a_contradiction_is_said_with_its_reason(orbits):
    drawn = [drawing(orbits) for drawing in (frequency_figure, forces_figure, power_figure, pitch_figure)]
    frequency, forces, power, pitch = (one.figure for one in drawn)
    for page in (frequency, forces, power, pitch):
        check_legends(page)
    captions = [one.caption for one in drawn]
    assert {"paper-su-fan", "paper-dickinson"} <= gids(frequency.axes[1])
    (star,) = (line for line in frequency.axes[1].get_lines() if line.get_gid() == "paper-dickinson")
    np.testing.assert_array_equal(star.get_xydata(), [[10.0, 12.0]])
    for axes in (*forces.axes[:2], *power.axes, *pitch.axes):
        assert "paper" in gids(axes)
    bars = [line for line in pitch.axes[0].get_lines() if line.get_gid() == "paper"]
    assert [np.ptp(bar.get_ydata()) for bar in bars] == pytest.approx([10.0, 25.0])
    peak = orbits[BAT].record()["peak_power"]
    note = captions[2]
    assert f"prints a peak of 30 W with Su-Fan; ours: {peak:.3g} W, which contradicts it" in note
    assert "The paper leaves open which mean angles are free" in note
    ratio = orbits[BAT_DICKINSON].wingbeat.frequency / orbits[BAT].wingbeat.frequency
    note = captions[0]
    assert f"almost twice that near 10 m/s with Dickinson; ours: {ratio:.2f} times (mirrored), which" in note
    extent = math.degrees(orbits[BAT].record()["body_pitch_range"])
    verdict = "agrees" if extent <= 10 else "contradicts it"
    assert f"ours: {extent:.3g} deg, which {verdict}" in captions[3]


def test_frequencies_are_those_of_the_orbits(orbits):
    figure, table, _ = frequency_figure(orbits)
    for case, orbit in orbits.items():
        about = {
            "animal": case.animal,
            "treatment": case.treatment,
            "model": case.model,
            "speed_m_per_s": case.speed,
        }
        assert column(table, "frequency_Hz", kind="orbit", **about) == [orbit.wingbeat.frequency]
    drawn = lines(figure.axes[0])
    np.testing.assert_array_equal(drawn["Su-Fan, mirrored"].get_xdata(), [10.0, 12.0])
    filled, hollow = (drawn[f"Su-Fan, {name}"].get_markerfacecolor() for name in ("mirrored", "signed"))
    assert (filled, hollow) == ("#0072B2", "w")
    assert drawn["Dickinson, mirrored"].get_marker() != drawn["Su-Fan, mirrored"].get_marker()


def test_a_speed_without_a_certified_orbit_is_marked_and_not_drawn(without_dickinson):
    figure, table, _ = frequency_figure(without_dickinson)
    drawn = lines(figure.axes[1])
    assert not len(drawn["Dickinson, mirrored"].get_xdata())
    crosses = [line for line in figure.axes[1].get_lines() if line.get_gid() == "absent-mirrored-dickinson"]
    np.testing.assert_array_equal(crosses[0].get_xdata(), [10.0])
    row = next(row for row in table if (row["animal"], row.get("model")) == ("bat", "dickinson"))
    assert row["status"] == "infeasible"
    assert math.isnan(row["frequency_Hz"])


def test_what_was_measured_carries_its_source(orbits):
    _, table, _ = frequency_figure(orbits)
    for measured in MEASURED_FREQUENCIES:
        assert measured.source
        assert measured.grade in ("A", "D")
        assert measured.unit == "Hz"
        assert measured.spread >= 0
        rows = [row for row in table if row.get("label") == measured.label]
        assert rows
        assert {row["source"] for row in rows} == {measured.source}
        low, high = measured.speeds
        assert all(low <= row["speed_m_per_s"] <= high for row in rows)


@pytest.mark.parametrize(
    ("animal", "speed", "frequencies"),
    # As literature gives them for our vehicles, to the digits it gives.
    [("pigeon", 10.0, [5.4, 6.9, 8.3, 8.02]), ("bat", 5.0, [7.1, 6.0]), ("bat", 10.0, [6.3, 6.0])],
)
def test_laws_of_frequency_give_the_published_values(animal, speed, frequencies):
    species = wb.load_species(animal)
    found = [m.value(species.vehicle, species.air, speed) for m in MEASURED_FREQUENCIES if m.animal == animal]
    np.testing.assert_allclose(found, frequencies, atol=0.06)


def test_forces_are_those_of_one_strip_of_both_wings(orbits):
    figure, table, caption = forces_figure(orbits)
    data = orbits[BAT].dataset
    weight = 0.068 * 9.81
    # Of ten strips, the third and the eighth have their centres at 1/4 and 3/4 of the span.
    for strip, fraction in ((2, 0.25), (7, 0.75)):
        about = {"model": "su-fan", "span_fraction": fraction}
        strip_force = 2 * data["strip_force"].isel(station=strip) / weight
        horizontal = column(table, "horizontal_force_over_weight", **about)
        np.testing.assert_allclose(horizontal, strip_force.sel(axis="x"), rtol=1e-9, atol=1e-12)
        vertical = column(table, "vertical_force_over_weight", **about)
        np.testing.assert_allclose(vertical, strip_force.sel(axis="z"), rtol=1e-9, atol=1e-12)
        alpha = np.radians(column(table, "alpha_deg", **about))
        wanted = orbits[BAT].record()["alpha_quarter_span" if fraction < 0.5 else "alpha_three_quarter_span"]
        np.testing.assert_allclose([alpha.min(), alpha.max()], wanted, rtol=1e-9)
    assert "one of 10 equal strips, both wings" in caption
    solid, dashed = (lines(figure.axes[0])[name] for name in ("Su-Fan", "Dickinson"))
    assert (solid.get_linestyle(), dashed.get_linestyle()) == ("-", "--")


def test_the_downstroke_is_shaded(orbits):
    for figure in (forces_figure(orbits)[0], power_figure(orbits)[0], pitch_figure(orbits)[0]):
        for axes in figure.axes:
            (shade,) = (each for each in axes.collections if each.get_gid() == "downstroke")
            (box,) = shade.get_paths()
            assert (box.vertices[:, 0].min(), box.vertices[:, 0].max()) == (0.0, 0.5)
            assert axes.get_xlim() == (0.0, 1.0)


def test_power_and_its_peaks(orbits):
    figure, table, caption = power_figure(orbits)
    np.testing.assert_array_equal(
        column(table, "hinge_power_W", model="su-fan"), orbits[BAT].dataset["hinge_power"]
    )
    assert f"Su-Fan {orbits[BAT].record()['peak_power']:.3g} W" in caption
    levels = [line.get_ydata()[0] for line in figure.axes[0].get_lines() if line.get_gid() == "paper"]
    assert levels == [30.0, 150.0]


def test_body_pitch_and_its_range(orbits):
    _, table, caption = pitch_figure(orbits)
    drawn = column(table, "body_pitch_deg", model="dickinson")
    np.testing.assert_array_equal(drawn, np.degrees(orbits[BAT_DICKINSON].dataset["body_pitch"]))
    wanted = math.degrees(orbits[BAT_DICKINSON].record()["body_pitch_range"])
    assert np.ptp(drawn) == pytest.approx(wanted, rel=1e-9)
    assert f"Dickinson {wanted:.3g} deg" in caption


@pytest.mark.parametrize("drawing", [forces_figure, power_figure, pitch_figure])
def test_a_figure_says_what_is_not_certified(without_dickinson, drawing):
    figure, table, _ = drawing(without_dickinson)
    assert "bat at 10 m/s with Dickinson (mirrored): infeasible" in words(figure).replace("\n", " ")
    assert {row["model"] for row in table} == {"su-fan"}
    figure, table, _ = drawing({})
    assert "no certified orbit" in words(figure)
    assert not table


def test_absence_is_told_in_words(orbits, without_dickinson):
    assert absence(orbits, "mirrored", "bat") == ""
    assert absence(orbits, "signed", "pigeon", ("su-fan",)) == ""
    told = absence(without_dickinson, "mirrored", "bat")
    assert told == "No certified orbit of the bat at 10 m/s with Dickinson (mirrored): infeasible."


def test_files_are_written_and_the_same_again(tmp_path, orbits):
    for folder in ("one", "two"):
        written = draw_figures(orbits, [7], tmp_path / folder)
        assert [path.name for path in written] == ["figure7.png", "figure7.pdf", "figure7.csv", "figure7.md"]
        assert sorted(path.name for path in (tmp_path / folder).iterdir()) == sorted(path.name for path in written)
    for path in (tmp_path / "one").iterdir():
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes()
    page = (tmp_path / "one" / "figure7.md").read_text(encoding="utf-8")
    assert "(figure7.png)" in page
    assert power_figure(orbits).caption in page
    with open(tmp_path / "one" / "figure7.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * orbits[BAT].dataset.sizes["phase"]
    peak = max(float(row["hinge_power_W"]) for row in rows if row["model"] == "su-fan")
    assert peak == pytest.approx(orbits[BAT].record()["peak_power"], rel=1e-8)
    pixels = imread(tmp_path / "one" / "figure7.png")
    assert pixels.shape[1] == pytest.approx(89 / 25.4 * 300, abs=1)


def test_a_folder_that_cannot_be_is_told(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(wb.FileError, match="cannot write"):
        draw_figures({}, [3], tmp_path / "file" / "folder")


def test_a_table_of_nothing_is_a_file_of_nothing():
    assert csv_text([]) == "\n"


@pytest.mark.parametrize(("numbers", "sample"), [([0], "mirrored"), ([9], "mirrored"), ([4], "sideways")])
def test_an_unknown_figure_or_treatment_is_refused(tmp_path, numbers, sample):
    with pytest.raises(wb.InvalidInputError, match="is not a known choice"):
        draw_figures({}, numbers, tmp_path / "new", sample)
    assert not (tmp_path / "new").exists()
