# The public names and where they live, once: type checkers read this, and `wingbeat.experiment` loads from it.

from .campaign import Campaign as Campaign
from .campaign import save_runs as save_runs
from .campaign import synthetic_runs as synthetic_runs
from .coefficient_table import CoefficientTable as CoefficientTable
from .coefficient_table import load_measurements as load_measurements
from .curve_forms import FORMS as FORMS
from .curve_forms import CurveForm as CurveForm
from .curve_forms import WingForm as WingForm
from .film import Film as Film
from .film import synthetic_film as synthetic_film
from .film_file import read_film as read_film
from .film_fit import BodyPath as BodyPath
from .film_fit import FilmedBeat as FilmedBeat
from .film_fit import fit_body_path as fit_body_path
from .film_fit import fit_film as fit_film
from .load_cell_run import LoadCellRun as LoadCellRun
from .load_cell_run import read_run as read_run
from .reduction import reduce_run as reduce_run
from .reduction import reduce_runs as reduce_runs
from .regression import CurveFit as CurveFit
from .regression import FitRangeWarning as FitRangeWarning
from .regression import fit_curve as fit_curve
from .wing_fit import WingFit as WingFit
from .wing_fit import draw as draw
from .wing_fit import fit_wing as fit_wing
