"""Every bad input through the real command line: exit code 2, a line for each fault, and nothing left behind."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from wingbeat.cli import main

GOOD_TABLE = "alpha_deg,c_l,c_d\n0,0,0.1\n20,0.8,0.4\n40,1.2,0.9\n60,1,1.6\n90,0,2\n"
SPECIES = """
[vehicle]
mass = {mass}
[vehicle.body]
pitch_inertia = {inertia}
[vehicle.wing]
semi_span = 0.3
chord = {chord}
mass = 0.01
{more}
[wingbeat]
frequency = {frequency}
flap_mean = 0
flap_amplitude_deg = 40
pitch_mean = 0.1
pitch_amplitude = 0.2
[free]
frequency = {{ bounds = [2.0, 20.0], reason = "wide" }}
"""
GOOD = {"mass": "0.3", "inertia": "1e-4", "chord": "0.1", "frequency": "5", "more": ""}
SPECIES_FILES: dict[str, dict[str, str]] = {
    "negative.toml": {"mass": "-0.3"},
    "text.toml": {"chord": '"wide"'},
    "nan.toml": {"frequency": "nan"},
    "inf.toml": {"inertia": "inf"},
    "key.toml": {"more": "colour = 3"},
    "three.toml": {"frequency": "-5", "inertia": "0", "chord": "true"},
}
# Bytes kept: HDF5's signature, pieces of its superblock, the superblock, some of the data.
LENGTHS = (8, 16, 24, 48, 96, 512, 2048)


@pytest.fixture(scope="session")
def orbit_bytes(pigeon_orbit: Any, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("orbit") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return path.read_bytes()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of bad files and a good result, which nobody may touch; the working directory."""
    for name, changes in SPECIES_FILES.items():
        (tmp_path / name).write_text(SPECIES.format(**GOOD | changes))
    (tmp_path / "broken.toml").write_text("[vehicle\nmass = 0.3\n")
    (tmp_path / "empty.toml").write_text("")
    (tmp_path / "latin.toml").write_bytes(b'name = "caf\xe9"\n')
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "head.csv").write_text("alpha_deg,c_l,c_d\n")
    (tmp_path / "sorted.csv").write_text(GOOD_TABLE.replace("40,1.2", "10,1.2"))
    (tmp_path / "column.csv").write_text(GOOD_TABLE.replace("c_d", "drag"))
    (tmp_path / "cells.csv").write_text(GOOD_TABLE.replace("1.2", "nan").replace("1.6", "x").replace("0.4", "-1"))
    (tmp_path / "short.csv").write_text(GOOD_TABLE.replace("90,0,2\n", ""))
    (tmp_path / "good.csv").write_text(GOOD_TABLE)
    (tmp_path / "text.nc").write_text("phase,flap\n0,1\n")
    (tmp_path / "kept.nc").write_text("an older result")
    (tmp_path / "kept.png").write_text("an older figure")
    for name in ("folder.nc", "folder.csv", "folder.toml", "folder"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    return tmp_path


@pytest.fixture(autouse=True)
def nothing_is_solved(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bad input is refused before the work begins."""
    if "orbit_bytes" in request.fixturenames:
        request.getfixturevalue("orbit_bytes")  # solved before the ban

    def refuse(*_: Any) -> None:
        raise AssertionError("bad input was let through to the search")

    monkeypatch.setattr("wingbeat.orbits.solve._searches", refuse)
    monkeypatch.setattr("wingbeat.results.flight.fly_beats", refuse)


def contents(folder: Path) -> dict[str, bytes | None]:
    """Return what lies in a folder, files with their bytes."""
    return {
        str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")
    }


def check(code: int, out: str, err: str, parts: tuple[str, ...]) -> None:
    """Check that a command line was refused, with one line for each of `parts`, which holds all words of it."""
    lines = err.splitlines()
    assert "Traceback" not in err
    assert (code, out) == (2, ""), err
    assert len(lines) == len(parts), err
    for line, part in zip(lines, parts, strict=True):
        assert line.startswith("error: "), line
        for words in part.split("|"):
            assert words in line


def refuse(capsys: pytest.CaptureFixture[str], words: str, *parts: str) -> None:
    """Run a command line that must be refused, and leave everything as it was."""
    before = contents(Path.cwd())
    code = main(shlex.split(words))
    told = capsys.readouterr()
    check(code, told.out, told.err, parts)
    assert contents(Path.cwd()) == before


# A command line and, for each fault, what its one line must hold: what, where, the allowed or the fix.
NUMBERS = {
    "--speed nan": "speed = nan: must be finite|0 is hover",
    "--speed inf": "speed = inf: must be finite",
    "--speed -3": "speed = -3.0: must be >= 0 and <= 100 m/s|0 is hover",
    "--speed 101": "speed = 101.0: must be >= 0 and <= 100 m/s",
    "--speed abc": '--speed|"abc"|float',
    "--speed": "--speed requires an argument",
    "": "--speed = None: is missing; give the mean forward speed in m/s, 0 for hover",
    "--speed 5 --speed 6": "--speed specified multiple times",
    "--speed 0 --climb nan": "climb = nan: must be finite|0 is level flight",
    "--speed 9 --climb -inf": "climb = -inf: must be finite",
    "--speed 9 --climb 101": "climb = 101.0: must be >= -100 and <= 100 m/s",
    "--speed 9 --starts 0": "starts = 0: must be a whole number from 1 to 100000",
    "--speed 9 --starts -2": "starts = -2: must be a whole number from 1",
    "--speed 9 --starts 1.5": '--starts|"1.5" is not a whole number',
    "--speed 9 --starts inf": '--starts|"inf" is not a whole number',
    "--speed 9 --starts 100001": "starts = 100001: must be a whole number from 1 to 100000",
    "--speed 9 --seed -1": "seed = -1: must be a whole number from 0 to 100000",
    "--speed 9 --seed 0.5": '--seed|"0.5" is not a whole number',
    "--speed 9 --strips 0": "aero.strips = 0: must be a whole number from 1 to 1000; the paper has 10",
    "--speed 9 --strips 1001": "aero.strips = 1001: must be a whole number from 1 to 1000",
    "--speed 9 --strips ten": '--strips|"ten" is not a whole number',
    "--speed 9 --flap-amplitude-max nan": "--flap-amplitude-max = nan: must be finite; the flap amplitude of",
    "--speed 9 --flap-amplitude-max -5": "--flap-amplitude-max = -5.0: must be > 5 and < 180 degrees",
    "--speed 9 --flap-amplitude-max 4": "--flap-amplitude-max = 4.0: must be > 5|is searched from 5 degrees up",
    "--speed 9 --flap-amplitude-max 180": "--flap-amplitude-max = 180.0: must be > 5 and < 180 degrees",
    "--speed 9 --blend-width-deg 0": "blend_width_deg = 0.0: must be > 0 and <= 3 degrees; 1 is the default",
    "--speed 9 --blend-width-deg nan": "blend_width_deg = nan: must be finite",
}
NAMES = {
    "--extension sideways": "extension = 'sideways'|use one of mirrored, signed-drag, signed, clipped-drag",
    "--aero sufan": "coefficients = 'sufan': is not a known coefficient model; did you mean su-fan?",
    "--aero foo": "coefficients = 'foo'|su-fan, dickinson|a table's path ends in .csv",
    "--force-point nose": "aero.force_point = 'nose'|use one of quarter-chord, centre-of-pressure",
    "--force-point centre-of-pressure --aero dickinson": "aero.force_point|which dickinson has none of; use quar",
    "--frequency 3": "--frequency",
    "12": "'12'",
    "--json=perhaps": "--json|perhaps",
}
TABLES = {
    "missing.csv": ["missing.csv|there is no such file; check the path"],
    "folder.csv": ["folder.csv|irectory|give the path to a CSV file"],
    "empty.csv": ["empty.csv row 1 = '': the file is empty; the first row must read alpha_deg,c_l,c_d"],
    "head.csv": ["has fewer than 4 rows|measure at more angles"],
    "sorted.csv": ["sorted.csv row 4, column alpha_deg = 10.0: must be above the 20 before it; sort the rows"],
    "column.csv": [
        "column.csv row 1, column c_d = 'alpha_deg,c_l,drag': the column is missing; the first row must read",
        "column.csv row 1, column 3 = 'drag': is not a known column; the columns are alpha_deg, c_l, c_d, x_cp",
    ],
    "cells.csv": [
        "cells.csv row 4, column c_l = nan: must be finite; drop the row or give a value",
        "cells.csv row 5, column c_d = 'x': is not a number; write one number with a decimal point",
        "cells.csv row 3, column c_d = -1.0: must be >= 0|turn its sign",
    ],
    "short.csv": ["short.csv row 5, column alpha_deg = 60.0: the table must reach at least 90 degrees"],
    "good.csv --extension signed": ["good.csv row 2, column alpha_deg = 0.0|use mirrored"],
}
SETTINGS = {
    "wing.mass=-1": ["wing.mass = -1.0: must be > 0 kg; give the mass of one wing"],
    "wing.mass=0": ["wing.mass = 0.0: must be > 0 kg"],
    "wing.mass=nan air.density=inf": ["wing.mass = nan: must be finite", "air.density = inf: must be finite"],
    "wing.mass=heavy": ["wing.mass = 'heavy': is not a number or a list of numbers; for example 0.02"],
    "wing.mass": ["--set = 'wing.mass': must be PATH=VALUE; for example wing.mass=0.02"],
    "=3": ["--set = '=3': must be PATH=VALUE"],
    "": ["--set = '': must be PATH=VALUE; for example wing.mass=0.02"],
    "wing.mas=1": ["wing.mas = 1.0: is not the path of a number; did you mean wing.mass"],
    "mass=0.3": ["mass = 0.3: is not the path of a number; set body.mass or wing.mass"],
    "wing.mass=0.01 wing.mass=0.02": ["--set = 'wing.mass=0.02': is set twice; keep one of them"],
    "wing.mass=0.01 vehicle.wing.mass=0.02": ["vehicle.wing.mass = 0.02: is given as wing.mass too; keep one"],
    "wing.shoulder=1": ["wing.shoulder = 1.0: must be a list of numbers"],
    "wing.mass=1 --set wing.mass=2 --set x": [
        "--set = 'wing.mass=2': is set twice",
        "--set = 'x': must be PATH=VALUE",
    ],
}
ANIMALS = {
    "pigon": ["species = 'pigon': is not in the box; did you mean pigeon"],
    "eagle": ["species = 'eagle': is not in the box; |pigeon|.toml file"],
    "none.toml": ["cannot read 'none.toml': no such file or directory; check the path"],
    "folder.toml": ["cannot read 'folder.toml': it is not a file; give the path of a text file"],
    "empty.toml": ["'empty.toml' holds nothing; `wingbeat species new FILE` writes a template"],
    "broken.toml": ["broken.toml|line 1"],
    "latin.toml": ["cannot read 'latin.toml': byte 11 is not UTF-8 text; save the file as UTF-8 text"],
    "negative.toml": ["vehicle.mass = -0.3: must be > 0 kg"],
    "text.toml": ["wing.chord = 'wide': must be a number"],
    "nan.toml": ["wingbeat.frequency = nan: must be finite"],
    "inf.toml": ["body.pitch_inertia = inf: must be finite"],
    "key.toml": ["wing.colour = 3: is not a known key; use one of semi_span, chord, mass"],
}
OUTPUTS = {
    "-o missing/orbit.nc": "cannot write 'missing/orbit.nc': no such file or directory; check the path and that",
    "-o kept.nc/orbit.nc": "cannot write 'kept.nc/orbit.nc': not a directory; check the path and that its folder",
    "-o folder": "cannot write 'folder': it is a folder; give the path of a file",
    "-o ''": "it is a folder; give the path of a file",
    "-o": "-o requires an argument",
}
FIGURES = {
    "--plot page.txt": "--plot = 'page.txt': is not a figure's name; end it in .png, .pdf, .svg",
    "--plot page": "--plot = 'page': is not a figure's name",
    "--plot missing/page.png": "cannot write 'missing/page.png': no such file or directory",
    "--plot kept.png/page.png": "cannot write 'kept.png/page.png': not a directory",
    "--plot kept.png -o ./kept.png": "--plot = 'kept.png': is the file of --output too; give each its own",
}
FLIGHTS = {
    "--beats 0": ["beats = 0: must be a whole number from 1 to 10000"],
    "--beats 10001": ["beats = 10001: must be a whole number from 1 to 10000"],
    "--beats 2.5": ['--beats|"2.5" is not a whole number'],
    "--beats -1 --samples 0": ["beats = -1: must be a whole", "samples = 0: must be a whole number from 1 to 4096"],
    "--u nan --w inf": ["initial_state.u = nan: must be finite", "initial_state.w = inf: must be finite"],
    "--u fast": ['--u|"fast"|float'],
    "--body-pitch-deg nan": ["initial_state.body_pitch = nan: must be finite"],
    "--pitch-rate -inf": ["initial_state.pitch_rate = -inf: must be finite"],
    "--set wingbeat.frequency=0": ["wingbeat.frequency = 0.0: must be > 0 Hz"],
}


@pytest.mark.parametrize("options", NUMBERS)
def test_orbit_refuses_numbers(folder: Path, capsys: Any, options: str) -> None:
    refuse(capsys, f"orbit pigeon -o kept.nc --plot kept.png {options}", NUMBERS[options])


@pytest.mark.parametrize("command", ["orbit --speed 9 --plot kept.png", "simulate"])
@pytest.mark.parametrize("options", NAMES)
def test_names_that_are_unknown(folder: Path, capsys: Any, command: str, options: str) -> None:
    refuse(capsys, f"{command} -o kept.nc pigeon {options}", NAMES[options])


@pytest.mark.parametrize("command", ["orbit --speed 9", "simulate"])
@pytest.mark.parametrize("table", TABLES)
def test_tables_that_cannot_be_used(folder: Path, capsys: Any, command: str, table: str) -> None:
    refuse(capsys, f"{command} pigeon -o kept.nc --aero {table}", *TABLES[table])


@pytest.mark.parametrize("command", ["orbit --speed 9", "simulate"])
@pytest.mark.parametrize("settings", SETTINGS)
def test_settings_that_cannot_be(folder: Path, capsys: Any, command: str, settings: str) -> None:
    refuse(capsys, f"{command} pigeon -o kept.nc --set {settings}", *SETTINGS[settings])


@pytest.mark.parametrize("command", ["orbit --speed 9", "simulate", "species"])
@pytest.mark.parametrize("animal", ANIMALS)
def test_species_that_cannot_be_read(folder: Path, capsys: Any, command: str, animal: str) -> None:
    refuse(capsys, f"{command} {animal}", *ANIMALS[animal])


@pytest.mark.parametrize("command", ["orbit --speed 9", "simulate", "species"])
def test_all_faults_of_a_species_file_come_at_once(folder: Path, capsys: Any, command: str) -> None:
    refuse(
        capsys,
        f"{command} three.toml",
        "wing.chord = True: must be a number",
        "body.pitch_inertia = 0: must be > 0",
        "wingbeat.frequency = -5: must be > 0 Hz",
    )


@pytest.mark.parametrize("command", ["orbit pigeon --speed 9", "simulate pigeon"])
@pytest.mark.parametrize("output", OUTPUTS)
def test_outputs_that_cannot_be_written(folder: Path, capsys: Any, command: str, output: str) -> None:
    refuse(capsys, f"{command} {output}", OUTPUTS[output])


@pytest.mark.parametrize("figure", FIGURES)
def test_figures_that_cannot_be_written(folder: Path, capsys: Any, figure: str) -> None:
    refuse(capsys, f"orbit pigeon --speed 9 {figure}", FIGURES[figure])


@pytest.mark.parametrize("command", ["orbit pigeon --speed 9", "simulate pigeon"])
@pytest.mark.parametrize("device", ["/dev/full", "/dev/null"])
def test_devices_are_no_files(folder: Path, capsys: Any, command: str, device: str) -> None:
    if not Path(device).exists():
        pytest.skip(f"{device} is not on this system")
    refuse(capsys, f"{command} -o {device}", f"cannot write '{device}': it is not a plain file; give the path of")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_permission(folder: Path, capsys: Any) -> None:
    (folder / "folder").chmod(0o500)
    refuse(capsys, "orbit pigeon --speed 9 -o folder/orbit.nc", "cannot write|permission denied|permissions")


@pytest.mark.parametrize("options", FLIGHTS)
def test_simulate_refuses_numbers(folder: Path, capsys: Any, options: str) -> None:
    refuse(capsys, f"simulate pigeon -o kept.nc {options}", *FLIGHTS[options])


def test_nothing_to_fly(folder: Path, capsys: Any) -> None:
    missing = "SPECIES = None: is missing; give a name such as pigeon"
    refuse(capsys, "orbit", missing, "--speed = None: is missing; give the mean forward speed")
    refuse(capsys, "orbit --speed 9 -o kept.nc", missing)
    refuse(capsys, "simulate -o kept.nc", f"{missing}| or --from")


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show"])
@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("missing.nc", "cannot read 'missing.nc': no such file or directory; check the path"),
        ("kept.nc/orbit.nc", "cannot read 'kept.nc/orbit.nc': not a directory"),
        ("folder.nc", "cannot read 'folder.nc': is a directory"),
        ("text.nc", "cannot read 'text.nc': it is not a NetCDF-4 file; give a file of `orbit -o`"),
        ("good.csv", "cannot read 'good.csv': it is not a NetCDF-4 file"),
    ],
)
def test_results_that_are_none(folder: Path, capsys: Any, command: str, name: str, part: str) -> None:
    refuse(capsys, f"{command} {name}", part)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with a name on this system")
@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show"])
def test_a_pipe_is_not_waited_for(folder: Path, capsys: Any, command: str) -> None:
    os.mkfifo(folder / "pipe.nc")
    refuse(capsys, f"{command} pipe.nc", "cannot read 'pipe.nc': it is not a plain file")


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show"])
def test_results_cut_short(orbit_bytes: bytes, folder: Path, capsys: Any, command: str) -> None:
    whole = len(orbit_bytes)
    for length in (0, 4, *LENGTHS, whole // 10, whole // 2, whole - 1):
        (folder / "cut.nc").write_bytes(orbit_bytes[:length])
        reason = "it is not a NetCDF-4 file" if length < 8 else "it is damaged or cut short (|solve it again"
        refuse(capsys, f"{command} cut.nc", f"cannot read 'cut.nc': {reason}")


def test_results_with_rotten_bytes(orbit_bytes: bytes, folder: Path, capfd: Any) -> None:
    random = np.random.default_rng(5)
    refused = 0
    for _ in range(40):
        rotten = np.frombuffer(orbit_bytes, np.uint8).copy()
        places = random.integers(0, len(rotten), 64)
        rotten[places] = random.integers(0, 256, 64)
        (folder / "rotten.nc").write_bytes(rotten.tobytes())
        code = main(["show", "rotten.nc", "--json"])
        told = capfd.readouterr()
        assert code in (0, 2)  # a changed number of the series cannot be told from a true one
        if code == 2:
            refused += 1
            check(code, told.out, told.err, ("cannot read 'rotten.nc'|",))
    assert refused > 5


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show", "show --json"])
def test_a_result_of_somebody_else(folder: Path, capsys: Any, command: str) -> None:
    stranger = xr.Dataset({"temperature": ("time", np.zeros(3))}, attrs={"title": "sea surface", "speed": 3.0})
    stranger.to_netcdf("foreign.nc", engine="h5netcdf")
    refuse(capsys, f"{command} foreign.nc", "cannot read 'foreign.nc'|wingbeat|give a file of `")


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from"])
def test_inputs_that_were_changed_by_hand(orbit_bytes: bytes, folder: Path, capsys: Any, command: str) -> None:
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    good = xr.load_dataset("orbit.nc", engine="h5netcdf").attrs
    inputs = json.loads(good["inputs"])
    for changed in ("", "{", "[]", "{}", "null", json.dumps(inputs | {"vehicle": {}}), None):
        attributes = good | {"inputs": changed} if changed is not None else {"wingbeat_kind": "orbit"}
        xr.Dataset(attrs=attributes).to_netcdf("changed.nc", engine="h5netcdf")
        refuse(capsys, f"{command} changed.nc", "cannot read 'changed.nc' as an orbit: its |damaged|solve it again")
    for name, value in (("air", {"density": -1.0}), ("speed", "fast"), ("free", ["colour"]), ("bounds", {"x": 1})):
        xr.Dataset(attrs=good | {"inputs": json.dumps(inputs | {name: value})}).to_netcdf(
            "changed.nc", engine="h5netcdf"
        )
        refuse(capsys, f"{command} changed.nc", "its inputs are damaged (")


@pytest.mark.parametrize(
    "value", ["[]", "null", '"x"', "{", float("nan"), np.array([1.0, 2.0])], ids=lambda v: repr(v)[:6]
)
def test_records_that_were_changed_by_hand(orbit_bytes: bytes, folder: Path, capsys: Any, value: Any) -> None:
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    good = xr.load_dataset("orbit.nc", engine="h5netcdf").attrs
    for name in ("wingbeat", "vehicle", "initial_state"):
        xr.Dataset(attrs=good | {name: value}).to_netcdf("changed.nc", engine="h5netcdf")
        for command in ("show", "show --json", "simulate --from"):
            refuse(capsys, f"{command} changed.nc", "cannot read 'changed.nc' as an orbit: its attributes are dam")


def test_what_other_tools_add_does_no_harm(orbit_bytes: bytes, folder: Path, capsys: Any) -> None:
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    touched = xr.load_dataset("orbit.nc", engine="h5netcdf").assign_attrs(history="Mon: ncks a b", NCO="5.1")
    touched.to_netcdf("touched.nc", engine="h5netcdf")
    shown = []
    for name in ("orbit.nc", "touched.nc"):
        assert main(["show", "--json", name]) == 0
        shown.append(json.loads(capsys.readouterr().out))
    assert shown[0] == shown[1]


@pytest.mark.parametrize(
    ("words", "left_out"),
    [
        ("orbit pigeon --from orbit.nc", "SPECIES"),
        ("orbit --from orbit.nc --speed 9 --climb 1", "--speed, --climb"),
        ("orbit --from orbit.nc --set wing.mass=1 --starts 2", "--starts, --set"),
        ("orbit --from orbit.nc --aero dickinson --extension signed --strips 5", "--aero, --extension, --strips"),
        ("orbit --from orbit.nc --flap-amplitude-max 45 --seed 3", "--flap-amplitude-max, --seed"),
        ("orbit --from orbit.nc --blend-width-deg nan", "--blend-width-deg"),
        ("simulate pigeon --from orbit.nc", "SPECIES"),
        ("simulate --from orbit.nc --set wing.mass=1 --force-point nose", "--force-point, --set"),
    ],
)
def test_an_orbit_comes_with_its_own_inputs(folder: Path, capsys: Any, words: str, left_out: str) -> None:
    refuse(capsys, words, f"--from = 'orbit.nc': comes with its own inputs; leave out {left_out}")


# --- the real program, one of each kind ---

REAL = [
    ("species pigon", ["did you mean pigeon"]),
    ("orbit pigeon --speed 0 --climb nan -o kept.nc", ["climb = nan: must be finite"]),
    ("orbit pigeon --speed=-3 --plot kept.png", ["speed = -3.0: must be >= 0"]),
    ("species pigeon --set wing.mass=-1", ["wing.mass = -1.0: must be > 0 kg"]),
    ("orbit pigeon --speed 9 --starts 0 -o kept.nc --plot kept.png", ["starts = 0: must be a whole number"]),
    ("orbit three.toml --speed 9", ["wing.chord = True", "pitch_inertia = 0", "frequency = -5"]),
    ("orbit pigeon --speed 9 --aero empty.csv", ["empty.csv row 1 = '': the file is empty"]),
    ("orbit pigeon --speed 9 -o kept.nc/orbit.nc", ["cannot write 'kept.nc/orbit.nc': not a directory"]),
    ("show cut.nc", ["cannot read 'cut.nc': it is damaged or cut short"]),
    ("simulate pigeon --u nan -o kept.nc", ["initial_state.u = nan: must be finite"]),
    ("show text.nc", ["cannot read 'text.nc': it is not a NetCDF-4 file"]),
    ("species negative.toml", ["vehicle.mass = -0.3: must be > 0 kg"]),
]


@pytest.mark.parametrize(("words", "parts"), REAL, ids=[re.sub(r"\W+", "-", words) for words, _ in REAL])
def test_the_real_program(folder: Path, words: str, parts: list[str]) -> None:
    (folder / "cut.nc").write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(100))
    before = contents(folder)
    code = "import sys; from wingbeat.cli import main; sys.exit(main())"
    ended = subprocess.run(
        [sys.executable, "-W", "error", "-c", code, *shlex.split(words)],
        capture_output=True,
        text=True,
        check=False,
        stdin=subprocess.DEVNULL,
    )
    check(ended.returncode, ended.stdout, ended.stderr, tuple(parts))
    assert contents(folder) == before
