"""A wing on a stand against a harmonic oscillator, and the page of published wings against the program."""

from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from wingbeat_evidence.passive_wings import fly, measured, passive_wings

PAGE = Path(__file__).parents[2] / "docs" / "evidence" / "passive_wings.md"


@pytest.mark.parametrize("frequency", [4.0, 9.0])
def test_in_vacuum_the_hinge_is_a_driven_oscillator(frequency: float) -> None:
    """Below and above resonance. Oracle: J a'' + c a' + k a = S flap'', S = sum m r x (hinge-balance)."""
    span, chord, mass, behind, gyration = 0.4, 0.1, 0.02, 0.3, 0.2  # behind the axis, in chords
    stiffness, damping, flap = 0.05, 3e-4, 1e-4
    wing = wb.Wing(span, chord, mass, pitch_axis=0.1, mass_axis=0.1 + behind, mass_gyration=gyration)
    hinge = wb.PitchHinge(stiffness, damping)
    wingbeat = wb.Wingbeat(frequency, 0.0, flap, 0.0, 0.0, pitch_hinge=hinge)
    vacuum = wb.Air(density=1e-12, gravity=0.0)
    aero = wb.aero.BladeElement("su-fan", force_point="centre-of-pressure")
    vehicle = wb.Vehicle(wb.Body(1.0, 1.0), wing)
    found = wb.wing_on_stand(vehicle, wingbeat, aero, vacuum)
    inertia = 2 * mass * chord**2 * (behind**2 + gyration**2)
    coupling = 2 * mass * (span / 2) * behind * chord
    turn = 2 * np.pi * frequency
    response = -coupling * turn**2 / (stiffness - inertia * turn**2 + 1j * turn * damping)
    assert found.amplitude == pytest.approx(flap * abs(response), rel=1e-5)
    assert np.exp(1j * found.lead) == pytest.approx(response / abs(response), abs=1e-5)
    decay = np.exp(-damping / (2 * inertia) / frequency)
    assert np.abs(found.multipliers) == pytest.approx([decay, decay], rel=1e-6)


def test_a_wing_without_a_hinge_is_refused() -> None:
    """And a speed from behind and too few steps, at once."""
    robot = wb.load_species("robofalcon2")
    with pytest.raises(wb.InvalidInputError, match="PitchHinge") as caught:
        wb.wing_on_stand(robot.vehicle, robot.wingbeat, "su-fan", speed=-1.0, steps=4)
    assert "speed" in str(caught.value)
    assert "steps" in str(caught.value)


def test_the_force_acts_at_the_centre_of_pressure_unless_the_loads_say_otherwise() -> None:
    """As in a problem with a hinge: coefficients alone must not put it on the axis, where air turns no wing."""
    robot, hinge = wb.load_species("robofalcon2"), wb.PitchHinge(stiffness=1.4, damping=0.017)
    wingbeat = wb.Wingbeat(6.0, 0.0, 0.6, 0.0, 0.0, pitch_hinge=hinge)
    asked = ["su-fan", *(wb.aero.BladeElement("su-fan", force_point=p) for p in wb.aero.FORCE_POINTS[::-1])]
    alone, centre, quarter = (wb.wing_on_stand(robot.vehicle, wingbeat, one, speed=8.0) for one in asked)
    assert alone.amplitude == centre.amplitude
    assert quarter.amplitude < 0.9 * centre.amplitude or quarter.amplitude > 1.1 * centre.amplitude


def test_a_filmed_wing_leads_by_some_quarter() -> None:
    """Of the film, without the program's least squares: the discrete Fourier sum over the frames of one stroke."""
    case = passive_wings()["cases"][0]
    frames = np.arange(45)
    turn = np.exp(-2j * np.pi * case["frequency"] / case["samples_a_second"] * frames)
    flap, pitch = (np.mean(np.array(case[name])[:45] * turn) for name in ("flap_deg", "pitch_deg"))
    truth = measured(case)
    assert truth.lead == pytest.approx(np.degrees(np.angle(pitch / flap)), abs=2)
    assert truth.harmonic == pytest.approx(2 * abs(pitch), rel=0.03)


@pytest.mark.slow
def test_the_page_states_what_the_program_finds() -> None:
    """The first row, flown again."""
    case = passive_wings()["cases"][0]
    flown = fly(case, "su-fan")
    row = next(line for line in PAGE.read_text(encoding="utf-8").splitlines() if case["name"] in line)
    assert flown.phase_error is not None
    said = (f"{flown.amplitude:.0f}", f"{flown.ratio:.2f}", f"{np.degrees(flown.stroke.lead):.0f}")
    assert " | ".join([*said, f"{flown.phase_error:+.0f}", "yes"]) in row
