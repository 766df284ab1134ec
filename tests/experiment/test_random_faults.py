"""Of random films and records, nearly all with a fault are refused or warned of, and nearly no good ones."""

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.measured_files import FILM_FAULTS, RECORD_FAULTS, film_text, record
from wingbeat.experiment import fit_film, read_film, reduce_run

EACH = 12


def said_of_film(path, seed, fault=""):
    path.write_text(film_text(np.random.default_rng(seed), fault))
    try:
        beat = fit_film(read_film(path))
    except wb.InvalidInputError as error:
        return [str(fault) for fault in error.faults]
    return [*beat.warnings, *(note for note in beat.notes if "wings" not in note)]


def said_of_record(seed, fault=""):
    try:
        return list(reduce_run(record(np.random.default_rng(seed), fault)).notes)
    except wb.InvalidInputError as error:
        return [str(fault) for fault in error.faults]


def test_good_films_are_not_warned_of(tmp_path):
    said = [said_of_film(tmp_path / "film.csv", seed) for seed in range(100)]
    assert sum(map(bool, said)) <= 2, [notes for notes in said if notes]


def test_good_records_are_not_warned_of():
    said = [said_of_record(seed) for seed in range(100)]
    assert sum(map(bool, said)) <= 2, [notes for notes in said if notes]


@pytest.mark.parametrize("fault", FILM_FAULTS)
def test_a_film_with_a_fault_is_refused_or_warned_of(fault, tmp_path):
    said = [said_of_film(tmp_path / "film.csv", seed, fault) for seed in range(1000, 1000 + EACH)]
    assert sum(map(bool, said)) >= EACH - 1


@pytest.mark.parametrize("fault", RECORD_FAULTS)
def test_a_record_with_a_fault_is_refused_or_warned_of(fault):
    said = [said_of_record(seed, fault) for seed in range(1000, 1000 + EACH)]
    assert sum(map(bool, said)) >= EACH - 1
