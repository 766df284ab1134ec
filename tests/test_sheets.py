"""Units in the head of a table: those that say nothing, and those that do not fit."""

import pytest

import wingbeat as wb
from wingbeat.errors import FaultList
from wingbeat.sheets import check_unit, split_unit


@pytest.mark.parametrize("heading", ["x_cp", "x_cp [-]", "x_cp (-)", "x_cp [1]", "x_cp []"])
def test_a_column_without_unit_may_say_so(heading):
    faults = FaultList()
    check_unit(faults, "x_cp", split_unit(heading).unit, "")
    faults.raise_if_any()


@pytest.mark.parametrize(("heading", "wanted"), [("x_cp [m]", ""), ("alpha [-]", "deg"), ("alpha [rad]", "deg")])
def test_a_unit_that_does_not_fit_is_a_fault(heading, wanted):
    faults = FaultList()
    check_unit(faults, "column", split_unit(heading).unit, wanted)
    with pytest.raises(wb.InvalidInputError, match="column"):
        faults.raise_if_any()
