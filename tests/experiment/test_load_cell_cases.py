"""Records of a load cell that were reduced to wrong coefficients without a word."""

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.measured_files import record
from tests.helpers.places import ROOT
from wingbeat.cli.app import main
from wingbeat.experiment import read_run, reduce_run

CASES = ROOT / "tests/cases/loadcell"
TRUE = [0.95, 0.45]


@pytest.fixture
def good(tmp_path, monkeypatch):
    """The text of a good record; commands run in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return (CASES / "good.csv").read_text()


def reduced(capsys, *words):
    code = main(["reduce", *map(str, words), "-o", "c.csv"])
    return code, capsys.readouterr().err


def test_a_good_record_lacks_zero_readings(good, capsys):
    assert reduce_run(read_run(CASES / "good.csv")).mean[:2] == pytest.approx(TRUE, abs=0.001)
    code, said = reduced(capsys, CASES / "good.csv")
    assert code == 0
    assert "note: good.csv: zero readings are missing, so the zero is taken as 0" in said
    Path("zeroed.csv").write_text(
        "".join(f"# tare_{n} = 0, 0\n" for n in ("normal_force", "tangential_force", "moment")) + good
    )
    code, said = reduced(capsys, "zeroed.csv")
    assert (code, "note" in said) == (0, False)


def test_a_record_with_semicolons_and_decimal_commas_is_read_and_said(good):
    head, rows = good.split("time", 1)
    rows = ("time" + rows).replace(",", ";").replace(".", ",")
    Path("commas.csv").write_text(head + rows)
    found = reduce_run(read_run("commas.csv"))
    assert found.mean[:2] == pytest.approx(TRUE, abs=0.001)
    assert "commas.csv: read with semicolons between the columns and decimal commas" in found.notes


def test_rest_at_both_ends_gives_the_zero(good, capsys):
    path = CASES / "rest_at_both_ends.csv"
    code, said = reduced(capsys, path)
    assert code == 0
    assert "the record steps within the window, at about 34.9 s: C_L from 1.08 to 0.187" in said
    assert "state the rest, which also measures the zero: --rest 0:4.98 35:39.98" in said
    for spans in (("0:5", "35:40"), ("0:4.98", "35:39.98")):
        code, said = reduced(capsys, path, "--rest", *spans)
        assert (code, "note" in said) == (0, False)
        cells = Path("c.csv").read_text().splitlines()
        row = dict(zip(cells[-2].split(","), map(float, cells[-1].split(",")), strict=True))
        for name, true in zip(("C_L", "C_D"), TRUE, strict=True):
            assert row[name] == pytest.approx(true, abs=3 * row[f"{name}_se"])
            assert row[f"{name}_se"] > 0.001  # the zero's error is ten times that of the window
    means = reduce_run(read_run(path), rest=((0, 5), (35, 40)))
    assert means.mean[:2] == pytest.approx(TRUE, abs=0.002)


def test_a_window_at_rest_is_refused(good, capsys):
    code, said = reduced(capsys, CASES / "rest_at_both_ends.csv", "--last", "5")
    assert code == 2
    assert "from 35 to 39.98 s is at rest" in said
    assert "--rest 0:4.98 35:39.98" in said


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--rest", "0:7", "35:40"], "rest 0:7 = '1.7 N': is not at rest: the force changes within the interval"),
        (["--rest", "0:5", "35:40", "--last", "31"], "is longer than the record of rest_at_both_ends.csv between"),
        (["--rest", "5"], "--rest = '5': is not an interval; write start:end in seconds"),
        (["--rest", "5:0"], "must be a start and a later end"),
        (["--rest", "0:5", "4:6"], "overlaps the interval that ends at 5 s"),
        (["--rest", "50:60"], "must hold at least 16 samples of the record, 0 to 39.98 s"),
        (["--rest", "-1:60"], "covers the whole record"),
    ],
)
def test_rest_that_is_none_is_refused(words, said, good, capsys):
    code, err = reduced(capsys, CASES / "rest_at_both_ends.csv", *words)
    assert code == 2
    assert said in err


def test_rest_and_zero_readings_are_not_mixed():
    run = record(np.random.default_rng(0))
    with pytest.raises(wb.InvalidInputError, match="is stated, and the record has zero readings too"):
        reduce_run(run, rest=((0, 2),))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[m2/s] = 1e-6", "[m2/s] = 1.002e-3", "seems to be the dynamic viscosity of water in Pa s; the kinematic"),
        ("[m2/s] = 1e-6", "= 1.0", "multiply mm2/s, cSt and mPa s by 1e-6"),
        ("[m2/s] = 1e-6", "= 1e-9", "is not that of a liquid"),
        ("[kg/m3] = 998.0", "= 0.998", "is the density in g/cm3? Water has 998 kg/m3"),
        ("[m] = 0.076", "= 76", "row 4, chord = 76.0: must lie between 0.0001 and 10 m; give it in m; is it in mm"),
        ("[m] = 0.076", "= 7.6", "less than a tenth of a plate's there"),
        ("[m/s] = 0.4", "= 40", "is faster than any water tunnel, 30 m/s; give it in m/s; is it in cm/s?"),
        ("[m/s] = 0.4", "= 1e-3", "C_L = 152011"),
        ("# chord", "# speed = 4\n# chord", "speed': appears twice (above as speed [m/s])"),
        ("# chord", "# Speed(m/s) = 4\n# chord", "appears twice (above as speed [m/s])"),
    ],
)
def test_constants_in_other_units_are_refused_in_words(old, new, said, good, capsys):
    text = good.replace(old, new, 1)
    assert text != good
    Path("run.csv").write_text(text)
    code, err = reduced(capsys, "run.csv")
    assert code == 2
    assert said in err


@pytest.mark.parametrize(
    ("factors", "said"),
    [
        ((1, 1e3, 1e3, 1e3), "C_L = 950.07"),
        ((1, 1e3, 1e3, 1e3), "the numbers seem to have forces in mN"),
        ((1, 10, 10, 10), "must lie between -5 and 5: no wing has more"),
        ((1, 1e-3, 1e-3, 1e-3), "less than a tenth of a plate's there, about 0.55"),
        ((1, -1, -1, -1), "C_D = -0.45"),
        ((1, 1, 1, 1e3), "give it about mid-chord, in N m; is it in N mm?"),
        ((1e3, 1, 1, 1), "samples 20 s apart; the times seem to be milliseconds; give seconds"),
        ((50, 1, 1, 1), "the times seem to count samples; give seconds"),
    ],
)
def test_channels_in_other_units_are_refused_in_words(factors, said, good, capsys):
    head, *rows = good.split("alpha_deg\n")
    cells = np.array([[float(cell) for cell in row.split(",")] for row in rows[0].splitlines()])
    cells[:, :4] *= factors
    cells[:, 0] = np.round(cells[:, 0], 6)
    head = head.replace("[s]", "").replace("[N]", "").replace("[N m]", "")
    body = "\n".join(",".join(f"{cell:.9g}" for cell in row) for row in cells)
    Path("run.csv").write_text(f"{head}alpha_deg\n{body}\n")
    code, err = reduced(capsys, "run.csv")
    assert code == 2
    assert said in err


@pytest.mark.parametrize(("name", "said"), [("labview.lvm", "LabVIEW"), ("ati.csv", "an ATI force sensor")])
def test_files_of_instruments_are_named_in_two_sentences(name, said, good, capsys):
    code, err = reduced(capsys, CASES / name)
    assert code == 2
    assert len(err.splitlines()) == 2
    assert said in err
    assert "does not say which is the normal force, the tangential force, the moment; say so: --channels" in err
    assert "give --set speed=.. density=.. viscosity=.. chord=.. span=.. in m/s, kg/m3, m2/s, m, m" in err


def test_faults_of_a_channel_are_said():
    run = record(np.random.default_rng(1))
    normal = np.asarray(run.normal_force)
    spiked = normal.copy()
    spiked[-100] *= 9
    late = run.time > run.time[-1] - 6
    kept = ~late | (run.time > run.time[-1] - 3)
    gap = {
        name: getattr(run, name)[kept]
        for name in ("time", "normal_force", "tangential_force", "moment", "alpha_deg")
    }
    slow = {
        name: np.repeat(getattr(run, name)[::4], 4)[: normal.size]
        for name in ("normal_force", "tangential_force", "moment")
    }
    cases = {
        "is the load cell overloaded?": {"normal_force": np.minimum(normal, np.quantile(normal, 0.9))},
        "normal_force has 1 spikes, the largest": {"normal_force": spiked},
        "tangential_force (0) never changes; is the channel connected?": {"tangential_force": 0 * normal},
        "no samples for 3.0": gap,
        "repeat the one before; the sensor is slower": slow,
        "is too large for a normal force": {"moment": 20 * np.asarray(run.moment)},
        "is the angle in radians?": {"alpha_deg": np.radians(run.alpha_deg)},
    }
    assert reduce_run(run).notes == ()
    for words, change in cases.items():
        assert words in " ".join(reduce_run(dataclasses.replace(run, **change)).notes), words


def test_exchanged_forces_and_a_moment_about_the_leading_edge_are_seen():
    run = dataclasses.replace(record(np.random.default_rng(1)), alpha_deg=45.0)
    assert reduce_run(run).notes == ()
    edge = np.asarray(run.moment) - 0.5 * run.chord * np.asarray(run.normal_force)
    assert "is it about mid-chord" in " ".join(reduce_run(dataclasses.replace(run, moment=edge)).notes)
    names, other = ("normal_force", "tangential_force"), ("tangential_force", "normal_force")
    changes = {name: getattr(run, source) for name, source in zip(names, other, strict=True)}
    changes["tare"] = np.asarray(run.tare)[[1, 0, 2]]
    with pytest.raises(wb.InvalidInputError, match=r"C_T = .* are the two columns exchanged, or are they lift and"):
        reduce_run(dataclasses.replace(run, **changes))


def test_a_drift_is_told_with_advice_that_fits():
    run = record(np.random.default_rng(4))
    scale = abs(float(np.mean(run.normal_force)))
    growing = dataclasses.replace(run, normal_force=run.normal_force + scale * run.time / run.time[-1])
    (note,) = reduce_run(growing).notes
    assert "a smaller --last does not help; check the zero readings" in note
    (*_, note) = reduce_run(dataclasses.replace(growing, tare=None)).notes
    assert "the zero may drift: give zero readings before and after the run, or rest at both ends (--rest)" in note
    since = run.time - (run.time[-1] - 20)
    decaying = dataclasses.replace(run, normal_force=run.normal_force + scale * np.exp(-np.maximum(since, 0) / 3))
    assert "the drift decays: give a smaller --last" in reduce_run(decaying).notes[0]


def test_the_dynamic_viscosity_of_air_is_noted():
    run = record(np.random.default_rng(0))
    air = dataclasses.replace(run, density=1.2, viscosity=1.82e-5, speed=run.speed * np.sqrt(run.density / 1.2))
    assert "seems to be the dynamic one of air in Pa s" in " ".join(reduce_run(air).notes)


def test_the_example_of_the_guide_finds_the_true_force():
    page = (ROOT / "docs/guide/load_cells.md").read_text()
    (code,) = re.findall(r"```py\n(.*?)```", page, re.DOTALL)
    assert "assert abs(means.normal - true) < 3 * means.normal_se" in code
    exec(compile(code, "load_cells.md", "exec"), {})


def test_the_instruments_own_files_are_read_with_a_stated_mapping(good, capsys):
    """Five rows of each case, repeated until the run is long enough."""
    plate = ["--set", "speed=0.4", "density=998", "viscosity=1e-6", "chord=0.076", "span=0.456"]
    for name, channels in (
        ("labview.lvm", ["normal=Fn,tangential=Ft,moment=M,alpha=Angle"]),
        ("ati.csv", ["normal=Fx,tangential=Fy,moment=Fz", "--alpha-deg", "20"]),
    ):
        lines = (CASES / name).read_text().splitlines()
        rows = [re.split(r"[\t,]" if name == "ati.csv" else r"\t", line, maxsplit=1)[1] for line in lines[-5:]]
        mark, comma = ("\t", True) if name == "labview.lvm" else (",", False)
        times = [f"{0.02 * i:.2f}".replace(".", "," if comma else ".") for i in range(1500)]
        body = [f"{time}{mark}{rows[i % 5]}" for i, time in enumerate(times)]
        head = [line for line in lines if not re.match(r"\d+[,.]\d+[\t,]", line)]
        Path(name).write_text("\n".join([*head, *body]) + "\n")
        code, said = reduced(capsys, name, "--channels", *channels, *plate)
        assert code == 0, said
        cells = Path("c.csv").read_text().splitlines()
        row = dict(zip(cells[-2].split(","), map(float, cells[-1].split(",")), strict=True))
        assert [row["C_L"], row["C_D"]] == pytest.approx(TRUE, abs=0.01)
