"""The command line around species: what it prints, what it refuses and how, and how soon it answers."""

import json
import os
import re
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from cyclopts import App

from wingbeat._base import FileError, __version__
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import species_names, template
from wingbeat.cli import main
from wingbeat.cli.app import COMMANDS, build_app

HEAVY = ("jax", "numpy", "scipy", "matplotlib", "xarray", "pandas", "pydantic", "diffrax")


def wingbeat(*words: str, **options: Any) -> subprocess.CompletedProcess[str]:
    """Run the real program, as a shell would."""
    command = [sys.executable, "-W", "error", "-m", "wingbeat"]
    return subprocess.run([*command, *words], capture_output=True, text=True, check=False, **options)


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run the program in this process: exit code, stdout, lines on stderr."""
    monkeypatch.setenv("COLUMNS", "160")

    def run_here(*words: str, app: App | None = None) -> tuple[int, str, list[str]]:
        code = main(words, app=app)
        printed = capsys.readouterr()
        return code, printed.out, printed.err.splitlines()

    return run_here


# --- the program itself ---


def test_help_names_every_command_and_imports_nothing_heavy() -> None:
    code = (
        "import sys; from wingbeat.cli import main; assert main(['--help']) == 0;"
        f"print('HEAVY', sorted(set({HEAVY!r}) & set(sys.modules)))"
    )
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert "HEAVY []" in shown
    for name in COMMANDS:
        assert f" {name} " in shown


@pytest.mark.slow
def test_help_takes_less_than_half_a_second_of_work() -> None:
    # CPU time and not the clock's: other tests run beside this one.
    def work() -> float:
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    def one() -> float:
        before = work()
        assert wingbeat("--help").returncode == 0
        return work() - before

    assert min(one() for _ in range(4)) < 0.5


def test_version_and_no_command() -> None:
    assert wingbeat("--version").stdout.strip() == __version__
    nothing = wingbeat()
    assert (nothing.returncode, nothing.stderr) == (0, "")
    assert "Usage: wingbeat COMMAND" in nothing.stdout


@pytest.mark.parametrize(
    ("words", "line"),
    [
        (["specis"], "error: unknown command 'specis'; did you mean species?"),
        (["--jsno"], "error: unknown option '--jsno'; use one of "),
        (["species", "--jsno"], "error: Unknown option: --jsno. Did you mean --json?"),
        (["species", "pigeon", "bat"], "error: "),
        (["species", "pigon"], "error: species = 'pigon': is not a built-in species; did you mean pigeon"),
        (["species", "none.toml"], "error: cannot read 'none.toml': no such file or directory"),
        (["species", "--set", "wing.mass=1"], "error: --set = 'no species': needs a species to change"),
        (["species", "pigeon", "--set", "wing.mas=1"], "error: wing.mas = 1.0: no number has this path; did"),
        (["species", "pigeon", "--alternative", "x"], "error: alternative = 'x': is unknown; use one of avin"),
        (["species", "new"], "error: "),
        (["species", "new", "no/such/folder/x.toml"], "error: cannot write 'no/such/folder/x.toml': no such"),
        (
            ["species", "new", "mine.txt"],
            "error: PATH = 'mine.txt': is not the name of a species file; end it in .toml",
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(run: Any, words: list[str], line: str) -> None:
    code, out, errors = run(*words)
    assert (code, out, len(errors)) == (2, "", 1)
    assert errors[0].startswith(line)


def test_the_real_program_ends_the_same_way(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text("[vehicle]\nmass = -1\n[air]\ndensity = 0\n")
    ended = wingbeat("species", "bad.toml", cwd=tmp_path)
    lines = ended.stderr.splitlines()
    assert (ended.returncode, ended.stdout) == (2, "")
    assert all(line.startswith("error: ") for line in lines)
    assert len(lines) > 5
    assert any(line.startswith("error: air.density = 0: must be > 0 kg/m3") for line in lines)


def test_a_command_whose_module_is_missing_does_not_break_the_others(
    run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(COMMANDS, "nowhere", "is not there")
    assert run("nowhere")[::2] == (2, ["error: the command 'nowhere' is not part of this installation"])
    assert run("species")[0] == 0
    assert "nowhere" in run("--help")[1]


def test_numbers_below_zero_are_values_and_codes_are_handed_on(run: Any) -> None:
    app, seen = build_app(), []

    @app.command
    def probe(*, climb: float, alpha: str) -> int:
        seen.append((climb, alpha))
        return 3

    assert run("probe", "--climb", "-1", "--alpha=-180:180:1", app=app)[0] == 3
    assert run("probe", "--climb=-1.5e-3", "--alpha", "-5", app=app)[0] == 3
    assert seen == [(-1.0, "-180:180:1"), (-1.5e-3, "-5")]


@pytest.mark.parametrize(
    ("error", "code", "lines"),
    [
        (KeyboardInterrupt(), 130, ["error: interrupted"]),
        (FileError("one\ntwo"), 2, ["error: one", "error: two"]),
        (SystemExit(5), 5, []),
        (SystemExit(None), 0, []),
    ],
)
def test_how_a_command_may_end(run: Any, error: BaseException, code: int, lines: list[str]) -> None:
    app = build_app()

    @app.command
    def probe() -> None:
        raise error

    assert run("probe", app=app)[::2] == (code, lines)


def test_a_fault_of_our_own_is_not_hidden(run: Any) -> None:
    app = build_app()

    @app.command
    def probe() -> None:
        raise ImportError("a broken installation")

    with pytest.raises(ImportError):
        run("probe", app=app)


@pytest.mark.slow
@pytest.mark.parametrize("words", ["--help", "species pigeon", "species pigeon --json"])
def test_a_reader_who_leaves_early_is_no_error(words: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-W", "error", "-m", "wingbeat", *words.split()]
    ended = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, check=False)
    os.close(writing)
    assert (ended.returncode, ended.stderr) == (141, b"")


# --- wingbeat species ---


def test_the_list(run: Any) -> None:
    code, out, errors = run("species")
    rows = {line.split()[0]: line for line in out.splitlines() if line.strip()}
    assert (code, errors) == (0, [])
    assert [word in rows["pigeon"] for word in ("316", "279", "112", "2.7 to 6.7")] == [True] * 4
    assert [word in rows["bat"] for word in ("68", "300", "100", "3.0 to 7.5")] == [True] * 4
    warning = " ".join(out.partition("warning: ")[2].split())
    assert "outside Su et al.'s Reynolds numbers (20000 to 50000) at 10 m/s: " in warning
    assert "pigeon" in warning
    assert "noctule" not in warning
    # No word is broken at the usual width of a terminal, and the columns are explained.
    assert {"dog-faced-fruit-bat", "purdue-hummingbird"} <= set(rows)
    assert "yellow-bellied" in rows["bat"]
    assert "su-fan: speeds at which the chord's Reynolds number" in " ".join(out.split())


def test_the_list_as_json(run: Any) -> None:
    animals = {animal["name"]: animal for animal in json.loads(run("species", "--json")[1])}
    assert list(animals) == list(species_names())
    assert animals["pigeon"]["fitted_speeds"] == pytest.approx([0.3 / 0.112, 0.75 / 0.112])
    assert animals["pigeon"]["mass"] == pytest.approx(0.316)
    assert animals["pigeon"]["reynolds_at_10_m_per_s"] == pytest.approx(0.112 * 10 / 1.5e-5)


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_one_species_shows_every_number_bound_source_and_alternative(run: Any, name: str) -> None:
    code, out, errors = run("species", name)
    animal = load_species(name)
    text = " ".join(out.split())
    assert (code, errors) == (0, [])
    for path, number in animal.numbers.items():
        shown = path.removeprefix("vehicle.") + ("_deg" if number.unit == "rad" else "")
        assert f" {shown} " in text
        assert " ".join(number.source.split()) in text
    for key in animal.free:
        assert animal.reasons[key].removeprefix("guess: ") in text
    for key, other in animal.alternatives.items():
        assert f"alternative {key}: {other.reason}" in text


@pytest.mark.parametrize("width", ["1", "20"])
def test_a_narrow_terminal_is_no_error(run: Any, monkeypatch: pytest.MonkeyPatch, width: str) -> None:
    monkeypatch.setenv("COLUMNS", width)
    assert run("species", "pigeon")[::2] == (0, [])


def test_a_terminal_that_knows_ascii_alone_is_no_error(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(template().replace('name = "my-flyer"', 'name = "M\u00f6we"'), encoding="utf-8")
    ended = wingbeat("species", str(path), env=os.environ | {"PYTHONIOENCODING": "ascii"})
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout.startswith("M\\xf6we")


def test_one_species_as_json_is_its_dict(run: Any) -> None:
    plain = json.loads(run("species", "bat", "--json")[1])
    assert plain == json.loads(json.dumps(load_species("bat").as_dict()))


def test_set_and_alternative(run: Any) -> None:
    words = ("species", "pigeon", "--alternative", "avinertia", "--set", "wing.mass=0.05", "air.density=1")
    changed = json.loads(run(*words, "--json")[1])
    assert changed["vehicle"]["wing"]["mass"] == 0.05
    assert changed["vehicle"]["wing"]["mass_exponent"] == 4.0
    assert changed["air"]["density"] == 1.0
    assert "warning: vehicle.wing.mass = 0.05 kg is outside" in run(*words)[1]


def test_all_bad_settings_are_told_at_once(run: Any) -> None:
    code, _, errors = run("species", "bat", "--set", "x", "--set", "wing.mass=y", "--set", "=1")
    assert (code, len(errors)) == (2, 3)
    code, _, errors = run("species", "bat", "--set", "wing.mass=1", "--set", "wing.mass=2")
    assert (code, len(errors)) == (2, 1)


def test_faults_of_alternative_settings_and_air_are_told_at_once_by_their_options(run: Any) -> None:
    """`species` once stopped at the first of these, and named `altitude`, which is no option."""
    words = ("--alternative", "x", "--set", "wing.mass=y", "air.density=1", "--altitude", "20000")
    code, out, errors = run("species", "pigeon", *words)
    assert (code, out, len(errors)) == (2, "", 4)
    assert errors[0].startswith("error: alternative = 'x'")
    assert errors[2] == "error: --set = 'air.density=1': is what --altitude sets; keep one of them"
    assert errors[3].startswith("error: --altitude = 20000.0: must be >= -500 and <= 9000 m")
    code, out, errors = run("species", "pigeon", "--altitude", "2000", "--set", "air.gravity=9.8", "--json")
    assert (code, errors) == (0, [])
    assert json.loads(out)["air"]["density"] == pytest.approx(1.0065, abs=1e-4)


def test_markup_in_a_file_is_text(run: Any, tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(template().replace('name = "my-flyer"', 'name = "[bold]:bat:[/x]"'))
    code, out, _ = run("species", str(path))
    assert code == 0
    assert out.startswith("[bold]:bat:[/x]: bird\n")


def test_the_schema_is_json(run: Any) -> None:
    assert json.loads(run("species", "--schema")[1])["title"] == "wingbeat species file"


# --- wingbeat species new ---


def test_a_new_robot_has_its_parts_as_comments(run: Any, tmp_path: Path) -> None:
    """Without the sign of a comment before its numbers, each part is there and nothing is refused."""
    path, size = tmp_path / "mine.toml", ("--mass", "0.25", "--wing-span", "0.8", "--wing-area", "0.1")
    code, _, errors = run("species", "new", str(path), "--kind", "robot", *size)
    assert (code, errors) == (0, [])
    bare = load_species(path).vehicle
    assert (bare.tail, bare.motor, bare.battery, bare.springs) == (None, None, None, None)
    path.write_text(with_parts(path.read_text(encoding="utf-8")), encoding="utf-8")
    robot = load_species(path)
    whole = robot.vehicle
    assert None not in (whole.tail, whole.motor, whole.battery, whole.springs)
    assert whole.muscle is None
    assert whole.battery is not None
    assert whole.battery.cells == 3
    told = "examples of the template, until their source says otherwise: numbers of"
    assert f"{told} pitch_hinge, tail, motor, springs, battery" in robot.warnings[-1]
    # Nothing is drawn from the range of an example.
    examples = [number for number in robot.numbers.values() if number.source == "example"]
    assert len(examples) > 20
    assert not any(number.range for number in examples)


def with_parts(text: str, parts: str = r"(?!wing)\w+") -> str:
    """Return a species file without the sign of a comment before the numbers of parts."""
    tables = text.split("\n\n")
    for i, table in enumerate(tables):
        if re.search(rf"^# \[vehicle\.({parts})\]$", table, flags=re.MULTILINE):
            tables[i] = re.sub(r"^# (?=\[vehicle|\w+ = \{)", "", table, flags=re.MULTILINE)
    return "\n\n".join(tables)


@pytest.mark.slow
@pytest.mark.parametrize("parts", [r"(?!wing)\w+", "pitch_hinge|motor|battery"])
def test_the_parts_of_a_new_robot_fly_it(run: Any, tmp_path: Path, parts: str) -> None:
    """As the comments of the file promise: at 8 m/s, for a time, within what motor and battery give."""
    path, size = tmp_path / "mine.toml", ("--mass", "0.25", "--wing-span", "0.8", "--wing-area", "0.1")
    run("species", "new", str(path), "--kind", "robot", *size)
    path.write_text(with_parts(path.read_text(encoding="utf-8"), parts), encoding="utf-8")
    asked = ("--minimise", "electrical-power", "--starts", "2", "--json")
    code, out, _ = run("orbit", str(path), "--speed", "8", *asked)
    record = json.loads(out)
    assert (code, record["status"]) == (0, "converged")
    assert 25.0 < record["electrical_power"] < 45.0
    # 3S 850 mAh are 0.85 A h times about 11.1 V; some is left where the voltage under load is that of the cut-off.
    full = 0.85 * 3600.0 * 11.1 / record["electrical_power"]
    assert 0.8 * full < record["endurance"] < full
    assert record["peak_motor_voltage"] < record["least_battery_voltage"]
    assert record["peak_battery_current"] < 20.0
    # Nothing sits at a bound, so the example's hinge and gear suit the speed.
    assert record["active_bounds"] == []


def test_new_writes_a_file_that_loads(run: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    code, out, errors = run("species", "new", str(path))
    assert (code, errors) == (0, [])
    assert str(path) in out
    assert path.read_text() == template()
    assert run("species", str(path))[0] == 0


def test_new_derives_a_bird_of_a_size(run: Any, tmp_path: Path) -> None:
    path = tmp_path / "crow.toml"
    size = ("--mass", "0.3", "--wing-span", "0.62", "--wing-area", "0.06")
    code, _, errors = run("species", "new", str(path), "--kind", "bird", *size)
    assert (code, errors) == (0, [])
    crow = load_species(path)
    assert (crow.name, crow.vehicle.mass) == ("crow", pytest.approx(0.3))
    assert "doi 10.1242/jeb.198.8.1655" in crow.numbers["vehicle.wing.mass"].source
    code, _, errors = run("species", "new", str(path), "--force", "--kind", "bat", *size[:2])
    assert (code, len(errors)) == (2, 2)
    assert errors[0].startswith("error: --wing-span = None: must be given")
    code, _, errors = run("species", "new", str(path), "--force", *size)
    assert (code, len(errors)) == (2, 3)
    assert "add --kind bird, bat or robot" in errors[0]
    code, _, errors = run("species", "new", str(path), "--force", "--kind", "bird", *size[:5], "6")
    assert (code, len(errors)) == (2, 1)
    assert "larger than the square of the span" in errors[0]
    assert load_species(path).name == "crow"


def test_new_does_not_replace_a_file_unless_forced(run: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("precious")
    code, _, errors = run("species", "new", str(path))
    assert code == 2
    assert "--force" in errors[0]
    assert path.read_text() == "precious"
    assert run("species", "new", str(path), "--force")[0] == 0
    assert path.read_text() == template()
    assert os.listdir(tmp_path) == ["mine.toml"]


def test_new_refuses_folders_and_unwritable_places(run: Any, tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "none" / "x.toml", Path("/proc/x.toml")):
        code, out, errors = run("species", "new", str(path), "--force")
        assert (code, out, len(errors)) == (2, "", 1)
        assert errors[0].startswith("error: cannot write")
    assert os.listdir(tmp_path) == []


def test_a_species_is_shown_with_the_bounds_of_a_model(run: Any) -> None:
    """A warning called a bound a guess that no command showed."""
    code, out, _ = run("species", "pigeon", "--model", "animal")
    assert code == 0
    for name, bounds in (("flap_mean_deg", "-10 to 25"), ("downstroke_fraction", "0.4 to 0.6")):
        assert re.search(rf"wingbeat\.{name} +{bounds} .*guess: ", out)
    assert "guess: guess" not in out
    assert "downstroke_fraction    0.4" not in run("species", "pigeon")[1]
    assert run("species", "pigeon", "--model", "animals")[0] == 2
    assert run("species", "--model", "animal")[0] == 2
