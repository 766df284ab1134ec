"""From load-cell records to a coefficient model, and from a film to a wingbeat, with their uncertainty.

The names are loaded when first used: `wingbeat orbit`, which may need a film, then starts 0.15 s sooner.

>>> import wingbeat as wb
>>> film = wb.experiment.synthetic_film(wb.load_species("pigeon").wingbeat, frames=60, noise_deg=0.0)
>>> round(wb.experiment.fit_film(film).numbers["flap_amplitude"], 3)
0.785
"""

from __future__ import annotations

import importlib

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from wingbeat.experiment.body_path import BodyPath as BodyPath
    from wingbeat.experiment.body_path import fit_body_path as fit_body_path
    from wingbeat.experiment.campaign import Campaign as Campaign
    from wingbeat.experiment.campaign import save_runs as save_runs
    from wingbeat.experiment.campaign import synthetic_runs as synthetic_runs
    from wingbeat.experiment.drawing import draw as draw
    from wingbeat.experiment.film import Film as Film
    from wingbeat.experiment.film_file import read_film as read_film
    from wingbeat.experiment.film_fit import FilmedBeat as FilmedBeat
    from wingbeat.experiment.film_fit import fit_film as fit_film
    from wingbeat.experiment.forms import CurveForm as CurveForm
    from wingbeat.experiment.known_film import synthetic_film as synthetic_film
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
    from wingbeat.experiment.wing_forms import FORMS as FORMS
    from wingbeat.experiment.wing_forms import WingForm as WingForm

_HOME = {
    "BodyPath": "body_path",
    "Campaign": "campaign",
    "CoefficientTable": "table",
    "CurveFit": "regression",
    "CurveForm": "forms",
    "FORMS": "wing_forms",
    "Film": "film",
    "FilmedBeat": "film_fit",
    "FitRangeWarning": "regression",
    "LoadCellRun": "record",
    "WingFit": "wing_fit",
    "WingForm": "wing_forms",
    "draw": "drawing",
    "fit_body_path": "body_path",
    "fit_curve": "regression",
    "fit_film": "film_fit",
    "fit_wing": "wing_fit",
    "load_measurements": "table",
    "read_film": "film_file",
    "read_run": "record",
    "reduce_run": "reduction",
    "reduce_runs": "reduction",
    "save_runs": "campaign",
    "synthetic_film": "known_film",
    "synthetic_runs": "campaign",
}

__all__ = [*_HOME]  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(importlib.import_module(f"wingbeat.experiment.{_HOME[name]}"), name)
    raise AttributeError(f"module 'wingbeat.experiment' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
