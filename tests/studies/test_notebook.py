"""A study in a notebook, before and after its run."""

import wingbeat as wb
from tests.helpers.notebooks import check_figure, check_table


def test_a_study_shows_how_far_it_is(cheap):
    study = cheap([8.0, 10.0, 12.0])
    asked = wb.plan_study(study.file)
    assert "waiting 3" in check_table(asked)
    _, out, _ = study.run()
    told = asked.summary(10_000)
    assert " ".join(told.split()) == out
    assert "certified" in check_table(asked) or "converged" in check_table(asked)
    check_figure(asked.plot("speed"))  # the only number of a point that the stand-in solves
