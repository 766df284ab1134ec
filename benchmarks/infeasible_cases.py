"""Thirty problems without an answer, five of each of six kinds, and the law of balance that each must fail by."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

import wingbeat as wb

LIFT, THRUST, MOMENT = "lift", "thrust", "pitching moment"


class Case(NamedTuple):
    """A problem without an answer: its kind, what is wrong in words, the laws that may be named."""

    kind: str
    what: str
    laws: tuple[str, ...]
    problem: wb.OrbitProblem


def _degrees(**pairs: tuple[float, float]) -> dict[str, tuple[float, float]]:
    return {name: (math.radians(low), math.radians(high)) for name, (low, high) in pairs.items()}


def _loaded(species: Any, times: float) -> Any:
    """Return the species with its whole mass so many times what it is, the load in the body."""
    vehicle = species.vehicle
    return species.with_values({"body.mass": times * vehicle.mass - 2 * vehicle.wing.mass})


def cases() -> Iterator[Case]:
    """Yield the cases. Narrow bounds, rather than parameters held, spare a compilation."""
    pigeon, bat = wb.load_species("pigeon"), wb.load_species("bat")
    dickinson = wb.aero.Dickinson()

    def problem(species: Any, speed: float, frequency: float = 0.0, **more: Any) -> wb.OrbitProblem:
        bounds = {**more.pop("bounds", {})}
        if frequency:
            bounds["frequency"] = (1.0, frequency)
        return wb.OrbitProblem(species, speed=speed, bounds=bounds, **more)

    for species, times, speed, most in (
        (pigeon, 3.0, 8.0, 8.0),
        (pigeon, 2.0, 6.0, 8.0),
        (pigeon, 4.0, 9.0, 10.0),
        (bat, 3.0, 4.0, 6.0),
        (bat, 5.0, 5.0, 8.0),
    ):
        what = f"{species.name} of {times:g} times its mass at {speed:g} m/s, up to {most:g} Hz"
        yield Case("too heavy", what, (LIFT,), problem(_loaded(species, times), speed, most))
    for species, speed, most, aero in (
        (pigeon, 3.0, 8.0, wb.aero.SuFan()),
        (pigeon, 4.0, 7.0, wb.aero.SuFan()),
        (pigeon, 2.0, 7.0, dickinson),
        (bat, 2.0, 4.0, wb.aero.SuFan()),
        (bat, 1.0, 3.0, dickinson),
    ):
        what = f"{species.name} at {speed:g} m/s, up to {most:g} Hz, {aero.name}"
        yield Case("too slow", what, (LIFT,), problem(species, speed, most, aero=aero))
    for species, speed, amplitude, most in (
        (pigeon, 12.0, 6.0, 30.0),
        (pigeon, 14.0, 10.0, 12.0),
        (pigeon, 16.0, 12.0, 10.0),
        (bat, 8.0, 6.0, 30.0),
        (bat, 10.0, 10.0, 12.0),
    ):
        what = f"{species.name} at {speed:g} m/s, flap amplitude up to {amplitude:g} deg, up to {most:g} Hz"
        bounds = _degrees(flap_amplitude=(5.0, amplitude))
        yield Case("amplitude too small", what, (THRUST,), problem(species, speed, most, bounds=bounds))
    for speed, back, swing in (
        (10.0, 0.08, 20.0),
        (12.0, 0.10, 20.0),
        (8.0, 0.09, 15.0),
        (9.0, 0.09, 12.0),
        (11.0, 0.10, 15.0),
    ):
        what = f"pigeon at {speed:g} m/s, shoulders {1000 * back:g} mm back, body pitch within {swing:g} deg"
        bent = pigeon.with_values({"wing.shoulder": [-back, 0.0, 0.0]})
        bounds = _degrees(body_pitch=(-swing, swing))
        yield Case("shoulder too far back", what, (MOMENT,), problem(bent, speed, bounds=bounds))
    held = ["pitch_amplitude=0", "pitch_mean=0", "flap_mean=0"]
    still = _degrees(pitch_amplitude=(0.0, 0.5), pitch_mean=(0.0, 0.5), flap_mean=(-0.5, 0.5))
    for species, speed, how in (
        (pigeon, 10.0, {"subject_to": held}),
        (bat, 8.0, {"subject_to": held}),
        (pigeon, 13.0, {"bounds": still}),
        (bat, 10.0, {"bounds": still}),
        (pigeon, 8.0, {"bounds": still}),
    ):
        kept = "wing pitch amplitude, mean wing pitch and mean flap held at 0"
        if "bounds" in how:
            kept = "wing pitch amplitude and mean wing pitch from 0 to 0.5 deg, mean flap within ±0.5 deg"
        what = f"{species.name} at {speed:g} m/s, {kept}"
        yield Case("no pitch freedom", what, (MOMENT,), problem(species, speed, **how))
    for species, speed, torque in (
        (pigeon, 10.0, 0.3),
        (pigeon, 10.0, 1.0),
        (pigeon, 14.0, 0.5),
        (bat, 6.0, 0.05),
        (bat, 8.0, 0.1),
    ):
        what = f"{species.name} at {speed:g} m/s, flap torque up to {torque:g} N m"
        limit = [f"peak_flap_torque<={torque:g}"]
        yield Case("torque limit", what, (LIFT, THRUST), problem(species, speed, subject_to=limit))


def drawn(count: int, seed: int) -> Iterator[Case]:
    """Yield so many cases of each kind with numbers drawn at random, infeasible or not."""
    random = np.random.default_rng(seed)
    animals = [wb.load_species(name) for name in ("pigeon", "bat")]
    for i in range(count):
        species = animals[i % 2]
        slow, cruise = random.uniform(1.0, 4.0), random.uniform(8.0, 14.0)
        most, times = random.uniform(3.0, 8.0), random.uniform(2.0, 5.0)
        amplitude, back, torque = random.uniform(6.0, 12.0), random.uniform(0.06, 0.15), random.uniform(0.05, 0.5)
        swing = random.uniform(10.0, 30.0)
        bent = species.with_values({"wing.shoulder": [-back, 0.0, 0.0]})
        still = _degrees(pitch_amplitude=(0.0, 0.5), pitch_mean=(0.0, 0.5), flap_mean=(-0.5, 0.5))
        for kind, laws, who, speed, how in (
            ("too heavy", (LIFT,), _loaded(species, times), slow + 3.0, {"bounds": {"frequency": (1.0, most)}}),
            ("too slow", (LIFT,), species, slow, {"bounds": {"frequency": (1.0, most)}}),
            (
                "amplitude too small",
                (THRUST,),
                species,
                cruise,
                {"bounds": _degrees(flap_amplitude=(5.0, amplitude))},
            ),
            ("shoulder too far back", (MOMENT,), bent, cruise, {"bounds": _degrees(body_pitch=(-swing, swing))}),
            ("no pitch freedom", (MOMENT,), species, cruise, {"bounds": still}),
            ("torque limit", (LIFT, THRUST), species, cruise, {"subject_to": [f"peak_flap_torque<={torque:.2g}"]}),
        ):
            what = f"{species.name} at {speed:.3g} m/s: {times:.2g} times its mass, up to {most:.2g} Hz"
            others = {
                "too slow": f"{species.name} at {speed:.3g} m/s, up to {most:.2g} Hz",
                "amplitude too small": f"{species.name} at {speed:.3g} m/s, amplitude up to {amplitude:.3g} deg",
                "shoulder too far back": f"{species.name} at {speed:.3g} m/s, shoulders {1000 * back:.0f} mm back, "
                f"body pitch within {swing:.2g} deg",
                "no pitch freedom": f"{species.name} at {speed:.3g} m/s",
                "torque limit": f"{species.name} at {speed:.3g} m/s, up to {torque:.2g} N m",
            }
            yield Case(kind, others.get(kind, what), laws, wb.OrbitProblem(who, speed=speed, **how))
