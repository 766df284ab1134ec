"""Whether an orbit is plausible is said apart from whether it closes, everywhere, from ranges with a source."""

from __future__ import annotations

import dataclasses
import json
import math
from typing import Any

import pytest
import xarray as xr

import wingbeat as wb
from wingbeat._base import InvalidInputError
from wingbeat.animal.species.reading import template
from wingbeat.animal.species.writing import species_text
from wingbeat.cli.app import main
from wingbeat.records.judgements import judged, statements
from wingbeat.records.result_files import save_result
from wingbeat.studies.recipe import recipe_from
from wingbeat.words.orbit_words import orbit_report

# Those of an animal without muscle and tail, as the model `paper` has it.
NAMES = [
    "positive_power_per_mass",
    "frequency",
    "flap_amplitude",
    "peak_force_over_weight",
    "mean_body_pitch",
    "body_pitch_range",
    "strouhal",
    "reynolds",
]


@pytest.fixture(scope="module")
def orbit() -> wb.Orbit:
    """The bat at 10 m/s, which closes and which no bat flies."""
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("bat"), speed=10.0), starts=1)


def _by_name(orbit: wb.Orbit) -> dict[str, dict[str, Any]]:
    return {one["name"]: one for one in orbit.record()["plausibility"]}


def test_the_record_judges_numbers_that_are_read_off_the_data(orbit: wb.Orbit) -> None:
    """Each value against the time series, each range against the species file."""
    record, data, bat = orbit.record(), orbit.dataset, wb.load_species("bat")
    judged = _by_name(orbit)
    assert list(judged) == NAMES
    assert all(set(one) == {"name", "value", "unit", "low", "high", "within", "source"} for one in judged.values())
    mass = bat.vehicle.mass
    force = float(((data["force_x"] ** 2 + data["force_z"] ** 2) ** 0.5).max())
    assert judged["positive_power_per_mass"]["value"] == pytest.approx(record["mean_positive_power"] / mass)
    assert judged["peak_force_over_weight"]["value"] == pytest.approx(force / (mass * 9.81), rel=1e-9)
    for name in ("body_pitch_range", "strouhal", "reynolds"):
        assert judged[name]["value"] == record[name]
    pitch = data["body_pitch"].values
    assert judged["mean_body_pitch"]["value"] == pytest.approx((pitch[:-1] + pitch[1:]).mean() / 2, rel=1e-6)
    for name in ("frequency", "flap_amplitude"):
        assert judged[name]["value"] == record["wingbeat"][name]
        number = bat.numbers[f"wingbeat.{name}"]
        assert [judged[name]["low"], judged[name]["high"]] == list(number.range or ())
        assert judged[name]["source"] == number.source
    for one in judged.values():
        low, high, value = one["low"], one["high"], one["value"]
        assert one["within"] is ((low is None or low <= value) and (high is None or value <= high))
        assert one["source"]
        assert (low, high) != (None, None)
    units = ["W/kg", "Hz", "rad", "1", "rad", "rad", "1", "1"]
    assert [one["unit"] for one in judged.values()] == units
    assert orbit.status is wb.Status.CONVERGED
    assert judged["flap_amplitude"]["within"] is False
    assert judged["flap_amplitude"]["high"] == pytest.approx(math.radians(52))


def test_two_statements_in_file_show_and_figure(orbit: wb.Orbit, tmp_path: Any, capsys: Any) -> None:
    path = tmp_path / "bat.nc"
    orbit.save(path)
    again = wb.load_orbit(path)
    assert again.record() == orbit.record()
    said = statements(orbit.record())
    assert said.closes.startswith("closes to ")
    assert " times the power of muscle" in said.plausible
    assert "flap amplitude 60 above 52 deg" in said.plausible
    assert not said.good
    attributes = xr.load_dataset(path, engine="h5netcdf").attrs
    assert attributes["statement_of_closure"] == said.closes
    assert attributes["statement_of_plausibility"] == said.plausible
    assert main(["show", str(path)]) == 0
    first, second = capsys.readouterr().out.splitlines()[:2]
    assert first.strip() == f"certified: {said.closes}"
    limits = next(line for line in orbit_report(orbit.record()) if getattr(line, "head", "").startswith("set by"))
    found = f"{orbit.wingbeat.frequency:.4g} Hz"
    assert limits.head == "set by limits, not predicted"
    assert (
        limits.text == f": flap mean 30 deg, flap angle, and with them flap amplitude 60 deg and frequency {found}"
    )
    assert second.startswith("plausible: no: ")
    texts = [text.get_text() for text in wb.plots.wingbeat_page(again.dataset).texts]
    assert f"Certified: {said.closes}" in texts
    assert any(text.startswith("Plausible: no: ") for text in texts)
    # The same problem comes back with its ranges.
    assert again.problem.species.plausible == orbit.problem.species.plausible


def test_a_judgement_that_lacks_a_key_is_refused(orbit: wb.Orbit, tmp_path: Any, capsys: Any) -> None:
    data = orbit.dataset.copy()
    data.attrs = data.attrs | {"plausibility": json.dumps([{"name": "frequency"}])}
    save_result(data, tmp_path / "bad.nc")
    assert main(["show", str(tmp_path / "bad.nc")]) == 2
    assert "it is damaged (plausibility holds something else than it should)" in capsys.readouterr().err


def test_hover_and_a_file_without_ranges_say_what_is_not_known() -> None:
    bat = wb.load_species("bat")
    assert bat.plausible_range("strouhal", 3.0)[:2] == (None, None)
    assert bat.plausible_range("strouhal", 10.0)[:2] == (0.2, 0.4)
    bare = dataclasses.replace(bat, plausible={})
    assert bare.plausible_range("reynolds", 10.0).source.startswith("nothing is known")
    robot = wb.robot(mass=0.026, wing_span=0.62, wing_area=0.055)
    assert all(known[:2] == (None, None) for known in robot.plausible.values())
    record = {"status": "converged", "closure": {"x": 1e-9}, "plausibility": []}
    assert statements(record) == ("closes to 1e-09", "plausible: not known: no range is known", False)


def test_every_species_has_ranges_with_sources_that_survive_writing(tmp_path: Any) -> None:
    derived = [
        wb.bird(mass=0.3, wing_span=0.62, wing_area=0.06),
        wb.bat(mass=0.028, wing_span=0.362, wing_area=0.0163),
        wb.robot(mass=0.026, wing_span=0.62, wing_area=0.055),
    ]
    for animal in [*map(wb.load_species, wb.species_names()), *derived]:
        ranges = [animal.plausible_range(name, 10.0) for name in NAMES]
        assert all(known.source for known in ranges), animal.name
        path = tmp_path / "again.toml"
        path.write_text(species_text(animal), encoding="utf-8")
        again = wb.load_species(path).plausible
        for name, known in animal.plausible.items():
            assert again[name].source == " ".join(known.source.split())
            for own, other in zip(known[:2], again[name][:2], strict=True):
                assert other == (own if own is None else pytest.approx(own, rel=1e-5))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "strouhal = { low = 0.4, high = 0.2 }",
            "plausible.strouhal = [0.4, 0.2]: has a low end above its high end",
        ),
        ("strouhal = { high = 0.2, unit = 'deg' }", "plausible.strouhal.unit = 'deg': must be '1'"),
        ("strouhl = { high = 0.2 }", "did you mean strouhal?"),
        ("strouhal = { hihg = 0.2 }", "did you mean high?"),
        ("strouhal = 0.2", "plausible.strouhal = 0.2: must be a table"),
        ("frequency = { high = 9.0 }", "plausible.frequency"),
        ("reynolds = { high = 1e5, speeds = [9, 3] }", "plausible.reynolds.speeds"),
        ("reynolds = { high = nan }", "must be finite"),
    ],
)
def test_a_wrong_range_is_refused_in_words(text: str, said: str, tmp_path: Any) -> None:
    path = tmp_path / "own.toml"
    path.write_text(template().replace("[plausible]\n", f"[plausible]\n{text}\n"), encoding="utf-8")
    with pytest.raises(InvalidInputError) as refused:
        wb.load_species(path)
    assert said in str(refused.value)


def test_within_plausible_finds_an_orbit_that_is_plausible(capsys: Any) -> None:
    """The bat at 5 m/s: without the flag its amplitude is 70 degrees, with it every number is within its range."""
    assert main(["orbit", "bat", "--speed", "5", "--starts", "2", "--within-plausible", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["status"] == "converged"
    assert all(one["within"] is not False for one in record["plausibility"])
    assert record["wingbeat"]["flap_amplitude"] <= math.radians(52)
    said = statements(record)
    assert said.plausible == "plausible: yes; no range is known for mean body pitch and Strouhal number"
    assert said.good


def test_ranges_become_bounds_and_limits_that_follow_the_speed() -> None:
    bat = wb.load_species("bat")
    problem = wb.OrbitProblem(bat, speed=10.0, bounds="plausible", subject_to=["flap_amplitude<=40 deg"])
    assert problem.bounds["frequency"] == (4.0, 13.0)
    assert problem.bounds["flap_amplitude"] == pytest.approx((math.radians(19), math.radians(40)))
    assert problem.bounds["pitch_mean"] == bat.bounds["pitch_mean"]
    limits = {(c.quantity.name, c.at_most): c.limit for c in problem.subject_to}
    assert limits["positive_power_per_mass", True] == pytest.approx(105.8, rel=1e-3)
    assert limits["positive_power_per_mass", True] < 105.8
    assert ("strouhal", True) in limits
    assert ("strouhal", False) in limits
    slow = problem.at_speed(4.0)
    assert "strouhal" not in {c.quantity.name for c in slow.subject_to}
    assert len(slow.subject_to) == len(problem.subject_to) - 4
    assert slow.bounds == problem.bounds
    plain = wb.OrbitProblem(bat, speed=10.0)
    assert plain.at_speed(4.0) == dataclasses.replace(plain, speed=4.0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--flap-amplitude-max", "10"], "bounds.flap_amplitude"),
        (["--subject-to", "flap_amplitude=70 deg"], "wingbeat.flap_amplitude = 1.2217"),
        (["--speed", "40"], "gives a Reynolds number of 2.67e+05, outside the plausible range (at most 1.2e+05)"),
    ],
)
def test_what_leaves_nothing_plausible_is_refused(words: list[str], said: str, capsys: Any) -> None:
    speed = [] if "--speed" in words else ["--speed", "10"]
    assert main(["orbit", "bat", *speed, "--within-plausible", *words]) == 2
    assert said in " ".join(capsys.readouterr().err.split())


def test_a_study_searches_inside_what_is_plausible(tmp_path: Any) -> None:
    form = {"species": "bat", "speed": [5.0, 10.0], "bounds": "plausible"}
    study = wb.plan_study(form, store=tmp_path / "x.study.sqlite")
    recipe = recipe_from(json.loads(json.dumps(study.plan.bases[0].recipe.inputs())))
    assert recipe.problem({"speed": 10.0}).bounds["frequency"] == (4.0, 13.0)
    with pytest.raises(InvalidInputError, match="use 'plausible', or a table of \\[lower, upper\\] pairs"):
        wb.plan_study(form | {"bounds": "likely"}, store=tmp_path / "x.study.sqlite")


def test_bounds_of_another_word_are_refused() -> None:
    with pytest.raises(InvalidInputError, match="is not a known choice; use one of plausible"):
        wb.OrbitProblem(wb.load_species("bat"), speed=10.0, bounds="likely")


def test_what_a_limit_holds_exactly_is_within_its_range() -> None:
    pigeon = wb.load_species("pigeon")
    flown = wb.models.animal(pigeon).species(pigeon)
    for value, within in ((1.0 + 1e-8, True), (1.0 + 1e-4, False)):
        assert judged(flown, 12.0, "peak_activation", value)["within"] is within
