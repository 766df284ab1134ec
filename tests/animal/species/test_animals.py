"""Animals from mass, span and area: the laws, what is marked as derived, what is refused, and that they fly."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers.species_texts import faults_of
from wingbeat.animal.species import deriving, scaling
from wingbeat.animal.species.building import DERIVED
from wingbeat.animal.species.writing import species_text

SIZE = {"mass": 0.3, "wing_span": 0.62, "wing_area": 0.06}
MAKERS = {"bird": wb.bird, "bat": wb.bat, "robot": wb.robot}
# Built-in animals that laws complete, with the size that their files name in words.
COMPLETED: dict[str, tuple[Any, float, float, float, dict[str, Any]]] = {
    "annas-hummingbird": (wb.bird, 0.00434, 0.1041, 0.001427, {}),
    "barn-swallow": (wb.bird, 0.016, 0.32, 0.0136, {}),
    "cockatiel": (wb.bird, 0.09, 0.501, 0.03586, {}),
    "common-murre": (wb.bird, 0.995, 0.707, 0.0536, {}),
    "common-starling": (wb.bird, 0.083, 0.38, 0.0244, {}),
    "common-swift": (wb.bird, 0.038, 0.4, 0.0168, {}),
    "dog-faced-fruit-bat": (wb.bat, 0.031, 0.41, 0.028, {}),
    "herring-gull": (wb.bird, 1.142, 1.34, 0.1968, {}),
    "horned-puffin": (wb.bird, 0.663, 0.607, 0.0434, {}),
    "jackdaw": (wb.bird, 0.215, 0.67, 0.0652, {}),
    "noctule": (wb.bat, 0.0281, 0.362, 0.0163, {}),
    "pigeon-guillemot": (wb.bird, 0.47, 0.578, 0.0422, {}),
    "robofalcon2": (wb.robot, 0.8, 1.2, 0.2198, {}),
    "short-tailed-bat": (wb.bat, 0.018, 0.3, 0.015, {}),
    "tufted-puffin": (wb.bird, 0.799, 0.662, 0.0512, {}),
    "zebra-finch": (wb.bird, 0.0133, 0.161, 0.00628, {"semi_span": 0.072}),
}
# A speed [m/s] that each animal is known to fly, or one that suits a robot; where that was read; and the
# highest frequency [Hz] seen of it.
FLOWN = {
    "annas-hummingbird": (
        8.0,
        "a hummingbird of 3 g flew at 0 to 12 m/s, Tobalske et al. 2007, J Exp Biol 210:2368",
        56.0,
    ),
    "cockatiel": (10.0, "least metabolic power, Morris, Nelson and Askew 2010, J Exp Biol 213:2788", math.inf),
    "dog-faced-fruit-bat": (6.0, "2.4 to 7.8 m/s, Iriarte-Diaz et al. 2011, doi 10.1242/jeb.037804", math.inf),
    "herring-gull": (12.8, "radar, Alerstam et al. 2007, doi 10.1371/journal.pbio.0050197", math.inf),
    "purdue-hummingbird": (5.0, "no speed read: a robot that hovers; its simulation flaps at 34 Hz", 34.0),
    "robofalcon2": (9.0, "no speed read; highest frequency, doi 10.1126/sciadv.adx0465", 7.5),
    "short-tailed-bat": (5.0, "3 to 7 m/s, doi 10.1098/rsif.2014.0147", math.inf),
    "zebra-finch": (8.0, "0 to 14 m/s, Tobalske, Peacock and Dial 1999, J Exp Biol 202:1725", math.inf),
}


# --- the laws ---


@pytest.mark.parametrize(
    ("law", "values", "expected"),
    [
        # As evaluated in the notes on the literature for the pigeon of 0.316 kg and 0.279 m, and the bat of 68 g.
        (scaling.BIRD_WING_MASS, (0.316,), 0.0199),
        (scaling.BIRD_FLAP_INERTIA, (0.0199, 0.279), 1.41e-4),
        (scaling.FREQUENCY_BY_MASS, (0.316,), 5.4),
        (scaling.FREQUENCY_BY_WING, (0.279,), 6.9),
        (scaling.BAT_FLAP_INERTIA, (0.00476, 0.30), 7.4e-5),
        (scaling.BAT_FREQUENCY, (0.068, 1.0), 9.1),
        (scaling.BAT_FREQUENCY, (0.068, 5.0), 7.1),
        (scaling.BAT_FREQUENCY, (0.068, 10.0), 6.3),
        (scaling.BAT_FLAP_AMPLITUDE, (3.0, 0.06), math.radians(53 / 2)),
        (scaling.BAT_FLAP_AMPLITUDE, (10.0, 0.06), math.radians(89 / 2)),
        (scaling.BIRD_PITCH_INERTIA, (0.316,), 3.6e-4),
        (scaling.BODY_DRAG_AREA, (0.316,), 0.2 * 3.78e-3),
        # Pennycuick's law for two of the birds whose frequency was measured.
        (scaling.BIRD_FREQUENCY, (0.995, 0.707, 0.0536, 1.225, 9.81), 10.71),
        (scaling.BIRD_FREQUENCY, (0.483, 0.66, 0.06122, 1.225, 9.81), 8.35),
    ],
)
def test_laws_give_the_published_examples(law: scaling.Law, values: tuple[float, ...], expected: float) -> None:
    assert law(*values) == pytest.approx(expected, rel=0.012)


_OF_MUSCLE = ("rad/(N m)", "J/kg", "W")


def test_every_law_has_unit_source_and_spread() -> None:
    laws = [law for law in vars(scaling).values() if isinstance(law, scaling.Law)]
    assert len(laws) > 20
    for law in laws:
        assert law.source.strip()
        assert law.scatter.strip()
        assert law.unit in ("m", "kg", "kg m2", "m2", "1", "Hz", "rad", "m/s", "Pa", "1/s", "1/rad", *_OF_MUSCLE)
        assert 0 <= law.spread[0] <= 1 <= law.spread[1]


@pytest.mark.parametrize("exponent", [0.0, 0.94, 2.0, 4.0])
def test_the_exponent_gives_the_inertia_it_was_made_from(exponent: float) -> None:
    share = 2 / ((exponent + 2) * (exponent + 3))
    assert scaling.exponent_of_inertia(share) == pytest.approx(exponent, abs=1e-12)
    strips = (np.arange(2000) + 0.5) / 2000
    masses = (1 - strips) ** exponent
    assert (masses * strips**2).sum() / masses.sum() == pytest.approx(share, rel=1e-5)


def test_more_inertia_than_a_uniform_wing_has_is_a_uniform_wing() -> None:
    assert scaling.exponent_of_inertia(0.5) == 0.0


# --- what comes out ---


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_the_animals_of_the_paper_lie_within_the_spread(name: str) -> None:
    """Size in, everything else within the spread that is claimed."""
    animal = wb.load_species(name)
    wing = animal.vehicle.wing
    span = wing.semi_span / 0.464 if name == "pigeon" else 2 * wing.semi_span
    size = {"mass": animal.vehicle.mass, "wing_span": span, "wing_area": span * wing.mean_chord}
    derived = MAKERS["bird" if name == "pigeon" else "bat"](**size)
    for path in ("body.pitch_inertia", "wing.semi_span", "wing.chord", "wing.mass", "wing.mass_exponent"):
        low, high = derived.numbers[f"vehicle.{path}"].range or (math.nan, math.nan)
        value = animal.numbers[f"vehicle.{path}"].value
        assert isinstance(value, float)
        assert low <= value <= high, path
    low, high = derived.numbers["wingbeat.frequency"].range or (math.nan, math.nan)
    assert low <= animal.wingbeat.frequency <= high


def test_the_dissected_pigeon_lies_within_the_spread() -> None:
    derived = wb.bird(mass=0.2602, wing_span=0.613, wing_area=0.06)
    measured = {
        "body.pitch_inertia": 2.6e-4,
        "wing.semi_span": 0.278,
        "wing.mass": 0.0249,
        "wing.mass_exponent": 4.0,
    }
    for path, value in measured.items():
        low, high = derived.numbers[f"vehicle.{path}"].range or (math.nan, math.nan)
        assert low <= value <= high, path


@pytest.mark.parametrize("kind", MAKERS)
def test_every_number_is_given_derived_or_a_guess(kind: str) -> None:
    animal = MAKERS[kind](**SIZE)
    for path, number in animal.numbers.items():
        text = number.source
        if text == "not given: the default":  # a law that is off
            assert path.startswith("wingbeat.")
            assert number.value in (0.0, 0.5, ())
            continue
        told = text.startswith(("given", DERIVED, "guess: ", "first guess", "Su et al.", "vehicle.mass less"))
        assert told, (path, text)
        assert number.range or path in ("vehicle.mass", "vehicle.body.mass"), path
    laws = ["body.pitch_inertia", "wing.semi_span", "wing.chord", "wing.mass", "wing.mass_exponent"]
    assert animal.warnings == (f"derived by scaling laws, not measured: {', '.join(laws)}",)
    assert animal.vehicle.mass == pytest.approx(SIZE["mass"], rel=1e-14)
    assert all(animal.reasons[name] for name in (*animal.free, "body_pitch"))
    for name in animal.alternatives:
        assert animal.with_alternative(name).vehicle.mass == pytest.approx(SIZE["mass"], rel=1e-14)


def test_what_is_measured_stays_and_laws_go_on_from_it() -> None:
    known = wb.bird(
        **SIZE, wing_mass=0.03, chord=[0.12, 0.1, 0.05], frequency=5.0, flap_amplitude_deg=40, density=1.0
    )
    assert known.vehicle.wing.mass == 0.03
    assert known.vehicle.mass == pytest.approx(0.3, rel=1e-14)
    assert known.vehicle.wing.chord == (0.12, 0.1, 0.05)
    assert known.wingbeat.flap_amplitude == math.radians(40)
    assert known.air.density == 1.0
    assert known.bounds["frequency"] == (0.625, 20.0)
    assert known.numbers["vehicle.wing.mass"].source == "given"
    assert "m_w = 0.03 kg" in known.numbers["vehicle.wing.mass_exponent"].source
    assert "wing.mass," not in known.warnings[0]


def test_bounds_of_frequency_grow_as_animals_shrink() -> None:
    swift, swan = (
        wb.bird(mass=0.038, wing_span=0.4, wing_area=0.0168),
        wb.bird(mass=9.0, wing_span=2.3, wing_area=0.6),
    )
    assert swift.bounds["frequency"][1] > 2 * swan.bounds["frequency"][1]
    known = wb.robot(**SIZE, frequency_range=(2, 6))
    assert known.bounds["frequency"] == (2.0, 6.0)
    assert "frequency" not in known.guessed_bounds
    assert "frequency" in wb.robot(**SIZE).guessed_bounds


@pytest.mark.parametrize("make", MAKERS.values())
def test_the_air_of_a_derived_animal_is_that_of_whoever_names_none(make: Any) -> None:
    """The numbers of standard air stand in `deriving.toml` and in `Air`; they must not part."""
    assert make(**SIZE).air == wb.Air()


def test_a_fault_of_the_stock_numbers_is_not_swallowed(monkeypatch: pytest.MonkeyPatch, tmp_path: Any) -> None:
    """A misspelt number of `deriving.toml` would be left out without a word."""
    path = tmp_path / "deriving.toml"
    path.write_text(deriving._FILE.read_text().replace("\ndensity =", "\ndensty ="))
    monkeypatch.setattr(deriving, "_FILE", path)
    with pytest.raises(wb.InvalidInputError) as caught:
        deriving._stock.__wrapped__()
    assert [fault.where for fault in caught.value.faults] == ["air.densty"]


def test_odd_sizes_draw_a_warning() -> None:
    assert "vehicle.mass = 3 kg is outside" in wb.bird(**SIZE | {"mass": 3.0}).warnings[0]
    assert "aspect ratio" in wb.bird(**SIZE | {"wing_area": 0.2}).warnings[0]


# --- what is refused ---


def test_nonsense_is_refused_all_at_once() -> None:
    wrong: dict[str, Any] = {
        "mass": -1,
        "wing_span": 0,
        "wing_area": "x",
        "wing_mas": 3,
        "chord": [1],
        "semi_span": -1.0,
        "frequency": math.nan,
        "flap_mean": 0.1,
        "flap_mean_deg": 4,
    }
    lines = faults_of(lambda: wb.bird(**wrong))
    named = {"mass", "wing_span", "wing_area", "wing_mas", "chord", "semi_span", "frequency", "flap_mean_deg"}
    assert set(lines) == named
    assert "did you mean wing_mass" in lines["wing_mas"]


@pytest.mark.parametrize(
    ("size", "where", "rule"),
    [
        ({"wing_area": 0.5}, "wing_area", "larger than the square of the span, 0.3844 m2"),
        ({"wing_area": 6e-4}, "wing_area", "less than 0.01 of the square"),
        ({"mass": math.inf}, "mass", "must be finite"),
        ({"mass": 300_000}, "mass", "<= 1000 kg"),
        ({"wing_span": True}, "wing_span", "must be a number"),
        ({"wing_mass": 0.15}, "mass", "leaves no mass for the body"),
        ({"wing_mass": 0.2}, "wing_mass", "must be 1e-06 to 0.5 times the mass of 0.3"),
        ({"wing_mass": -0.15}, "wing_mass", "must be 1e-06 to"),
        ({"semi_span": 0.7}, "semi_span", "times the wing_span of 0.62"),
        ({"gravity": 0}, "gravity", ">= 0.001"),
        ({"twist_ratio": math.inf}, "twist_ratio", "finite"),
        ({"name": ""}, "name", "text on one line"),
        ({"common_name": "a\nb"}, "common_name", "text on one line"),
        ({"body_mass": 0.2}, "body_mass", "is not a number of a species"),
    ],
)
def test_what_cannot_be_is_refused(size: dict[str, Any], where: str, rule: str) -> None:
    assert rule in faults_of(lambda: wb.bird(**SIZE | size))[where]


def test_a_bat_beyond_the_law_of_amplitude_must_say_how_it_beats() -> None:
    assert wb.bat(**SIZE | {"mass": 20.0}).wingbeat.frequency > 1.0
    assert wb.bat(**SIZE | {"mass": 20.0}, frequency=2.0).wingbeat.frequency == 2.0
    tiny = {"mass": 1e-3, "wing_span": 1e-3, "wing_area": 1e-7}
    assert "outside the range of the law" in faults_of(lambda: wb.bat(**tiny))["wing_area"]


@pytest.mark.parametrize("limits", [(5,), 3, (6, 2), (0, 4), ("a", 3), (1, math.inf), (4, 4)])
def test_a_frequency_range_that_is_none(limits: Any) -> None:
    assert "frequency_range" in faults_of(lambda: wb.robot(**SIZE, frequency_range=limits))


@settings(derandomize=True, deadline=None, max_examples=150)
@given(
    st.sampled_from(sorted(MAKERS)),
    st.floats(1e-7, 2e3),
    st.floats(1e-4, 200.0),
    st.floats(0.5, 200.0),
    st.dictionaries(st.sampled_from(["wing_mass", "chord", "semi_span", "frequency"]), st.floats(), max_size=2),
)
def test_any_size_makes_an_animal_or_faults(
    kind: str, mass: float, span: float, aspect_ratio: float, measured: dict[str, float]
) -> None:
    size = {"mass": mass, "wing_span": span, "wing_area": span * span / aspect_ratio}
    try:
        animal = MAKERS[kind](**size, **measured)
    except wb.InvalidInputError as error:
        told = {fault.where for fault in error.faults}
    else:
        told = set()
    assert told <= {*size, *measured}
    if told:
        return
    assert animal.vehicle.mass == pytest.approx(mass, rel=1e-12)
    for name, value in measured.items():
        assert value > 0, name
    for low, high in animal.bounds.values():
        assert math.isfinite(low)
        assert low < high < math.inf


# --- files and flight ---


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_the_text_of_an_animal_loads_as_the_same_animal(make: Any, tmp_path: Any) -> None:
    animal = make(**SIZE, name="odd-bird", common_name='the "odd" one \\ other', chord=[0.1, 0.09])
    path = tmp_path / "own.toml"
    path.write_text(species_text(animal), encoding="utf-8")
    again = wb.load_species(path)
    assert (again.name, again.common_name, again.free) == (animal.name, animal.common_name, animal.free)
    assert again.reasons == animal.reasons
    assert again.guessed_bounds == animal.guessed_bounds
    assert again.alternatives.keys() == animal.alternatives.keys()
    for path_, number in animal.numbers.items():
        other = again.numbers[path_]
        assert (other.unit, other.source) == (number.unit, " ".join(number.source.split()))
        np.testing.assert_allclose(other.value, number.value, rtol=1e-5)
    for name, bound in animal.bounds.items():
        np.testing.assert_allclose(again.bounds[name], bound, rtol=1e-5)


@pytest.mark.parametrize("name", COMPLETED)
def test_derived_numbers_of_built_in_animals_are_what_the_laws_give(name: str) -> None:
    make, mass, span, area, measured = COMPLETED[name]
    filed, derived = wb.load_species(name), make(mass=mass, wing_span=span, wing_area=area, **measured)
    assert filed.vehicle.mass == pytest.approx(mass, rel=1e-9)
    checked = 0
    for path, number in filed.numbers.items():
        if number.source.startswith(DERIVED):
            assert number.source.startswith(derived.numbers[path].source), path
            np.testing.assert_allclose(number.value, derived.numbers[path].value, rtol=5e-4)
            checked += 1
    assert checked >= 4
    assert filed.warnings[0] == (
        f"derived by scaling laws, not measured: {', '.join(p[8:] for p in _derived(filed))}"
    )
    assert all("outside the data they were fitted to" in line for line in filed.warnings[1:])


def _derived(animal: wb.Species) -> list[str]:
    return [p for p, n in animal.numbers.items() if p.startswith("vehicle.") and n.source.startswith(DERIVED)]


def test_derived_animals_fly() -> None:
    """From a swallow to a swan, a bat and a robot: one search each ends in a certified orbit."""
    animals = [
        (wb.load_species("barn-swallow"), 8.0),
        (wb.load_species("noctule"), 8.0),
        (wb.bird(mass=10.6, wing_span=2.3, wing_area=0.65, name="swan"), 16.0),
        (wb.robot(mass=0.1, wing_span=0.9, wing_area=0.12, frequency_range=(1, 8)), 5.0),
    ]
    orbits = wb.solve_orbits([wb.OrbitProblem(animal, speed=speed) for animal, speed in animals], starts=1)
    assert [orbit.status.value for orbit in orbits] == ["converged"] * 4
    assert any("derived by scaling laws" in line for line in orbits[0].record()["warnings"])


def test_built_in_animals_and_robots_fly() -> None:
    """Least frequency by the plate: no higher than the highest that was seen of the animal or robot."""
    problems = [wb.OrbitProblem(wb.load_species(name), speed=speed) for name, (speed, _, _) in FLOWN.items()]
    for orbit, (name, (_, _, highest)) in zip(wb.solve_orbits(problems, starts=1), FLOWN.items(), strict=True):
        assert orbit.status is wb.Status.CONVERGED, (name, orbit.message)
        assert orbit.wingbeat.frequency <= highest, name


def test_a_given_mass_is_exact_unless_no_bird_of_that_span_has_it() -> None:
    assert wb.bird(mass=0.2, wing_span=0.73, wing_area=0.07).numbers["vehicle.mass"].range is None
    grams = wb.bird(mass=200.0, wing_span=0.73, wing_area=0.07)
    assert any(line.startswith("vehicle.mass = 200 kg is outside its plausible range") for line in grams.warnings)
