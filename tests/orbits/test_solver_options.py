"""Options of the solvers: checked when made, obeyed by every verb, kept with the answer; and no tuning outside."""

import ast
import dataclasses
from pathlib import Path

import pytest

import wingbeat as wb
from wingbeat.orbits.options import DEFAULTS

CLASSES = [type(getattr(DEFAULTS, field.name)) for field in dataclasses.fields(DEFAULTS)]
CLASSES += [wb.NewtonOptions, wb.LeastSquaresOptions, wb.SolverOptions]
ORBITS = Path(wb.__file__).parent / "orbits"

# Numbers of modules that tune no search: sizes of compiled programs and memories, formats, limits of the physics.
NOT_TUNING = {
    "_REMEMBERED": "flights or problems kept in memory",
    "_OVERFLOW": "where squares of floats overflow",
    "_UNBOUNDED": "no bound, as a number that SLSQP takes",
    "SAMPLES": "of a record's series",
    "_ROUGH_SAMPLES": "of a path that is only measured for its peak",
    "_SAMPLES": "of a beat that gives shapes only",
    "STEPS": "of one compiled flight; finer flights chain several",
    "PARTS": "in which a series has a peak each: the rows of a compiled program",
    "QUARTERS": "of the beat in which the stroke is measured: the rows of a compiled program",
    "_STEPS": "of the compiled program of the multipliers",
    "_LANES": "of the compiled program of the multipliers",
    "_MOST_PROCESSES": "limit at the door",
    "_MOST": "limit at the door",
    "FASTEST": "limit at the door",
    "FASTEST_CLIMB": "limit at the door",
    "_BRISK": "in the table of start families, which is an option",
    "_ROUNDING": "of decimal numbers in a file",
    "_INSET": "share by which plausible ranges are drawn in, so that an answer at the edge is inside",
    "_HALVED": "how often a reach beyond what can be is halved",
    "_LEAST": "the least change that is worth a digit of its own",
    "_QUARTER_TURN": "an angle",
    "_NEWTON": "steps of the compiled program of the stroke's distances",
    "_ANY_FLAP": "an angle beyond which there is no wingbeat",
    "_AMPLITUDE": "an angle beyond which there is no wingbeat",
    "_HARMONIC": "beyond which there is no wingbeat",
    "_AROUND": "a guessed range of a wing's numbers, which error bars draw from",
    "_BESIDE": "steps of difference quotients of the stroke map",
    "STABLE_RADIUS": "the limit that --stable stands for",
    "_EQUAL": "units in the definition of the gust response",
    "_STEADY": "where the gust response, which has no value beyond 1, goes over into a penalty",
    "_BEYOND": "slope of that penalty",
    "_WEIGHT": "scale of one of the conditions of stability, as `scale` of other quantities",
    "_CENTRAL": "weights of a difference quotient",
    "_UPWARDS": "weights of a difference quotient",
}


PLAIN = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.Tuple, ast.operator, ast.unaryop, ast.expr_context, ast.Name)


def numbers_of_modules():
    """Yield (file, name) of every module constant in `orbits` that is a plain number."""
    for path in sorted(ORBITS.rglob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                names = [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]
                values = [*ast.walk(node.value)]
                known = (
                    ast.Constant
                    | ast.UnaryOp
                    | ast.BinOp
                    | ast.Tuple
                    | ast.operator
                    | ast.unaryop
                    | ast.expr_context
                )
                plain = all(isinstance(value, known | ast.Name | ast.Attribute) for value in values)
                if plain and any(isinstance(v, ast.Constant) and isinstance(v.value, float | int) for v in values):
                    yield from ((path.relative_to(ORBITS), name) for name in names)


def test_no_number_of_a_module_tunes_a_search_from_outside_the_options():
    found = list(numbers_of_modules())
    assert {name for _, name in found} >= {"STEPS", "SAMPLES"}  # the scan sees something
    assert [f"{path}: {name}" for path, name in found if name not in NOT_TUNING] == []


@pytest.mark.parametrize("made", CLASSES)
def test_every_option_says_what_it_is(made):
    words = made.__doc__
    for field in dataclasses.fields(made):
        assert field.name in words, f"{made.__name__}.{field.name} is not in the docstring"


@pytest.mark.parametrize("made", CLASSES)
def test_every_option_is_read(made):
    package = ORBITS.parent
    own = {ORBITS / "options.py", ORBITS / "search_options.py"}
    code = "\n".join(p.read_text() for p in package.rglob("*.py") if p not in own)
    fields = [field.name for field in dataclasses.fields(made)]
    assert not [name for name in fields if f".{name}" not in code and made is not wb.SolverOptions]


@pytest.mark.parametrize(
    ("made", "given", "words"),
    [
        (wb.SearchOptions, {"iterations": 0}, r"SearchOptions.iterations.*from 1"),
        (wb.SearchOptions, {"iterations": 2.5}, r"SearchOptions.iterations.*whole number"),
        (wb.SearchOptions, {"tolerance": -1e-6}, r"SearchOptions.tolerance.*> 0"),
        (wb.CertificateOptions, {"rtol": float("nan")}, r"CertificateOptions.rtol.*finite"),
        (wb.DiagnosisOptions, {"raised_bounds": ()}, r"DiagnosisOptions.raised_bounds.*tuple"),
        (wb.DiagnosisOptions, {"raised_bounds": (2.0, "x")}, r"raised_bounds\[1\].*number"),
        (wb.SearchOptions, {"restoration": 3}, r"SearchOptions.restoration.*LeastSquaresOptions"),
        (wb.SolverOptions, {"search": wb.NewtonOptions()}, r"SolverOptions.search.*SearchOptions"),
    ],
)
def test_an_impossible_option_is_refused(made, given, words):
    with pytest.raises(wb.InvalidInputError, match=words):
        made(**given)


def test_all_faults_are_told_at_once():
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.SearchOptions(iterations=0, tolerance=0.0)
    assert len(refused.value.faults) == 2


def test_options_are_values():
    assert wb.SolverOptions() == DEFAULTS
    assert hash(wb.SolverOptions()) == hash(DEFAULTS)
    with pytest.raises(dataclasses.FrozenInstanceError):
        DEFAULTS.search.iterations = 3


def test_the_answer_keeps_the_options_that_are_not_the_defaults(pigeon_orbit, tmp_path):
    assert "options" not in pigeon_orbit.orbit.inputs
    rtol = wb.CertificateOptions(rtol=1e-9)
    options = wb.SolverOptions(search=wb.SearchOptions(iterations=50), certificate=rtol)
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1, options=options)
    told = {"search": {"iterations": 50}, "certificate": {"rtol": 1e-9}}
    assert orbit.inputs["options"] == told
    orbit.save(tmp_path / "orbit.nc")
    assert wb.load_orbit(tmp_path / "orbit.nc").inputs["options"] == told


def test_every_verb_obeys_the_options():
    """With one iteration nothing closes; the certificate that asks nothing of closure takes what is there."""
    problems = [wb.OrbitProblem(wb.load_species("pigeon"), speed=u) for u in (10.0, 11.0)]
    search = wb.SearchOptions(iterations=1, local_iterations=1, most_starts=1, restored_closure=1e-12)
    options = wb.SolverOptions(search=search)
    assert wb.solve_orbit(problems[0], starts=1).status is wb.Status.CONVERGED
    quick = {"starts": 1, "options": options}
    found = [
        *wb.solve_orbits(problems, **quick),
        *wb.solve_orbits(problems, in_order=True, **quick),
        *[o for row in wb.solve_curve(problems[0], [10.0, 11.0], **quick).record()["points"] for o in [row]],
    ]
    statuses = [one["status"] if isinstance(one, dict) else one.status.value for one in found]
    assert "converged" not in statuses


def test_derivatives_obey_the_options(pigeon_orbit):
    usual = wb.sensitivities(pigeon_orbit.orbit)
    rough = wb.SolverOptions(sensitivity=wb.SensitivityOptions(step=1e-3))
    found = wb.sensitivities(pigeon_orbit.orbit, options=rough)
    pairs = [(a.objective, b.objective) for a, b in zip(usual.slopes, found.slopes, strict=True)]
    assert any(one != other for one, other in pairs)
    assert all(one == pytest.approx(other, rel=0.02, abs=1e-3) for one, other in pairs)
