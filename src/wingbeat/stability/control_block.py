"""Feedback within a beat for other tools: a block of difference equations, as files and as it runs.

At sample j of a beat, with the deviation x of the measured state from the path and the memory m of the block,

    command = clip(-(gains_of_state[j] @ x + gains_of_memory[j] @ m), lower, upper)
    m = memory @ m + input @ command; each servo in m changes by at most largest_step

The memory holds the angles of the servos, as they should be, and the commands that have not yet acted. A robot that
measures its servos puts the measured angles in.
"""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, write_atomically
from wingbeat.stability.servos import SERVO_LAWS, WITHOUT_END, follow

if TYPE_CHECKING:
    from wingbeat.mechanics.flight_model import State

BLOCK_SUFFIXES = (".json", ".mat", ".csv")
_USE = (
    "x = (height above the start and above the climb since then, then the other states) - path[j]",
    "command = clip(-(gains_of_state[j] @ x + gains_of_memory[j] @ m), lower, upper), for all commands [rad]",
    "m = memory @ m + input @ command; each servo in m (the first if held) changes by at most largest_step",
    "j counts the samples of a beat from the top of the stroke; m is zero at the start; SI units, radians",
)
_READINGS = ("pitch_rate", "mean acceleration felt forward", "mean acceleration felt up", "z")
_BIASES = ("bias of pitch_rate", "bias forward", "bias up")
_USE_OF_READINGS = (
    "y = readings - path[j]; accelerations are means over the sample before, as sensors in the body feel them",
    "e = m + gains_of_readings[j] @ (y - output @ m)",
    "command = clip(-gains_of_estimate[j] @ e, lower, upper), for all commands [rad]",
    "m = memory[j] @ e + input[j] @ command; each servo in m (if held) changes by at most largest_step from e",
    "j counts the samples of a beat from the top of the stroke; m is zero at the start; SI units, radians",
)


# Segments whose lengths differ by less than this share of a beat are samples of a clock.
_UNEVEN = 1e-9


def block_of(record: dict[str, Any]) -> dict[str, Any]:
    """Return the block of a record of feedback within a beat: arrays by name, and what they are for.

    Theory: equation ``control-block``.
    """
    gains = np.array(record["gains"])
    order = gains.shape[2] - len(record["memory"]["matrix"])  # states that are measured
    if np.ptp(np.diff(record["phases"])) > _UNEVEN:
        faults = FaultList()
        fix = "give a sample_rate (--sample-rate), or a delay_time"
        faults.add("segments", len(gains), "divide this beat unevenly in time, as no clock does", fix)
        faults.raise_if_any()
    limits = [[record[end][name] for name in record["inputs"]] for end in ("lower", "upper")]
    speeds = [record["servo_speed"][name] for name in record["inputs"]] if record["held"] else []
    largest = [None if speed is None else speed / record["sample_rate"] for speed in speeds]
    block = {
        "use": list(_USE),
        "sample_rate": record["sample_rate"],
        "samples": len(gains),
        "states": record["state"][:order],
        "memories": record["state"][order:],
        "commands": record["inputs"],
        "path": np.array(record["path"])[:-1],
        "gains_of_state": gains[:, :, :order],
        "gains_of_memory": gains[:, :, order:],
        "memory": np.reshape(record["memory"]["matrix"], (gains.shape[2] - order,) * 2),
        "input": np.reshape(record["memory"]["input"], (gains.shape[2] - order, len(record["inputs"]))),
        "largest_step": largest,
        "lower": np.array(limits[0]),
        "upper": np.array(limits[1]),
        "climb": record["climb"],
        "frequency": record["frequency"],
        "delay_time": record["delay_time"],
    }
    return block if record["estimator"] is None else _with_filter(block, record["estimator"])


def _with_filter(block: dict[str, Any], found: dict[str, Any]) -> dict[str, Any]:
    """Return the block of a controller that knows readings alone; its memory is the filter's prediction."""
    gains = np.concatenate([block["gains_of_state"], block["gains_of_memory"]], axis=2)
    more = len(found["output"][0]) - gains.shape[2]
    states = [*block["states"], *block["memories"], "felt forward", "felt up", *_BIASES]
    for name in ("states", "gains_of_state", "gains_of_memory", "memory", "input"):
        del block[name]
    return block | {
        "use": list(_USE_OF_READINGS),
        "memories": states,
        "readings": list(_READINGS[: len(found["output"])]),
        "path": np.array(found["path"]),
        "gains_of_estimate": np.pad(gains, ((0, 0), (0, 0), (0, more))),
        "gains_of_readings": np.array(found["gains"]),
        "output": np.array(found["output"]),
        "memory": np.array(found["by_state"]),
        "input": np.array(found["by_command"]),
    }


def check_block(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a name without a suffix of a block's file."""
    if os.path.splitext(path)[1].lower() not in BLOCK_SUFFIXES:
        fix = "end the name in .json, .mat (MATLAB and Simulink) or .csv (a table)"
        faults.add(where, os.fspath(path), "does not end in a suffix for a controller", fix)


def save_block(record: dict[str, Any], path: str | PathLike[str]) -> None:
    """Write the block of a record to a file; the suffix of its name sets the format."""
    faults = FaultList()
    check_block(faults, "path", path)
    faults.raise_if_any()
    block = block_of(record)
    write = {".json": _json, ".mat": _mat, ".csv": _csv}[os.path.splitext(path)[1].lower()]
    write_atomically(path, write(block))


def _plain(block: dict[str, Any]) -> dict[str, Any]:
    return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in block.items()}


def _json(block: dict[str, Any]) -> bytes:
    return (json.dumps(_plain(block), indent=1, allow_nan=False) + "\n").encode()


def _mat(block: dict[str, Any]) -> bytes:
    """Return a MATLAB file, version 5; its last axis counts the samples, and what has no limit is infinite."""
    from scipy.io import savemat

    content = dict(block)
    content["largest_step"] = np.array([np.inf if one is None else one for one in block["largest_step"]])
    content["path"] = block["path"].T
    for name, value in block.items():
        if isinstance(value, np.ndarray) and value.ndim == 3:
            content[name] = np.moveaxis(value, 0, -1)
        elif isinstance(value, list) and name != "largest_step":
            content[name] = np.array(value, dtype=object)
    held = io.BytesIO()
    savemat(held, {"controller": content}, long_field_names=True, oned_as="column")
    return held.getvalue()


def _csv(block: dict[str, Any]) -> bytes:
    """Return a table: a row for each sample, with the other numbers of the block in comment lines above."""
    series = {name: value for name, value in block.items() if isinstance(value, np.ndarray) and value.ndim == 3}
    out, plain = io.StringIO(), _plain(block)
    for line in block["use"]:
        out.write(f"# {line}\n")
    for name, value in plain.items():
        if name not in ("use", "path", *series):
            out.write(f"# {name} = {json.dumps(value)}\n")
    whole = np.concatenate([value.reshape(len(value), -1) for value in (block["path"], *series.values())], axis=1)
    names = [f"path[{i}]" for i in range(block["path"].shape[1])]
    names += [f"{name}[{i}][{k}]" for name, value in series.items() for i, k in np.ndindex(value.shape[1:])]
    table = csv.writer(out, lineterminator="\n")
    table.writerow(["sample", *names])
    table.writerows([j, *map(repr, row)] for j, row in enumerate(whole.tolist()))
    return out.getvalue().encode()


class ServoDriver:
    """The block at work, with the servos that follow it: what `MujocoFlight.fly` takes as ``servos``.

    Attributes
    ----------
    commands : those so far, each of shape (2,), or (1,) of the flap alone [rad].
    """

    def __init__(self, record: dict[str, Any]) -> None:
        if record["estimator"] is not None:
            faults, fix = FaultList(), "compute the feedback without an IMU"
            faults.add("imu", record["imu"], "has readings that MuJoCo's states do not give", fix)
            faults.raise_if_any()
        laws = record["inputs"]
        if laws not in (list(SERVO_LAWS), list(SERVO_LAWS[:1])):
            faults, fix = FaultList(), "give servos={'flap': ...}, or fly it with SegmentFeedback.fly"
            faults.add("driver", laws, "moves what MuJoCo is not told of", fix)
            faults.raise_if_any()
        self._block, self._held = block_of(record), record["held"]
        self._period = 1.0 / record["sample_rate"]
        speeds, bandwidths = (record[name].values() for name in ("servo_speed", "servo_bandwidth"))
        self._speed = np.array([WITHOUT_END if one is None else one for one in speeds])
        self._pace = np.array([WITHOUT_END if one is None else 2.0 * np.pi * one for one in bandwidths])
        self._steps = np.array([np.inf if one is None else one for one in self._block["largest_step"]])
        self.commands: list[np.ndarray] = []
        self._memory, self._angle, self._ground = np.zeros(len(self._block["memory"])), np.zeros(len(laws)), 0.0

    def command(self, state: State, hinge: Sequence[float] = ()) -> np.ndarray:
        """Return the command of the next sample, and remember it.

        Parameters
        ----------
        state : measured [m, rad, m/s, rad/s].
        hinge : angle and rate of a hinge that gives way [rad, rad/s].
        """
        block, sample, laws = self._block, len(self.commands), self._angle.size
        if sample == 0:
            self._ground = float(state.z)
        j, beats = sample % block["samples"], sample // block["samples"]
        away = np.array([*state, *hinge], dtype=float)[1:] - block["path"][j]
        away[0] -= self._ground + block["climb"] * beats / block["frequency"]
        wanted = -(block["gains_of_state"][j] @ away + block["gains_of_memory"][j] @ self._memory)
        command = np.clip(wanted, block["lower"], block["upper"])
        after = block["memory"] @ self._memory + block["input"] @ command
        if self._held:
            moved = after[:laws] - self._memory[:laws]
            after[:laws] = self._memory[:laws] + np.clip(moved, -self._steps, self._steps)
        self._memory = after
        self.commands.append(command)
        return command

    def __call__(
        self, time: float, step: float, state: State, hinge: Sequence[float] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return angles and rates of flap and pitch, added to the gait, at the end of a step.

        Parameters
        ----------
        time : at the start of the step [s]; steps follow each other, and each sample starts one.
        step : its length [s].
        state, hinge : at its start, as in `command`.

        Raises
        ------
        InvalidInputError : a step that does not divide a sample.
        """
        if abs(self._period / step - round(self._period / step)) > 1e-6:
            faults, each = FaultList(), self._block["samples"]
            fix = f"take a multiple of {each} a beat, such as MujocoFlight(orbit, steps={each * (256 // each)})"
            faults.add("steps", step, "do not divide the controller's samples", fix)
            faults.raise_if_any()
        if time >= len(self.commands) * self._period - 1e-9:
            self.command(state, hinge)
        late, end = self._block["delay_time"], time + step
        change = int(np.floor((end - late) / self._period - 1e-9)) * self._period + late  # of the last command
        for begin, until in ((time, min(max(change, time), end)), (min(max(change, time), end), end)):
            if until > begin and self._held:
                aim = self._aim(0.5 * (begin + until))
                self._angle = np.asarray(follow(self._angle, aim, self._speed, self._pace, until - begin))
        if self._held:
            rate = self._pace * (self._aim(end - 1e-9) - self._angle)
            found = self._angle, np.clip(rate, -self._speed, self._speed)
        else:
            since = (end - late) / self._period
            part = np.pi * (since - np.floor(since))
            height = self._aim(end - 1e-6 * self._period)  # at the end of a bump, the next is not known yet
            found = height * np.sin(part) ** 2, height * np.sin(2.0 * part) * np.pi / self._period
        angle, rate = (np.pad(one, (0, len(SERVO_LAWS) - one.size)) for one in found)
        return angle, rate

    def _aim(self, time: float) -> np.ndarray:
        """Return the command that acts at a time."""
        at = int(np.floor((time - self._block["delay_time"]) / self._period + 1e-9))
        return self.commands[at] if at >= 0 else np.zeros(self._angle.size)
