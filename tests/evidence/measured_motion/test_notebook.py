"""A validation in a notebook."""

import wingbeat_evidence as evidence
from tests.helpers.notebooks import check_figure, check_table


def test_a_validation_shows_its_rows():
    found = evidence.validate(evidence.shipped_cases()[0], aero=["dickinson", "su-fan"])
    shown = check_table(found)
    assert f"* {found.recommended.aero.coefficients.name}" in shown
    assert f"{found.recommended.fz.mean_ratio:.2f}" in shown
    table = found.to_dataframe()
    assert len(table) == len(found.rows)
    assert table.loc[table["recommended"], "fz.rms"].item() == found.recommended.fz.rms
    check_figure(found.plot())
