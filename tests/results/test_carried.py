"""A body that moves as filmed: what its motion takes, and the path from a film."""

import dataclasses
import json
import math

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.unsteady_flights import all_terms, states_at
from wingbeat.cli.app import main
from wingbeat.experiment import BodyPath, Film, fit_body_path, fit_film, read_film, synthetic_film
from wingbeat.models import model_of
from wingbeat.records.flight_dataset import evaluate, evaluate_carried
from wingbeat.results.flight import carry

PHASES = np.linspace(0.0, 1.0, 9)[:-1]
SERIES = np.zeros((3, 17))
SERIES[:, :5] = [[0.0, 1e-3, -2e-3, 4e-4, 0.0], [0.0, 3e-3, 6e-3, 0.0, -5e-4], [0.2, 0.03, -0.02, 0.0, 0.005]]


@pytest.fixture(scope="module")
def flown():
    """A flight with every term of the air loads and every law of the wingbeat."""
    return all_terms("pigeon")


@pytest.mark.slow
def test_a_body_that_flies_freely_misses_nothing_and_any_other_its_share(flown):
    """With the free acceleration the loads are those of a flight; another needs mass times the difference."""
    model, beat = flown
    states = np.transpose(states_at(PHASES))
    free = evaluate(model, beat, PHASES, states)
    loads, missing = evaluate_carried(model, beat, PHASES, states, free.acceleration)
    weight = model.vehicle.mass * model.air.gravity
    for part in missing:
        np.testing.assert_allclose(part, 0.0, atol=1e-9 * weight)
    for name in ("air_force", "flap_torque", "hinge_power", "actuator_power", "air_power", "momentum"):
        np.testing.assert_allclose(getattr(loads, name), getattr(free, name), rtol=1e-9, atol=1e-11, err_msg=name)
    _, needed = evaluate_carried(model, beat, PHASES, states, free.acceleration + np.array([1.0, -2.0, 30.0]))
    assert np.all(np.abs(needed.force_z) > 1e-3 * weight)


def test_momentum_changes_by_air_weight_and_what_is_missing(flown):
    """Along a path, by differences; the angular momentum is about the centre of mass of the whole."""
    model, beat = flown
    path = BodyPath(float(beat.frequency), (8.0, 0.5), SERIES)
    step = 1e-5
    at = PHASES[:, None] + step * np.array([-1.0, 0.0, 1.0])
    phase = at.ravel()
    flight = carry(model, beat, path)
    flight = dataclasses.replace(
        flight, phase=phase, states=path.states(phase), accelerations=path.accelerations(phase)
    )
    data = {name: flight.dataset[name].to_numpy().reshape(at.shape) for name in NEEDED}
    weight = model.vehicle.mass * model.air.gravity
    for axis, pull in (("x", 0.0), ("z", weight)):
        change = (data[f"momentum_{axis}"][:, 2] - data[f"momentum_{axis}"][:, 0]) / (2 * step / beat.frequency)
        force = data[f"force_{axis}"] + data[f"missing_force_{axis}"]
        np.testing.assert_allclose(change, force[:, 1] - pull, atol=1e-5 * weight)
    spin = (data["angular_momentum"][:, 2] - data["angular_momentum"][:, 0]) / (2 * step / beat.frequency)
    away = [data[f"centre_of_mass_{axis}"][:, 1] - data[axis][:, 1] for axis in ("x", "z")]
    force = [(data[f"force_{axis}"] + data[f"missing_force_{axis}"])[:, 1] for axis in ("x", "z")]
    moment = (data["pitching_moment"] + data["missing_moment"])[:, 1] - (away[0] * force[1] - away[1] * force[0])
    np.testing.assert_allclose(spin, moment, atol=1e-4 * weight * model.vehicle.wing.mean_chord)


NEEDED = (
    *("momentum_x", "momentum_z", "force_x", "force_z", "missing_force_x", "missing_force_z", "missing_moment"),
    *("angular_momentum", "pitching_moment", "centre_of_mass_x", "centre_of_mass_z", "x", "z"),
)


def test_a_path_is_its_series_with_exact_derivatives():
    path, step = BodyPath(6.0, (9.0, -0.4), SERIES), 1e-4
    turn = 2 * math.pi * PHASES
    found = path.states(PHASES)
    pitch = 0.2 + 0.03 * np.cos(turn) - 0.02 * np.sin(turn) + 0.005 * np.sin(2 * turn)
    np.testing.assert_allclose(found[:, 2], pitch)
    np.testing.assert_allclose(found[0, :2], 0.0, atol=1e-15)
    around = [path.states(PHASES + way * step) for way in (-1, 1)]
    rates = (around[1] - around[0]) / (2 * step / 6.0)
    np.testing.assert_allclose(rates[:, :3], found[:, 3:], atol=1e-5)
    np.testing.assert_allclose(rates[:, 3:], path.accelerations(PHASES), atol=2e-4)
    assert path.states(np.array([1.0]))[0, :2] == pytest.approx([9.0 / 6, -0.4 / 6])


def body_film(wingbeat, path, noise=0.0, beats=3.0, frames=120, start=0.0):
    """A film of wing and body, with noise [m; deg]."""
    random = np.random.default_rng(2)
    phase = np.linspace(0.0, beats, frames, endpoint=False)
    wing = synthetic_film(wingbeat, frames, 0.0, columns=("flap_deg",))
    states = path.states(phase + start)
    flap = np.degrees(wingbeat.flap_mean + wingbeat.flap_amplitude * np.cos(2 * math.pi * (phase + start)))
    columns = {"flap_deg": flap, "body_x_m": states[:, 0], "body_z_m": states[:, 1]}
    columns = {name: values + random.normal(scale=noise, size=frames) for name, values in columns.items()}
    columns["body_pitch_deg"] = np.degrees(states[:, 2]) + random.normal(scale=100 * noise, size=frames)
    return Film("body", phase, columns, wing.frequency, 0.0, synthetic=True)


@pytest.mark.slow
def test_a_tail_that_is_tilted_to_balance_leaves_no_moment_missing():
    pigeon = wb.load_species("pigeon")
    model = model_of("animal", pigeon)
    flown = model.species(pigeon)
    assert flown.vehicle.tail is not None
    path = BodyPath(float(flown.wingbeat.frequency), (10.0, 0.0), np.zeros((3, 17)))
    own = wb.FlightModel(flown.vehicle, model.aero, flown.air, velocity=path.velocity)
    flight = carry(own, flown.wingbeat, path, 2, 64)
    found = flight.balanced()
    assert found is not None
    assert found.phase[-1] == 1.0
    assert abs(found.summary["missing_moment_mean"]) < 1e-5 < abs(flight.summary["missing_moment_mean"])
    tail = dataclasses.replace(flown.vehicle.tail, area=1e-9)
    vehicle = dataclasses.replace(flown.vehicle, tail=tail)
    small = wb.FlightModel(vehicle, model.aero, flown.air, velocity=path.velocity)
    assert dataclasses.replace(flight, model=small).balanced() is None


def test_a_filmed_path_is_recovered_wherever_the_film_began():
    beat = wb.Wingbeat(6.0, 0.1, 0.8, 0.1, 0.3)
    path = BodyPath(6.0, (9.0, -0.4), SERIES)
    found = fit_body_path(fit_film(body_film(beat, path, start=0.3)))
    assert found.velocity == pytest.approx(path.velocity, abs=1e-7)
    np.testing.assert_allclose(found.states(PHASES), path.states(PHASES), atol=1e-5)
    noisy = fit_body_path(fit_film(body_film(beat, path, noise=2e-4)))
    assert noisy.velocity == pytest.approx(path.velocity, abs=2e-3)
    np.testing.assert_allclose(noisy.states(PHASES)[:, :3], path.states(PHASES)[:, :3], atol=5e-3)


def test_what_no_path_can_be_is_refused():
    beat = wb.Wingbeat(6.0, 0.1, 0.8, 0.1, 0.3)
    short = fit_film(body_film(beat, BodyPath(6.0, (9.0, 0.0), SERIES), beats=0.8))
    with pytest.raises(wb.InvalidInputError, match="too little to separate travel from periodic motion"):
        fit_body_path(short)
    pitch = {"flap_deg": short.film.columns["flap_deg"], "body_pitch_deg": short.film.columns["body_pitch_deg"]}
    only = fit_film(dataclasses.replace(short.film, columns=pitch))
    with pytest.raises(wb.InvalidInputError, match="give the mean velocity"):
        fit_body_path(only)
    assert fit_body_path(only, u=7.0).velocity == (7.0, 0.0)
    with pytest.raises(wb.InvalidInputError, match="is filmed and given too"):
        fit_body_path(only, u=7.0, body_pitch=0.1)
    with pytest.raises(wb.InvalidInputError, match="velocities of the body need times"):
        Film("no clock", short.film.phase, pitch)


@pytest.mark.slow
def test_the_command_says_how_much_of_the_weight_is_held(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("wingbeat.cli.filmed.DRAWS", 3)
    pigeon = wb.load_species("pigeon")
    path = BodyPath(float(pigeon.wingbeat.frequency), (10.0, 0.0), SERIES)
    film = body_film(pigeon.wingbeat, path)
    lines = [
        "time," + ",".join(film.columns),
        *(
            ",".join(f"{value:.9g}" for value in row)
            for row in zip(film.phase / pigeon.wingbeat.frequency, *film.columns.values(), strict=True)
        ),
    ]
    file = tmp_path / "body.csv"
    file.write_text(f"# frequency = {film.frequency!r}\n" + "\n".join(lines))
    assert read_film(file).shows_body
    words = ["simulate", "pigeon", "--kinematics", str(file), "--beats", "1", "--samples", "32"]
    assert main([*words, "--json", "-o", str(tmp_path / "flight.nc")]) == 0
    told = json.loads(capsys.readouterr().out)
    summary = told["summary"]
    assert summary["mean_u"] == pytest.approx(10.0, abs=1e-3)
    with xr.open_dataset(tmp_path / "flight.nc", engine="h5netcdf") as data:
        assert data["missing_force_z"].attrs["units"] == "N"
        assert data.attrs["body"] == "prescribed"
    # On average over a periodic motion the air and what is missing hold the weight.
    model = wb.FlightModel(pigeon.vehicle, "su-fan", pigeon.air)
    flight = carry(model, pigeon.wingbeat, path, 1, 32)
    lift = np.mean(flight.dataset["force_z"].to_numpy()[:-1]) / summary["weight"]
    assert flight.summary["missing_force_z_mean"] == pytest.approx(1.0 - lift, abs=1e-3)
    assert summary["missing_force_z_mean"] == pytest.approx(flight.summary["missing_force_z_mean"], abs=5e-3)
    assert main([*words, "--u", "9"]) == 2
    assert "is filmed and given too" in capsys.readouterr().err
