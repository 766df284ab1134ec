"""Octave, R, ncdump and nccopy of Debian read units, texts and coordinates of every kind of result."""

import functools
import os
import shutil
import subprocess

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat.records.result_files import load_dataset
from wingbeat.studies.table import save_table

# A text of each kind of result, a unit, and a variable of texts with its first value.
ASKED = {
    "orbit": ("species", "pigeon", "hinge_power", "W", "corner", "leading inner"),
    "curve": ("status_of_none", "", "mean_power", "W", "status", "converged"),
    "glide": ("species", "pigeon", "sink", "m s-1", "", ""),
    "study": ("wingbeat_kind", "study", "speed", "m s-1", "name", "flügel 30°"),
}


def needs(program, package, *probe):
    """Skip without a program of Debian; in CI it has to be there."""
    there = shutil.which(program) is not None
    if there and probe:
        there = subprocess.run([program, *probe], capture_output=True, check=False).returncode == 0
    if not there and os.environ.get("CI"):
        pytest.fail(f"CI lacks {program}: apt-get install {package}")
    if not there:
        pytest.skip(f"needs {program}: apt-get install {package}")


def said(*words):
    ended = subprocess.run(list(map(str, words)), capture_output=True, text=True, check=False, timeout=120)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


@pytest.fixture(scope="module")
def files(pigeon_orbit, tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    problem = pigeon_orbit.problem
    pigeon_orbit.orbit.save(folder / "orbit.nc")
    wb.solve_curve(problem, [10.0, 11.0], starts=1).save(folder / "curve.nc")
    wb.glide_polar(problem.species, angles_of_attack=np.radians([4.0, 6.0])).save(folder / "glide.nc")
    table = pd.DataFrame({"name": ["flügel 30°", ""], "speed": [10.0, np.nan], "stable": [True, False]})
    save_table(table, {"varied": ["speed"]}, folder / "study.nc")
    return {kind: folder / f"{kind}.nc" for kind in ASKED}


OCTAVE = """
pkg load netcdf
function show(text)
  printf("%s|", char(reshape(text, 1, [])));
end
"""
R = "suppressMessages(library(ncdf4))\n"


def test_octave_reads_units_texts_and_coordinates(files, tmp_path):
    needs("octave-cli", "octave octave-netcdf", "-qf", "--eval", "pkg load netcdf")
    lines, expected = [OCTAVE], []
    for kind, (text, value, number, unit, texts, first) in ASKED.items():
        path = files[kind]
        lines.append(f"show(ncreadatt('{path}', '{number}', 'units'));")
        expected.append(unit)
        if value:
            lines.append(f"show(ncreadatt('{path}', '/', '{text}'));")
            expected.append(value)
        if texts:
            lines.append(f"t = ncread('{path}', '{texts}'); t = t(:, 1); show(t(t != 0));")
            expected.append(first)
        lines.append(f"printf('%d|', isnumeric(ncread('{path}', '{number}')));")
        lines.append(f"printf('%d|', any(strcmp({{ncinfo('{path}').Variables.Name}}, '{number}')));")
        expected += ["1", "1"]
    (tmp_path / "read.m").write_text("\n".join(lines), encoding="utf-8")
    out = said("octave-cli", "-qf", tmp_path / "read.m")
    assert [part.strip() for part in out.split("|")[:-1]] == expected


def test_r_reads_units_texts_and_coordinates(files, tmp_path):
    needs("Rscript", "r-base-core r-cran-ncdf4", "-e", "library(ncdf4)")
    lines, expected = [R], []
    for kind, (text, value, number, unit, texts, first) in ASKED.items():
        lines.append(f"f <- nc_open('{files[kind]}')")
        asked = [f"ncatt_get(f, '{number}', 'units')$value"]
        expected.append(unit)
        if value:
            asked.append(f"ncatt_get(f, 0, '{text}')$value")
            expected.append(value)
        if texts:
            asked.append(f"ncvar_get(f, '{texts}')[1]")
            expected.append(first)
        asked.append(f"is.numeric(ncvar_get(f, '{number}'))")
        expected.append("TRUE")
        lines += [f"cat({one}, '|', sep = '')" for one in asked]
    (tmp_path / "read.R").write_text("\n".join(lines), encoding="utf-8")
    assert said("Rscript", "--encoding=UTF-8", tmp_path / "read.R").split("|")[:-1] == expected


@functools.cache
def dumped(path):
    return said("ncdump", path)


def test_ncdump_prints_no_text_of_variable_length(files):
    needs("ncdump", "netcdf-bin")
    for kind, (text, value, number, unit, texts, _) in ASKED.items():
        out = dumped(files[kind])
        assert "string " not in out.split("data:")[0], kind
        assert f'{number}:units = "{unit}" ;' in out
        assert not value or f':{text} = "{value}" ;' in out
        assert not texts or f"char {texts}(" in out


def test_a_copy_by_nccopy_is_the_same_result(files, tmp_path):
    """Packed, chunked, and with another history, it is still what wingbeat wrote."""
    needs("nccopy", "netcdf-bin")
    for kind in ("orbit", "curve"):
        said("nccopy", "-d9", "-s", files[kind], tmp_path / "copy.nc")
        xr.testing.assert_identical(load_dataset(tmp_path / "copy.nc"), load_dataset(files[kind]))


def test_texts_of_every_kind_come_back_as_they_were(files):
    with xr.open_dataset(files["study"], engine="h5netcdf") as study:
        assert study["name"].values.tolist() == ["flügel 30°", ""]
        assert study["stable"].values.tolist() == [True, False]
    orbit = load_dataset(files["orbit"])
    assert orbit["body_pitch"].attrs["symbol"] == "ψ"
    assert orbit["corner"].values.tolist()[0] == "leading inner"
