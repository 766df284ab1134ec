"""Scenarios as links and JSON: they come back as they were, or are refused in words."""

import base64
import dataclasses
import json
import zlib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wingbeat import models
from wingbeat._base import FileError, InvalidInputError
from wingbeat.aero import EXTENSIONS, LIBRARY
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import species_names, template
from wingbeat_explorer.app.controls import choices_of
from wingbeat_explorer.app.links import from_json, from_plain, from_query, to_json, to_plain, to_query
from wingbeat_explorer.app.scenario import LARGEST_FILE, Scenario, problem_of, species_in

numbers = st.floats(-1e6, 1e6)
scenarios = st.builds(
    Scenario,
    species=st.sampled_from(species_names()),
    speed=st.floats(0, 100),
    climb=st.floats(-100, 100),
    model=st.sampled_from(models.MODELS),
    aero=st.sampled_from(sorted(LIBRARY)),
    extension=st.sampled_from(EXTENSIONS),
    blend_width_deg=st.floats(0.01, 3),
    strips=st.integers(1, 60),
    minimise=st.sampled_from(["frequency", "mean_positive_power"]),
    limits=st.lists(st.sampled_from(["peak_power<=30", "a & b = c", "ä+%"]), max_size=3).map(tuple),
    bounds=st.dictionaries(st.sampled_from(["frequency", "flap_mean"]), st.tuples(numbers, numbers)),
    values=st.dictionaries(
        st.sampled_from(["vehicle.wing.mass", "vehicle.wing.chord"]),
        numbers | st.lists(numbers, min_size=2, max_size=4).map(tuple),
    ),
    starts=st.none() | st.integers(1, 100),
    seed=st.integers(0, 100_000),
    sweep=st.tuples(st.floats(0, 10), st.floats(11, 20), st.floats(1, 5)),
    within_plausible=st.booleans(),
    frequency=st.none() | st.floats(0.1, 500),
    free_frequency=st.booleans(),
).filter(
    lambda one: not (one.within_plausible and one.bounds) and not (one.frequency is not None and one.free_frequency)
)


@given(scenarios)
@settings(max_examples=60, deadline=None)
def test_a_scenario_survives_link_and_file(scenario):
    assert from_query(to_query(scenario)) == scenario
    assert from_json(to_json(scenario), "state.json") == scenario


def test_a_species_file_travels_in_the_link():
    scenario = Scenario(species="mine", species_file=template())
    assert from_query(to_query(scenario)) == scenario
    assert problem_of(scenario).species.vehicle.mass > 0


@pytest.mark.slow
@given(st.text(max_size=80))
@settings(max_examples=200, deadline=None)
def test_no_text_breaks_the_reader(text):
    for read in (from_query, lambda t: from_json(t, "x")):
        try:
            read(text)
        except (InvalidInputError, FileError):
            continue


@given(
    st.recursive(
        st.none() | st.booleans() | st.floats() | st.text(max_size=5),
        lambda inner: (
            st.lists(inner)
            | st.dictionaries(st.sampled_from(["species", "speed", "set", "bounds", "sweep", "limits", "a"]), inner)
        ),
        max_leaves=8,
    )
)
@settings(max_examples=200, deadline=None)
def test_no_json_breaks_the_reader(plain):
    try:
        scenario = from_plain(plain)
    except InvalidInputError:
        return
    assert from_plain(to_plain(scenario)) == scenario


BOMB = base64.urlsafe_b64encode(zlib.compress(b"a" * 50_000_000, 9)).decode().rstrip("=")


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ("speed=fast", "speed = 'fast': must be a number"),
        ("speed=nan", "must be a number"),
        ("speed=1e999", "must be a number"),
        ("speed=101", "must be >= 0 and <= 100 m/s"),
        ("speed=1&speed=2", "is given twice"),
        ("sped=1", "is not part of a link; the parts of a link are"),
        ("species=dodo", "is not a known choice"),
        ("starts=1.5", "must be a whole number"),
        ("starts=1000", "must be a whole number from 1 to 100"),
        ("bound=frequency:1", "must be name:lowest:highest"),
        ("set=wing.mass", "must be path=number"),
        ("set=wing.mass=1&set=wing.mass=2", "is given twice"),
        ("sweep=1:2", "sweep"),
        ("sweep=0:100:0.1", "gives more than 60 speeds"),
        ("species_file=AAAA", "is not a packed species file"),
        ("species=%00", "is not understood"),
        ("species=%ff", "is not a query"),
        ("nonsense", "is not a query"),
        ("a=" + 30_000 * "b", "must be at most 24000"),
    ],
)
def test_a_link_that_cannot_be_is_refused_in_words(query, words):
    with pytest.raises(InvalidInputError, match=r".") as refused:
        from_query(query)
    assert words in str(refused.value)


def test_a_packed_bomb_is_not_blown_up():
    for size in (20_000, len(BOMB)):
        with pytest.raises(InvalidInputError):
            from_query(f"species_file={BOMB[:size]}")
    assert len(zlib.compress(b"a" * 10 * LARGEST_FILE)) < 24_000  # one that would fit into a link
    small = base64.urlsafe_b64encode(zlib.compress(b"a" * 10 * LARGEST_FILE)).decode()
    with pytest.raises(InvalidInputError, match="is not a packed species file"):
        from_query(f"species_file={small}")


def test_all_faults_are_told_at_once():
    with pytest.raises(InvalidInputError) as refused:
        from_query("speed=-1&climb=1000&seed=-3")
    assert {fault.where for fault in refused.value.faults} == {"speed", "climb", "seed"}


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"wingbeat_explorer": 2}', "[" * 100_000, "nan"])
def test_a_file_of_something_else_is_refused(text):
    with pytest.raises(FileError, match=r"load a file that"):
        from_json(text, "x.json")


def test_faults_of_the_problem_name_the_choice():
    scenario = Scenario(
        values={"vehicle.wing.mass": -1.0, "vehicle.wing.semi_span": 0.0},
        force_point="centre-of-pressure",
        airspeed="full",
        aero="byl",
    )
    with pytest.raises(InvalidInputError) as refused:
        problem_of(scenario)
    assert {"vehicle.wing.mass", "vehicle.wing.semi_span"} <= {fault.where for fault in refused.value.faults}
    assert len(refused.value.faults) == 3
    assert json.loads(to_json(scenario))["units"] == "SI units and radians"


def test_bounds_free_the_tail_tilt_that_species_hold_fixed():
    tail = {"vehicle.tail.area": 0.005, "vehicle.tail.arm": 0.15, "vehicle.tail.lift_slope": 3.0}
    fixed = Scenario(values=tail)
    freed = from_query(to_query(Scenario(values=tail, bounds={"tail_tilt": (-0.5, 0.4)})))
    species = load_species("pigeon")
    assert problem_of(fixed).free == species.free
    problem = problem_of(freed)
    assert problem.free == (*species.free, "tail_tilt")
    assert problem.bounds["tail_tilt"] == (-0.5, 0.4)
    with pytest.raises(InvalidInputError, match=r"there is no tail"):
        problem_of(Scenario(bounds={"tail_tilt": (-0.5, 0.4)}))


def test_bounds_of_a_tail_tilt_that_the_species_frees_only_replace_its_own():
    line = 'tail_tilt_deg = { bounds = [-20.0, 20.0], unit = "deg", reason = "" }'
    tail = {"vehicle.tail.area": 0.005, "vehicle.tail.arm": 0.15, "vehicle.tail.lift_slope": 3.0}
    own = Scenario(species="mine", species_file=template().replace("[free]", f"[free]\n{line}"), values=tail)
    for scenario in (own, dataclasses.replace(own, bounds={"tail_tilt": (-0.1, 0.1)})):
        assert problem_of(scenario).free.count("tail_tilt") == 1
    assert problem_of(scenario).bounds["tail_tilt"] == (-0.1, 0.1)


@pytest.mark.parametrize("name", ["pigeon", "bat", "purdue-hummingbird"])
def test_a_model_that_is_chosen_is_that_of_the_command(name):
    """The page takes its air loads and objective, and the problem is the model's own; the link keeps it."""
    species = load_species(name)
    model = models.animal(species)
    scenario = Scenario(species=name, model="animal", speed=9.0, **choices_of("animal", species))
    back = from_query(to_query(scenario))
    assert back == scenario
    found, wanted = problem_of(back), model.problem(species, 9.0)
    assert (found.vehicle, found.aero, found.free) == (wanted.vehicle, wanted.aero, wanted.free)
    assert (found.bounds, found.minimise, found.origin) == (wanted.bounds, wanted.minimise, wanted.origin)
    assert problem_of(Scenario(species=name)).origin == models.paper().problem(species, 10.0).origin


def test_bounds_of_ones_own_and_plausible_ranges_exclude_each_other():
    with pytest.raises(InvalidInputError, match="cannot be combined with bounds of your own"):
        problem_of(Scenario(within_plausible=True, bounds={"frequency": (5.0, 9.0)}))
    with pytest.raises(InvalidInputError, match="within_plausible = 'maybe': must be yes or no"):
        from_query("species=pigeon&within_plausible=maybe")
    with pytest.raises(InvalidInputError, match="within_plausible"):
        from_plain({"within_plausible": "yes"})


def test_a_model_for_a_species_of_unknown_kind_is_refused():
    text = template().replace('kind = "bird"', "")
    scenario = Scenario(species="mine", species_file=text, model="animal")
    assert species_in(scenario).vehicle.muscle is None
    with pytest.raises(InvalidInputError, match='kind = "bird", "bat" or "robot"'):
        problem_of(scenario)
