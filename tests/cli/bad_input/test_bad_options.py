"""Bad numbers, names, files and places on the command line."""

import os
from pathlib import Path
from typing import Any

import pytest

from tests.cli.bad_input.refusals import refuse

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
    "--speed 9 --strips 0": "aero.strips = 0: must be a whole number from 1 to 1000; Su et al. use 10",
    "--speed 9 --strips 1001": "aero.strips = 1001: must be a whole number from 1 to 1000",
    "--speed 9 --strips ten": '--strips|"ten" is not a whole number',
    "--speed 9 --flap-amplitude-max nan": "--flap-amplitude-max = nan: must be finite; the lower bound of the flap",
    "--speed 9 --flap-amplitude-max -5": "--flap-amplitude-max = -5.0: must be > 5 and < 180 degrees",
    "--speed 9 --flap-amplitude-max 4": "--flap-amplitude-max = 4.0: must be > 5|is 5 degrees",
    "--speed 9 --flap-amplitude-max 180": "--flap-amplitude-max = 180.0: must be > 5 and < 180 degrees",
    "--speed 9 --blend-width-deg 0": "blend_width_deg = 0.0: must be > 0 and <= 3 degrees; 1 is the default",
    "--speed 9 --blend-width-deg nan": "blend_width_deg = nan: must be finite",
}
NAMES = {
    "--extension sideways": "extension = 'sideways'|use one of mirrored, signed-drag, signed, clipped-drag",
    "--aero sufan": "coefficients = 'sufan': is not a known coefficient model; did you mean su-fan?",
    "--aero foo": "coefficients = 'foo'|su-fan, dickinson|a table's path ends in .csv",
    "--airspeed fast": "aero.airspeed = 'fast'|use one of planar, full",
    "--force-point nose": "aero.force_point = 'nose'|use one of quarter-chord, centre-of-pressure",
    "--force-point centre-of-pressure --aero dickinson": "aero.force_point|and dickinson has none; use quar",
    "--wobble 3": "--wobble",
    "12": "'12'",
    "--json=perhaps": "--json|perhaps",
}
TABLES = {
    "missing.csv": ["missing.csv|no such file or directory; check the path"],
    "folder.csv": ["folder.csv|it is not a file|give the path"],
    "empty.csv": ["empty.csv row 1 = '': the file holds no table; the first row names the columns"],
    "head.csv": ["head.csv row 1 = '': has no row of numbers; add the measurements"],
    "sorted.csv": ["sorted.csv row 4, column alpha_deg = 10.0: must be above the 20 before it; sort the rows"],
    "column.csv": [
        "column.csv row 1, column C_D = 'alpha_deg,c_l,drag': the column is missing; needed are alpha_deg"
    ],
    "cells.csv": [
        "cells.csv row 4, column c_l = 'nan': has no value, but this column needs one in each row",
        "cells.csv row 5, column c_d = 'x': is not a number; write one number with a decimal point",
        "cells.csv row 3, column c_d = -1.0: must be > 0|check the zero of the balance",
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
    "wing.mas=1": ["wing.mas = 1.0: no number has this path; did you mean wing.mass"],
    "mass=0.3": ["mass = 0.3: no number has this path; set body.mass or wing.mass"],
    "wing.mass=0.01 wing.mass=0.02": ["--set = 'wing.mass=0.02': is set twice; keep one of them"],
    "wing.mass=0.01 vehicle.wing.mass=0.02": ["vehicle.wing.mass = 0.02: is given as wing.mass too; keep one"],
    "wing.shoulder=1": ["wing.shoulder = 1.0: must be a list of numbers"],
    "wing.mass=1 --set wing.mass=2 --set x": [
        "--set = 'wing.mass=2': is set twice",
        "--set = 'x': must be PATH=VALUE",
    ],
}
ANIMALS = {
    "pigon": ["species = 'pigon': is not a built-in species; did you mean pigeon"],
    "eagle": ["species = 'eagle': is not a built-in species; |pigeon|.toml file"],
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
    "-o kept.png": "--output = 'kept.png': does not end in a suffix for results; end the name in .nc",
    "-o beat.csv --kinematics ./beat.csv": "--output = 'beat.csv': is a file that the command reads",
    "--aero old.csv -o old.csv": "--output = 'old.csv': is a file that the command reads",
    "-o orbit": "--output = 'orbit': does not end in a suffix for results|.csv or .mat",
}
FIGURES = {
    "--plot page.txt": "--plot = 'page.txt': is not a figure format; end it in .png, .pdf, .svg",
    "--plot page": "--plot = 'page': is not a figure format",
    "--plot missing/page.png": "cannot write 'missing/page.png': no such file or directory",
    "--plot kept.png/page.png": "cannot write 'kept.png/page.png': not a directory",
    "--tornado kept.png --plot ./kept.png": "--tornado = 'kept.png': is also the file of --plot; give each option",
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
