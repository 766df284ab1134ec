"""The address of the server's page names the push that is shown, and shows it again."""

import pytest

from tests.explorer.app.page import solved
from tests.helpers.browsers import PATIENCE

SHOWN = "() => wingbeatPage.face?.viewer?.pushes.name === 'tail*1'"


@pytest.mark.slow
def test_the_link_of_a_push_shows_it_again(visit):
    page = visit("species=pigeon&speed=10&starts=1")
    solved(page, "pigeon at 10 m/s, su-fan")
    page.get_by_role("button", name="Push it with a gust").click()
    gust = page.get_by_label("Gust", exact=True)
    gust.wait_for(timeout=2 * PATIENCE)
    gust.select_option("tail")
    page.get_by_label("Size").select_option("1")
    page.get_by_role("button", name="Push", exact=True).click()
    page.wait_for_function(SHOWN)
    address = page.evaluate("location.href")
    assert "species=pigeon" in address
    assert address.endswith("#push=tail*1")
    page.get_by_role("button", name="Back to the orbit").click()
    assert page.evaluate("location.hash") == ""
    # The link is opened anew, and the same flight is pushed once it is solved.
    page = visit(address.split("/?")[1])
    page.wait_for_function(SHOWN, timeout=3 * PATIENCE)
    page.evaluate("location.hash = ''")
    page.wait_for_function("wingbeatPage.face.viewer.pushes.name === ''")
    page.evaluate("location.hash = '#push=tail*1'")
    page.wait_for_function(SHOWN)


@pytest.mark.slow
def test_the_push_of_a_flight_that_was_solved_beforehand_is_shown(visit):
    page = visit("#push=tail*1")
    page.wait_for_function(SHOWN, timeout=3 * PATIENCE)
