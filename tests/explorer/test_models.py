"""The explorer's names of models are the same for the server's page, the folder and the command."""

import pytest

import wingbeat as wb
from wingbeat.app.controls import choices_of
from wingbeat.app.scenario import Scenario, problem_of
from wingbeat.explorer import LATTICE_MODELS, solve_lattice
from wingbeat.explorer.models import MODEL_TITLES, name_of, parts_of


def test_every_model_of_the_package_is_offered_under_its_own_name():
    assert set(wb.models.MODELS) < set(LATTICE_MODELS)
    assert all(parts_of(name) == (name, None) for name in wb.models.MODELS)
    assert len(set(MODEL_TITLES.values())) == len(LATTICE_MODELS)


@pytest.mark.parametrize("name", LATTICE_MODELS)
def test_folder_and_page_mean_the_same_problem_by_a_name(name, monkeypatch):
    asked = []
    monkeypatch.setattr("wingbeat.explorer.lattice.solve_orbits", lambda problems, *_, **__: asked.extend(problems))
    monkeypatch.setattr("wingbeat.explorer.lattice.lattice_of", lambda *_: {})
    bat = wb.load_species("bat")
    solve_lattice(bat, name, [8.0])
    model, coefficients = parts_of(name)
    chosen = choices_of(model, bat) | ({"aero": coefficients} if coefficients else {})
    scenario = Scenario(species="bat", speed=8.0, model=model, **chosen)
    assert scenario.face_model == name_of(model, scenario.aero) == name
    assert problem_of(scenario).aero == asked[0].aero
    assert problem_of(scenario).minimise == asked[0].minimise
