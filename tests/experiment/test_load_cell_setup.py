"""What files of load cells do not say: channels, constants and zeros by a setup, a TOML, other files."""

from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.experiment.test_load_cell_files import COUNT, NAMES, PLATE, STEP, lvm, signals
from tests.helpers.places import ROOT
from wingbeat.cli.app import main
from wingbeat.experiment import LoadCellSetup, load_setup, read_run, reduce_run

CASES = ROOT / "tests/cases/loadcell"


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_a_tare_file_is_the_zero_with_its_error():
    plate, setup = signals(zero=0.3), LoadCellSetup(NAMES, PLATE, tare=(Path("still.lvm"),))
    Path("run.lvm").write_text(lvm(plate))
    Path("still.lvm").write_text(lvm(signals(0.0, 0.3, seed=1)))
    true = reduce_run(read_run("run.lvm", LoadCellSetup(NAMES, PLATE)), 20).mean[:2]
    means = reduce_run(read_run("run.lvm", setup), 20)
    force = 0.5 * 998 * 0.4**2 * 0.076 * 0.456
    assert abs(means.normal - 2.9 / force) < 4 * means.normal_se
    assert abs(true[0] - means.mean[0]) > 0.05
    assert 0.01 / force / np.sqrt(COUNT) < means.normal_se < 0.01 / force / np.sqrt(100)
    assert "zero readings are missing" not in " ".join(means.notes)
    drifted = np.asarray([signals(0.0, zero, seed=2) for zero in (0.2, 0.4)])
    for name, loads in zip(("a.lvm", "b.lvm"), drifted, strict=True):
        Path(name).write_text(lvm(loads))
    run = read_run("run.lvm", LoadCellSetup(NAMES, PLATE, tare=(Path("a.lvm"), Path("b.lvm"))))
    np.testing.assert_allclose(run.tare, drifted.mean(axis=2).T, atol=1e-9)


def test_a_tare_file_that_is_none_is_refused():
    Path("run.lvm").write_text(lvm(signals()))
    with pytest.raises(wb.InvalidInputError, match="is the run itself"):
        read_run("run.lvm", LoadCellSetup(NAMES, PLATE, tare=(Path("run.lvm"),)))
    flow = signals(0.0)
    flow[0, COUNT // 2 :] += 2.0
    Path("still.lvm").write_text(lvm(flow))
    with pytest.raises(wb.InvalidInputError, match="is not at rest: the force changes within the record"):
        read_run("run.lvm", LoadCellSetup(NAMES, PLATE, tare=(Path("still.lvm"),)))


def test_a_toml_holds_channels_constants_and_zero(capsys):
    Path("rig").mkdir()
    Path("run.lvm").write_text(lvm(signals(zero=0.3)))
    Path("rig/still.lvm").write_text(lvm(signals(0.0, 0.3, seed=1)))
    constants = "\n".join(f"{name} = {value}" for name, value in PLATE.items())
    names = "\n".join(f'{role} = "{name}"' for role, name in NAMES.items())
    Path("rig/rig.toml").write_text(f'tare = "still.lvm"\nrest = [[0, 1]]\n{constants}\n[channels]\n{names}\n')
    setup, rest = load_setup("rig/rig.toml")
    assert rest == ((0.0, 1.0),)
    assert dict(setup.constants) == PLATE
    Path("rig/rig.toml").write_text(Path("rig/rig.toml").read_text().replace("rest = [[0, 1]]", ""))
    assert main(["reduce", "run.lvm", "-o", "c.csv", "--channels", "rig/rig.toml"]) == 0
    assert "zero readings are missing" not in capsys.readouterr().err
    words = ["reduce", "run.lvm", "-o", "c.csv", "--channels", "normal=-Fz,tangential=Fx,moment=Ty,alpha=Angle"]
    assert main([*words, "--set", *(f"{name}={value}" for name, value in PLATE.items())]) == 2
    assert "--channels normal=-NAME reverses one" in capsys.readouterr().err
    for wrong, said in [
        ("speeed = 1", "speeed': is not known; did you mean speed?"),
        ("speed = 'fast'", "bad.toml, speed = 'fast': must be a number"),
        ("channels = 3", "must be a table"),
        ("rest = [1, 2]", "must be pairs of numbers"),
        ("tare = 3", "must be the names of files"),
    ]:
        Path("bad.toml").write_text(wrong + "\n")
        assert main(["reduce", "run.lvm", "-o", "c.csv", "--channels", "bad.toml"]) == 2
        assert said in capsys.readouterr().err


def test_two_tomls_are_refused(capsys):
    """The last one won, and nothing said so."""
    for name in ("a.toml", "b.toml"):
        Path(name).write_text("speed = 1.0\n")
    Path("run.lvm").write_text(lvm(signals()))
    assert main(["reduce", "run.lvm", "-o", "c.csv", "--channels", "a.toml", "b.toml"]) == 2
    assert (
        "--channels = 'a.toml b.toml': are several TOMLs; keep one, with all of the setup"
        in capsys.readouterr().err
    )


def test_a_log_of_axes_below_constants_is_read():
    """A log below lines "# speed = .." was refused with the advice to give --channels, which were given."""
    loads = signals()
    rows = "\n".join(f"{STEP * i},{x!r},0,{z!r},0,{m!r},0" for i, (z, x, m) in enumerate(loads.T.tolist()))
    constants = "".join(f"# {name} = {value}\n" for name, value in PLATE.items())
    Path("run.csv").write_text(f"{constants}time,Fx,Fy,Fz,Tx,Ty,Tz\n{rows}\n")
    run = read_run("run.csv", LoadCellSetup({"normal": "Fz", "tangential": "Fx", "moment": "Ty"}, {}, 20.0))
    np.testing.assert_array_equal([run.normal_force, run.tangential_force, run.moment], loads)
    assert run.speed == PLATE["speed"]
    with pytest.raises(wb.InvalidInputError, match="which does not say which is the normal force"):
        read_run("run.csv")


def test_what_is_assumed_about_the_zeros_file_is_said():
    Path("run.lvm").write_text(lvm(signals(zero=0.3)))
    Path("still.lvm").write_text(lvm(signals(0.0, 0.3, seed=1), decimal=",", head_decimal=False))
    run = read_run("run.lvm", LoadCellSetup(NAMES, PLATE, tare=(Path("still.lvm"),)))
    assert "still.lvm: its head names no Decimal_Separator" in " ".join(run.notes)


def test_a_reversed_moment_is_noted():
    Path("run.lvm").write_text(lvm(signals()))
    run = read_run("run.lvm", LoadCellSetup(NAMES | {"moment": "-Ty"}, PLATE))
    assert "is it nose-up positive? --channels moment=-NAME reverses it" in " ".join(reduce_run(run, 20).notes)


def test_tables_with_other_names_are_mapped():
    text = (CASES / "good.csv").read_text()
    plain = read_run(CASES / "good.csv")
    renamed = text.replace("normal_force [N]", "Fz (N)").replace("tangential_force [N]", "Fx [mN]")
    Path("run.csv").write_text(renamed.replace("moment [N m]", "Ty"))
    run = read_run("run.csv", LoadCellSetup({"normal": "Fz", "tangential": "Fx", "moment": "Ty"}))
    np.testing.assert_array_equal(run.normal_force, plain.normal_force)
    np.testing.assert_allclose(run.tangential_force, 1e-3 * plain.tangential_force)
    assert run.speed == plain.speed
    with pytest.raises(wb.InvalidInputError, match="speed = 2: is stated, but the file says"):
        read_run("run.csv", LoadCellSetup({"normal": "Fz", "tangential": "Fx", "moment": "Ty"}, {"speed": 2}))


def test_no_error_bar_excuses_a_number_that_nothing_has():
    """Wild samples widened the range of C_M by four of their own standard errors, and were in it."""
    loads = signals()
    loads[2, -150] = 1e20
    Path("run.lvm").write_text(lvm(loads))
    with pytest.raises(wb.InvalidInputError, match=r"C_M = .*: must lie between -5 and 5"):
        reduce_run(read_run("run.lvm", LoadCellSetup(NAMES, PLATE)), 20)
