"""Results that are none, cut short, rotten or changed by hand; and the program in a process of its own."""

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

from tests.cli.bad_input.refusals import check, contents, refuse
from wingbeat.cli import main
from wingbeat.records.result_files import load_dataset, save_result

# Bytes kept: HDF5's signature, pieces of its superblock, the superblock, some of the data.
LENGTHS = (8, 16, 24, 48, 96, 512, 2048)


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show"])
@pytest.mark.parametrize(
    ("name", "part"),
    [
        ("missing.nc", "cannot read 'missing.nc': no such file or directory; check the path"),
        ("kept.nc/orbit.nc", "cannot read 'kept.nc/orbit.nc': not a directory"),
        ("folder.nc", "cannot read 'folder.nc': is a directory"),
        (
            "text.nc",
            "cannot read 'text.nc': it is not a NetCDF-4 file; give a file that |`wingbeat orbit -o`| wrote",
        ),
        ("good.csv", "cannot read 'good.csv': wingbeat reads results from .nc files"),
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
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    assert main(["show", "orbit.nc", "--json"]) == 0
    true = json.loads(capfd.readouterr().out)
    refused = 0
    for _ in range(40):
        rotten = np.frombuffer(orbit_bytes, np.uint8).copy()
        places = random.integers(0, len(rotten), 64)
        rotten[places] = random.integers(0, 256, 64)
        (folder / "rotten.nc").write_bytes(rotten.tobytes())
        code = main(["show", "rotten.nc", "--json"])
        told = capfd.readouterr()
        assert code in (0, 2)
        if code == 0:  # the rot is where nothing lies
            assert json.loads(told.out) == true
        if code == 2:
            refused += 1
            check(code, told.out, told.err, ("cannot read 'rotten.nc'|",))
    assert refused > 5


@pytest.mark.parametrize("command", ["orbit --from", "simulate --from", "show", "show --json"])
def test_a_result_of_somebody_else(folder: Path, capsys: Any, command: str) -> None:
    stranger = xr.Dataset({"temperature": ("time", np.zeros(3))}, attrs={"title": "sea surface", "speed": 3.0})
    stranger.to_netcdf("foreign.nc", engine="h5netcdf")
    refuse(capsys, f"{command} foreign.nc", "cannot read 'foreign.nc'|wingbeat|give a file that `")


@pytest.mark.slow
@pytest.mark.parametrize("command", ["orbit --from", "simulate --from"])
def test_inputs_that_were_changed_by_hand(orbit_bytes: bytes, folder: Path, capsys: Any, command: str) -> None:
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    series = load_dataset("orbit.nc")
    good, inputs = series.attrs, json.loads(series.attrs["inputs"])
    for changed in ("", "{", "[]", "{}", "null", json.dumps(inputs | {"vehicle": {}}), None):
        attributes = good | {"inputs": changed} if changed is not None else {"wingbeat_kind": "orbit"}
        save_result(
            series.assign_attrs(attributes) if changed is not None else xr.Dataset(attrs=attributes), "changed.nc"
        )
        words = "cannot read 'changed.nc' as an orbit: it is damaged (|solve it again"
        refuse(capsys, f"{command} changed.nc", words)
    for name, value in (("air", {"density": -1.0}), ("speed", "fast"), ("free", ["colour"]), ("bounds", {"x": 1})):
        save_result(series.assign_attrs(inputs=json.dumps(inputs | {name: value})), "changed.nc")
        refuse(capsys, f"{command} changed.nc", "damaged (the inputs do not match their hash)")


@pytest.mark.slow
@pytest.mark.parametrize(
    "value", ["[]", "null", '"x"', "{", float("nan"), np.array([1.0, 2.0])], ids=lambda v: repr(v)[:6]
)
def test_records_that_were_changed_by_hand(orbit_bytes: bytes, folder: Path, capsys: Any, value: Any) -> None:
    (folder / "orbit.nc").write_bytes(orbit_bytes)
    series = load_dataset("orbit.nc")
    for name in ("wingbeat", "vehicle", "initial_state"):
        save_result(series.assign_attrs({name: value}), "changed.nc")
        for command in ("show", "show --json", "simulate --from"):
            refuse(capsys, f"{command} changed.nc", "cannot read 'changed.nc'|it is damaged (")


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
    ("orbit pigeon --speed 9 --aero empty.csv", ["empty.csv row 1 = '': the file holds no table"]),
    ("orbit pigeon --speed 9 -o kept.nc/orbit.nc", ["cannot write 'kept.nc/orbit.nc': not a directory"]),
    ("show cut.nc", ["cannot read 'cut.nc': it is damaged or cut short"]),
    ("simulate pigeon --u nan -o kept.nc", ["initial_state.u = nan: must be finite"]),
    ("show text.nc", ["cannot read 'text.nc': it is not a NetCDF-4 file"]),
    ("species negative.toml", ["vehicle.mass = -0.3: must be > 0 kg"]),
]


@pytest.mark.slow
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
