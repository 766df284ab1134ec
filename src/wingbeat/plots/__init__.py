"""Figures: of wingbeats, flights, stability, gusts, curves, fits, measured motions and second opinions; saving.

>>> import wingbeat as wb
>>> pigeon = wb.load_species("pigeon")
>>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
>>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1)
>>> figure = wb.plots.wingbeat_page(flight.dataset)  # wb.plots.save_figure writes it to a file
>>> len(figure.axes) > 0
True
"""

from wingbeat.plots.curve_page import Published as Published
from wingbeat.plots.curve_page import curve_page as curve_page
from wingbeat.plots.film_page import film_page as film_page
from wingbeat.plots.fit_page import fit_page as fit_page
from wingbeat.plots.glide_page import glide_page as glide_page
from wingbeat.plots.gust_page import gust_page as gust_page
from wingbeat.plots.gust_page import survey_page as survey_page
from wingbeat.plots.manoeuvre_page import manoeuvre_page as manoeuvre_page
from wingbeat.plots.pareto_page import pareto_page as pareto_page
from wingbeat.plots.power_page import power_page as power_page
from wingbeat.plots.saving import FIGURE_SUFFIXES as FIGURE_SUFFIXES
from wingbeat.plots.saving import check_figure_name as check_figure_name
from wingbeat.plots.saving import save_figure as save_figure
from wingbeat.plots.stability_page import stability_page as stability_page
from wingbeat.plots.study_page import study_page as study_page
from wingbeat.plots.terms_page import terms_page as terms_page
from wingbeat.plots.tornado_page import tornado_page as tornado_page
from wingbeat.plots.wingbeat_page import wingbeat_page as wingbeat_page

__all__ = [
    "FIGURE_SUFFIXES",
    "Published",
    "check_figure_name",
    "curve_page",
    "film_page",
    "fit_page",
    "glide_page",
    "gust_page",
    "manoeuvre_page",
    "pareto_page",
    "power_page",
    "save_figure",
    "stability_page",
    "study_page",
    "survey_page",
    "terms_page",
    "tornado_page",
    "wingbeat_page",
]


def __dir__() -> list[str]:
    return sorted(__all__)
