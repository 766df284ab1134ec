"""Points of wings that are known exactly, from the model's equations, as tracking programs write them."""

import math

import numpy as np

FORWARD, LEFT, UP = np.eye(3)
# Turns of the axes of a file: where the animal's forward, left and up are. All are right-handed.
TURNS = {
    "z up": (FORWARD, LEFT, UP),
    "y up": (FORWARD, -UP, LEFT),
    "x up": (LEFT, UP, FORWARD),
    "z up, flying to -y": (-LEFT, FORWARD, UP),
    "y up, flying to z": (UP, FORWARD, LEFT),
}


def a_beat(seed):
    """Return the parameters of a random wingbeat: angles in degrees, lengths in wings, frequency in Hz."""
    random = np.random.default_rng(seed)
    return {
        "frequency": random.uniform(4, 14),
        "flap_mean": random.uniform(-10, 20),
        "flap_amplitude": random.uniform(25, 55),
        "pitch_mean": random.uniform(-10, 15),
        "pitch_amplitude": random.uniform(5, 30),
        "stroke_plane": random.uniform(70, 110),
        "fold": 0.0,
        "retraction": random.uniform(0, 0.3),
        "climb": random.uniform(-8, 8),
        "speed": random.uniform(8, 25),  # wings a second
        "phase": random.uniform(0, 1),
    }


def points_of(beat, time, side="left", semi_span=0.3, wrist=0.45, trailing=True):
    """Return shoulder, wrist, tip and trailing edge as forward, left, up; the equations are those of frames.md."""
    phase = beat["frequency"] * time + beat["phase"]
    turn = 2 * math.pi * phase
    flap = np.radians(beat["flap_mean"] + beat["flap_amplitude"] * np.cos(turn))
    pitch = np.radians(beat["pitch_mean"] - beat["pitch_amplitude"] * np.sin(turn))
    recovery = (1 - np.sin(turn)) / 2
    length = semi_span * (1 - beat["retraction"] * recovery)
    plane, climb = math.radians(beat["stroke_plane"]), math.radians(beat["climb"])
    up = np.array([-math.cos(plane), 0, math.sin(plane)])
    ahead = np.array([math.sin(plane), 0, math.cos(plane)])

    def along(angle):
        return np.cos(angle)[:, None] * LEFT + np.sin(angle)[:, None] * up

    arm, hand = along(flap), along(flap - np.radians(beat["fold"]) * recovery)
    chord = np.cos(pitch)[:, None] * ahead + np.sin(pitch)[:, None] * np.cross(ahead, arm)
    at = {"shoulder": np.zeros((len(time), 3)), "wrist": wrist * length[:, None] * arm + 0.1 * semi_span * chord}
    at["tip"] = length[:, None] * (wrist * arm + (1 - wrist) * hand)
    if trailing:
        at["trailing"] = wrist * length[:, None] * arm - 0.2 * semi_span * chord
    turned = np.array([[math.cos(climb), 0, -math.sin(climb)], [0, 1, 0], [math.sin(climb), 0, math.cos(climb)]])
    travel = semi_span * beat["speed"] * time[:, None] * np.array([math.cos(climb), 0, math.sin(climb)])
    travel = travel + 0.02 * semi_span * np.sin(turn + 0.4)[:, None] * UP
    root = travel + 0.1 * semi_span * LEFT + np.array([0.1, 0.4, 1.0])
    mirror = np.array([1, 1 if side == "left" else -1, 1])
    return {role: mirror * (root + one @ turned.T) for role, one in at.items()}


def tracked(at, axes="z up", noise=0.0, gaps=0.0, seed=0):
    """Return points in the axes of a file, with noise, and with runs of frames in which a point was hidden."""
    random = np.random.default_rng(seed)
    found = {}
    for role, one in at.items():
        seen = one @ np.array(TURNS[axes]) + random.normal(scale=noise, size=one.shape)
        hidden = random.random(len(one)) < gaps / 4
        hidden = np.convolve(hidden, np.ones(4))[: len(one)] > 0
        seen[hidden & (role != "shoulder")] = np.nan
        found[role] = seen
    return found


def csv_of(at, names=None, sign=",", head="{}_{}"):
    """Return a table with three columns for each point."""
    names = names or list(at)
    rows = [sign.join(head.format(name, axis) for name in names for axis in "xyz")]
    for row in np.hstack(list(at.values())):
        rows.append(sign.join("NaN" if math.isnan(cell) else f"{cell:.5f}" for cell in row))
    return "\n".join(rows) + "\n"
