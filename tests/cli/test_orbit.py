"""The orbit command: record, table, files, figures, options, and a search that finds nothing."""

import functools
import json
import math
import re
import shlex
import subprocess
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.forks import ForkServer
from tests.helpers.terminals import needs_terminal, on_terminal
from wingbeat.cli import main

# The names of the record as it is documented.
NAMES = {
    "": "status message species model vehicle aero air speed climb objective objective_value constraints wingbeat "
    "frequency_basis "
    "initial_state active_bounds closure failed_balance relaxations optimality starts distinct_optima "
    "starts_at_best plausibility "
    "mean_power peak_power mean_positive_power mean_actuator_power peak_actuator_power cost_of_transport "
    "body_pitch_range strouhal reduced_frequency reynolds alpha_quarter_span alpha_three_quarter_span "
    "detached_share floquet_multipliers stable warnings solve_seconds version",
    "model": "name choices changed",
    "vehicle": "body wing",
    "vehicle.body": "mass pitch_inertia drag_area crossflow_area",
    "vehicle.wing": "semi_span chord mass mass_exponent shoulder stroke_plane_angle",
    "aero": "coefficients extension blend_width_deg strips force_point airspeed",
    "air": "density viscosity gravity",
    "wingbeat": "frequency flap_mean flap_amplitude pitch_mean pitch_amplitude span_retraction twist_ratio "
    "fold_amplitude wrist pitch_phase downstroke_fraction sweep_mean sweep_amplitude sweep_phase stroke_plane_tilt "
    "flap_harmonics pitch_harmonics span_harmonics",
    "initial_state": "x z body_pitch u w pitch_rate",
    "closure": "x z body_pitch u w pitch_rate",
    "constraints": "",
}
TABLE = "# a plate\nalpha_deg,c_l,c_d\n" + "".join(
    f"{a},{1.2 * math.sin(math.radians(2 * a)):.6f},{1.3 - 1.2 * math.cos(math.radians(2 * a)):.6f}\n"
    for a in range(0, 111, 10)
)


class Run(NamedTuple):
    """How a command line ended."""

    code: int
    out: str
    err: str


class Solved(NamedTuple):
    """One orbit found by the real program, with the files it left."""

    folder: Path
    ended: Run
    record: dict[str, Any]


PROGRAM = "import sys, warnings; warnings.simplefilter('error'); from wingbeat.cli import main; sys.exit(main())"


@pytest.fixture(scope="session")
def solved(tmp_path_factory: pytest.TempPathFactory, forks: ForkServer) -> Solved:
    folder = tmp_path_factory.mktemp("solved")
    words = shlex.split("orbit pigeon --speed 12 --starts 1 --json -o orbit.nc --plot page.svg")
    found = forks.start(PROGRAM, words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    out, err = found.communicate()
    return Solved(folder, Run(found.returncode, out, err), json.loads(out))


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run `wingbeat orbit` in this process with one search."""
    monkeypatch.setenv("COLUMNS", "80")

    def run_here(*words: object) -> Run:
        code = main(["orbit", *map(str, words), "--starts", "1"])
        return Run(code, *capsys.readouterr())

    return run_here


def names_of(record: dict[str, Any], path: str = "") -> dict[str, set[str]]:
    """Return the names of a record and of every table in it."""
    found = {path: set(record)}
    for name, value in record.items():
        if isinstance(value, dict):
            found |= names_of(value, f"{path}.{name}".strip("."))
    return found


@pytest.fixture
def asked(solved: Solved, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Whatever is asked for, the orbit at hand is the answer; what was asked for is listed here."""
    questions: list[Any] = []

    def answer(*question: Any, **_: Any) -> wb.Orbit:
        questions.extend(question)
        return wb.load_orbit(solved.folder / "orbit.nc")

    monkeypatch.setattr("wingbeat.cli.orbit.solve_orbit", answer)
    return questions


@pytest.mark.slow
def test_json_is_the_record_and_nothing_else(solved: Solved) -> None:
    assert (solved.ended.code, solved.ended.err) == (0, "")
    record = solved.record  # all of stdout was one JSON text
    assert names_of(record) == {path: set(names.split()) for path, names in NAMES.items()}
    assert record["status"] == "converged"
    assert (record["species"], record["speed"], record["climb"], record["starts"]) == ("pigeon", 12.0, 0.0, 1)
    assert record["version"] == wb.__version__
    assert max(abs(miss) for miss in record["closure"].values()) < 1e-6
    assert len(record["floquet_multipliers"]) == 4
    assert "NaN" not in solved.ended.out
    assert "Infinity" not in solved.ended.out


def test_numbers_of_the_record_follow_their_definitions(solved: Solved) -> None:
    r = solved.record
    body, wing, beat = r["vehicle"]["body"], r["vehicle"]["wing"], r["wingbeat"]
    weight = (body["mass"] + 2 * wing["mass"]) * r["air"]["gravity"]
    speed, frequency = r["speed"], beat["frequency"]
    expected = {
        "cost_of_transport": r["mean_positive_power"] / (weight * speed),
        "strouhal": 2 * frequency * wing["semi_span"] * math.sin(beat["flap_amplitude"]) / speed,
        "reduced_frequency": math.pi * frequency * wing["chord"] / speed,
        "reynolds": speed * wing["chord"] / r["air"]["viscosity"],
    }
    assert {name: r[name] for name in expected} == pytest.approx(expected, rel=1e-12)
    assert r["stable"] == (max(math.hypot(*pair) for pair in r["floquet_multipliers"]) < 1)


def test_the_files_asked_for_and_no_others(solved: Solved) -> None:
    assert sorted(path.name for path in solved.folder.iterdir()) == ["orbit.nc", "page.svg"]
    page = (solved.folder / "page.svg").read_text()
    assert page.lstrip().startswith("<?xml")
    assert len(page) > 10_000
    with xr.open_dataset(solved.folder / "orbit.nc", engine="h5netcdf") as dataset:
        for name, variable in dataset.variables.items():
            assert variable.attrs.get("units") or name in ("axis", "corner"), name


def test_show_gives_the_same_record(solved: Solved, capsys: Any) -> None:
    assert main(["show", str(solved.folder / "orbit.nc"), "--json"]) == 0
    assert capsys.readouterr().out == solved.ended.out


@needs_terminal
def test_from_a_file_the_record_comes_again_bit_for_bit(solved: Solved, forks: ForkServer) -> None:
    """Also: on a terminal, stderr shows how far the search is, and stdout still holds the record alone."""
    words = ("orbit", "--from", solved.folder / "orbit.nc", "--json")
    code, out, bar = on_terminal(functools.partial(forks.start, PROGRAM, words))
    assert code == 0
    again = json.loads(out)
    assert "pigeon at 12 m/s" in bar
    assert re.search(r"\d/[1?]", bar)
    assert "error" not in bar
    # json.loads and == hold the numbers to their last bit.
    assert again.pop("solve_seconds") > 0
    assert again == {name: value for name, value in solved.record.items() if name != "solve_seconds"}


def test_the_library_finds_the_same_orbit_in_the_file(solved: Solved) -> None:
    orbit = wb.load_orbit(solved.folder / "orbit.nc")
    assert orbit.record() == solved.record
    assert orbit.problem.speed == 12.0
    assert (orbit.inputs["starts"], orbit.inputs["seed"]) == (1, 0)


def test_the_table_and_a_bound_and_a_mass(run: Any, solved: Solved, tmp_path: Path) -> None:
    """The table, for an orbit with less flap amplitude and heavier wings; nothing else may have moved."""
    path = tmp_path / "orbit.nc"
    words = ("pigeon", "--speed", 12, "--flap-amplitude-max", 45, "--set", "wing.mass=0.021", "-o", path)
    ended = run(*words)
    assert (ended.code, ended.err) == (0, "")
    lines = ended.out.splitlines()
    assert re.fullmatch(r"certified: closes to \de-\d\d", lines[0].rstrip())
    assert lines[1].startswith("plausible: ")
    assert max(map(len, lines)) <= 80
    assert "\x1b" not in ended.out
    assert re.search(r"^  flap amplitude +45 deg \(set by the limit\) *$", ended.out, re.MULTILINE)
    assert re.search(r"^  species, mean speed +pigeon at 12 m/s *$", ended.out, re.MULTILINE)

    record = wb.load_orbit(path).record()
    assert "flap_amplitude" in record["active_bounds"]
    assert record["wingbeat"]["flap_amplitude"] == pytest.approx(math.radians(45), abs=1e-9)
    assert record["wingbeat"]["frequency"] > solved.record["wingbeat"]["frequency"]
    before, after = solved.record["vehicle"], record["vehicle"]
    assert (before["wing"].pop("mass"), after["wing"].pop("mass")) == (0.02, 0.021)
    assert after == before  # so the whole mass has grown by that of the wings
    mass = after["body"]["mass"] + 2 * 0.021
    power = re.search(r"hinges, mean +(\S+) W \((\S+) W/kg\)", ended.out)
    assert power is not None
    assert float(power[2]) == pytest.approx(float(power[1]) / mass, rel=1e-3)


@pytest.mark.slow
def test_a_table_of_ones_own_with_fewer_strips_climbing(run: Any, tmp_path: Path) -> None:
    (tmp_path / "plate.csv").write_text(TABLE)
    words = ("pigeon", "--speed", 10, "--climb", 1, "--aero", tmp_path / "plate.csv", "--strips", 5)
    ended = run(*words, "-o", tmp_path / "orbit.nc", "--json")
    record = json.loads(ended.out)
    assert (ended.code, ended.err, record["status"]) == (0, "", "converged")
    assert (record["speed"], record["climb"]) == (10.0, 1.0)
    assert (record["aero"]["coefficients"], record["aero"]["strips"]) == ("plate", 5)
    with xr.open_dataset(tmp_path / "orbit.nc", engine="h5netcdf") as dataset:
        risen = float(dataset["z"][-1] - dataset["z"][0])
    assert risen * record["wingbeat"]["frequency"] == pytest.approx(1.0, abs=1e-5)
    # The file needs the table no more: its numbers are inside.
    (tmp_path / "plate.csv").unlink()
    problem = wb.load_orbit(tmp_path / "orbit.nc").problem
    assert problem.aero.coefficients.alpha_deg == tuple(range(0, 111, 10))


def test_every_option_reaches_the_problem(asked: list[Any], capsys: Any) -> None:
    options = (
        "--climb=-0.5 --aero dickinson --extension signed --blend-width-deg 2 --strips 7 --starts 3 --seed 4 "
        "--flap-amplitude-max 40 --set wing.mass=0.002 air.density=1.0 --set wingbeat.twist_ratio=0.5"
    )
    assert main(["orbit", "bat", "--speed", "8", *options.split(), "--json"]) == 0
    problem, starts, seed, progress = asked
    assert (starts, seed, callable(progress)) == (3, 4, True)
    assert (problem.species.name, problem.speed, problem.climb) == ("bat", 8.0, -0.5)
    coefficients = problem.aero.coefficients
    about = (coefficients.name, coefficients.extension, coefficients.blend_width_deg, problem.aero.strips)
    assert about == ("dickinson", "signed", 2.0, 7)
    stock = wb.load_species("bat")
    least = stock.bounds["flap_amplitude"][0]
    assert problem.bounds["flap_amplitude"] == (least, math.radians(40))
    assert problem.bounds["frequency"] == stock.bounds["frequency"]
    assert (problem.vehicle.wing.mass, problem.air.density) == (0.002, 1.0)
    assert problem.vehicle.mass == pytest.approx(stock.vehicle.body.mass + 0.004)
    assert problem.species.wingbeat.twist_ratio == 0.5
    asked.clear()
    assert main(["orbit", "pigeon", "--speed", "0", "--force-point", "centre-of-pressure"]) == 0
    assert (asked[0].aero.force_point, *asked[1:3]) == ("centre-of-pressure", None, 0)
    asked.clear()
    assert main(["orbit", "pigeon", "--speed", "0", "--airspeed", "full"]) == 0
    assert asked[0].aero.airspeed == "full"
    capsys.readouterr()


@pytest.mark.slow
def test_figures_by_their_suffix(asked: list[Any], tmp_path: Path, capsys: Any) -> None:
    for suffix, magic in ((".png", b"\x89PNG"), (".pdf", b"%PDF"), (".SVG", b"<?xml")):
        page = tmp_path / f"page{suffix}"
        assert main(["orbit", "pigeon", "--speed", "12", "--plot", str(page)]) == 0
        assert page.read_bytes().startswith(magic)
    assert len(list(tmp_path.iterdir())) == 3
    assert capsys.readouterr().err == ""


@pytest.mark.slow
def test_an_infeasible_problem_exits_with_3(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    few = wb.SolverOptions(search=wb.SearchOptions(most_starts=1))  # the other 49 find nothing either
    monkeypatch.setattr("wingbeat.cli.orbit.solve_orbit", functools.partial(wb.solve_orbit, options=few))
    words = ("pigeon", "--speed", 12, "--flap-amplitude-max", 6, "-o", tmp_path / "orbit.nc")
    ended = run(*words, "--json", "--plot", tmp_path / "page.png")
    record = json.loads(ended.out)
    assert (ended.code, ended.err) == (3, "")
    assert record["status"] == "infeasible"
    assert record["stable"] is None
    pattern = r"no orbit within the bounds.*thrust is short of drag.*changes that give an orbit"
    assert re.search(pattern, record["message"])
    assert {path.name for path in tmp_path.iterdir()} == {"orbit.nc", "page.png"}
    assert wb.load_orbit(tmp_path / "orbit.nc").record() == record
    assert main(["show", str(tmp_path / "orbit.nc")]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith("not certified, infeasible: no orbit within the bounds")
    assert re.search(r"unbalanced at the closest.*\n +thrust +\S+ N, \d+ % of the weight", shown)
    assert re.search(r"either +upper bound of flap amplitude 6 -> 20", shown)


def test_an_interrupt_leaves_the_old_files(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stop(*_: Any, **__: Any) -> None:
        assert sorted(path.name for path in tmp_path.iterdir()) == ["orbit.nc", "page.pdf"]
        raise KeyboardInterrupt

    monkeypatch.setattr("wingbeat.cli.orbit.solve_orbit", stop)
    for name in ("orbit.nc", "page.pdf"):
        (tmp_path / name).write_text("old")
    ended = run("pigeon", "--speed", 9, "-o", tmp_path / "orbit.nc", "--plot", tmp_path / "page.pdf")
    assert ended == (130, "", "error: interrupted\n")
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"orbit.nc": "old", "page.pdf": "old"}


def test_a_full_disk_is_one_line(
    asked: list[Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Any
) -> None:
    """A limit on the size of files stands in for the full disk; HDF5 by itself would even crash."""
    resource = pytest.importorskip("resource")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "orbit.nc").write_text("old")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, before[1]))
    try:
        code = main(["orbit", "pigeon", "--speed", "12", "-o", "orbit.nc"])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    told = capfd.readouterr()
    assert code == 2
    assert told.out.startswith("certified")  # the answer is not lost
    assert told.err == "error: cannot write 'orbit.nc': file too large; choose another path\n"
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("orbit.nc", "old")]


@pytest.mark.parametrize(
    ("aero", "speed", "best"),
    [("su-fan", 13.75, 11.359), ("dickinson", 9.0, 8.211), ("dickinson", 9.25, 8.412), ("dickinson", 9.5, 8.616)],
)
def test_the_default_search_finds_the_best_where_it_once_missed(aero, speed, best, capsys):
    """There, default answers for the bat were up to 22 % too high; the best is that of the fine sweep."""
    assert main(["orbit", "bat", "--speed", str(speed), "--aero", aero, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["wingbeat"]["frequency"] == pytest.approx(best, rel=5e-4)
