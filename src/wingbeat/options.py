"""Every tuning number of the solvers, with the measurement behind its default, in one place.

>>> import wingbeat as wb
>>> wb.options.SolverOptions().search.iterations > 0
True
"""

from wingbeat.orbits.options import ChangeOptions as ChangeOptions
from wingbeat.orbits.options import ContinuationOptions as ContinuationOptions
from wingbeat.orbits.options import DiagnosisOptions as DiagnosisOptions
from wingbeat.orbits.options import SensitivityOptions as SensitivityOptions
from wingbeat.orbits.options import SolverOptions as SolverOptions
from wingbeat.orbits.search_options import CertificateOptions as CertificateOptions
from wingbeat.orbits.search_options import LeastSquaresOptions as LeastSquaresOptions
from wingbeat.orbits.search_options import NewtonOptions as NewtonOptions
from wingbeat.orbits.search_options import SearchOptions as SearchOptions
from wingbeat.orbits.search_options import StartFamily as StartFamily
from wingbeat.orbits.search_options import WakeOptions as WakeOptions
from wingbeat.stability.options import FeedbackOptions as FeedbackOptions
from wingbeat.stability.options import LinearOptions as LinearOptions
from wingbeat.stability.options import ManoeuvreOptions as ManoeuvreOptions
from wingbeat.stability.options import ManyOptions as ManyOptions
