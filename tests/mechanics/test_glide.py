"""Steady glides: the closed form, the full equations of motion, trim, what holds the wings, and the command."""

import json
import math

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.cli import main
from wingbeat.mechanics.glide import held_still

PIGEON, BAT = wb.load_species("pigeon"), wb.load_species("bat")
ANGLES = np.radians([2.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0])
ABOVE = {"wing.shoulder": [0.01, 0.02, 0.03], "wing.stroke_plane_angle_deg": 75.0, "body.drag_area": 1e-3}


def column(glides, name):
    return np.array([getattr(glide, name) for glide in glides])


def one_by_one(species, aero=None, **how):
    """Return the glides at `ANGLES`, without the search for the best between them, which takes longest."""
    return [wb.glide_polar(species, aero, [angle], **how).glides[0] for angle in ANGLES]


@pytest.mark.parametrize("drag_area", [0.0, 7.56e-4])
@pytest.mark.parametrize("coefficients", [wb.aero.SuFan(), wb.aero.Dickinson()])
@pytest.mark.parametrize("species", [PIGEON, BAT])
def test_a_plain_wing_glides_as_the_closed_form_says(species, coefficients, drag_area):
    plain = species.with_values({"wingbeat.twist_ratio": 1.0, "body.drag_area": drag_area})
    glides = one_by_one(plain, coefficients)
    wing, air = plain.vehicle.wing, plain.air
    area = 2 * wing.semi_span * wing.chord
    lift, drag = coefficients.lift(ANGLES), coefficients.drag(ANGLES) + drag_area / area
    glide_angle = np.arctan2(drag, lift)
    pressure = plain.vehicle.mass * air.gravity / (area * (lift * np.cos(glide_angle) + drag * np.sin(glide_angle)))
    speed = np.sqrt(2 * pressure / air.density)
    np.testing.assert_allclose(column(glides, "glide_angle"), glide_angle, rtol=1e-8)
    np.testing.assert_allclose(column(glides, "speed"), speed, rtol=1e-8)
    np.testing.assert_allclose(column(glides, "sink"), speed * np.sin(glide_angle), rtol=1e-8)
    np.testing.assert_allclose(column(glides, "glide_ratio"), lift / drag, rtol=1e-8)
    # The wings' weight acts a quarter chord behind the shoulder, which is at the body's centre of mass.
    behind = 0.25 * wing.chord * np.cos(ANGLES - glide_angle)
    moment = -2 * wing.mass * air.gravity * behind
    np.testing.assert_allclose(column(glides, "tail_moment"), moment, rtol=1e-8)
    assert not column(glides, "trimmed").any()
    # The air carries the whole weight, on average half way out; the wings carry their own inside of that.
    share = (1 - (np.arange(10) + 0.5) / 10) ** wing.mass_exponent
    wings = 2 * wing.mass * air.gravity * wing.semi_span * np.average((np.arange(10) + 0.5) / 10, weights=share)
    drag_of_body = np.sin(glide_angle) * 0.5 * air.density * speed**2 * drag_area
    lifted = (plain.vehicle.mass * air.gravity - drag_of_body) * 0.5 * wing.semi_span
    across = 0.5 * air.density * speed**2 * drag_area * np.cos(glide_angle) * 0.5 * wing.semi_span
    stroke = -glide_angle  # the body lies along the path, and so does the flap axis
    vertical = (lifted - wings) * np.cos(stroke) - across * np.sin(stroke)
    np.testing.assert_allclose(column(glides, "flap_torque"), -vertical, rtol=1e-8)


@pytest.mark.parametrize("trim", ["body-pitch", "flap"])
@pytest.mark.parametrize("species", [PIGEON, BAT])
def test_a_trimmed_glide_is_an_equilibrium_of_the_flight(species, trim):
    """The body's accelerations, from sums that know nothing of the glide, vanish; so does every later step."""
    odd = species.with_values(ABOVE) if trim == "body-pitch" else species
    glides = one_by_one(odd, flap=0.1, trim=trim)
    model = wb.FlightModel(odd.vehicle, wb.aero.BladeElement(wb.aero.SuFan()), odd.air)
    trimmed = [glide for glide in glides if glide.trimmed]
    assert len(trimmed) >= 2
    for glide in trimmed:
        assert glide.tail_moment == 0.0
        still = held_still(odd.wingbeat)
        wings = vars(still) | {"flap_mean": glide.flap, "pitch_mean": glide.wing_pitch}
        u, w = glide.speed * math.cos(glide.glide_angle), -glide.sink
        state = wb.State(body_pitch=glide.body_pitch, u=u, w=w)
        found = wb.flight_loads(model, wb.Wingbeat(**wings), state, np.zeros(257))
        np.testing.assert_allclose(found.acceleration, 0.0, atol=1e-8)
        assert float(found.flap_torque[0]) == pytest.approx(glide.flap_torque, rel=1e-8)
        assert float(found.pitch_torque[0]) == pytest.approx(glide.pitch_torque, rel=1e-8)
        assert float(found.hinge_power[0]) == 0.0
    turned = "body_pitch" if trim == "body-pitch" else "flap"
    others = one_by_one(odd, flap=0.1, trim="tail")
    assert np.nanmax(np.abs(column(glides, turned) - column(others, turned))) > 1e-2


def test_a_tail_that_gives_the_moment_asked_for_makes_an_equilibrium():
    glide = wb.glide_polar(PIGEON, angles_of_attack=[0.1], trim="tail").glides[0]
    model = wb.FlightModel(PIGEON.vehicle, wb.aero.BladeElement(wb.aero.SuFan()), PIGEON.air)
    u, w = glide.speed * math.cos(glide.glide_angle), -glide.sink
    q, q_dot = np.array([0, 0, glide.body_pitch, 0.0, glide.wing_pitch]), np.array([u, w, 0, 0, 0])
    tau = wb.generalised_torques(model, held_still(PIGEON.wingbeat), q, q_dot, np.zeros(5), 0.0)
    wanted = [0, 0, glide.tail_moment, glide.flap_torque, glide.pitch_torque]
    np.testing.assert_allclose(tau, wanted, atol=1e-10)


def test_lowered_wings_trim_what_the_body_cannot():
    angles = np.radians([4.0, 6.0, 8.0])
    level = wb.glide_polar(PIGEON, angles_of_attack=angles).glides
    lowered = wb.glide_polar(PIGEON, angles_of_attack=angles, trim="flap").glides
    assert not column(level, "trimmed").any()
    assert column(lowered, "trimmed").all()
    assert (column(lowered, "flap") < 0).all()
    np.testing.assert_allclose(column(lowered, "speed"), column(level, "speed"), rtol=5e-3)


def test_the_slowest_sink_and_the_flattest_path():
    polar = wb.glide_polar(PIGEON, trim="tail")
    assert len(check_legends(wb.plots.glide_page(polar.dataset))) == 6
    sink, ratio = polar.least_sink, polar.best_ratio
    coefficients = wb.aero.SuFan()
    fine = np.radians(np.linspace(4.0, 12.0, 200_001))
    lift, drag = coefficients.lift(fine), coefficients.drag(fine)
    assert ratio.glide_ratio == pytest.approx((lift / drag).max(), rel=1e-10)
    force = np.hypot(lift, drag)
    pressure = PIGEON.vehicle.mass * 9.81 / (2 * 0.279 * 0.112 * force)
    assert sink.sink == pytest.approx((np.sqrt(2 * pressure / 1.225) * drag / force).min(), rel=1e-9)
    assert sink.speed < ratio.speed
    assert sink.sink <= column(polar.glides, "sink").min()
    beyond = np.radians([10.0, 15.0, 20.0])
    assert wb.glide_polar(PIGEON, angles_of_attack=beyond, trim="tail").best_ratio is None


def test_a_payload_glides_faster_along_the_same_path():
    loaded = PIGEON.with_payload(0.1)
    assert loaded.vehicle.mass == pytest.approx(0.416)
    assert loaded.vehicle.body.pitch_inertia == PIGEON.vehicle.body.pitch_inertia
    assert loaded.vehicle.wing == PIGEON.vehicle.wing
    assert PIGEON.with_payload(0.0) is PIGEON
    light, heavy = one_by_one(PIGEON), one_by_one(loaded)
    np.testing.assert_allclose(column(heavy, "glide_angle"), column(light, "glide_angle"), rtol=1e-8)
    np.testing.assert_allclose(column(heavy, "speed") / column(light, "speed"), math.sqrt(416 / 316), rtol=1e-8)


def test_the_command_prints_writes_and_draws(capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    out, figure = tmp_path / "glide.nc", tmp_path / "glide.png"
    words = ["glide", "pigeon", "--alpha", "2:12:2", "--payload", "0.1", "--set", "wing.shoulder=[0.0,0.0,0.03]"]
    assert main([*words, "-o", str(out), "--plot", str(figure)]) == 0
    printed = capsys.readouterr().out
    assert "slowest sink: " in printed
    assert "flattest glide: " in printed
    assert max(len(line) for line in printed.splitlines()) <= 80
    assert main([*words, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    polar = wb.glide_polar(
        PIGEON.with_values({"wing.shoulder": [0, 0, 0.03]}).with_payload(0.1),
        angles_of_attack=np.radians([2, 4, 6, 8, 10, 12]),
    )
    assert record == json.loads(json.dumps(polar.record()))
    with xr.open_dataset(out, engine="h5netcdf") as saved:
        np.testing.assert_array_equal(saved["sink"], record["sink"])
        assert saved["sink"].attrs["units"] == "m s-1"
        assert json.loads(saved.attrs["least_sink"]) == record["least_sink"]
    assert figure.read_bytes().startswith(b"\x89PNG")


def test_where_nothing_glides_ahead_it_says_so(capsys, tmp_path):
    plate = tmp_path / "plate.csv"
    plate.write_text("alpha_deg,c_l,c_d\n0,0,0.1\n10,-0.3,0.2\n30,0.5,0.6\n60,0.6,1.2\n90,0,1.6\n110,-0.3,1.5\n")
    assert main(["glide", "pigeon", "--aero", str(plate), "--alpha", "4:6:1", "--json"]) == 3
    record = json.loads(capsys.readouterr().out)
    assert record["speed"] == [None] * 3
    assert record["least_sink"] is None
    assert "there is no steady forward glide at 3 angles of attack" in record["warnings"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--alpha 0:10:1", "--alpha = '0:10:1': must rise from above 0"),
        ("--alpha 10:2:-1", "must rise"),
        ("--flap-deg 90", "--flap-deg = 90.0"),
        ("--trim rudder", "trim = 'rudder': is not a known choice; use one of body-pitch, flap, tail"),
        ("--payload -1", "payload = -1.0: must be >= 0 kg"),
        ("--set air.gravity=0", "air.gravity = 0.0: must be > 0 m/s2; nothing glides without weight"),
        ("--payload nan", "payload = nan: must be finite"),
        ("--plot glide.txt", "is not a figure format"),
        ("--plot glide.png -o glide.png", "is also the file of --output"),
        ("--strips 0", "aero.strips = 0"),
    ],
)
def test_what_cannot_be_is_refused(capsys, options, words):
    assert main(["glide", "pigeon", *options.split()]) == 2
    assert words in capsys.readouterr().err


def test_the_function_refuses_too():
    with pytest.raises(wb.InvalidInputError, match=r"angles_of_attack.*\n.*flap = 2.*\n.*trim"):
        wb.glide_polar(PIGEON, angles_of_attack=[0.2, 0.1], flap=2, trim="none")
    with pytest.raises(wb.InvalidInputError, match="is no glide polar"):
        wb.plots.glide_page(xr.Dataset())
