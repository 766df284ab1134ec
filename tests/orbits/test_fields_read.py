"""A search computes only the fields of a beat that its objective and limits read; the results are the same."""

import jax
import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.flight.beat import BY_STRIP, Beat, WeightedSamples
from wingbeat.orbits.flight.time_series import beat_reader
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.outputs import Outputs
from wingbeat.orbits.problem.quantities import QUANTITIES, Constraint, Quantity
from wingbeat.orbits.starts import start_point


def fields_of(quantity, drive):
    return set(Outputs([quantity], [], 10, drive).fields)


def test_a_muscles_power_reads_torques_and_rates_only():
    pigeon = wb.load_species("pigeon").with_muscle()
    needed = {"flap", "flap_rate", "wing_pitch_rate", "flap_torque", "pitch_torque", "frequency"}
    assert fields_of(QUANTITIES["metabolic_power"], pigeon.vehicle.drive) - {"phase"} == needed


@pytest.mark.parametrize(
    ("of", "needed"),
    [
        (lambda beat: beat.mean(beat.lift.sum(axis=1)), {"lift"}),
        (lambda beat: beat.hinge_power.max(), {"hinge_power"}),
        (lambda beat: beat.time, {"time"}),
        (lambda beat: beat.mean(beat.u) + 0.0 * beat.lift.sum(), {"u", "lift"}),
    ],
)
def test_fields_are_found_in_what_a_users_function_computes(of, needed):
    assert fields_of(Quantity("own", of), wb.load_species("pigeon").vehicle.drive) - {"phase"} == needed


def test_a_function_that_only_looks_at_a_field_gets_all_of_them():
    of = lambda beat: beat.mean(beat.u) / beat.lift.shape[1]  # noqa: E731
    assert len(fields_of(Quantity("own", of), wb.load_species("pigeon").vehicle.drive)) == len(Beat._fields) - 1


@pytest.mark.slow
def test_values_and_derivatives_are_those_of_the_whole_beat():
    pigeon = wb.load_species("pigeon")
    limit = Constraint(QUANTITIES["peak_pitch_torque"], 0.1)
    problem = wb.OrbitProblem(pigeon, speed=10.0, minimise="mean_positive_power", subject_to=[limit])
    programme = Transcription(problem)
    unknowns = programme.physical(programme.scaled(start_point(problem, 0, 0)))
    flown = programme.fly(unknowns[4:], unknowns[:4], 1)
    found, jacobian = programme._read(programme.outputs, unknowns, flown, 1)
    beat, changes = beat_reader(problem.model, pigeon.wingbeat, problem.free, (10.0, 0.0))(unknowns[4:], flown)
    assert beat.lift is not None
    assert changes.actuator_power is not None

    def values(whole):
        return [problem.minimise.of(whole), limit.quantity.of(whole)]

    beat, changes = (series._replace(drive=problem.vehicle.drive) for series in (beat, changes))
    power, torque = (np.asarray(a) for a in values(beat))
    weighted = WeightedSamples(torque)
    assert found[0] == pytest.approx(power, rel=1e-12)
    assert found[1:] == pytest.approx(weighted.peaks / limit.quantity.scale, rel=1e-12)
    step = jax.tree.map(np.zeros_like, beat)
    for k in range(len(unknowns)):
        along = step._replace(**{n: getattr(changes, n)[k] for n in Beat._fields if n != "drive"})
        slope, _ = (np.asarray(a) for a in jax.jvp(values, (beat,), (along,))[1])
        assert jacobian[0, k] == pytest.approx(slope, rel=1e-9, abs=1e-12)


def test_fields_that_take_long_are_left_out():
    pigeon = wb.load_species("pigeon")
    problem = wb.OrbitProblem(pigeon, speed=10.0, minimise="mean_positive_power")
    programme = Transcription(problem)
    unknowns = programme.physical(programme.scaled(start_point(problem, 0, 0)))
    flown = programme.fly(unknowns[4:], unknowns[:4], 1)
    reader = beat_reader(problem.model, pigeon.wingbeat, problem.free, (10.0, 0.0), ("hinge_power",))
    beat, changes = reader(unknowns[4:], flown)
    assert beat.hinge_power.shape == (33,)
    assert changes.hinge_power.shape == (len(unknowns), 33)
    assert all(getattr(beat, name) is None for name in (*BY_STRIP, "actuator_power"))
