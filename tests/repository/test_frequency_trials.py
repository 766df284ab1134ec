"""The pages on what sets the frequency: scripts print their words, and theory of the wake gives the numbers."""

import importlib
import re

import numpy as np
import pytest
from scipy.special import hankel2

import wingbeat as wb
from tests.helpers.places import ROOT

DOCS, TEMPLATES = ROOT / "docs" / "evidence", ROOT / "validation" / "pages"
PAGE = (DOCS / "frequency_trials.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["frequency_trials", "slow_flight"])
def test_the_script_prints_the_words_of_the_page(name, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    script, page = importlib.import_module(name), (DOCS / f"{name}.md").read_text(encoding="utf-8")
    before, after = (TEMPLATES / f"{name}.md").read_text(encoding="utf-8").split("{table}")
    assert page.startswith(before)
    assert page.endswith(after)
    rows = [line.split(" | ")[0].removeprefix("| ") for line in page.splitlines() if line.startswith("| ")]
    assert rows[2:] == [trial.name for trial in script.trials()]


def share_of_plunge(reduced_frequency):
    """Return the share of the power that becomes thrust in plunge, (F^2 + G^2) / F with C(k) = F + i G."""
    one, zero = hankel2(1, reduced_frequency), hankel2(0, reduced_frequency)
    lag = one / (one + 1j * zero)
    return abs(lag) ** 2 / lag.real


def test_shares_of_thrust_are_those_of_garrick():
    chord = wb.load_species("pigeon").vehicle.wing.mean_chord
    said = " ".join(PAGE.split())
    for speed, shares in (
        (12.0, "at 12 m/s a share of {:.2f} of the power becomes thrust at 30 Hz, and {:.2f} at 5 Hz"),
        (10.0, "At 10 m/s the shares are {:.2f} at 17 Hz and {:.2f} at 8 Hz"),
    ):
        frequencies = [float(one) for one in re.findall(r"(\d+) Hz", shares)]
        found = [share_of_plunge(np.pi * frequency * chord / speed) for frequency in frequencies]
        assert shares.format(*found) in said
