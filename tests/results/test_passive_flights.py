"""Simulated flights of a wing whose pitch gives way: its hinge starts at rest or as given, and goes on."""

import dataclasses
import json

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

import wingbeat as wb
from tests.helpers.programs import compiled
from tests.helpers.reflight import dop853
from wingbeat.cli import main
from wingbeat.mechanics.flights import state_rates

pytestmark = pytest.mark.slow


def flown(orbit, beats=2, samples=64, **given):
    given = {"hinge": orbit.record()["hinge_start"]} | given
    start = given.pop("start", orbit.initial_state)
    return wb.simulate(orbit.problem.model, orbit.wingbeat, start, beats, samples, **given)


@compiled
def _rates(model, wingbeat, phase, state, wind):
    through_air = state_rates(model, wingbeat, phase, state.at[3:5].add(-wind))
    return through_air.at[:2].add(wind) / wingbeat.frequency


def test_an_orbit_is_repeated(passive_orbit):
    flight = flown(passive_orbit, beats=3, samples=256)
    data, series = flight.dataset, passive_orbit.dataset
    for k in range(3):
        beat = data.isel(phase=slice(256 * k, 256 * k + 257))
        for name in ("hinge_angle", "hinge_rate", "hinge_torque", "wing_pitch", "body_pitch", "w", "flap_torque"):
            scale = np.abs(series[name]).max()
            assert np.abs(beat[name].values - series[name].values).max() < 1e-5 * scale, name
    assert np.abs(flight.hinge[::256] - flight.hinge[0]).max() < 1e-6
    assert (data["pitch_torque"] == 0).all()
    assert data["hinge_angle"].attrs["units"] == "rad"


def test_the_drawn_wing_has_the_pitch_that_was_flown(passive_orbit):
    """Corners of the strips, from which viewer and films draw the wing: their chord is turned by the hinge."""
    data = flown(passive_orbit, hinge=(0.2, 1.0)).dataset
    corner, body = data["strip_corner"].values[:, 4], data["body_pitch"].values
    beta = passive_orbit.problem.vehicle.wing.stroke_plane_angle
    along, out = corner[:, 0] - corner[:, 3], corner[:, 1] - corner[:, 0]
    turn = body + 0.5 * np.pi - beta
    ahead = np.stack([np.cos(turn), np.zeros_like(turn), np.sin(turn)], axis=-1)
    up = np.cross(ahead, out / np.linalg.norm(out, axis=-1, keepdims=True))
    found = np.arctan2(np.sum(along * up, axis=-1), np.sum(along * ahead, axis=-1))
    np.testing.assert_allclose(found, data["hinge_angle"], rtol=0, atol=1e-12)
    assert np.ptp(found) > 0.5


def test_by_default_the_hinge_is_at_rest(passive_orbit):
    flight = flown(passive_orbit, hinge=None)
    assert flight.hinge[0].tolist() == [passive_orbit.wingbeat.pitch_hinge.rest_angle, 0.0]
    assert np.abs(flight.states[-1] - flown(passive_orbit).states[-1]).max() > 1e-2
    again = flown(passive_orbit, beats=1, start=flight.states[64], hinge=flight.hinge[64])
    np.testing.assert_allclose(again.hinge[-1], flight.hinge[-1], rtol=0, atol=1e-7)


def test_a_gust_is_flown_as_scipy_flies_it(passive_orbit):
    beat, model = passive_orbit.wingbeat, passive_orbit.problem.model
    gust = wb.winds.CosineGust(u=-0.5, w=1.0, start=0.3 / beat.frequency, duration=1.2 / beat.frequency)

    def rates(phase, state):
        wind = np.array(gust(np.array([phase / beat.frequency])))[:, 0]
        return _rates(model, beat, np.asarray(phase % 1.0), state, wind)

    start = np.hstack([passive_orbit.initial_state, [*passive_orbit.record()["hinge_start"].values()]])
    end = dop853(rates, (0.0, 2.0), start, rtol=1e-10)
    found = flown(passive_orbit, wind=gust)
    # The cubics' error; the gust moves the hinge by much more.
    assert np.abs(np.hstack([found.states[-1], found.hinge[-1]]) - end).max() < 2e-3
    assert np.abs(found.hinge[:, 0] - flown(passive_orbit).hinge[:, 0]).max() > 0.01


def test_an_even_wind_is_still_air_that_moves_along(passive_orbit):
    wind = np.array([1.5, -0.7])
    start = np.add(passive_orbit.initial_state, [0, 0, 0, *wind, 0])
    blown, still = flown(passive_orbit, wind=tuple(wind), start=start), flown(passive_orbit)
    assert np.abs(blown.hinge - still.hinge).max() < 1e-6
    for name in ("force_z", "hinge_torque", "alpha"):
        scale = np.abs(still.dataset[name]).max()
        assert np.abs(blown.dataset[name] - still.dataset[name]).max() < 1e-6 * scale, name


def test_energy_is_what_air_flap_springs_and_dampers_give(passive_orbit):
    data = flown(passive_orbit, beats=2, samples=512, hinge=(0.2, 1.0)).dataset
    energy = (data["kinetic_energy"] + data["potential_energy"]).values
    power = (data["air_power"] + data["hinge_power"] + data["hinge_torque"] * data["hinge_rate"]).values
    given = cumulative_simpson(power, x=data["time"].values, initial=0.0)
    assert np.abs(energy - energy[0] - given).max() < 2e-5 * np.abs(given).max()


def test_a_controller_changes_the_beat_and_not_whether_the_pitch_gives_way(passive_orbit):
    beat = passive_orbit.wingbeat
    faster = dataclasses.replace(beat, frequency=1.1 * beat.frequency)
    flight = flown(passive_orbit, controller=lambda k, state: faster if k else beat)
    np.testing.assert_allclose(flight.hinge[:65], flown(passive_orbit).hinge[:65], rtol=0, atol=1e-12)
    assert flight.dataset["hinge_angle"].shape == (129,)
    bare = dataclasses.replace(beat, pitch_hinge=None)
    with pytest.raises(wb.InvalidInputError, match=r"controller = .*: takes away the hinge .* after 0 beats"):
        flown(passive_orbit, controller=lambda k, state: bare)


def test_bad_starts_are_refused(passive_orbit, pigeon_orbit):
    for hinge, words in (
        ((1.0,), r"hinge = .*: must be two numbers; angle \[rad\] and rate"),
        ({"angle": 1.0}, r"hinge = .*: must be two numbers"),
        ((30.0, 0.0), r"hinge\.angle = 30"),
        ((0.1, float("nan")), r"hinge\.rate = nan"),
    ):
        with pytest.raises(wb.InvalidInputError, match=words):
            flown(passive_orbit, hinge=hinge)
    with pytest.raises(wb.InvalidInputError, match=r"hinge = .*: has no effect on .* whose pitch is prescribed"):
        wb.simulate(pigeon_orbit.model, pigeon_orbit.wingbeat, wb.State(u=10.0), hinge=(0.0, 0.0))


def test_a_saved_orbit_knows_its_start_and_the_shell_repeats_it(passive_orbit, tmp_path, capsys):
    path = tmp_path / "orbit.nc"
    passive_orbit.save(path)
    assert wb.load_orbit(path).record()["hinge_start"] == passive_orbit.record()["hinge_start"]
    code = main(["simulate", "--from", str(path), "--beats", "2", "--json", "-o", str(tmp_path / "flight.nc")])
    assert code == 0
    last = json.loads(capsys.readouterr().out)["beats"][-1]
    for name in ("body_pitch", "u", "w"):
        assert last[name] == pytest.approx(getattr(passive_orbit.initial_state, name), abs=1e-6)
    assert main(["simulate", "robofalcon2", "--set", "pitch_hinge.stiffness=1.4", "--beats", "1", "--json"]) == 0


def test_a_film_of_such_a_wing_says_that_its_pitch_does_nothing():
    robot = wb.load_species("robofalcon2")
    film = wb.experiment.fit_film(wb.experiment.synthetic_film(robot.wingbeat, frames=60, noise_deg=0.0))
    passive = robot.with_values({"pitch_hinge.stiffness": 1.4})
    words = "the filmed pitch has no effect"
    assert any(words in note for note in wb.filmed_species(film, passive).warnings)
    assert not any(words in note for note in wb.filmed_species(film, robot).warnings)
