"""``wingbeat export``: what it writes, and what it refuses."""

import pytest

import wingbeat as wb
from wingbeat.cli import main


@pytest.fixture(scope="module")
def saved(pigeon_orbit, tmp_path_factory):
    path = tmp_path_factory.mktemp("exports") / "pigeon.nc"
    pigeon_orbit.orbit.save(path)
    return str(path)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("suffix", "begins"),
    [
        *((".csv", b"# gait"), (".mat", b"MATLAB 5.0"), (".xml", b"<mujoco"), (".c3d", b"\x02P")),
        *((".urdf", b"<?xml"), (".sdf", b"<?xml"), (".yaml", b"# one wingbeat")),
    ],
)
def test_every_format_is_written_from_a_saved_orbit(suffix, begins, saved, pigeon_orbit, tmp_path, capsys):
    if suffix == ".c3d":
        pytest.importorskip("ezc3d")
    path = tmp_path / f"gait{suffix}"
    assert main(["export", saved, "-o", str(path), "--samples", "32"]) == 0
    assert path.read_bytes().startswith(begins)
    told = capsys.readouterr().err
    assert f"wrote {path}" in told
    assert ("roll and yaw are guesses" in told) == (suffix in (".urdf", ".sdf"))
    if suffix not in (".mat", ".c3d"):  # which hold the time of writing
        wb.export(pigeon_orbit.orbit, tmp_path / f"again{suffix}", samples=32)
        assert (tmp_path / f"again{suffix}").read_bytes() == path.read_bytes()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "gait.txt"], "--output = 'gait.txt': does not end in a suffix for a gait"),
        (["-o", "gait.nc"], "an orbit is saved as .nc by `wingbeat orbit -o`"),
        (["-o", "gait.csv", "--samples", "0"], "samples = 0: must be a whole number from 2 to 4096"),
        (["-o", "gait.csv", "--samples", "1.5"], '"1.5" is not a whole number'),
        (["-o", "none/gait.csv"], "cannot write 'none/gait.csv'"),
        ([], "--output"),
    ],
)
def test_bad_input_gets_its_sentence(words, said, saved, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["export", saved, *words]) == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_file_of_another_kind_gets_its_sentence(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pigeon = wb.load_species("pigeon")
    flight = wb.simulate(wb.OrbitProblem(pigeon, 10.0).model, pigeon.wingbeat, wb.State(u=10.0), 1, 16)
    flight.save("flight.nc")
    (tmp_path / "text.nc").write_text("phase,flap\n")
    for name, said in (
        ("flight.nc", "cannot read 'flight.nc' as an orbit: it holds another kind of result, 'flight'"),
        ("text.nc", "it is not a NetCDF-4 file"),
        ("missing.nc", "no such file"),
    ):
        assert main(["export", name, "-o", "gait.csv"]) == 2
        assert said in capsys.readouterr().err
    assert not (tmp_path / "gait.csv").exists()


@pytest.mark.slow
def test_an_orbit_that_is_not_certified_ends_with_3(uncertified_orbit, tmp_path, capsys):
    uncertified_orbit.save(tmp_path / "open.nc")
    assert main(["export", str(tmp_path / "open.nc"), "-o", str(tmp_path / "gait.csv")]) == 3
    assert "open.nc: not-converged: the search ended too early" in capsys.readouterr().err
    assert not (tmp_path / "gait.csv").exists()
