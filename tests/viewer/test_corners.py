"""Corners of the strips in the data set, against the model's words written anew."""

import numpy as np
import pytest

import wingbeat as wb


def corners_by_hand(vehicle, beat, strips, phase, x, z, body_pitch):
    """Place one wing's strips by sections 1 and 2 of the model, strip by strip."""
    wing, turn = vehicle.wing, 2 * np.pi * phase
    recovery = (1 - np.sin(turn)) / 2
    length = wing.semi_span * (1 - beat.span_retraction * recovery)
    arm = beat.flap_mean + beat.flap_amplitude * np.cos(turn)
    root_pitch = beat.pitch_mean - beat.pitch_amplitude * np.sin(turn)
    hand, beta = arm - beat.fold_amplitude * recovery, wing.stroke_plane_angle
    up, fore = np.array([-np.cos(beta), 0, np.sin(beta)]), np.array([np.sin(beta), 0, np.cos(beta)])
    out = np.array([0.0, 1.0, 0.0])
    nose = np.array(
        [[np.cos(body_pitch), 0, -np.sin(body_pitch)], [0, 1, 0], [np.sin(body_pitch), 0, np.cos(body_pitch)]]
    )
    found = []
    for i in range(strips):
        eta = (i + 0.5) / strips
        along_arm = np.cos(arm) * out + np.sin(arm) * up
        along_hand = np.cos(hand) * out + np.sin(hand) * up
        inner, outer = min(eta, beat.wrist), max(eta - beat.wrist, 0.0)
        place = np.array(wing.shoulder) + length * (inner * along_arm + outer * along_hand)
        along = along_arm if eta <= beat.wrist else along_hand
        pitch = root_pitch * (1 + (beat.twist_ratio - 1) * eta)
        chordwise = np.cos(pitch) * fore + np.sin(pitch) * np.cross(fore, along)
        chord = np.interp(eta, np.linspace(0, 1, np.size(wing.chord)), np.atleast_1d(wing.chord))
        half = length / strips / 2
        around = ((0.25, -half), (0.25, half), (-0.75, half), (-0.75, -half))
        found.append([place + share * chord * chordwise + away * along for share, away in around])
    return np.array([x, 0.0, z]) + np.array(found) @ nose.T


# As many strips, phases and stations as orbits have, and those of the paper's leaf, whose programs are there.
STATIONS = (0.12, 0.125, 0.11, 0.13, 0.12, 0.11, 0.105, 0.09, 0.095, 0.07, 0.05)


@pytest.mark.parametrize("chord", [None, STATIONS], ids=["rectangle", "stations"])
@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_corners_are_where_the_model_puts_them(name, chord):
    species = wb.load_species(name)
    if chord:
        species = species.with_values({"wing.chord": chord, "wing.shoulder": (0.01, 0.02, 0.005)})
    vehicle, beat = species.vehicle, species.wingbeat
    model = wb.FlightModel(vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    start = wb.State(x=0.3, z=-0.1, body_pitch=0.2, u=9.0, w=0.4, pitch_rate=1.0)
    data = wb.simulate(model, beat, start, beats=1, samples=256).dataset
    assert list(data["corner"].values) == ["leading inner", "leading outer", "trailing outer", "trailing inner"]
    for k in range(0, 257, 16):
        place = (float(data[n][k]) for n in ("phase", "x", "z", "body_pitch"))
        by_hand = corners_by_hand(vehicle, beat, 10, *place)
        np.testing.assert_allclose(data["strip_corner"].values[k], by_hand, rtol=0, atol=1e-13)


def test_quarter_chords_lie_between_the_corners(bats):
    data = bats["su-fan"].dataset
    leading, trailing = data["strip_corner"][:, :, :2].mean("corner"), data["strip_corner"][:, :, 2:].mean("corner")
    np.testing.assert_allclose(0.75 * leading + 0.25 * trailing, data["strip_position"], rtol=0, atol=1e-13)
