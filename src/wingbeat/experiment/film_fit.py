"""From a film to a wingbeat: periodic smoothing splines, as Fourier series, with their errors.

The penalty is the square of (third derivative plus (2 pi)^2 times first derivative) of the spline. It is zero for a
mean and a plain sine (Ramsay and Silverman 2005, doi 10.1007/b98888): order k pays ``k^2 (k^2 - 1)^2``. Restricted
maximum likelihood chooses its weight. The errors are those of the posterior whose mean is the spline (Wahba 1983,
doi 10.1111/j.2517-6161.1983.tb01239.x), so they include the spline's bias. The result is a `Wingbeat` with
harmonics up to order 8, even if they are zero, so that one compiled program serves all films.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat.errors import FaultList, InvalidInputError
from wingbeat.experiment.film import FILMED, Film
from wingbeat.harmonics import HIGHEST_ORDER
from wingbeat.kinematics import FREE_NAMES, Wingbeat

# Mean, cosine and sine of order 1 are free of the penalty.
_PLAIN = 3
# Range in which the weight of the penalty is searched, times the number of frames.
_WEIGHTS = (1e-12, 1e8)
# How far below zero, in standard errors, noise may bring a retraction.
_NOISE = 3.0
Array = NDArray[np.float64]


def _design(phase: Any) -> Array:
    """Return the columns 1, cos, sin, .. of a Fourier series, shape (n, 17)."""
    turns = 2 * math.pi * np.asarray(phase)[:, None] * np.arange(1, HIGHEST_ORDER + 1)
    waves = np.stack([np.cos(turns), np.sin(turns)], axis=-1).reshape(len(turns), 2 * HIGHEST_ORDER)
    return np.hstack([np.ones((len(turns), 1)), waves])


class FilmedLaw(NamedTuple):
    """One column of a film as a Fourier series of the film's phase, in the unit of the column.

    Attributes
    ----------
    coefficients : mean, cosine and sine of order 1, of order 2 and so on up to 8, shape (17,).
    covariance : of the coefficients, shape (17, 17).
    residual_sd : standard deviation of a frame from the series.
    degrees : effective number of parameters of the spline; a mean and a plain sine are 3.
    frames : number of frames.
    """

    coefficients: Array
    covariance: Array
    residual_sd: float
    degrees: float
    frames: int

    def curve(self, phase: Any) -> tuple[Array, Array]:
        """Return the series at phases of the film, and its standard error.

        Parameters
        ----------
        phase : phases of the film, shape (n,).
        """
        columns = _design(phase)
        return columns @ self.coefficients, np.sqrt(np.einsum("ni,ij,nj->n", columns, self.covariance, columns))


def _fit_law(phase: Array, values: Array) -> FilmedLaw:
    """Fit a periodic smoothing spline; restricted maximum likelihood chooses its weight."""
    from scipy.optimize import minimize_scalar

    count, columns = len(values), _design(phase)
    orders = np.repeat(np.arange(2, HIGHEST_ORDER + 1), 2)
    penalty = np.concatenate([np.zeros(_PLAIN), orders**2 * (orders**2 - 1.0) ** 2])
    square, right = columns.T @ columns, columns.T @ values
    rounding = count * (1e-9 * np.abs(values).max()) ** 2

    def solved(log_weight: float) -> tuple[Array, Array, float]:
        stiff = square + np.diag(count * math.exp(log_weight) * penalty)
        found = np.asarray(np.linalg.solve(stiff, right), dtype=np.float64)
        rest = values - columns @ found
        return stiff, found, float(rest @ rest + found @ (stiff - square) @ found) + rounding

    def unlikely(log_weight: float) -> float:
        stiff, _, left = solved(log_weight)
        return float((count - _PLAIN) * math.log(left) + np.linalg.slogdet(stiff)[1] - orders.size * log_weight)

    # The likelihood may have two maxima, so a grid comes first.
    grid = np.linspace(math.log(_WEIGHTS[0]), math.log(_WEIGHTS[1]), 81)
    best = int(np.argmin([unlikely(at) for at in grid]))
    around = float(grid[max(best - 1, 0)]), float(grid[min(best + 1, grid.size - 1)])
    finest: Any = minimize_scalar(unlikely, bounds=around, method="bounded")
    stiff, found, left = solved(float(finest.x))
    variance, inverse = left / (count - _PLAIN), np.asarray(np.linalg.inv(stiff), dtype=np.float64)
    return FilmedLaw(found, variance * inverse, math.sqrt(variance), float(np.trace(inverse @ square)), count)


def _from(shift: float, coefficients: Array) -> Array:
    """Return the coefficients of a series whose phase begins at `shift` of the old one."""
    cosines, sines = coefficients[1::2], coefficients[2::2]
    turns = 2 * math.pi * shift * np.arange(1, len(cosines) + 1)
    c, s = np.cos(turns), np.sin(turns)
    waves = np.stack([cosines * c + sines * s, sines * c - cosines * s], axis=-1).ravel()
    return np.concatenate([coefficients[:1], waves])


def _numbers(laws: Mapping[str, Array]) -> dict[str, Any]:
    """Return the fields of a wingbeat from Fourier coefficients; flap's first harmonic is highest at phase 0."""
    flap = laws.get("flap_deg")
    shift = 0.0 if flap is None else math.atan2(flap[2], flap[1]) / (2 * math.pi)
    fields: dict[str, Any] = {"downstroke_fraction": 0.5}
    for name, coefficients in laws.items():
        moved = _from(shift, coefficients)
        moved = np.radians(moved) if FILMED[name] == "deg" else moved
        mean, *waves = moved.tolist()
        if name == "flap_deg":
            fields |= {"flap_mean": mean, "flap_amplitude": waves[0], "flap_harmonics": tuple(waves[2:])}
        elif name == "pitch_deg":
            fields |= {"pitch_mean": mean, "pitch_amplitude": math.hypot(*waves[:2])}
            fields |= {"pitch_phase": math.atan2(-waves[0], -waves[1]), "pitch_harmonics": tuple(waves[2:])}
        else:
            # The law of retraction has a mean and a sine; the harmonics make up for the rest.
            retraction = max(2.0 * (1.0 - mean), 0.0)
            fields["span_retraction"] = retraction
            fields["span_harmonics"] = (waves[0], waves[1] - 0.5 * retraction, *waves[2:])
    return fields


@dataclass(frozen=True)
class FilmedBeat:
    """A wingbeat fitted to a film, law by law; made by `fit_film`.

    Attributes
    ----------
    film : the film.
    laws : a Fourier series for each column of it.
    """

    film: Film
    laws: dict[str, FilmedLaw]

    @property
    def numbers(self) -> dict[str, Any]:
        """The fields of a `Wingbeat` that the film gives, SI and radians."""
        known = {} if self.film.frequency is None else {"frequency": self.film.frequency}
        return known | _numbers({name: law.coefficients for name, law in self.laws.items()})

    @property
    def held(self) -> frozenset[str]:
        """The parameters of a wingbeat that the film gives; an orbit may choose none of them."""
        filmed = tuple(f"{name.partition('_')[0]}_" for name in self.laws)
        return frozenset(name for name in FREE_NAMES if name.startswith(filmed)) | self.numbers.keys()

    def draws(self, wingbeat: Wingbeat, count: int = 32, seed: int = 0) -> list[Wingbeat]:
        """Return wingbeats as other films of the same beat would have given them.

        Parameters
        ----------
        wingbeat : holds what was not filmed.
        count : number of wingbeats; an impossible one, such as one without amplitude, is left out.
        seed : the same seed gives the same wingbeats.
        """
        random, found = np.random.default_rng(seed), []
        for _ in range(count):
            drawn = {
                n: random.multivariate_normal(law.coefficients, law.covariance) for n, law in self.laws.items()
            }
            fields = _numbers(drawn)
            if self.film.frequency is not None:
                fields["frequency"] = random.normal(self.film.frequency, self.film.frequency_se)
            try:
                found.append(dataclasses.replace(wingbeat, **fields))
            except InvalidInputError:
                continue
        return found


def fit_film(film: Film) -> FilmedBeat:
    """Fit periodic laws to a film.

    Each law is a periodic smoothing spline. The penalty leaves the mean and the first harmonic free. Restricted
    maximum likelihood chooses its weight.

    Parameters
    ----------
    film : one wingbeat, or several similar ones.

    Raises
    ------
    InvalidInputError : a flap angle that does not vary, a span fraction that is on average above 1 or below one
        half.

    >>> from wingbeat.experiment import synthetic_film
    >>> beat = fit_film(synthetic_film(Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3), frames=80, noise_deg=1.0))
    >>> round(beat.numbers["flap_amplitude"], 2), round(beat.laws["flap_deg"].residual_sd, 1)
    (0.8, 1.0)
    """
    faults, laws = FaultList(), {}
    for name in film.columns:
        phase, values = film.seen(name)
        laws[name] = _fit_law(phase, values)
    if "flap_deg" in laws:
        flap = laws["flap_deg"].coefficients
        if math.hypot(flap[1], flap[2]) < 1.0:
            fix = "is the phase right, and the column in degrees?"
            faults.add(f"{film.name}, flap_deg", f"{math.hypot(flap[1], flap[2]):.2g} deg", "hardly swings", fix)
    if "span_fraction" in laws:
        mean, error = laws["span_fraction"].coefficients[0], math.sqrt(laws["span_fraction"].covariance[0, 0])
        if not 0.5 < mean <= 1.0 + _NOISE * error:
            rule = "is its mean and must be above 0.5 and at most 1"
            faults.add(f"{film.name}, span_fraction", float(mean), rule, "divide by the species' semi_span")
    faults.raise_if_any()
    return FilmedBeat(film, laws)
