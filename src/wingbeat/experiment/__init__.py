"""From load-cell records to a coefficient model, and from a film to a wingbeat, with their uncertainty."""

from wingbeat.experiment.body_path import BodyPath, fit_body_path
from wingbeat.experiment.campaign import Campaign, save_runs, synthetic_runs
from wingbeat.experiment.drawing import draw
from wingbeat.experiment.film import Film, read_film, synthetic_film
from wingbeat.experiment.film_fit import FilmedBeat, fit_film
from wingbeat.experiment.forms import CurveForm
from wingbeat.experiment.record import LoadCellRun, read_run
from wingbeat.experiment.reduction import reduce_run, reduce_runs
from wingbeat.experiment.regression import CurveFit, FitRangeWarning, fit_curve
from wingbeat.experiment.table import CoefficientTable, load_measurements
from wingbeat.experiment.wing_fit import WingFit, fit_wing
from wingbeat.experiment.wing_forms import FORMS, WingForm

__all__ = [
    "FORMS",
    "BodyPath",
    "Campaign",
    "CoefficientTable",
    "CurveFit",
    "CurveForm",
    "Film",
    "FilmedBeat",
    "FitRangeWarning",
    "LoadCellRun",
    "WingFit",
    "WingForm",
    "draw",
    "fit_body_path",
    "fit_curve",
    "fit_film",
    "fit_wing",
    "load_measurements",
    "read_film",
    "read_run",
    "reduce_run",
    "reduce_runs",
    "save_runs",
    "synthetic_film",
    "synthetic_runs",
]


def __dir__() -> list[str]:
    return sorted(__all__)
