"""The words under an answer's numbers."""

import pytest

from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat_explorer.app.panels import _message

FOUND = {"record": {"status": "converged", "message": "", "objective": "frequency"}}


def test_a_certified_answer_needs_no_words():
    assert _message(FOUND) == ""


@pytest.mark.parametrize(
    ("objective", "value", "words"),
    [
        ("frequency", 9.528, "frequency, 9.528 Hz"),
        ("body_pitch_range", 0.1, "body pitch range, 5.73 deg"),
        ("strouhal", 0.25, "strouhal, 0.25"),
    ],
)
def test_a_lower_optimum_of_an_earlier_result_is_told(objective, value, words):
    record = FOUND["record"] | {"objective": objective}
    told = _message({"record": record, "continued_better": value})
    assert told == f"Continuation from an earlier result found a lower {words}. More starts may find it."


@pytest.mark.parametrize("objective", sorted(QUANTITIES))
def test_every_objective_has_words(objective):
    assert " lower " in _message({"record": FOUND["record"] | {"objective": objective}, "continued_better": 1.0})
