"""The show and plot commands: what they print and draw, and every file they must refuse."""

import io
import json
import re

import numpy as np
import pytest
import xarray as xr
from rich.console import Console

import wingbeat as wb
from wingbeat.cli import main
from wingbeat.cli.show import flight_report, flight_summary
from wingbeat.cli.terminal import print_report
from wingbeat.records.result_files import save_result
from wingbeat.words.orbit_words import orbit_report


@pytest.fixture(scope="module")
def orbit():
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)


@pytest.fixture(scope="module")
def flight(orbit):
    return wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats=2, samples=64)


@pytest.fixture(scope="module")
def files(orbit, flight, tmp_path_factory):
    """One good file of each kind and every bad one."""
    folder = tmp_path_factory.mktemp("files")
    orbit.save(folder / "orbit.nc")
    flight.save(folder / "flight.nc")
    whole = (folder / "orbit.nc").read_bytes()
    (folder / "cut.nc").write_bytes(whole[: len(whole) // 2])
    (folder / "empty.nc").write_bytes(b"")
    (folder / "text.nc").write_text("phase,flap\n0,1\n")
    xr.Dataset({"flap": ("phase", np.zeros(3))}).to_netcdf(folder / "foreign.nc", engine="h5netcdf")
    (folder / "folder.nc").mkdir()
    return folder


BAD_FILES = [
    ("missing.nc", "no such file or directory"),
    ("cut.nc", "it is damaged or cut short"),
    ("empty.nc", "it is not a NetCDF-4 file"),
    ("text.nc", "it is not a NetCDF-4 file"),
    ("foreign.nc", "it is not from wingbeat; give a file that"),
    ("folder.nc", "is a directory"),
]


@pytest.mark.parametrize(("name", "reason"), BAD_FILES)
@pytest.mark.parametrize("command", ["show", "plot"])
def test_bad_files_exit_with_2(files, tmp_path, capsys, command, name, reason):
    output = ["-o", str(tmp_path / "page.png")] if command == "plot" else []
    assert main([command, str(files / name), *output]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith(f"error: cannot read '{files / name}': ")
    assert reason in told.err
    assert not list(tmp_path.iterdir())


def test_damaged_attributes_exit_with_2(orbit, flight, tmp_path, capsys):
    path = tmp_path / "damaged.nc"
    save_result(orbit.dataset.assign_attrs(wingbeat="{"), path)
    for words in (["show", str(path)], ["plot", str(path), "-o", str(tmp_path / "page.svg")]):
        assert main(words) == 2
        assert "error: " in capsys.readouterr().err
    save_result(flight.dataset.drop_vars("hinge_power"), path)
    assert main(["show", str(path)]) == 2
    assert "it is damaged (hinge_power is missing)" in capsys.readouterr().err
    assert [file.name for file in tmp_path.iterdir()] == ["damaged.nc"]


def test_show_prints_the_record(files, orbit, capsys):
    assert main(["show", str(files / "orbit.nc")]) == 0
    told = capsys.readouterr()
    assert told.err == ""
    record = orbit.record()
    lines = told.out.splitlines()
    assert re.fullmatch(r"certified: closes to \de-\d\d", lines[0].rstrip())
    assert lines[1].startswith("plausible: ")
    assert any(
        line.startswith("set by limits, not predicted: flap amplitude 70 deg, and with it") for line in lines
    )
    assert max(map(len, lines)) <= 80
    assert "\x1b" not in told.out
    mass = record["vehicle"]["body"]["mass"] + 2 * record["vehicle"]["wing"]["mass"]
    power = record["mean_power"]
    for label, value in (
        ("species, mean speed", "pigeon at 10 m/s"),
        ("air loads", "su-fan, mirrored, quarter-chord"),
        ("frequency", f"{record['wingbeat']['frequency']:.4g} Hz (follows from the limit of flap"),
        ("flap amplitude", f"{np.degrees(record['wingbeat']['flap_amplitude']):.4g} deg (set by the limit)"),
        ("body pitch, nose up", f"{np.degrees(record['initial_state']['body_pitch']):.4g} deg"),
        ("hinges, mean", f"{power:.4g} W ({power / mass:.4g} W/kg)"),
        ("cost of transport", f"{record['cost_of_transport']:.4g}"),
        ("at the bound of", ", ".join(record["active_bounds"])),
        ("stable", "yes" if record["stable"] else "no"),
    ):
        assert re.search(rf"^  {re.escape(label)} +{re.escape(value)} *$", told.out, re.MULTILINE), label
    assert told.out.count("\n- ") == len(record["warnings"])


def test_show_json_is_the_record_alone(files, orbit, capsys):
    assert main(["show", str(files / "orbit.nc"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == orbit.record()


def test_show_a_flight(files, flight, capsys):
    assert main(["show", str(files / "flight.nc")]) == 0
    out = capsys.readouterr().out
    assert out.startswith("flown: 2 beats\n")
    for part in ("state at the start", "state at the end", "hinges, mean"):
        assert part in out
    assert main(["show", str(files / "flight.nc"), "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert (summary["completed"], summary["beats"]) == (True, 2.0)
    assert list(summary["end"].values()) == flight.states[-1].tolist()
    power = np.trapezoid(flight.dataset["hinge_power"].values, flight.phase) / 2
    assert summary["mean_power"] == pytest.approx(power, rel=1e-12)


def test_show_a_flight_that_was_lost(flight, tmp_path, capsys):
    lost = flight.dataset.copy(deep=True)
    for name in ("hinge_power", "actuator_power", "x", "z", "body_pitch", "u", "w", "pitch_rate"):
        lost[name].values[64:] = np.nan
    save_result(lost, tmp_path / "lost.nc")
    assert main(["show", str(tmp_path / "lost.nc")]) == 0
    assert capsys.readouterr().out.startswith("not finished: 0.9844 beats, then the vehicle tumbled")
    for name in ("hinge_power", "u"):
        lost[name].values[:] = np.nan
    save_result(lost, tmp_path / "never.nc")
    assert main(["show", str(tmp_path / "never.nc"), "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert (summary["beats"], summary["end"], summary["mean_power"]) == (0.0, None, None)


def _printed(record, width=80, **options):
    console = Console(width=width, record=True, file=io.StringIO(), **options)
    print_report(orbit_report(record), console)
    return console


def test_status_is_green_or_red_on_a_terminal(orbit):
    terminal = {"force_terminal": True, "color_system": "standard", "no_color": False}
    good = _printed(orbit.record(), **terminal).export_text(styles=True)
    assert good.startswith("\x1b[1mcertified\x1b[0m: closes to ")  # not green: the amplitude is no bird's
    assert "\x1b[1;33mplausible\x1b[0m: no: " in good
    judged = [one | {"within": True} for one in orbit.record()["plausibility"]]
    both = _printed(orbit.record() | {"plausibility": judged}, **terminal).export_text(styles=True)
    assert both.startswith("\x1b[1;32mcertified\x1b[0m: closes to ")
    assert "\x1b[1;32mplausible\x1b[0m: yes" in both
    lost = orbit.record() | {"status": "infeasible", "message": "no orbit", "stable": None}
    bad = _printed(lost, **terminal).export_text(styles=True)
    assert bad.startswith("\x1b[1;31mnot certified, infeasible\x1b[0m")
    assert "unknown: the orbit is not certified" in bad


def test_text_from_files_is_no_markup(orbit):
    record = orbit.record() | {"species": "[red]x[/red] :bat:", "warnings": ["[bold]see[/bold] [1] [/nothing]"]}
    text = _printed(record).export_text()
    assert "[red]x[/red] :bat:" in text
    assert "[bold]see[/bold] [1] [/nothing]" in text


@pytest.mark.parametrize("width", [30, 40, 80, 200])
def test_every_width_holds_all_words(orbit, width):
    text = _printed(orbit.record(), width).export_text()
    assert max(map(len, text.splitlines())) <= width
    assert "certificate" in text
    assert "…" not in text


def test_what_is_undefined_or_absent_is_not_invented(orbit):
    hover = orbit.record() | {
        "cost_of_transport": None,
        "strouhal": None,
        "floquet_multipliers": [[None, None]] * 4,
    }
    hover["closure"] = dict.fromkeys(hover["closure"])
    text = _printed(hover).export_text()
    assert re.search(r"cost of transport +-", text)
    assert re.search(r"largest residual when re-flown +lost, in", text)
    assert "multipliers" not in text
    assert "not certified, not-converged" in _printed({"status": "not-converged"}).export_text()


@pytest.mark.parametrize(
    ("size", "words"),
    [(2.0, "doubles in +1 beats"), (0.5, "halves in +1 beats"), (1.0, None), (0.0, "halves in +0 beats")],
)
def test_time_to_double(orbit, size, words):
    record = orbit.record() | {"floquet_multipliers": [[0.0, size]] + [[0.0, 0.0]] * 3, "stable": size < 1}
    text = _printed(record).export_text()
    assert re.search(words, text) if words else "a disturbance" not in text


def test_a_flight_can_be_printed_narrow(flight):
    console = Console(width=30, record=True, file=io.StringIO())
    print_report(flight_report(flight_summary(flight.dataset)), console)
    assert max(map(len, console.export_text().splitlines())) <= 30


@pytest.mark.slow
@pytest.mark.parametrize("name", ["orbit.nc", "flight.nc"])
@pytest.mark.parametrize("suffix", ["png", "svg", "pdf"])
def test_plot_writes_the_page(files, tmp_path, capsys, name, suffix):
    path = tmp_path / f"page.{suffix}"
    assert main(["plot", str(files / name), "-o", str(path)]) == 0
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err == f"wrote {path}\n"
    assert path.stat().st_size > 10_000
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("output", ["page.txt", "page", "missing/page.png"])
def test_plot_refuses_the_output(files, tmp_path, capsys, output):
    assert main(["plot", str(files / "orbit.nc"), "-o", str(tmp_path / output)]) == 2
    assert re.match(
        r"error: (--output = .*: is not a figure format; end it in|cannot write ')", capsys.readouterr().err
    )
    assert not list(tmp_path.iterdir())


def test_plot_needs_an_output(files, capsys):
    assert main(["plot", str(files / "orbit.nc")]) == 2
    assert "--output" in capsys.readouterr().err
