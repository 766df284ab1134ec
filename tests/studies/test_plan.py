"""From a study file to its points: which there are, their keys, and every fault told at once."""

import itertools
import math
import re

import pytest
from fuzz import STUDIES

import wingbeat as wb
from tests.helpers.species_texts import GOOD, SPECIES
from wingbeat.cli import main
from wingbeat.studies.form import check_form
from wingbeat.studies.recipe import recipe_from


def plan(store="x.study.sqlite", **form):
    return wb.plan_study({"species": "pigeon", "starts": 1} | form, store=store).plan


def keys(**form):
    return {point.key for point in plan(**form).points()}


def test_the_form_of_the_issue(tmp_path):
    file = tmp_path / "wings.toml"
    file.write_text(STUDIES[0])
    study = wb.plan_study(file)
    assert study.store == tmp_path / "wings.study.sqlite"
    points = list(study.plan.points())
    assert len(study) == len(points) == len({p.key for p in points}) == 36
    assert [base.told for base in study.plan.bases] == [
        {"species": s, "aero": a} for s, a in itertools.product(("pigeon", "bat"), ("su-fan", "dickinson"))
    ]
    masses = {p.values[1] for p in points if study.plan.bases[p.base].recipe.species.name == "bat"}
    bat = wb.load_species("bat").vehicle.wing.mass
    assert masses == {0.8 * bat, bat, 1.2 * bat}
    problem = study.plan.bases[3].recipe.problem(points[-1].changes)
    assert (problem.species.name, problem.aero.coefficients.name) == ("bat", "dickinson")
    assert (problem.speed, problem.vehicle.wing.mass) == (10.0, 1.2 * bat)


def test_keys_hang_on_inputs_alone():
    some = keys(vary={"speed": {"grid": [8.0, 9.0]}})
    assert some == keys(vary={"speed": {"grid": [9, 8]}}, aero=["su-fan"], seed=0)
    assert some == keys(speed=[8.0, 9.0])
    assert some < keys(vary={"speed": {"grid": [7.0, 8.0, 9.0]}})
    # What is varied to what it was anyway is the same point.
    assert some < keys(vary={"speed": {"list": [8.0, 9.0]}, "wing.mass": {"relative": [1.0, 1.1]}})
    for changed in ({"seed": 1}, {"starts": 2}, {"aero": "dickinson"}, {"minimise": "power"}, {"climb": 1.0}):
        assert not some & keys(**{"vary": {"speed": {"grid": [8.0, 9.0]}}} | changed)
    assert not some & keys(vary={"speed": {"grid": [8.0, 9.0]}}, set={"air.density": 1.0})
    assert not some & keys(vary={"speed": {"grid": [8.0, 9.0]}}, bounds={"flap_amplitude_deg": [5.0, 60.0]})


def test_a_key_is_the_same_on_every_machine_until_the_numbers_change(tmp_path):
    (tmp_path / "kite.toml").write_text(SPECIES.format(**GOOD))
    (key,) = keys(species=str(tmp_path / "kite.toml"), speed=8.0)
    # Another one throws everybody's stores away: raise NUMERICAL_VERSION, and say so in the changelog.
    assert key == "0e9f710f97c56dd79bc4e99cb465d790677c0134725b87c01fd7ee9f14020de5"


def test_points_of_a_chain_know_those_before_them():
    short, long = (keys(vary={"speed": {"grid": list(s)}}, chain="speed") for s in ((7.0, 8.0), (7.0, 8.0, 9.0)))
    assert short < long
    assert len(short & keys(vary={"speed": {"grid": [8.0, 7.0]}}, chain="speed")) == 0
    found = list(
        plan(vary={"speed": {"grid": [7.0, 8.0]}, "wing.mass": {"relative": [1.0, 1.1]}}, chain="speed").points()
    )
    assert [p.unit for p in found] == [0, 0, 1, 1]
    assert [p.values[-1] for p in found] == [7.0, 8.0, 7.0, 8.0]


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
def test_samples_lie_within_their_ranges_and_multiply_with_the_grid(method):
    vary = {
        "wing.mass": {"relative_range": [0.9, 1.1]},
        "speed": {"range": [6.0, 14.0]},
        "climb": {"grid": [0.0, 1.0]},
    }
    found = [p.values for p in plan(vary=vary, sample={"method": method, "n": 25}).points()]
    mass = wb.load_species("pigeon").vehicle.wing.mass
    assert len(found) == 50
    assert all(0.9 * mass <= m <= 1.1 * mass and 6.0 <= u <= 14.0 for m, u, _ in found)
    for column in (0, 1):
        assert len({values[column] for values in found}) == 25
    again = [p.values for p in plan(vary=vary, sample={"method": method, "n": 25}).points()]
    other = [p.values for p in plan(vary=vary, sample={"method": method, "n": 25, "seed": 1}).points()]
    assert found == again != other


def test_more_of_a_sobol_sample_keeps_the_points_there_were():
    vary = {"speed": {"range": [6.0, 14.0]}}
    assert keys(vary=vary, sample={"n": 5}) < keys(vary=vary, sample={"n": 20})


def test_lists_go_row_by_row():
    found = plan(vary={"speed": {"list": [7.0, 9.0]}, "aero.extension": {"list": ["mirrored", "signed-drag"]}})
    assert [p.values for p in found.points()] == [[7.0, "mirrored"], [9.0, "signed-drag"]]


@pytest.mark.parametrize(
    ("path", "value", "told"),
    [
        ("wing.shoulder", [0.01, 0.0, 0.02], lambda p: p.vehicle.wing.shoulder == (0.01, 0.0, 0.02)),
        ("wing.stroke_plane_angle_deg", 80.0, lambda p: p.vehicle.wing.stroke_plane_angle == math.radians(80.0)),
        ("air.density", 1.0, lambda p: p.air.density == 1.0),
        ("wingbeat.span_retraction", 0.2, lambda p: p.species.wingbeat.span_retraction == 0.2),
        ("payload", 0.05, lambda p: p.vehicle.mass == pytest.approx(0.366)),
        ("climb", 1.0, lambda p: p.climb == 1.0),
        ("aero.extension", "signed-drag", lambda p: p.aero.coefficients.extension == "signed-drag"),
        ("aero.strips", 5, lambda p: p.aero.strips == 5),
        ("aero.force_point", "centre-of-pressure", lambda p: p.aero.force_point == "centre-of-pressure"),
        ("aero.airspeed", "full", lambda p: p.aero.airspeed == "full"),
        ("aero.hand", "feathered", lambda p: p.aero.hand.name == "feathered"),
        ("aero.upstroke_factor", 0.3, lambda p: p.aero.upstroke_factor == 0.3),
        ("aero.lift.amplitude", 1.3, lambda p: p.aero.coefficients.lift_terms.amplitude == 1.3),
        ("bounds.flap_amplitude.upper", 1.0, lambda p: p.bounds["flap_amplitude"][1] == 1.0),
        ("limit.peak_power", 70.0, lambda p: p.subject_to[0].limit == 70.0),
    ],
)
def test_every_kind_of_path_reaches_the_problem(path, value, told):
    made = plan(speed=9.0, subject_to="peak_power<=80", vary={path: {"grid": [value]}})
    (point,) = made.points()
    recipe = recipe_from(made.bases[0].recipe.inputs())  # as it comes to a worker
    assert told(recipe.problem(point.changes))
    assert recipe.inputs() == made.bases[0].recipe.inputs()


FAULTS = [
    ({}, "species = nothing: must be given"),
    ({"species": "pigeon"}, "speed = nothing: must be given; write speed = 10.0, or under [vary]"),
    ({"species": "pidgeon", "speed": 9.0}, "species = 'pidgeon': is not a built-in species; did you mean pigeon"),
    ({"species": 3, "speed": 9.0}, "species = 3: must be a text; put it in quotes"),
    ({"species": ["pigeon", "pigeon"], "speed": 9.0}, "names a value twice; keep one of them"),
    ({"species": "pigeon", "sped": 9.0}, "sped = 9.0: is not a known key; did you mean speed"),
    ({"species": "pigeon", "speed": -1.0}, "speed = -1.0: must be >= 0 and <= 100 m/s"),
    ({"species": "pigeon", "speed": math.nan}, "speed = nan: must be finite"),
    ({"species": "pigeon", "speed": 9.0, "starts": 0}, "starts = 0: must be a whole number from 1 to 100000"),
    ({"species": "pigeon", "speed": 9.0, "starts": 1.5}, "starts = 1.5: must be a whole number"),
    (
        {"species": "pigeon", "speed": 9.0, "aero": "sufan"},
        "is not a known coefficient model; did you mean su-fan?",
    ),
    ({"species": "pigeon", "speed": 9.0, "minimise": "powr"}, "is not known to wingbeat"),
    ({"species": "pigeon", "speed": 9.0, "minimise": "no.py:f"}, "cannot read"),
    ({"species": "pigeon", "speed": 9.0, "subject_to": "power<30"}, "power<30"),
    ({"species": "pigeon", "speed": 9.0, "free": []}, "free = []: must hold at least 1 values"),
    ({"species": "pigeon", "speed": 9.0, "free": ["flap"]}, "is not a wingbeat parameter that can be free"),
    ({"species": "pigeon", "speed": 9.0, "set": {"wing.mas": 1.0}}, "wing.mas = 1.0: no number has this path"),
    ({"species": "pigeon", "speed": 9.0, "bounds": {"flap_amplitude": [2.0, 1.0]}}, "lower must be below upper"),
    ({"species": "pigeon", "speed": 9.0, "chain": "climb"}, "chain = 'climb': is not a parameter varied by grid"),
    (
        {"species": "pigeon", "speed": 9.0, "advise": True, "explain": False},
        "advise = True: cannot be combined with explain = false; leave one of them out",
    ),
]
VARY_FAULTS = [
    ({"speed": 9.0}, "vary.speed = 9.0: must be a table; for example { grid = [6.0, 8.0] }"),
    ({"speed": {}}, "vary.speed = nothing: must be given by exactly one of grid, relative, list, range"),
    ({"speed": {"grid": [9.0], "list": [9.0]}}, "vary.speed = 'grid, list': must be given by exactly one of"),
    ({"speed": {"grid": []}}, "must hold at least 1 values"),
    ({"speed": {"gird": [9.0]}}, "vary.speed.gird = [9.0]: is not a known key; did you mean grid?"),
    ({"speed": {"grid": [9.0, -1.0]}}, "vary.speed.grid[1] = -1.0: must be >= 0 and <= 100 m/s"),
    ({"speed": {"grid": [9.0, 9]}}, "vary.speed.grid = [9.0, 9]: names a value twice"),
    ({"speed": {"grid": ["fast"]}}, "vary.speed.grid[0] = 'fast': must be a number"),
    ({"speed": {"relative": [1.0]}}, "vary.speed.relative = [1.0]: needs a value other than zero"),
    ({"aero.unsteady": {"relative": [1.0]}}, "relative = [1.0]: would multiply a word; use grid"),
    ({"speed": {"range": [9.0, 6.0]}}, "vary.speed.range = [9.0, 6.0]: must be [lowest, highest]"),
    ({"speed": {"range": [6.0, 9.0]}}, "sample = nothing: must be given, since speed has a range"),
    ({"wing.mass": {"grid": [-1.0]}}, 'vary."wing.mass".grid[0] = -1.0: must be > 0 kg'),
    ({"wing.mass": {"grid": ["heavy"]}}, "vary.\"wing.mass\".grid[0] = 'heavy': must be a number"),
    ({"wing.mas": {"grid": [1.0]}}, 'vary."wing.mas" = 1.0: no number has this path; did you mean wing.mass'),
    ({"mass": {"grid": [1.0]}}, "set body.mass or wing.mass; the whole mass follows from both"),
    ({"aero.extension": {"grid": ["mirored"]}}, "is not a known choice"),
    ({"aero.lift.amplitude": {"grid": ["big"]}}, "must be a number"),
    ({"aero.strips": {"grid": [2.5]}}, "must be a whole number from 1 to 1000"),
    (
        {"speed": {"list": [8.0, 9.0]}, "climb": {"list": [1.0]}},
        "has lists of unequal length, but lists are combined row by row",
    ),
]


@pytest.mark.parametrize(
    ("form", "words"), [*FAULTS, *(({"species": "pigeon", "speed": 9.0, "vary": v}, w) for v, w in VARY_FAULTS)]
)
def test_every_fault_is_told_before_anything_runs(form, words):
    if "speed" in form.get("vary", {}):
        del form["speed"]
    with pytest.raises(wb.WingbeatError) as told:
        wb.plan_study(form, store="x.study.sqlite")
    assert words in str(told.value)


def test_all_faults_come_at_once(tmp_path, capsys):
    file = tmp_path / "bad.toml"
    file.write_text(
        'species = ["pidgeon", "bat"]\nstarts = -1\nminimise = "powr"\n'
        '[vary]\nspeed = { grid = [8.0, -8.0] }\n"wing.mas" = { grid = [1.0] }\n'
    )
    assert main(["study", str(file)]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert "Traceback" not in told.err
    lines = told.err.splitlines()
    assert all(line.startswith("error: ") for line in lines)
    for words in ("pidgeon", "starts = -1", "powr"):
        assert sum(words in line for line in lines) == 1, told.err
    assert not list(tmp_path.glob("*.sqlite*"))


def test_each_path_that_is_not_there_is_told():
    """The first was once the only one that was told."""
    vary = {path: {"grid": [0.9, 1.1]} for path in ("mass", "wing.spam", "wing.cord")}
    with pytest.raises(wb.InvalidInputError) as told:
        wb.plan_study({"species": "pigeon", "speed": 9.0, "vary": vary}, store="x.study.sqlite")
    assert str(told.value).count("no number has this path") == 3


@pytest.mark.parametrize(
    ("form", "words"),
    [
        ({"vary": {"wingbeat.flap_amplitude": {"grid": [0.3, 0.6]}}}, "is free: the solver would overwrite it"),
        ({"vary": {"wingbeat.frequency": {"grid": [7, 8]}}}, "vary bounds.frequency.lower or .upper"),
        ({"vary": {"wingbeat.pitch_mean_deg": {"grid": [3, 6]}}, "free": ["pitch_mean", "frequency"]}, "is free"),
        ({"bounds": {"frequency_deg": [60, 500]}}, "is not the name of an angle; give bounds.frequency"),
        (
            {"bounds": {"flap_amplitude_deg": [5, 40], "flap_amplitude": [0.1, 1.2]}},
            "is given as flap_amplitude too",
        ),
        ({"vary": {"body.drag_area": {"relative": [1, 2]}}}, "needs a value other than zero to be relative to"),
        ({"vary": {"climb": {"grid": [0.0, -0.0]}}}, "names a value twice"),
        (
            {"vary": {n: {"grid": [0.02, 0.021]} for n in ("wing.mass", "vehicle.wing.mass")}},
            "is varied as wing.mass too",
        ),
        (
            {"vary": {f"wing.stroke_plane_angle{d}": {"grid": [0.1, 0.2]} for d in ("", "_deg")}},
            "is varied as wing.stroke_plane_angle too",
        ),
        ({"strips": [5, 8], "vary": {"aero.strips": {"grid": [5, 8]}}}, "is also varied"),
    ],
)
def test_what_could_be_misread_is_refused(form, words):
    with pytest.raises(wb.InvalidInputError, match=re.escape(words)):
        plan(**{"speed": 9.0} | form)


def test_what_is_not_free_may_be_varied():
    made = plan(speed=9.0, free=["frequency", "flap_amplitude"], vary={"wingbeat.pitch_mean": {"grid": [0.1, 0.2]}})
    assert [point.changes["wingbeat.pitch_mean"] for point in made.points()] == [0.1, 0.2]


def test_a_range_of_a_list_is_sampled_item_by_item():
    vary, chords = {"wing.chord": {"relative_range": [0.9, 1.1]}}, [0.12, 0.10]
    made = plan(speed=9.0, vary=vary, set={"wing.chord": chords}, sample={"n": 4})
    shares = [[new / old for new, old in zip(point.values[0], chords, strict=True)] for point in made.points()]
    assert len({round(share, 9) for share, _ in shares}) == 4
    for inner, outer in shares:
        assert inner == pytest.approx(outer)
        assert 0.9 <= inner <= 1.1


def test_a_users_file_that_leaves_is_refused(tmp_path):
    (tmp_path / "mine.py").write_text("import sys\nsys.exit(0)\n")
    (tmp_path / "study.toml").write_text('species = "pigeon"\nspeed = 9.0\nminimise = "mine.py:f"\n')
    with pytest.raises(wb.InvalidInputError, match="cannot be run: SystemExit"):
        wb.plan_study(tmp_path / "study.toml")


def test_too_many_points_are_refused():
    with pytest.raises(wb.InvalidInputError, match="points are more than 10000000"):
        plan(
            vary={
                f"wingbeat.{name}": {"grid": [i / 1e4 for i in range(400)]}
                for name in ("span_retraction", "twist_ratio", "pitch_phase")
            },
            speed=9.0,
        )


@pytest.mark.parametrize("words", [["-j", "0"], ["-j", "1.5"], *(["--timeout", t] for t in ("0", "nan", "1e12"))])
def test_options_out_of_range_are_refused(words, tmp_path, capsys):
    file = tmp_path / "good.toml"
    file.write_text('species = "pigeon"\nspeed = 9.0\n')
    assert main(["study", "run", str(file), *words]) == 2
    assert capsys.readouterr().err.startswith("error: ")
    assert main(["study", "status", str(file)]) == 0
    assert "1 points" in capsys.readouterr().out


def test_a_form_may_hold_what_python_holds():
    import numpy as np

    form, faults = check_form({"species": ("pigeon",), "vary": {"speed": {"grid": np.arange(6.0, 9.0)}}})
    assert not faults.faults
    assert form.vary["speed"].values == [6.0, 7.0, 8.0]


@pytest.mark.parametrize("source", [5, b"wings.toml", ["wings.toml"]])
def test_what_is_no_study_is_refused(source):
    with pytest.raises(
        wb.InvalidInputError, match=r"source = .* is neither a path nor a dictionary; give a study file"
    ):
        wb.plan_study(source)


def test_a_mistyped_subcommand_is_not_taken_for_a_file(tmp_path, monkeypatch, capsys):
    (tmp_path / "wings.toml").write_text(STUDIES[0])
    monkeypatch.chdir(tmp_path)
    for words in ("statu wings.toml", "statu"):
        assert main(["study", *words.split()]) == 2
        told = "error: study = 'statu': is neither a file nor a subcommand; did you mean status?\n"
        assert capsys.readouterr().err == told
    # A file may have the name of anything.
    (tmp_path / "statu").write_text("species = 3")
    assert main(["study", "statu"]) == 2
    assert "species = 3: must be a text" in capsys.readouterr().err


def test_a_study_by_both_models():
    """What the study does not give is as the model says; what it gives replaces that."""
    bases = plan(species=["pigeon", "bat"], model=["paper", "animal"], speed=8.0).bases
    assert [(base.told["species"], base.told["model"]) for base in bases] == [
        (species, model) for species in ("pigeon", "bat") for model in ("paper", "animal")
    ]
    for base in bases:
        species = wb.load_species(base.told["species"])
        model = wb.models.model_of(base.told["model"], species)
        found, wanted = base.recipe.example, model.problem(species, 10.0)
        compared = "species", "aero", "free", "bounds", "minimise", "own_frequency", "own_posture"
        assert {n: getattr(found, n) for n in compared} == {n: getattr(wanted, n) for n in compared}
    own = plan(model="animal", aero="dickinson", inflow="none", minimise="frequency", speed=8.0).bases[0].recipe
    assert (own.aero.coefficients.name, own.aero.unsteady, own.aero.inflow) == (
        "dickinson",
        "thin-aerofoil",
        "none",
    )
    assert own.objective == {"name": "frequency"}
    assert own.species.vehicle.muscle is not None


def test_a_varied_number_that_equals_the_stock_one_is_flown():
    """The animal's own frequency and posture change with speed: no stock value stands for them."""
    vary = {"wingbeat.frequency": {"grid": [6.0, 6.5]}}
    varied = plan(species=["pigeon"], model="animal", speed=12.0, vary=vary)
    flown = [varied.bases[0].recipe.problem(point.changes) for point in varied.points()]
    assert [(one.species.wingbeat.frequency, one.frequency_basis) for one in flown] == [
        (6.0, "given"),
        (6.5, "given"),
    ]
    lower = plan(species=["pigeon"], model="animal", speed=12.0).bases[0].recipe.example.bounds["body_pitch"][0]
    varied = plan(
        species=["pigeon"], model="animal", speed=12.0, vary={"bounds.body_pitch.lower": {"grid": [lower]}}
    )
    [point] = varied.points()
    assert varied.bases[0].recipe.problem(point.changes).bounds["body_pitch"][0] == lower
    relative = {"wingbeat.frequency": {"relative": [0.9, 1.1]}}
    with pytest.raises(wb.InvalidInputError, match="the animal's own changes with speed; use grid or range"):
        plan(species=["pigeon"], model="animal", speed=12.0, vary=relative)


def test_an_unknown_model_of_a_study_is_refused():
    with pytest.raises(wb.InvalidInputError, match=r"model = 'beast'"):
        plan(model="beast", speed=8.0)


def test_a_study_of_a_hinge_has_its_force_where_a_problem_has_it():
    form = {"species": "robofalcon2", "speed": 8.0, "set": {"pitch_hinge.stiffness": 1.4}}
    (base,) = plan(**form).bases
    assert base.recipe.aero.force_point == "centre-of-pressure"
    (asked,) = plan(**form, force_point="quarter-chord").bases
    assert asked.recipe.aero.force_point == "quarter-chord"
    (rigid,) = plan(species="robofalcon2", speed=8.0).bases
    assert rigid.recipe.aero.force_point == "quarter-chord"
