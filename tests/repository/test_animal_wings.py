"""The models of animal wings are what their fit makes of the measurements, and the page says what the fit found."""

import subprocess
import sys

import pytest

import wingbeat as wb
from tests.helpers.places import ROOT

DATA, STUDY, PAGE = (
    ROOT / "../shared/data",
    ROOT / "validation/animal_wings.py",
    ROOT / "docs/evidence/animal_wings.md",
)
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="other people's measurements are not in this repository")


@pytest.fixture(scope="module")
def fitted():
    """Return the fits to the half wings, the jackdaw's frames and the fitted terms with their intervals."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT / "validation"))
        from animal_wings_data import half_wings, jackdaw_glides
        from animal_wings_fit import fit_half_wing, intervals, resampled

        glides = jackdaw_glides(DATA)
        fits = [fit_half_wing(wing, wing.fast) for wing in half_wings(DATA)]
        yield fits, intervals(fits, glides, resampled(fits, glides))


@pytest.mark.slow
@needs_data
def test_the_numbers_of_feathered_are_made_from_the_data(fitted):
    estimates = wb.aero.WING_ESTIMATES["feathered"]
    _, terms = fitted
    assert set(estimates) - set(terms) == {"lift_rounding", "onset_rounding_deg"}
    for name, term in terms.items():
        kept = estimates[name]
        # The package holds them to three figures, the least drag to its fourth decimal.
        for number, wanted in ((kept.value, term.value), (kept.low, term.low), (kept.high, term.high)):
            assert number == pytest.approx(wanted, rel=5e-3, abs=5e-5), name


@pytest.mark.slow
@needs_data
def test_the_page_holds_the_tables_of_the_fit(fitted):
    from animal_wings import estimates, gulls, parameters
    from animal_wings_glides import left_out

    fits, terms = fitted
    page = PAGE.read_text(encoding="utf-8")
    unseen, own_drag = left_out(fits), left_out(fits, own=("drag_least",))
    for part in (parameters(terms), gulls(fits, unseen), estimates()):
        assert part in page
    assert max(abs(one.errors[0]) for one in own_drag) < 0.15 < max(abs(one.errors[0]) for one in unseen)


@pytest.mark.slow
@needs_data
def test_the_jackdaw_glides_as_measured(fitted):
    """Rosen and Hedenstrom 2001: a ratio of 12.6 and a sink of 0.62 m/s, which the fit did not see."""
    from animal_wings import jackdaw_errors, jackdaw_row
    from animal_wings_glides import jackdaw_polar

    polar = jackdaw_polar("feathered")
    assert max(map(abs, jackdaw_errors(polar))) < 0.15
    assert jackdaw_row("`feathered`", polar) in PAGE.read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_study_says_what_is_missing(tmp_path):
    found = subprocess.run([sys.executable, STUDY, "--data", tmp_path], check=False, capture_output=True, text=True)
    assert found.returncode == 2
    assert "cannot find gull_wing_polar.csv" in found.stderr
