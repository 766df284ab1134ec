# The pages and where they live, once: type checkers read this, and `wingbeat.plots.__getattr__` loads from it.

from .draw_curve import curve_page as curve_page
from .draw_experiments import film_page as film_page
from .draw_experiments import fit_page as fit_page
from .draw_frequencies import frequency_page as frequency_page
from .draw_glide import glide_page as glide_page
from .draw_influences import pareto_page as pareto_page
from .draw_influences import terms_page as terms_page
from .draw_influences import tornado_page as tornado_page
from .draw_points import points_page as points_page
from .draw_power import power_page as power_page
from .draw_stability import gust_page as gust_page
from .draw_stability import manoeuvre_page as manoeuvre_page
from .draw_stability import stability_page as stability_page
from .draw_stability import survey_page as survey_page
from .draw_study import study_page as study_page
from .draw_wingbeat import wingbeat_page as wingbeat_page
from .figure_files import FIGURE_SUFFIXES as FIGURE_SUFFIXES
from .figure_files import check_figure_name as check_figure_name
from .figure_files import save_figure as save_figure
from .published import Published as Published
