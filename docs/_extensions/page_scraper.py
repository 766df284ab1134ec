"""Lets sphinx-gallery show wingbeat's own pages, which are matplotlib figures that pyplot does not know."""

from typing import Any

from matplotlib.figure import Figure


def scrape_pages(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the pages that a cell ends with, and return the text that shows them.

    Parameters
    ----------
    block : the cell; not used.
    block_vars : its variables, as sphinx-gallery gives them.
    gallery_conf : the configuration of the gallery.
    """
    from sphinx_gallery.scrapers import figure_rst

    last = block_vars["example_globals"].get("___")  # sphinx-gallery's name of the value that a cell ends with
    if not isinstance(last, Figure) or last.canvas.manager is not None:
        return ""
    path = next(block_vars["image_path_iterator"])
    last.savefig(path, dpi=200)
    return figure_rst([path], gallery_conf["src_dir"])
