"""The explorer's names of models are the same for the server's page, the folder and the command."""

import pytest

import wingbeat as wb
from wingbeat.cli.problem_options import ModelOptions
from wingbeat_explorer import LATTICE_MODELS, solve_lattice
from wingbeat_explorer.app.controls import choices_of
from wingbeat_explorer.app.links import from_plain, from_query, to_plain, to_query
from wingbeat_explorer.app.scenario import Scenario, problem_of
from wingbeat_explorer.models import EXPLORER_MODELS, name_of


def test_every_model_of_the_package_is_offered_under_its_own_name():
    assert set(wb.models.MODELS) < set(LATTICE_MODELS)
    assert all(EXPLORER_MODELS[name][1:] == (name, None, False) for name in wb.models.MODELS)
    assert len({one.title for one in EXPLORER_MODELS.values()}) == len(LATTICE_MODELS)


@pytest.mark.parametrize("name", LATTICE_MODELS)
def test_folder_and_page_mean_the_same_problem_by_a_name(name, monkeypatch):
    asked = []
    monkeypatch.setattr("wingbeat_explorer.lattice.solve_orbits", lambda problems, *_, **__: asked.extend(problems))
    monkeypatch.setattr("wingbeat_explorer.lattice.lattice_of", lambda *_: {})
    bat = wb.load_species("bat")
    solve_lattice(bat, name, [8.0])
    _, model, coefficients, within = EXPLORER_MODELS[name]
    chosen = choices_of(model, bat) | ({"aero": coefficients} if coefficients else {})
    scenario = Scenario(species="bat", speed=8.0, model=model, within_plausible=within, **chosen)
    assert scenario.face_model == name_of(model, scenario.aero, within) == name
    problem = problem_of(scenario)
    assert problem.aero == asked[0].aero
    assert problem.minimise == asked[0].minimise
    assert problem.bounds == asked[0].bounds
    assert problem.subject_to == asked[0].subject_to
    assert bool(problem.subject_to) == within


@pytest.mark.parametrize("within", [False, True])
@pytest.mark.parametrize(
    ("chosen", "options", "basis"),
    [
        ({}, {}, "law"),
        ({"frequency": 7.2}, {"frequency": 7.2}, "given"),
        ({"free_frequency": True}, {"free": ["frequency"]}, "free"),
    ],
)
def test_the_frequency_of_the_page_is_that_of_the_command_line(chosen, options, basis, within):
    chosen = choices_of("animal", wb.load_species("pigeon")) | chosen
    scenario = Scenario(species="pigeon", speed=12.0, model="animal", within_plausible=within, **chosen)
    told = ModelOptions(model="animal", **options).problem("pigeon", 12.0, None, within_plausible=within)
    assert problem_of(scenario) == told
    assert told.frequency_basis == basis
    assert from_query(to_query(scenario)) == from_plain(to_plain(scenario)) == scenario


def test_bounds_of_the_frequency_free_it_as_in_older_links():
    query = "species=pigeon&model=animal&aero=feathered-flapping&minimise=metabolic_power&bound=frequency:4.0:7.0"
    problem = problem_of(from_query(query))
    assert problem.frequency_basis == "free"
    assert problem.bounds["frequency"] == (4.0, 7.0)


@pytest.mark.parametrize(
    ("query", "words"),
    [
        ("frequency=0", "must be > 0 Hz"),
        ("frequency=fast", "must be a number"),
        ("frequency=7&free_frequency=yes", "is given, and also searched for; keep one"),
    ],
)
def test_a_frequency_that_cannot_be_is_refused(query, words):
    with pytest.raises(wb.InvalidInputError) as refused:
        from_query(query)
    assert words in str(refused.value)


def test_another_model_is_refused_by_its_name():
    with pytest.raises(wb.InvalidInputError, match=r"model = 'fish'.*plausible, animal, paper, dickinson"):
        solve_lattice(wb.load_species("bat"), "fish", [8.0])
