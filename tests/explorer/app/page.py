"""What tests do on the page of the explorer."""

import re

from tests.helpers.browsers import PATIENCE


def solved(page, what):
    """Wait until an answer to this stands on the page, in the face, too, and nothing is being solved."""
    script = """(what) => document.querySelector('.what')?.textContent.includes(what)
        && wingbeatPage.shown === Number(document.querySelector('.what').dataset.count)
        && document.querySelector('.state')?.textContent.startsWith('Solved')
        && document.querySelectorAll('.wbx-light').length === 2"""
    page.wait_for_function(script, arg=what, timeout=2 * PATIENCE)


def exact(page):
    return page.locator(".value").first.get_attribute("data-exact")


def asks_for(page, words):
    """Wait until the address says so: it follows what stands on the page."""
    page.wait_for_url(re.compile(re.escape(words)))


def unfold(page, place):
    """Open a folded part of the page, if it is not open, and return it."""
    fold = page.locator(place)
    if fold.get_attribute("open") is None:
        fold.locator("> summary").click()
    return fold


def drawer(page):
    """Return the drawer with the controls, open down to the expert numbers."""
    found = unfold(page, ".drawer")
    unfold(page, ".expert")
    return found


def enter(page, label, value):
    field = drawer(page).get_by_label(label, exact=True).first
    field.fill(value)
    field.press("Tab")


def choose(page, label, value):
    drawer(page).get_by_label(label, exact=True).select_option(value)
