"""Mutated study and species files, a sample of benchmarks/fuzz.py: each is accepted or explained in words."""

import pytest
from fuzz import STUDIES, Mutant, mutants, outcome

from tests.helpers.species_texts import check_words


@pytest.mark.slow
def test_mutated_files_are_accepted_or_explained(tmp_path):
    ends = [check_words(outcome(mutant, tmp_path)) for mutant in mutants(1000, seed=1)]
    assert 20 < sum(end == "accepted" for end in ends) < 200


@pytest.mark.parametrize("text", STUDIES)
def test_the_studies_themselves_are_accepted(text, tmp_path):
    assert outcome(Mutant("study", text.encode()), tmp_path) == "accepted"


@pytest.mark.parametrize("key", ["seed", "starts", "most_starts", "strips"])
def test_a_number_that_no_float_holds_is_refused(key, tmp_path):
    told = outcome(Mutant("study", f"species = 'pigeon'\nspeed = 9.0\n{key} = {'9' * 400}".encode()), tmp_path)
    assert key in told.split(" = ")[0]
