"""What a record says of pitch hinges: of those that give way, and of those that a prescribed pitch needs."""

import dataclasses
import json
import re
import shlex
from types import SimpleNamespace

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import held_at
from wingbeat.animal.pitch_hinge import PitchHinge
from wingbeat.cli import main
from wingbeat.cli.problem_options import with_settings
from wingbeat.mechanics.hinge_torques import hinge_alone
from wingbeat.orbits.problem.quantities import parse_wingbeat_limit
from wingbeat.records.hinges import hinge_inertia, hinge_names, hinge_warnings, prescribed_numbers
from wingbeat.records.orbit_record import crossing
from wingbeat.words.orbit_words import hinge_rows, power_rows, prescribed_rows

TURN = 2 * np.pi * np.linspace(0.0, 1.0, 257)
ROBOT = wb.load_species("robofalcon2")
GIVING = ROBOT.with_values(
    {"pitch_hinge.stiffness": 1.4, "pitch_hinge.damping": 0.0166, "pitch_hinge.rest_angle_deg": -18.0}
)


def pitched(stiffness, damping, rest, other=0.0, frequency=5.0):
    """Return a beat with the pitch torque of a hinge and a third harmonic, which no hinge gives."""
    pitch = -0.1 + 0.5 * np.cos(TURN + 1.2) + 0.2 * np.sin(2 * TURN)
    rate = 2 * np.pi * frequency * (-0.5 * np.sin(TURN + 1.2) + 0.4 * np.cos(2 * TURN))
    torque = -stiffness * (pitch - rest) - damping * rate + other * np.sin(3 * TURN)
    return SimpleNamespace(wing_pitch=pitch, wing_pitch_rate=rate, pitch_torque=torque)


def test_the_fit_finds_a_hinge_and_what_it_leaves():
    beat = pitched(2.0, 0.03, -0.25, other=0.4)
    found = prescribed_numbers(beat)
    assert [found[f"fitted_{name}"] for name in ("stiffness", "damping", "rest_angle")] == pytest.approx(
        [2.0, 0.03, -0.25], rel=1e-12
    )
    variance = np.var(beat.pitch_torque[:-1])
    assert found["fitted_share"] == pytest.approx(1 - 0.5 * 0.4**2 / variance, rel=1e-12)
    # Angle and rate are orthogonal: without a damper, its torque is left, too.
    lost = np.var(0.03 * beat.wing_pitch_rate[:-1])
    assert found["fitted_share_undamped"] == pytest.approx(1 - (0.5 * 0.4**2 + lost) / variance, rel=1e-12)
    # Springs do no net work, and the third harmonic works on neither: the damper takes up all.
    assert found["mean_pitch_power"] == pytest.approx(-0.03 * np.mean(beat.wing_pitch_rate[:-1] ** 2), rel=1e-12)
    fine, power = np.linspace(0, 256, 256001), beat.pitch_torque * beat.wing_pitch_rate
    positive = np.maximum(np.interp(fine, np.arange(257), power), 0)
    assert found["pitching_power"] == pytest.approx(positive.mean(), rel=1e-4)


def test_a_pitch_that_rests_or_a_flight_that_diverged_has_no_hinge():
    beat = pitched(2.0, 0.0, 0.0)
    rest = {"wing_pitch": 0 * TURN, "wing_pitch_rate": 0 * TURN}
    still = prescribed_numbers(SimpleNamespace(**vars(beat) | rest))
    assert still["fitted_share"] is None
    assert still["peak_pitch_torque"] > 0
    assert ("nearest hinge", "none: the pitch does not move") in prescribed_rows(still)
    lost = prescribed_numbers(SimpleNamespace(**vars(beat) | {"pitch_torque": np.full(257, np.nan)}))
    assert {*lost.values()} == {None}
    assert prescribed_rows(lost) == []


def test_the_command_flies_the_hinge_of_the_fit():
    rows = dict(prescribed_rows(prescribed_numbers(pitched(2.0, 0.03, -0.25, other=0.4))))
    option, *settings = shlex.split(rows["fly them"])
    assert option == "--set"
    hinge = with_settings(ROBOT, settings).wingbeat.pitch_hinge
    assert vars(hinge) == vars(PitchHinge(2.0, 0.03, hinge.rest_angle))
    assert hinge.rest_angle == pytest.approx(-0.25, abs=1e-4)
    assert "the air's part is left out" not in rows


def test_a_fit_to_a_torque_without_the_moment_of_the_air_says_so():
    """With the force at the quarter chord, the stiffness of a robot of 250 g is half of what the air asks for."""
    record = prescribed_numbers(pitched(2.0, 0.03, -0.25))
    for place, told in (("quarter-chord", True), ("centre-of-pressure", False)):
        rows = dict(prescribed_rows({**record, "aero": {"force_point": place}}))
        assert ("--force-point centre-of-pressure" in rows.get("the air's part is left out", "")) == told


@pytest.mark.parametrize(("stiffness", "damping", "lacks"), [(2.0, -0.01, "damping"), (-2.0, 0.01, "stiffness")])
def test_a_driven_pitch_is_called_driven(stiffness, damping, lacks):
    rows = dict(prescribed_rows(prescribed_numbers(pitched(stiffness, damping, -0.25))))
    assert rows[f"negative {lacks}"] == "this pitch is driven: no passive hinge gives it"
    assert "fly them" not in rows


def test_who_has_a_pitch_actuator():
    hummingbird, pigeon = wb.load_species("purdue-hummingbird"), wb.load_species("pigeon")
    kinds = [hinge_names(s.kind, s.vehicle, s.wingbeat) for s in (pigeon, hummingbird, ROBOT, GIVING)]
    assert kinds[0] == ()
    assert kinds[1] == kinds[2] != kinds[3]
    assert "damper_power" in kinds[3]


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_the_inertia_is_that_of_the_equations(share):
    species = GIVING.with_values(
        {
            "pitch_hinge.twist_share": share,
            "wing.pitch_axis": 0.1,
            "wing.mass_axis": 0.35,
            "wing.mass_gyration": 0.2,
        }
    )
    model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan(), strips=7))
    phase = np.array([0.0, 0.3, 0.8])
    held = held_at(species.wingbeat, phase, 0 * phase + 0.2, 0 * phase + 3.0, 0 * phase)
    found = hinge_inertia(species.vehicle, species.wingbeat, 7)
    np.testing.assert_allclose(hinge_alone(model, held, phase)[1], found, rtol=1e-12)
    if share == 0:  # all strips turn by one angle, and have one chord
        wing = species.vehicle.wing
        chords = np.ravel(wing.chord)
        if np.ptp(chords) == 0:
            assert found == pytest.approx(2 * wing.mass * chords[0] ** 2 * (0.25**2 + 0.2**2), rel=1e-12)


def test_the_path_in_the_file_names_a_free_parameter():
    free = GIVING.with_free(["pitch_hinge.stiffness", "vehicle.pitch_hinge.damping", "hinge_rest_angle"])
    assert free.free[-3:] == ("hinge_stiffness", "hinge_damping", "hinge_rest_angle")
    assert free.bounds["hinge_stiffness"] == pytest.approx((0.14, 14.0))
    assert {"hinge_stiffness", "hinge_damping"} <= free.guessed_bounds
    bounds = {"pitch_hinge.stiffness": (1.0, 2.0)}
    problem = wb.OrbitProblem(GIVING, 8.0, free=("frequency", "pitch_hinge.stiffness"), bounds=bounds)
    assert problem.free == ("frequency", "hinge_stiffness")
    assert problem.bounds["hinge_stiffness"] == (1.0, 2.0)
    assert parse_wingbeat_limit("pitch_hinge.stiffness<=2").name == "hinge_stiffness"
    with pytest.raises(wb.InvalidInputError, match="no plausible range"):
        ROBOT.with_free(["pitch_hinge.stiffness"])


def warned(angle, force_point="centre-of-pressure", alpha=0.3, **numbers):
    hinge = PitchHinge(1.4, **numbers)
    beat = SimpleNamespace(alpha=np.full((257, 5), alpha), lift=np.full((257, 5), 2.0), drag=np.full((257, 5), 0.5))
    aero = wb.aero.BladeElement(wb.aero.SuFan(), strips=5, force_point=force_point)
    motion = np.stack([angle * np.cos(TURN), 0 * TURN], axis=1)
    return hinge_warnings(ROBOT.vehicle, aero, SimpleNamespace(pitch_hinge=hinge), beat, motion)


def test_warnings_of_a_hinge():
    assert warned(0.7) == []
    assert warned(0.8, stop_stiffness=50.0, stop_angle=0.75) == []
    assert warned(0.9, stop_stiffness=50.0, stop_angle=0.75) == [
        "the pitch hinge turns 9 degrees beyond its stops at 43 degrees"
    ]
    assert warned(1.7) == ["the pitch hinge turns by up to 97 degrees, and has no stops"]
    assert "nobody measured" in warned(0.7, alpha=2.2)[0]  # su-fan was measured to 110 degrees
    assert warned(0.7, alpha=-0.5) == []  # a plate from its other side
    # x_cp is 0.36 chords at 17 degrees: the lever and the force are those of the formulas.
    (note,) = warned(0.7, "quarter-chord")
    degrees = np.degrees(0.3)
    centre = 0.247 + 0.016 * degrees**0.6 + 0.026 * degrees * np.exp(-0.11 * degrees)
    chord = wb.mechanics.wing_shape.strips_of(ROBOT.vehicle.wing, 5).chord
    moment = 2 * np.sum(chord) * (centre - 0.25) * (2.0 * np.cos(0.3) + 0.5 * np.sin(0.3))
    assert f"with up to {moment:.2g} N m" in note
    assert "it does not turn the hinge" in note


@pytest.fixture(scope="module")
def giving():
    problem = wb.OrbitProblem(GIVING, speed=8.0, minimise="mean_positive_power")
    return wb.solve_orbit(problem, starts=1)


@pytest.mark.slow
def test_the_record_of_hinges_that_give_way(giving, tmp_path, capsys):
    record, series = giving.record(), giving.dataset
    assert record["status"] == "converged"
    angle, flap = series["hinge_angle"].values, series["flap"].values
    assert (record["least_hinge_angle"], record["largest_hinge_angle"]) == (angle.min(), angle.max())
    parts = [[np.trapezoid(2 * x * f(TURN), dx=1 / 256) for f in (np.cos, np.sin)] for x in (angle, flap)]
    (cosine, sine), (flap_cosine, flap_sine) = parts
    assert record["hinge_amplitude"] == pytest.approx(np.hypot(cosine, sine), rel=1e-9)
    lead = np.arctan2(-sine, cosine) - np.arctan2(-flap_sine, flap_cosine)
    assert np.cos(record["hinge_lead"] - lead) == pytest.approx(1.0, abs=1e-12)
    assert 0.4 * np.pi < record["hinge_lead"] < 0.8 * np.pi  # wings pitch about a quarter of a beat ahead
    # Over a beat, the springs return what they take up: the dampers take all that the hinge takes.
    work = -np.trapezoid(series["hinge_torque"] * series["hinge_rate"], dx=1 / 256)
    assert record["damper_power"] == pytest.approx(work, rel=1e-6)
    assert record["peak_hinge_torque"] == pytest.approx(np.abs(series["hinge_torque"].values).max(), rel=1e-12)
    assert record["share_at_stops"] == 0.0
    natural = np.sqrt(1.4 / hinge_inertia(GIVING.vehicle, GIVING.wingbeat, 10)) / (2 * np.pi)
    assert record["hinge_frequency_ratio"] == pytest.approx(natural / record["wingbeat"]["frequency"], rel=1e-12)
    rows = dict(hinge_rows(record))
    assert rows["hinge angle"].endswith(" deg")
    assert "share of the beat at the stops" not in rows
    # The file holds it, and is refused if a number is another.
    giving.save(tmp_path / "own.nc")
    again = wb.load_orbit(tmp_path / "own.nc")
    assert again.record()["damper_power"] == record["damper_power"]
    assert again.record()["hinge_start"] == {name: series[name].values[0] for name in ("hinge_angle", "hinge_rate")}
    assert main(["stability", str(tmp_path / "own.nc")]) == 0
    assert "hinge rate" in capsys.readouterr().out


@pytest.mark.slow
def test_the_figure_shows_the_angle_and_its_rest(giving):
    wing = giving.plot().axes[0]
    drawn = {line.get_label(): line for line in wing.get_lines()}
    assert {"flap φ", "hinge θ", "at rest"} <= {*drawn}
    assert "pitch θ" not in drawn
    np.testing.assert_allclose(drawn["hinge θ"].get_ydata(), np.degrees(giving.dataset["hinge_angle"].values))
    rest = giving.record()["wingbeat"]["hinge_rest_angle"]
    assert drawn["at rest"].get_ydata()[0] == pytest.approx(np.degrees(rest))
    # With stops within what is drawn, they are one entry of the legend.
    stopped = giving.dataset.copy()
    beat = json.loads(stopped.attrs["wingbeat"]) | {"hinge_stop_stiffness": 10.0, "hinge_stop_angle": 0.2}
    stopped.attrs["wingbeat"] = json.dumps(beat)
    page = wb.plots.wingbeat_page(stopped)
    told = [text.get_text() for text in page.axes[0].get_legend().get_texts()]
    assert told == ["flap φ", "hinge θ", "at rest", "stops"]


@pytest.mark.slow
def test_a_curve_holds_the_hinges_numbers():
    curve = wb.solve_curve(wb.OrbitProblem(GIVING, speed=8.0, minimise="mean_positive_power"), [8.0, 8.4], starts=1)
    for name in ("hinge_amplitude", "hinge_lead", "damper_power", "hinge_stiffness", "hinge_rest_angle"):
        assert np.isfinite(curve.dataset[name].values[:, 0]).all()


@pytest.mark.slow
def test_a_robot_says_what_pitches_its_wings():
    hummingbird = wb.load_species("purdue-hummingbird")
    orbit = wb.solve_orbit(wb.OrbitProblem(hummingbird, speed=0.0, minimise="electrical_power"), starts=1)
    record, series = orbit.record(), orbit.dataset
    torque, rate = series["pitch_torque"].values, series["wing_pitch_rate"].values
    # A solver of its own: the normal equations, in place of a factorisation.
    columns = np.stack([series["wing_pitch"].values, 1 + 0 * rate, rate], axis=1)[:-1]
    columns, sizes = columns / np.abs(columns).max(axis=0), np.abs(columns).max(axis=0)
    best = np.linalg.solve(columns.T @ columns, columns.T @ torque[:-1]) / sizes
    assert record["fitted_stiffness"] == pytest.approx(-best[0], rel=1e-6)
    assert record["fitted_damping"] == pytest.approx(-best[2], rel=1e-6)
    assert record["peak_pitch_torque"] == np.abs(torque).max()
    said = dict(power_rows(record))["electrical power"]
    assert "would pitch the wings: no motor does" in said
    assert dict(prescribed_rows(record))


def test_wings_that_meet_where_the_hinge_flies_draw_a_warning(passive_orbit):
    """The shoulder is moved so near that the flown wing crosses by 2 mm; with its hinge at rest it does not."""
    flown = wb.certify(passive_orbit.problem.model, passive_orbit.wingbeat, passive_orbit.initial_state[2:])
    vehicle, hinge = passive_orbit.problem.vehicle, (flown.phase, flown.hinge[:, 0])
    least = float(passive_orbit.dataset["strip_corner"].values[..., 1].min())
    near = (vehicle.wing.shoulder[0], vehicle.wing.shoulder[1] - least - 2e-3, vehicle.wing.shoulder[2])
    narrow = dataclasses.replace(vehicle, wing=dataclasses.replace(vehicle.wing, shoulder=near))
    place = passive_orbit.problem.aero.strips, passive_orbit.wingbeat, (-2.0, 2.0)
    assert crossing(vehicle, *place, hinge) == crossing(narrow, *place) == []
    (note,) = crossing(narrow, *place, hinge)
    across = float(re.search(r"by up to (\S+) mm", note)[1])
    assert across == pytest.approx(2.0, abs=0.15)
