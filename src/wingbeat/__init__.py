"""wingbeat: how an animal or a flapping robot must beat its wings to fly, and how sure we are.

The public names are loaded when first used, so that importing the package is cheap.
"""

from __future__ import annotations

import importlib

from wingbeat._version import __version__ as __version__

TYPE_CHECKING = False  # the command line must be ready for Ctrl-C before it has time to import `typing`
if TYPE_CHECKING:
    from typing import Any

    from wingbeat import aero as aero
    from wingbeat import experiment as experiment
    from wingbeat import models as models
    from wingbeat import plots as plots
    from wingbeat import viewer as viewer
    from wingbeat import winds as winds
    from wingbeat.actuators import Motor as Motor
    from wingbeat.actuators import Muscle as Muscle
    from wingbeat.actuators import Springs as Springs
    from wingbeat.errors import ClusterError as ClusterError
    from wingbeat.errors import FileError as FileError
    from wingbeat.errors import ForkError as ForkError
    from wingbeat.errors import InvalidInputError as InvalidInputError
    from wingbeat.errors import WingbeatError as WingbeatError
    from wingbeat.errors import WorkerError as WorkerError
    from wingbeat.exports.mujoco_flight import MujocoFlight as MujocoFlight
    from wingbeat.exports.save import export as export
    from wingbeat.kinematics import Wingbeat as Wingbeat
    from wingbeat.measured_motion.comparison import Validation as Validation
    from wingbeat.measured_motion.comparison import ValidationRow as ValidationRow
    from wingbeat.measured_motion.comparison import validate as validate
    from wingbeat.measured_motion.reading import read_strip_case as read_strip_case
    from wingbeat.measured_motion.reading import shipped_cases as shipped_cases
    from wingbeat.measured_motion.strip_case import StripCase as StripCase
    from wingbeat.mechanics.equations_of_motion import air_forces as air_forces
    from wingbeat.mechanics.equations_of_motion import equations_of_motion as equations_of_motion
    from wingbeat.mechanics.equations_of_motion import generalised_torques as generalised_torques
    from wingbeat.mechanics.flight_loads import flight_loads as flight_loads
    from wingbeat.mechanics.flight_model import FlightModel as FlightModel
    from wingbeat.mechanics.flight_model import State as State
    from wingbeat.orbits.flight.beat import Beat as Beat
    from wingbeat.orbits.flight.certify import Certificate as Certificate
    from wingbeat.orbits.flight.certify import certify as certify
    from wingbeat.orbits.flight.floquet import floquet_multipliers as floquet_multipliers
    from wingbeat.orbits.infeasible.relaxation import Relaxation as Relaxation
    from wingbeat.orbits.many.uncertainty import ErrorBar as ErrorBar
    from wingbeat.orbits.many.uncertainty import Samples as Samples
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
    from wingbeat.orbits.problem import quantities as objectives  # noqa: F401
    from wingbeat.orbits.problem.filmed import filmed_problem as filmed_problem
    from wingbeat.orbits.problem.filmed import filmed_species as filmed_species
    from wingbeat.orbits.problem.limits import Constraint as Constraint
    from wingbeat.orbits.problem.map_quantities import MapQuantity as MapQuantity
    from wingbeat.orbits.problem.problem import OrbitProblem as OrbitProblem
    from wingbeat.orbits.problem.quantity import Quantity as Quantity
    from wingbeat.orbits.status import Status as Status
    from wingbeat.results.curve import Curve as Curve
    from wingbeat.results.curve import load_curve as load_curve
    from wingbeat.results.curve import solve_curve as solve_curve
    from wingbeat.results.flight import Flight as Flight
    from wingbeat.results.flight import TorqueDrivenFlight as TorqueDrivenFlight
    from wingbeat.results.flight import simulate as simulate
    from wingbeat.results.flight import simulate_torque_driven as simulate_torque_driven
    from wingbeat.results.glide import GlidePolar as GlidePolar
    from wingbeat.results.glide import glide_polar as glide_polar
    from wingbeat.results.orbit import Orbit as Orbit
    from wingbeat.results.orbit import load_orbit as load_orbit
    from wingbeat.results.pareto import ParetoFront as ParetoFront
    from wingbeat.results.pareto import pareto_front as pareto_front
    from wingbeat.results.power import power_account as power_account
    from wingbeat.results.sensitivities import Sensitivities as Sensitivities
    from wingbeat.results.sensitivities import sensitivities as sensitivities
    from wingbeat.results.solving import solve_orbit as solve_orbit
    from wingbeat.results.solving import solve_orbits as solve_orbits
    from wingbeat.results.spread import Spread as Spread
    from wingbeat.results.spread import orbit_spread as orbit_spread
    from wingbeat.results.stable_share import StableShare as StableShare
    from wingbeat.results.terms import TermTrace as TermTrace
    from wingbeat.results.terms import trace_terms as trace_terms
    from wingbeat.results.uncertainty import uncertainty_by_samples as uncertainty_by_samples
    from wingbeat.species import Species as Species
    from wingbeat.species import bat as bat
    from wingbeat.species import bird as bird
    from wingbeat.species import load_species as load_species
    from wingbeat.species import robot as robot
    from wingbeat.species import species_names as species_names
    from wingbeat.stability.causes import StabilitySensitivities as StabilitySensitivities
    from wingbeat.stability.causes import stability_sensitivities as stability_sensitivities
    from wingbeat.stability.feedback import Feedback as Feedback
    from wingbeat.stability.feedback import feedback as feedback
    from wingbeat.stability.feedback_controller import FeedbackController as FeedbackController
    from wingbeat.stability.feedback_options import FeedbackOptions as FeedbackOptions
    from wingbeat.stability.gust_survey import GustSurvey as GustSurvey
    from wingbeat.stability.gust_survey import survey_gusts as survey_gusts
    from wingbeat.stability.linear_flight import LinearFlight as LinearFlight
    from wingbeat.stability.linear_flight import linearise as linearise
    from wingbeat.stability.manoeuvre import Manoeuvre as Manoeuvre
    from wingbeat.stability.manoeuvre import manoeuvre as manoeuvre
    from wingbeat.stability.manoeuvre_options import ManoeuvreOptions as ManoeuvreOptions
    from wingbeat.stability.many_flights import ManyFlights as ManyFlights
    from wingbeat.stability.many_flights import simulate_many as simulate_many
    from wingbeat.stability.many_options import ManyOptions as ManyOptions
    from wingbeat.stability.modes import Mode as Mode
    from wingbeat.stability.options import LinearOptions as LinearOptions
    from wingbeat.stability.pushes import fly_pushes as fly_pushes
    from wingbeat.stability.riccati import Reach as Reach
    from wingbeat.stability.segment_feedback import SegmentFeedback as SegmentFeedback
    from wingbeat.stability.segment_feedback import SegmentFlight as SegmentFlight
    from wingbeat.stability.segment_feedback import feedback_in_beat as feedback_in_beat
    from wingbeat.studies.study import Study as Study
    from wingbeat.studies.study import plan_study as plan_study
    from wingbeat.vehicle import Air as Air
    from wingbeat.vehicle import Body as Body
    from wingbeat.vehicle import Tail as Tail
    from wingbeat.vehicle import Vehicle as Vehicle
    from wingbeat.vehicle import Wing as Wing
    from wingbeat.whole_flights.measured import MeasuredFlights as MeasuredFlights
    from wingbeat.whole_flights.measured import read_measured_flights as read_measured_flights
    from wingbeat.whole_flights.prediction import Prediction as Prediction
    from wingbeat.whole_flights.prediction import predict_flights as predict_flights

_HOME = {
    "Air": "vehicle",
    "Beat": "orbits.flight.beat",
    "Body": "vehicle",
    "Certificate": "orbits.flight.certify",
    "CertificateOptions": "orbits.options.certificate",
    "ChangeOptions": "orbits.options.diagnosis",
    "ClusterError": "errors",
    "Constraint": "orbits.problem.limits",
    "ContinuationOptions": "orbits.options.continuation",
    "Curve": "results.curve",
    "DiagnosisOptions": "orbits.options.diagnosis",
    "ErrorBar": "orbits.many.uncertainty",
    "Feedback": "stability.feedback",
    "FeedbackController": "stability.feedback_controller",
    "FeedbackOptions": "stability.feedback_options",
    "FileError": "errors",
    "Flight": "results.flight",
    "FlightModel": "mechanics.flight_model",
    "ForkError": "errors",
    "GlidePolar": "results.glide",
    "GustSurvey": "stability.gust_survey",
    "InvalidInputError": "errors",
    "LeastSquaresOptions": "orbits.options.least_squares",
    "LinearFlight": "stability.linear_flight",
    "LinearOptions": "stability.options",
    "Manoeuvre": "stability.manoeuvre",
    "ManoeuvreOptions": "stability.manoeuvre_options",
    "ManyFlights": "stability.many_flights",
    "ManyOptions": "stability.many_options",
    "MapQuantity": "orbits.problem.map_quantities",
    "MeasuredFlights": "whole_flights.measured",
    "Mode": "stability.modes",
    "Motor": "actuators",
    "MujocoFlight": "exports.mujoco_flight",
    "Muscle": "actuators",
    "NewtonOptions": "orbits.options.certificate",
    "Orbit": "results.orbit",
    "OrbitProblem": "orbits.problem.problem",
    "ParetoFront": "results.pareto",
    "Prediction": "whole_flights.prediction",
    "Quantity": "orbits.problem.quantity",
    "Reach": "stability.riccati",
    "Relaxation": "orbits.infeasible.relaxation",
    "Samples": "orbits.many.uncertainty",
    "SearchOptions": "orbits.options.search",
    "SegmentFeedback": "stability.segment_feedback",
    "SegmentFlight": "stability.segment_feedback",
    "Sensitivities": "results.sensitivities",
    "SensitivityOptions": "orbits.options.continuation",
    "SolverOptions": "orbits.options.solver",
    "Species": "species",
    "Spread": "results.spread",
    "Springs": "actuators",
    "StabilitySensitivities": "stability.causes",
    "StableShare": "results.stable_share",
    "StartFamily": "orbits.options.start_families",
    "State": "mechanics.flight_model",
    "Status": "orbits.status",
    "StripCase": "measured_motion.strip_case",
    "Study": "studies.study",
    "Tail": "vehicle",
    "TermTrace": "results.terms",
    "TorqueDrivenFlight": "results.flight",
    "Validation": "measured_motion.comparison",
    "ValidationRow": "measured_motion.comparison",
    "Vehicle": "vehicle",
    "Wing": "vehicle",
    "Wingbeat": "kinematics",
    "WingbeatError": "errors",
    "WorkerError": "errors",
    "air_forces": "mechanics.equations_of_motion",
    "bat": "species",
    "bird": "species",
    "certify": "orbits.flight.certify",
    "equations_of_motion": "mechanics.equations_of_motion",
    "export": "exports.save",
    "feedback": "stability.feedback",
    "feedback_in_beat": "stability.segment_feedback",
    "filmed_problem": "orbits.problem.filmed",
    "filmed_species": "orbits.problem.filmed",
    "fly_pushes": "stability.pushes",
    "flight_loads": "mechanics.flight_loads",
    "floquet_multipliers": "orbits.flight.floquet",
    "generalised_torques": "mechanics.equations_of_motion",
    "glide_polar": "results.glide",
    "linearise": "stability.linear_flight",
    "load_curve": "results.curve",
    "load_orbit": "results.orbit",
    "load_species": "species",
    "manoeuvre": "stability.manoeuvre",
    "orbit_spread": "results.spread",
    "pareto_front": "results.pareto",
    "plan_study": "studies.study",
    "power_account": "results.power",
    "predict_flights": "whole_flights.prediction",
    "read_measured_flights": "whole_flights.measured",
    "read_strip_case": "measured_motion.reading",
    "robot": "species",
    "sensitivities": "results.sensitivities",
    "shipped_cases": "measured_motion.reading",
    "simulate": "results.flight",
    "simulate_many": "stability.many_flights",
    "simulate_torque_driven": "results.flight",
    "solve_curve": "results.curve",
    "solve_orbit": "results.solving",
    "solve_orbits": "results.solving",
    "species_names": "species",
    "stability_sensitivities": "stability.causes",
    "survey_gusts": "stability.gust_survey",
    "trace_terms": "results.terms",
    "uncertainty_by_samples": "results.uncertainty",
    "validate": "measured_motion.comparison",
}
_MODULES = {
    "aero": "aero",
    "experiment": "experiment",
    "models": "models",
    "objectives": "orbits.problem.quantities",
    "plots": "plots",
    "viewer": "viewer",
    "winds": "winds",
}

__all__ = [*_HOME, *_MODULES, "__version__"]  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(f"wingbeat.{_MODULES[name]}")
    if name in _HOME:
        return getattr(importlib.import_module(f"wingbeat.{_HOME[name]}"), name)
    raise AttributeError(f"module 'wingbeat' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
