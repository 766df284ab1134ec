"""The simulate command: what it flies, prints and writes, and how it ends."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat.cli import main

PITCH_STATE = ("body_pitch", "u", "w", "pitch_rate")


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run `wingbeat simulate` in this process: exit code, stdout; stderr must stay empty."""
    monkeypatch.setenv("COLUMNS", "80")

    def run_here(*words: object) -> tuple[int, str]:
        code = main(["simulate", *map(str, words)])
        told = capsys.readouterr()
        assert told.err == ""
        return code, told.out

    return run_here


@pytest.fixture(scope="session")
def orbit_file(pigeon_orbit: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("orbit") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return path


def test_json_holds_every_beat_and_nothing_else(run: Any, tmp_path: Path) -> None:
    code, out = run("pigeon", "--beats", 2, "--json", "-o", tmp_path / "flight.nc")
    flown = json.loads(out)
    assert (code, set(flown), flown["completed"]) == (0, {"completed", "warnings", "beats"}, True)
    first, second = flown["beats"]
    names = {"beat", "mean_u", "mean_w", "x", "z", *PITCH_STATE, "mean_power"}
    assert set(first) == set(second) == names
    assert (first["beat"], second["beat"]) == (1, 2)
    period = 1 / wb.load_species("pigeon").wingbeat.frequency
    assert first["mean_u"] == pytest.approx(first["x"] / period, rel=1e-12)
    assert second["mean_w"] == pytest.approx((second["z"] - first["z"]) / period, rel=1e-12)

    # The file holds the same flight, and so does the library's.
    with xr.open_dataset(tmp_path / "flight.nc", engine="h5netcdf") as dataset:
        assert dataset.sizes["phase"] == 257
        ends = dataset.isel(phase=[128, 256])
        for name in ("x", "z", *PITCH_STATE):
            assert ends[name].values.tolist() == [first[name], second[name]]
        power = dataset["hinge_power"].values
        assert second["mean_power"] == pytest.approx(np.trapezoid(power[128:], dx=1 / 128), rel=1e-12)
    pigeon = wb.load_species("pigeon")
    model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()), pigeon.air)
    flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=2)
    assert flight.states[-1].tolist() == [second[name] for name in wb.State._fields]


def test_every_variable_has_a_unit_and_a_name(run: Any, tmp_path: Path) -> None:
    assert run("pigeon", "--beats", 1, "-o", tmp_path / "flight.nc")[0] == 0
    with xr.open_dataset(tmp_path / "flight.nc", engine="h5netcdf") as dataset:
        assert len(dataset.variables) > 30
        for name, variable in dataset.variables.items():
            assert variable.attrs["long_name"], name
            assert variable.attrs.get("units") or name in ("axis", "corner"), (
                name
            )  # the axes have names, no numbers
        assert dataset.attrs["Conventions"].startswith("CF-")
        pigeon = wb.load_species("pigeon")
        assert wb.Wingbeat(**json.loads(dataset.attrs["wingbeat"])) == pigeon.wingbeat
        assert json.loads(dataset.attrs["shape"]) == {
            "kind": "bird",
            **json.loads(json.dumps(pigeon.shape.drawn())),
        }
    assert [path.name for path in tmp_path.iterdir()] == ["flight.nc"]
    assert main(["show", str(tmp_path / "flight.nc")]) == 0


def test_the_table_has_units_and_fits_a_terminal(run: Any) -> None:
    code, out = run("pigeon", "--beats", 2)
    assert code == 0
    assert max(map(len, out.splitlines())) <= 80
    assert "\x1b" not in out
    heads = " ".join(word for line in out.splitlines()[:4] for word in line.strip("┃").split("┃"))
    for unit in ("[m/s]", "[deg]", "[rad/s]", "[W]"):
        assert unit in heads
    values = json.loads(run("pigeon", "--beats", 2, "--json")[1])["beats"]
    rows = [line.strip("│").split("│") for line in out.splitlines() if line.startswith("│")]
    shown = [[float(cell) for cell in row] for row in rows]
    for row, beat in zip(shown, values, strict=True):
        exact = [beat["beat"], beat["mean_u"], beat["mean_w"], math.degrees(beat["body_pitch"])]
        assert row == pytest.approx([*exact, beat["pitch_rate"], beat["mean_power"]], abs=6e-4)


def test_an_orbit_returns_after_one_beat(run: Any, orbit_file: Path, pigeon_orbit: Any) -> None:
    code, out = run("--from", orbit_file, "--beats", 1, "--json")
    (beat,) = json.loads(out)["beats"]
    start = pigeon_orbit.orbit.initial_state
    assert code == 0
    assert [beat[name] for name in PITCH_STATE] == pytest.approx([getattr(start, n) for n in PITCH_STATE], abs=1e-6)
    assert beat["mean_u"] == pytest.approx(10.0, abs=1e-5)
    assert beat["mean_w"] == pytest.approx(0.0, abs=1e-5)
    assert beat["mean_power"] == pytest.approx(pigeon_orbit.orbit.record()["mean_power"], rel=1e-3)


def test_a_disturbance_grows_as_the_multipliers_say(run: Any, orbit_file: Path, pigeon_orbit: Any) -> None:
    record = pigeon_orbit.orbit.record()
    growth = max(math.hypot(*pair) for pair in record["floquet_multipliers"])
    assert not record["stable"]
    start = record["initial_state"]
    disturbed = math.degrees(start["body_pitch"]) + 0.001
    out = run("--from", orbit_file, "--body-pitch-deg", disturbed, "--beats", 12, "--json")[1]
    beats = json.loads(out)["beats"]
    miss = [math.dist([beat[n] for n in PITCH_STATE], [start[n] for n in PITCH_STATE]) for beat in beats]
    assert miss[-1] > miss[3] > math.radians(0.001)
    assert (miss[11] / miss[7]) ** (1 / 4) == pytest.approx(growth, rel=0.1)


def test_what_is_given_replaces_the_start(run: Any, orbit_file: Path, tmp_path: Path, pigeon_orbit: Any) -> None:
    words = ("--u", 9, "--w", "-0.5", "--body-pitch-deg", 30, "--pitch-rate", "-1", "--beats", 1)
    start = pigeon_orbit.orbit.initial_state
    for source, place in ((["--from", orbit_file], start), (["pigeon"], wb.State())):
        assert run(*source, *words, "-o", tmp_path / "flight.nc")[0] == 0
        with xr.open_dataset(tmp_path / "flight.nc", engine="h5netcdf") as dataset:
            first = [float(dataset[name][0]) for name in wb.State._fields]
        assert first == pytest.approx([place.x, place.z, math.radians(30), 9.0, -0.5, -1.0], abs=1e-15)


@pytest.mark.slow
def test_settings_and_air_loads_are_heeded(run: Any, tmp_path: Path) -> None:
    words = ("--set", "wingbeat.frequency=8", "air.gravity=0", "--strips", 6, "--beats", 1, "--samples", 16)
    assert run("bat", *words, "--aero", "dickinson", "-o", tmp_path / "flight.nc")[0] == 0
    with xr.open_dataset(tmp_path / "flight.nc", engine="h5netcdf") as dataset:
        assert float(dataset["time"][-1]) == pytest.approx(1 / 8)
        assert (dataset.sizes["phase"], dataset.sizes["station"]) == (17, 6)
        assert json.loads(dataset.attrs["air"])["gravity"] == 0
        assert float(abs(dataset["potential_energy"]).max()) == 0


def test_a_tumbling_start_exits_with_3(run: Any, tmp_path: Path, capsys: Any) -> None:
    words = ("pigeon", "--pitch-rate", 1e5, "--beats", 2)
    code, out = run(*words, "--json", "-o", tmp_path / "lost.nc")
    flown = json.loads(out)
    assert (code, flown["completed"]) == (3, False)
    last = flown["beats"][-1]
    assert last["beat"] == 2
    assert {value for name, value in last.items() if name != "beat"} == {None}
    assert [path.name for path in tmp_path.iterdir()] == ["lost.nc"]  # what was flown is kept
    assert main(["show", str(tmp_path / "lost.nc")]) == 0
    assert "then the vehicle tumbled" in capsys.readouterr().out

    code, out = run(*words)
    assert code == 3
    assert "lost" in out
    assert out.endswith("the vehicle tumbled: the flight could not be finished\n")


def test_an_interrupt_leaves_the_old_file(capsys: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("wingbeat.results.flight.fly_beats", interrupt)
    (tmp_path / "flight.nc").write_text("old")
    assert main(["simulate", "pigeon", "-o", str(tmp_path / "flight.nc")]) == 130
    assert capsys.readouterr().err == "error: interrupted\n"
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("flight.nc", "old")]
