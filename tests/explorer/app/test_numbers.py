"""The fields for the numbers of an animal, in a real browser."""

import pytest

from tests.explorer.app.page import asks_for, drawer, solved


@pytest.mark.slow
def test_bounds_free_the_tilt_of_the_tail_and_empty_fields_hold_it(visit):
    page = visit()
    solved(page, "pigeon")
    drawer(page).locator("summary", has_text="Tail").first.click()
    page.get_by_role("button", name="Add the tail of a bird of this mass").click()
    asks_for(page, "set=vehicle.tail.area")
    pair = page.get_by_role("group", name="Bounds of tail tilt")
    lowest, highest = pair.get_by_role("textbox").all()
    assert (lowest.input_value(), highest.input_value()) == ("", "")
    lowest.fill("-20")
    lowest.press("Tab")
    asks_for(page, "bound=tail_tilt:-0.349")
    assert highest.input_value() == "30"
    drawer(page).get_by_label("Speed [m/s]", exact=True).first.press("Tab")
    highest.fill("")
    highest.press("Tab")
    page.wait_for_function("!location.search.includes('tail_tilt')")
    assert lowest.input_value() == ""
    lowest.fill("-20")
    lowest.press("Tab")
    asks_for(page, "bound=tail_tilt")
    page.get_by_role("button", name="Remove the tail").click()
    page.wait_for_function("!location.search.includes('tail')")
