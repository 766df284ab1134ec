"""The page on plates by NeuralFoil is what its script writes."""

import sys

import numpy as np

from tests.helpers.places import ROOT
from wingbeat.aero.neural_sections import section_polars


def test_the_page_is_what_the_script_writes(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import neural_plate

    polars = [section_polars(name, [re])[1][0] for name, re in neural_plate.PLATES]
    text = (ROOT / "docs" / "evidence" / "neural_plate.md").read_text(encoding="utf-8")
    assert neural_plate.page(polars) == text
    # What its words say.
    at = [int(np.argmin(np.abs(one.alpha_deg - 20))) for one in polars]
    paper = neural_plate.SuFan()
    for one, k in zip(polars, at, strict=True):
        assert one.drag[k] / paper.drag(np.radians(20.0)) < 0.6
        assert one.alpha_deg[one.kept].max() <= 24
    sys.modules.pop("neural_plate", None)
