"""Cases of any text: a sentence and exit code 2, or an answer without NaN; never a traceback."""

import contextlib
import dataclasses
import io
import json
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.helpers.strip_cases import case_text, flapping_case, forces_text, strips_text
from wingbeat.cli import main

MOTION = flapping_case(strips=2, count=12)
CASE = dataclasses.replace(MOTION, forces={"fz": np.sin(9 * MOTION.times)}, mean_force=None)
FILES = {"case.toml": case_text(CASE), "strips.csv": strips_text(CASE), "forces.csv": forces_text(CASE)}

CELLS = st.sampled_from(
    ["", "nan", "inf", "-1", "0", "1e-300", "1e300", "-1e5", "1e5", "1e3", "x", "1,2", '"', "1e-7"]
)
TOKENS = st.sampled_from(
    [
        "= -1",
        "= 0",
        "= nan",
        "= inf",
        '= "x"',
        "= true",
        "= []",
        "= [1, 2]",
        "= {a = 1}",
        "= 1e300",
        "= 1e-9",
        "= 9e4",
    ]
)
SCALED = ["x_m", "chord_x_m", "area_m2", "vx_m_s", "v3z_m_s"]
FAST = settings(
    max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def outcome(files):
    """Run the command on a case of these texts; return the exit code and what it printed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            (Path(folder) / name).write_bytes(text if isinstance(text, bytes) else text.encode("utf-8", "replace"))
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            words = ["--aero", "su-fan", "--unsteady", "thin-aerofoil-wake", "--inflow", "none", "--json"]
            code = main(["validate", str(Path(folder) / "case.toml"), *words])
    return code, out.getvalue(), err.getvalue()


def check(files):
    code, out, err = outcome(files)
    assert code in (0, 2)
    if code == 2:
        assert out == ""
        assert err.startswith("error: ")
        assert all(line.startswith("error: ") for line in err.splitlines())
    else:
        json.loads(out, parse_constant=lambda name: 1 / 0)


@FAST
@given(st.sampled_from(sorted(FILES)), st.data())
def test_cells_and_values_that_are_anything(file, data):
    lines = FILES[file].splitlines()
    for _ in range(data.draw(st.integers(1, 3))):
        i = data.draw(st.integers(0, len(lines) - 1))
        if file == "case.toml":
            lines[i] = lines[i].split("=")[0] + data.draw(TOKENS)
        else:
            cells = lines[i].split(",")
            cells[data.draw(st.integers(0, len(cells) - 1))] = data.draw(CELLS)
            lines[i] = ",".join(cells)
    check(FILES | {file: "\n".join(lines)})


@FAST
@given(st.sampled_from(sorted(FILES)), st.integers(0, 400), st.integers(0, 400), st.text(max_size=8))
def test_texts_that_are_cut_and_filled(file, start, length, filling):
    text = FILES[file]
    check(FILES | {file: text[:start] + filling + text[start + length :]})


@settings(FAST, max_examples=25)
@given(st.sampled_from(sorted(FILES)), st.binary(max_size=200))
def test_bytes_that_are_anything(file, content):
    check(FILES | {file: content})


@settings(FAST, max_examples=25)
@given(
    st.sampled_from(["x_m", "chord_x_m", "area_m2", "vx_m_s", "v3z_m_s"]), st.floats(1e-9, 1e9), st.floats(0, 1e6)
)
def test_columns_of_any_size(column, factor, shift):
    rows = [line.split(",") for line in FILES["strips.csv"].splitlines()]
    k = rows[0].index(column)
    for cells in rows[1:]:
        cells[k] = repr(float(cells[k]) * factor + shift)
    check(FILES | {"strips.csv": "\n".join(",".join(cells) for cells in rows)})


def test_the_case_itself_is_good():
    code, out, _ = outcome(FILES)
    assert code == 0
    assert json.loads(out)["results"][0]["recommended"]
