"""Where there is no orbit: the advice keeps the terms of the air loads, and says which made the difference."""

import dataclasses
import functools
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._jax.arrays import jax
from wingbeat.mechanics.flight_loads import flight_loads
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.orbits.changes import (
    TERMS,
    Change,
    Relaxation,
    on_and_off,
    possible_changes,
    terms_on,
    with_change,
    with_trace_of,
    without_term,
    words_without,
)
from wingbeat.orbits.diagnosis import least_change
from wingbeat.orbits.flight.period import LIFT
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import Settings, find_orbit

PIGEON = wb.load_species("pigeon")
ALL = {"unsteady": "thin-aerofoil", "wake": "jones-section", "inflow": "momentum", "induced_factor": 1.4}
ALL |= {"upstroke_factor": 0.4}
# Sectional as they are: making them so takes longer than all else in the tests that solve nothing.
HAND = {"hand": dataclasses.replace(wb.aero.SuFan(), aspect_ratio=math.inf), "hand_from": 0.4}
TAILED = PIGEON.with_tail().with_values({"wingbeat.tail_tilt": 0.1})
TRACE = DEFAULTS.diagnosis.term_trace


def with_all_terms(**more):
    return wb.OrbitProblem(TAILED, 4.0, aero=wb.aero.BladeElement("wang", **ALL, **HAND), **more)


# --- the relaxed problems ---


def test_every_change_keeps_every_term():
    problem = with_all_terms(subject_to=["mean_power<=30", "pitch_mean=0"])
    at_bounds = [(name, sign) for name in (*problem.free, "body_pitch", "flap") for sign in ("<=", ">=")]
    seen = set()
    for change in possible_changes(problem, at_bounds, {LIFT: 0.2}):
        changed = with_change(problem, change.name, change.sign, change.moved(0.1))
        assert changed.aero == problem.aero
        assert (changed.vehicle.tail == problem.vehicle.tail) == (change.name != "incidence")
        assert changed.species.wingbeat.tail_tilt == 0.1
        assert terms_on(changed) == TERMS
        assert jax.tree.structure(changed.model) == jax.tree.structure(problem.model)
        again = FlightModel(changed.vehicle, problem.aero, problem.air, (changed.speed, changed.climb))
        assert changed.model.induced_flow == again.induced_flow
        if change.name in ("mass", "speed"):  # which set the induced flow
            assert changed.model.induced_flow != problem.model.induced_flow
        seen.add(change.name)
    assert {"mass", "speed", "climb", "shoulder", "frequency", "body_pitch", "mean_power", "pitch_mean"} <= seen


def test_a_try_that_the_inflow_refuses_does_not_end_the_others(monkeypatch):
    problem = wb.OrbitProblem(PIGEON, 2.0, aero=wb.aero.BladeElement("su-fan", inflow="momentum"))
    flown = []
    monkeypatch.setattr(
        Transcription, "optimise", lambda easy, x, *_: (flown.append(easy.problem.climb), True) and (x, True)
    )
    monkeypatch.setattr(Transcription, "is_closed", lambda *_: False)
    sinking = Change("climb", "=", 0.0, -6.0, 1.0, (1.5, 5.0))
    with pytest.raises(wb.InvalidInputError, match="is a descent into the wings' own wake"):
        with_change(problem, "climb", "=", sinking.moved(1.5))
    assert least_change(problem, sinking, problem.unknowns().lower, DEFAULTS) is None
    assert set(flown) == {-5.0}


# --- a problem without one of its terms ---


@pytest.mark.parametrize("name", TERMS)
def test_a_term_is_taken_out_alone(name):
    problem = with_all_terms()
    other = without_term(problem, name)
    assert set(terms_on(other)) == set(TERMS) - {name}
    assert (other.free, other.bounds, other.speed) == (problem.free, problem.bounds, problem.speed)
    on, off, _ = on_and_off(problem, name)
    assert on != off
    change = Relaxation(name, "=", *on_and_off(problem, name), words_without(problem, name, 9.0))
    assert "9 Hz" in change.text
    applied = change.apply(problem)
    assert (applied.aero, applied.vehicle) == (other.aero, other.vehicle)


@pytest.mark.parametrize("name", [name for name in TERMS if name != "hand"])
def test_a_trace_of_a_term_needs_no_other_program_and_is_as_good_as_nothing(name):
    problem = with_all_terms()
    if name in ("unsteady", "wake"):  # one share scales both
        assert with_trace_of(problem, name, TRACE) is None
        problem = without_term(problem, {"unsteady": "wake", "wake": "unsteady"}[name])
    trace = with_trace_of(problem, name, TRACE)
    assert trace is not None
    assert jax.tree.structure(trace.model) == jax.tree.structure(problem.model)
    odd = [
        (was, now)
        for was, now in zip(*(jax.tree.leaves(p.model) for p in (problem, trace)), strict=True)
        if not np.allclose(was, now, rtol=1e-9, atol=0.0, equal_nan=True)
    ]
    gone = {
        "unsteady": 1,
        "wake": 1,
        "inflow": 3,
        "upstroke_factor": 3,
        "tail": 1,
    }  # leaves: induced factor and flow
    assert 1 <= len(odd) <= gone[name]
    for was, now in odd:
        if np.ndim(now) < 2:  # not what the wake knows of the polar
            assert (np.abs(now - (name == "upstroke_factor")) <= 2e-5 * np.abs(was) + TRACE).all()
    assert terms_on(trace) == terms_on(problem)


def test_no_term_no_trial_and_a_tail_that_turns_stays():
    assert terms_on(wb.OrbitProblem(PIGEON, 4.0)) == ()
    asked = {"free": (*PIGEON.free, "tail_tilt"), "bounds": {"tail_tilt": (-0.5, 0.5)}}
    assert terms_on(wb.OrbitProblem(TAILED, 4.0, **asked)) == ()
    assert with_trace_of(with_all_terms(), "hand", TRACE) is None


def test_a_share_of_no_term_is_left_with_none():
    half = wb.OrbitProblem(PIGEON, 8.0, aero=wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil", share=0.5))
    assert without_term(half, "unsteady").aero == wb.aero.BladeElement("su-fan")
    both = dataclasses.replace(half, aero=dataclasses.replace(half.aero, inflow="momentum"))
    assert without_term(both, "unsteady").aero.share == 0.5
    traced = with_trace_of(both, "unsteady", TRACE)
    assert traced is not None
    assert traced.model.induced_factor == pytest.approx(both.model.induced_factor)


@pytest.mark.parametrize(
    ("model", "words"), [("su-fan", "on a wing of aspect ratio 6"), ("wang", "on a finite wing")]
)
def test_what_the_polar_holds_of_the_inflow_is_told(model, words):
    problem = wb.OrbitProblem(PIGEON, 4.0, aero=wb.aero.BladeElement(model, inflow="momentum"))
    assert words in words_without(problem, "inflow", 9.0)


# --- a search, where unsteady terms cost too much force ---

HASTY = wb.SolverOptions(
    diagnosis=wb.DiagnosisOptions(far_iterations=2, back_iterations=2, back_times=1, term_starts=1)
)


@functools.cache
def slow():
    loads = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil")
    problem = wb.OrbitProblem(PIGEON, 8.0, aero=loads, bounds={"frequency": (1.0, 9.8)})
    return find_orbit(problem, Settings(1, most_starts=1, options=HASTY), threads=1)


@pytest.mark.slow
def test_the_term_that_made_the_difference_is_told_and_certified():
    found = slow()
    assert found.status is wb.Status.INFEASIBLE
    change = found.relaxations[-1]
    assert (change.name, change.old, change.new) == ("unsteady", 1.0, 0.0)
    assert found.message.endswith(f"; {change.text}")
    assert Relaxation(**json.loads(json.dumps(vars(change)))) == change
    again = find_orbit(change.apply(found.problem), Settings(1, advise=False))
    assert again.status is wb.Status.CONVERGED
    assert f"closes at {again.wingbeat.frequency:.3g} Hz" in change.text


@pytest.mark.slow
def test_the_force_that_is_told_counts_the_term():
    """What is short is what the mean of all air loads lacks, rotation and added mass among them."""
    found = slow()
    (short,) = found.deficits
    problem, phase = found.problem, found.certificate.phase
    axis, needed = (1, problem.vehicle.mass * problem.air.gravity) if short.law == LIFT else (0, 0.0)

    def lacking(model):
        loads = flight_loads(model, found.wingbeat, wb.State(*found.certificate.states.T), phase)
        return needed - np.trapezoid(loads.air_force[:, axis], phase)

    assert lacking(problem.model) == pytest.approx(short.amount, rel=0.05)
    assert abs(lacking(without_term(problem, "unsteady").model) - short.amount) > 0.2 * abs(short.amount)
