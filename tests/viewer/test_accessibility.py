"""What axe finds in the page."""

import pytest

from tests.helpers.browsers import AXE


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_no_fault(show, page_of_two, theme, width):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(page_of_two, width=width, color_scheme=theme, bypass_csp=True).page
    page.evaluate("document.querySelector('.wb-viewer').viewer.pause()")
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
    assert len(found["passes"]) > 10
