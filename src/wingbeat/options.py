"""Every tuning number of the solvers, with the measurement behind its default, in one place.

>>> import wingbeat as wb
>>> wb.options.SolverOptions().search.iterations > 0
True
"""

from wingbeat.orbits.options.certificate import CertificateOptions as CertificateOptions
from wingbeat.orbits.options.certificate import NewtonOptions as NewtonOptions
from wingbeat.orbits.options.continuation import ContinuationOptions as ContinuationOptions
from wingbeat.orbits.options.continuation import SensitivityOptions as SensitivityOptions
from wingbeat.orbits.options.diagnosis import ChangeOptions as ChangeOptions
from wingbeat.orbits.options.diagnosis import DiagnosisOptions as DiagnosisOptions
from wingbeat.orbits.options.least_squares import LeastSquaresOptions as LeastSquaresOptions
from wingbeat.orbits.options.search import SearchOptions as SearchOptions
from wingbeat.orbits.options.solver import SolverOptions as SolverOptions
from wingbeat.orbits.options.start_families import StartFamily as StartFamily
from wingbeat.stability.options import FeedbackOptions as FeedbackOptions
from wingbeat.stability.options import LinearOptions as LinearOptions
from wingbeat.stability.options import ManoeuvreOptions as ManoeuvreOptions
from wingbeat.stability.options import ManyOptions as ManyOptions
