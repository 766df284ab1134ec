"""Sphinx builds the site from these pages: ``uv run --group docs sphinx-build -W -b html docs site``."""

from __future__ import annotations

import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

import wingbeat

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))
from page_scraper import scrape_pages  # noqa: E402  # after its folder is known

project = "wingbeat"
author = "the wingbeat authors"
copyright = "the wingbeat authors, BSD-3-Clause"
version = release = wingbeat.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
    "accessible",
    "docstrings",
    "mathml",
    "reference_pages",
    "live_animal",
    "static_explorer",
]
exclude_patterns = ["_extensions", "sg_execution_times.rst", "gallery/*.ipynb", "gallery/*.zip", "gallery/*.py"]
templates_path = ["_templates"]

# Pages are read in the repository as well, so they are Markdown with links between files.
myst_enable_extensions = ["amsmath", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
myst_links_external_new_tab = False
# Code fences name languages for `tests/repository/test_docs.py`; `py` is Python that the tests do not run.
highlight_language = "none"
lexers["csv"] = TextLexer()

default_role = "code"
autosummary_generate = True
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
python_use_unqualified_type_names = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
add_module_names = False

sphinx_gallery_conf = {
    "examples_dirs": ["../examples/gallery"],
    "gallery_dirs": ["gallery"],
    "filename_pattern": "plot_",
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "image_scrapers": ("matplotlib", scrape_pages),
    "capture_repr": (),
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
    "remove_config_comments": True,
    "plot_gallery": "True",
    "matplotlib_animations": False,
    "thumbnail_size": (480, 320),
}

html_theme = "furo"
html_title = "wingbeat"
html_static_path = ["_static"]
html_extra_path = ["_live"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#005a9c", "color-brand-content": "#005a9c"},
    "dark_css_variables": {"color-brand-primary": "#7cc0ff", "color-brand-content": "#7cc0ff"},
}
copybutton_exclude = ".linenos, .gp, .go"
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = False
# The scraper is a function, and several classes have a number `u` or `lift`.
suppress_warnings = ["config.cache", "myst.xref_missing", "ref.python"]
