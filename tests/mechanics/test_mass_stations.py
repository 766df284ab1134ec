"""Masses by station: what the strips keep of the table and what they lose, by sums written here, and refusals."""

import dataclasses
import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers.weighed_wing import TABLE, TOTAL
from wingbeat.mechanics.wing_shape import strips_of
from wingbeat.records.hinges import hinge_inertia

WING = wb.Wing(0.5, (0.2, 0.19, 0.06), TOTAL, pitch_axis=0.1, **TABLE)


def with_wing(wing, strips=10):
    return wb.FlightModel(wb.Vehicle(wb.Body(0.5, 5e-3), wing), wb.aero.BladeElement("su-fan", strips))


def sums(mass, along, behind, gyration):
    """Mass, moments along the span, about the pitch axis, mixed, and pitch inertia."""
    moments = (mass, mass * along, mass * along**2, mass * behind, mass * along * behind)
    return np.array([np.sum(one) for one in (*moments, mass * (behind**2 + gyration**2))])


def of_table(wing):
    along, mass = np.array(wing.mass_stations), np.array(wing.station_masses)
    chords = np.atleast_1d(wing.chord)
    chord = np.interp(along, np.linspace(0, 1, len(chords)), chords) if len(chords) > 1 else chords
    axis = wing.mass_axis if wing.station_axes is None else np.array(wing.station_axes)
    gyration = wing.mass_gyration if wing.station_gyrations is None else np.array(wing.station_gyrations)
    mass = mass * wing.mass / mass.sum()
    return sums(mass, wing.semi_span * along, (axis - wing.pitch_axis) * chord, gyration * chord)


def of_strips(wing, count):
    cut = strips_of(wing, count)
    behind = cut.behind + (0.25 - wing.pitch_axis) * cut.chord
    return sums(*(np.asarray(a) for a in (cut.mass, wing.semi_span * cut.span_fraction, behind, cut.gyration**0.5)))


@pytest.mark.parametrize("count", [7, 10, 40])
def test_strips_keep_mass_moments_and_inertias_of_spar_and_skin(count):
    with_wing(WING, count)
    np.testing.assert_allclose(of_strips(WING, count), of_table(WING), rtol=1e-13)
    assert np.asarray(strips_of(WING, count).mass).min() >= 0


def test_the_inertia_that_a_hinge_turns_is_that_of_the_pieces():
    beat = dataclasses.replace(wb.load_species("robofalcon2").wingbeat, pitch_hinge=wb.PitchHinge(1.0))
    found = hinge_inertia(with_wing(WING).vehicle, beat, 10)
    assert found == pytest.approx(2 * of_table(WING)[-1], rel=1e-13)


@pytest.mark.parametrize("exponent", [0.0, 2.0])
def test_a_table_at_the_centres_of_the_strips_is_the_law(exponent):
    law = wb.Wing(0.5, (0.2, 0.05), 0.02, exponent, mass_axis=0.4)
    cut = strips_of(law, 10)
    table = wb.Wing(
        0.5, (0.2, 0.05), 0.02, mass_axis=0.4,
        mass_stations=tuple(np.asarray(cut.span_fraction)), station_masses=tuple(np.asarray(cut.mass)),
    )  # fmt: skip
    found = strips_of(table, 10)
    np.testing.assert_allclose(found.mass, cut.mass, rtol=1e-13)
    np.testing.assert_allclose(found.behind, 0.15 * cut.chord, rtol=1e-13)
    np.testing.assert_allclose(found.gyration, cut.chord**2 / 12, rtol=1e-13)


def test_a_fine_uniform_table_comes_near_the_law_of_exponent_0_with_more_strips():
    """The law's strips lack what each has about its own middle, a twelfth of its width squared; the table's not."""
    fine = (np.arange(4000) + 0.5) / 4000
    table = wb.Wing(0.5, 0.1, 0.02, mass_stations=tuple(fine), station_masses=(0.02 / 4000,) * 4000)
    gaps = []
    for count in (10, 20, 40, 80):
        law = np.asarray(
            strips_of(dataclasses.replace(WING, **dict.fromkeys(TABLE), chord=0.1, mass=0.02), count).mass
        )
        found = np.asarray(strips_of(table, count).mass)
        gaps.append(np.abs(found / law - 1).max())
        assert found @ ((np.arange(count) + 0.5) / count) ** 2 == pytest.approx(0.02 / 3, rel=1e-6)
    assert gaps[0] < 0.03
    assert gaps[-1] < 5e-4
    assert all(3.5 < a / b < 4.5 for a, b in itertools.pairwise(gaps))


def test_what_is_lost_is_the_third_moment_and_falls_with_the_width_squared():
    along, mass = np.array(TABLE["mass_stations"]), np.array(TABLE["station_masses"])
    lost = []
    for count in (10, 20, 40):
        place = (np.arange(count) + 0.5) / count
        lost.append(abs(np.asarray(strips_of(WING, count).mass) @ place**3 - mass @ along**3) / (mass @ along**3))
    assert lost[0] < 2e-3
    assert max(lost[1:]) < lost[0] / 2


def test_a_mass_at_the_tip_keeps_its_inertia():
    """A tenth of the wing at its very end, beyond the centre of the last strip."""
    along = (*(np.arange(10) + 0.5) / 10, 1.0)
    wing = wb.Wing(0.5, 0.1, 0.02, mass_stations=along, station_masses=(*[0.0018] * 10, 0.002))
    with_wing(wing)
    np.testing.assert_allclose(of_strips(wing, 10), of_table(wing), rtol=1e-13)


def column(low, high):
    return lambda n: st.lists(st.floats(low, high), min_size=n, max_size=n)


COLUMNS = [column(*ends) for ends in ((0, 1), (1e-4, 1e-2), (0, 1), (0, 0.5))]
TABLES = st.integers(3, 25).flatmap(lambda n: st.tuples(*(of(n) for of in COLUMNS)))
CHORDS, AXES = st.lists(st.floats(0.05, 0.2), min_size=1, max_size=4), st.floats(0, 0.5)


@settings(derandomize=True, deadline=None, max_examples=60)
@given(TABLES, CHORDS, AXES, st.sampled_from([5, 10, 20]))
def test_a_table_is_kept_or_refused(table, chord, axis, count):
    place, mass, axes, gyrations = map(tuple, table)
    assume(len({*place}) > 2)
    chord = chord[0] if len(chord) == 1 else tuple(chord)
    columns = {"mass_stations": place, "station_masses": mass, "station_axes": axes, "station_gyrations": gyrations}
    wing = wb.Wing(0.4, chord, sum(mass), pitch_axis=axis, **columns)
    try:
        with_wing(wing, count)
    except wb.InvalidInputError as error:
        (fault,) = error.faults
        if fault.where == "aero.strips":
            return
        raise
    found, wanted = of_strips(wing, count), of_table(wing)
    scale = sum(mass) * np.array([1, 0.4, 0.16, 0.2, 0.08, 0.04])
    np.testing.assert_allclose(found[:5] / scale[:5], wanted[:5] / scale[:5], rtol=0, atol=1e-9)
    # Pieces without gyration on a bent axis may keep too much of the inertia, never too little.
    assert found[5] >= wanted[5] - 1e-9 * scale[5]
    if np.asarray(strips_of(wing, count).gyration).max() > 0:
        assert found[5] == pytest.approx(wanted[5], abs=1e-9 * scale[5])


def test_a_bare_spar_keeps_its_inertia_to_a_thousandth():
    spar = dict(zip(TABLE, (np.array(column)[:12] for column in TABLE.values()), strict=True))
    spar = {name: tuple(column) for name, column in spar.items()}
    for count in (10, 20, 40):
        wing = wb.Wing(0.5, (0.1, 0.2, 0.05), sum(spar["station_masses"]), **spar)
        assert of_strips(wing, count)[5] == pytest.approx(of_table(wing)[5], rel=1e-3)


# --- refusals


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"mass": 0.03}, "wing.mass = 0.03: is not the sum of wing.station_masses, 0.0162 kg"),
        ({"station_masses": None}, "wing.station_masses = None: must be a list of numbers in a table of masses"),
        ({"mass_stations": (0.1, 0.2)}, "wing.station_masses = .*: has 22 numbers, wing.mass_stations has 2"),
        (
            {"mass_exponent": 1.0},
            "wing.mass_exponent = 1.0: has no effect beside wing.station_masses; leave it out",
        ),
        ({"mass_axis": 0.3}, "wing.mass_axis = 0.3: has no effect beside wing.station_axes"),
        ({"mass_gyration": 0.1}, "wing.mass_gyration = 0.1: has no effect beside wing.station_gyrations"),
        (
            {"mass_stations": (1.5, *TABLE["mass_stations"][1:])},
            r"wing.mass_stations\[0\] = 1.5: must be >= 0 and <= 1",
        ),
        (
            {"station_masses": (-1e-3, *TABLE["station_masses"][1:])},
            r"wing.station_masses\[0\] = -0.001: must be > 0",
        ),
        ({"station_gyrations": (0.6, *[0.1] * 21)}, r"wing.station_gyrations\[0\] = 0.6: must be >= 0 and <= 0.5"),
        ({"mass_stations": (*[0.5] * 21, 0.6)}, "wing.mass_stations = .*: are fewer than three different places"),
    ],
)
def test_wrong_tables_are_refused(changes, told):
    with pytest.raises(wb.InvalidInputError, match=told):
        dataclasses.replace(WING, **changes)


def test_what_a_shoulder_holds_is_sent_to_the_body():
    wing = wb.Wing(0.5, 0.1, 0.02, mass_stations=(0.0, 0.5, 0.9), station_masses=(0.018, 0.001, 0.001))
    with pytest.raises(wb.InvalidInputError, match=r"aero.strips = 10: is too few .* shoulder to the body"):
        with_wing(wing)


def test_another_mass_scales_the_stations():
    double = WING.weighing(2 * TOTAL)
    np.testing.assert_allclose(of_strips(double, 10), 2 * of_strips(WING, 10), rtol=1e-14)
    assert double.told()["station_masses"][0] == pytest.approx(2 * TABLE["station_masses"][0])
    law = wb.Wing(0.5, 0.1, 0.02)
    assert law.weighing(0.03) == dataclasses.replace(law, mass=0.03)
    assert not {*TABLE} & {*law.told()}
