"""From load-cell records to a coefficient model, and from a film to a wingbeat, with their uncertainty."""

from __future__ import annotations

from wingbeat.experiment.campaign import Campaign as Campaign
from wingbeat.experiment.campaign import save_runs as save_runs
from wingbeat.experiment.campaign import synthetic_runs as synthetic_runs
from wingbeat.experiment.drawing import draw as draw
from wingbeat.experiment.film import Film as Film
from wingbeat.experiment.film import read_film as read_film
from wingbeat.experiment.film import synthetic_film as synthetic_film
from wingbeat.experiment.film_fit import FilmedBeat as FilmedBeat
from wingbeat.experiment.film_fit import fit_film as fit_film
from wingbeat.experiment.forms import FORMS as FORMS
from wingbeat.experiment.forms import CurveForm as CurveForm
from wingbeat.experiment.forms import WingForm as WingForm
from wingbeat.experiment.record import LoadCellRun as LoadCellRun
from wingbeat.experiment.record import read_run as read_run
from wingbeat.experiment.reduction import reduce_run as reduce_run
from wingbeat.experiment.reduction import reduce_runs as reduce_runs
from wingbeat.experiment.regression import CurveFit as CurveFit
from wingbeat.experiment.regression import FitRangeWarning as FitRangeWarning
from wingbeat.experiment.regression import fit_curve as fit_curve
from wingbeat.experiment.table import CoefficientTable as CoefficientTable
from wingbeat.experiment.table import load_measurements as load_measurements
from wingbeat.experiment.wing_fit import WingFit as WingFit
from wingbeat.experiment.wing_fit import fit_wing as fit_wing
