"""Figure 1, the plate with its forces, and the words of captions on what the paper prints."""

import math

import numpy as np
import pytest

from wingbeat_evidence.paper.contradictions import WHY, Printed, near, told
from wingbeat_evidence.paper.figure_plate import plate_figure


def test_the_plate_is_drawn_with_its_forces_at_the_centre_of_pressure():
    figure, (row,), _ = plate_figure()
    alpha = math.radians(row["alpha_deg"])
    c, s = math.cos(alpha), math.sin(alpha)
    # The paper's equation 1, and its C_M = C_N (0.5 - x_cp).
    assert row["C_N"] * c - row["C_T"] * s == pytest.approx(row["C_L"], rel=1e-12)
    assert row["C_N"] * s + row["C_T"] * c == pytest.approx(row["C_D"], rel=1e-12)
    assert row["C_M_mid_chord"] == pytest.approx(row["C_N"] * (0.5 - row["x_cp_chords"]), rel=1e-12)
    section = figure.axes[1]
    (centre,) = (line for line in section.get_lines() if line.get_gid() == "centre of pressure")
    at = row["x_cp_chords"] * np.array([c, -s])
    np.testing.assert_allclose(centre.get_xydata()[0], at)
    arrows = {each.get_gid(): np.array(each.xy) - each.xyann for each in section.texts if each.get_gid()}
    np.testing.assert_allclose(arrows["lift"] + arrows["drag"], arrows["normal"] + arrows["tangential"], atol=1e-12)
    assert arrows["lift"][0] == arrows["drag"][1] == 0.0
    (plate,) = (patch for patch in figure.axes[0].patches if patch.get_gid() == "plate")
    assert (plate.get_width(), plate.get_height()) == (0.076, 0.456)


def test_a_figure_that_agrees_gives_no_reason():
    agreeing = told(7, [Printed("a peak of 30 W", "31 W", near(31.0, 30.0, 0.25))])
    assert agreeing == "The paper prints a peak of 30 W; ours: 31 W, which agrees."
    assert WHY[7] in told(7, [Printed("a peak of 30 W", "61 W", near(61.0, 30.0, 0.25))])
