"""From a film to a wingbeat and the motion of the body, with errors: a periodic spline for each column.

The result is a `Wingbeat` with harmonics up to order 8, even if they are zero, so that one compiled program serves
all films. The body moves by uniform travel plus a spline.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import HIGHEST_ORDER, Fault, FaultList, InvalidInputError
from wingbeat.animal.kinematics import FREE_NAMES, Wingbeat, span_ratio
from wingbeat.animal.vehicle import Vehicle
from wingbeat.experiment.film import FILMED, WHOLE, Film
from wingbeat.experiment.periodic import Array, FilmedLaw, fit_law, fourier_columns, from_phase

# How far below zero, in standard errors, noise may bring a retraction.
_NOISE = 3.0
# A residual above this share of the amplitude is more than noise. Columns other than flap may vary little, so
# theirs must also exceed the noise of films [deg, or a fraction].
_LARGE, _NOISE_DEG, _NOISE_SHARE = 0.2, 5.0, 0.05
# A tracker followed another point where a frame is so many times farther from the curve than the middle frame, and
# by more than this share of the amplitude. Normal noise reaches the former in one frame of 10^9.
_SWAPPED, _SWAPPED_SHARE = 9.0, 0.25
# Least share of a flap's amplitude in its first harmonic. A sawtooth has 0.64, a square wave 1.27. Frames of ten
# phases in radians, taken for beats, have 0.06.
_ONCE = 0.4
# Noise alone exceeds this chi squared of four numbers in one film of a hundred.
_CHANCE = 13.28


def _drawn_in(law: str, mean: float, waves: list[float]) -> dict[str, Any]:
    """Return retraction, which has a mean and a sine, and harmonics, for the rest, of span or chord."""
    retraction = max(2.0 * (1.0 - mean), 0.0)
    harmonics = (waves[0], waves[1] - 0.5 * retraction, *waves[2:])
    return {f"{law}_retraction": retraction, f"{law}_harmonics": harmonics}


# Sixteen samples in the highest harmonic's period: higher harmonics are not aliased into lower ones.
_PHASES = np.arange(16 * HIGHEST_ORDER) / (16 * HIGHEST_ORDER)
_COLUMNS = fourier_columns(_PHASES)


def _chord_of(area: Array, span: Array) -> Array:
    """Return the Fourier coefficients of area divided by span, from those of area and of span."""
    ratio = (_COLUMNS @ area) / (_COLUMNS @ span)
    return np.asarray(np.linalg.lstsq(_COLUMNS, ratio, rcond=None)[0], dtype=np.float64)


def _span_of(wingbeat: Wingbeat) -> Array:
    """Return the Fourier coefficients of a span law with equally long down- and upstroke, as for a film."""
    span = np.asarray(span_ratio(dataclasses.replace(wingbeat, downstroke_fraction=0.5), _PHASES))
    return np.asarray(np.linalg.lstsq(_COLUMNS, span, rcond=None)[0], dtype=np.float64)


def _top_of(laws: Mapping[str, Array]) -> float:
    """Return the phase of the film at which the flap's first harmonic is highest, 0 without a flap."""
    flap = laws.get("flap_deg")
    return 0.0 if flap is None else math.atan2(flap[2], flap[1]) / (2 * math.pi)


def _numbers(laws: Mapping[str, Array], species_span: Array | None = None) -> dict[str, Any]:
    """Return the fields of a wingbeat from Fourier coefficients; flap's first harmonic is highest at phase 0.

    The chord law needs a span law: the film's or, if the film shows no span, the species'.
    """
    shift = _top_of(laws)
    fields: dict[str, Any] = {"downstroke_fraction": 0.5}
    series = {name: from_phase(shift, coefficients) for name, coefficients in laws.items()}
    series |= {name: np.radians(moved) for name, moved in series.items() if FILMED[name] == "deg"}
    span = series.get("span_fraction", species_span)
    for name, (mean, *waves) in ((name, moved.tolist()) for name, moved in series.items()):
        if name == "flap_deg":
            fields |= {"flap_mean": mean, "flap_amplitude": waves[0], "flap_harmonics": tuple(waves[2:])}
        elif name in ("pitch_deg", "sweep_deg"):
            # These laws are mean + sign amplitude sin(2 pi phase + lead).
            law, sign = name.removesuffix("_deg"), -1.0 if name == "pitch_deg" else 1.0
            lead = math.atan2(sign * waves[0], sign * waves[1])
            fields |= {f"{law}_mean": mean, f"{law}_amplitude": math.hypot(*waves[:2]), f"{law}_phase": lead}
            fields[f"{law}_harmonics"] = tuple(waves[2:])
        elif name == "span_fraction":
            fields |= _drawn_in("span", mean, waves)
        elif name == "fold_deg":
            # Least squares of the law fold_amplitude (1 - sin)/2 to the series.
            fields |= {"fold_amplitude": (4.0 * mean - 2.0 * waves[1]) / 3.0}
    if "tip_pitch_deg" in series:
        mean, *waves = (series["tip_pitch_deg"] - series["pitch_deg"]).tolist()
        # Each of the two angles is known only up to whole turns.
        fields |= {"twist_ratio": 1.0, "twist_mean": math.remainder(mean, 2 * math.pi)}
        fields["twist_harmonics"] = tuple(waves)
    if "area_fraction" in series and span is not None:
        mean, *waves = _chord_of(series["area_fraction"], span).tolist()
        fields |= _drawn_in("chord", mean, waves)
    return fields


# The beginnings of the names of those wingbeat parameters that each column determines.
_SETTLED = {"flap_deg": "flap_", "pitch_deg": "pitch_", "span_fraction": "span_", "sweep_deg": "sweep_"}
_SETTLED |= {"tip_pitch_deg": "twist_", "stroke_plane_deg": "stroke_plane_tilt", "area_fraction": "chord_"}
_SETTLED |= {"fold_deg": "fold_"}


def _amplitude(law: FilmedLaw) -> float:
    """Return half of peak to peak of a fitted curve."""
    return 0.5 * float(np.ptp(law.curve(np.linspace(0.0, 1.0, 97))[0]))


@dataclass(frozen=True)
class FilmedBeat:
    """A wingbeat fitted to a film, each filmed quantity of the wing on its own; made by `fit_film`.

    Attributes
    ----------
    film : the film.
    laws : the Fourier series of each column of the wing in the film, by the column's name.
    """

    film: Film
    laws: dict[str, FilmedLaw]

    @property
    def numbers(self) -> dict[str, Any]:
        """The fields of a `Wingbeat` that the film gives without its species, SI and radians.

        The tilt of the stroke plane, and a chord whose span was not filmed, need the species: see `numbers_of`.
        """
        return self._numbers(None)

    @property
    def shift(self) -> float:
        """The phase of the film that is phase 0 of the wingbeat."""
        return _top_of({name: law.coefficients for name, law in self.laws.items()})

    def _numbers(self, span: Array | None) -> dict[str, Any]:
        known = {} if self.film.frequency is None else {"frequency": self.film.frequency}
        return known | _numbers({name: law.coefficients for name, law in self.laws.items()}, span)

    def numbers_of(self, vehicle: Vehicle, wingbeat: Wingbeat) -> dict[str, Any]:
        """Return all fields of a `Wingbeat` that the film gives, SI and radians.

        Parameters
        ----------
        vehicle : gives the angle of the stroke plane; the tilt adds to it.
        wingbeat : gives the span law, if it was not filmed.

        Raises
        ------
        InvalidInputError : a chord that is on average above the full one or below half of it.
        """
        fields = self._numbers(_span_of(wingbeat))
        if "area_fraction" in self.laws:
            area, span = self.laws["area_fraction"], self.laws.get("span_fraction")
            mean = _chord_of(area.coefficients, _span_of(wingbeat) if span is None else span.coefficients)[0]
            error = math.hypot(*(math.sqrt(law.covariance[0, 0]) for law in (area, span) if law is not None))
            if not 0.5 < mean <= 1.0 + _NOISE * error:
                rule = "the mean ratio of area fraction to span fraction must be above 0.5 and at most 1"
                fix = "divide the areas by that of the fully spread wing of the species file"
                raise InvalidInputError([Fault(f"{self.film.name}, area_fraction", float(mean), rule, fix)])
        if "stroke_plane_deg" in self.laws:
            angle = math.radians(self.laws["stroke_plane_deg"].coefficients[0]) - vehicle.wing.stroke_plane_angle
            fields["stroke_plane_tilt"] = math.remainder(angle, 2 * math.pi)
        return fields

    @property
    def notes(self) -> tuple[str, ...]:
        """What the reader of the fit must know, warnings included."""
        notes, law = [*self.film.notes], self.laws.get("stroke_plane_deg")
        waves = np.zeros(4) if law is None else law.coefficients[1:5]
        if law is not None and waves @ np.linalg.solve(law.covariance[1:5, 1:5], waves) > _CHANCE:
            notes.append(
                f"{self.film.name}, column stroke_plane_deg: the angle varies by {2 * _amplitude(law):.2g} degrees "
                "over the beat, more than the noise; a wingbeat has a fixed stroke plane, so the mean angle is used"
            )
        return (*notes, *self._misfits)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Those notes that may change every number computed from the film."""
        return (*self.film.warnings, *self._misfits)

    @functools.cached_property
    def _misfits(self) -> tuple[str, ...]:
        """Say which columns are far from their curve, and in which frames only."""
        found = []
        for name, law in self.laws.items():
            where, (phase, values) = f"{self.film.name}, column {name}", self.film.seen(name)
            unit = "degrees" if FILMED[name] == "deg" else f"of the {WHOLE[name]}"
            size, off = _amplitude(law), np.abs(values - law.curve(phase)[0])
            least = 0.0 if name == "flap_deg" else _NOISE_DEG if FILMED[name] == "deg" else _NOISE_SHARE
            # The middle of the absolute deviations, on average over the noise of few frames.
            far = np.flatnonzero(off > max(_SWAPPED * float(np.median(off)), _SWAPPED_SHARE * size, least))
            if 0 < len(far) <= max(0.1 * len(off), 1):
                worst = int(far[np.argmax(off[far])])
                time = f" ({phase[worst] / self.film.frequency:.4g} s)" if self.film.frequency else ""
                found.append(
                    f"{where}: {len(far)} of {len(off)} frames are far from the fitted curve, by up to "
                    f"{off[worst]:.2g} {unit} at phase {phase[worst]:.3f}{time}; did the tracker follow another "
                    "point? Leave such cells empty"
                )
            if law.residual_sd > max(_LARGE * size, least):
                found.append(
                    f"{where}: the frames lie {law.residual_sd:.2g} {unit} from the fitted wingbeat, whose "
                    f"amplitude is {size:.2g} {unit}: the beats are not alike, or the clock is wrong; do not trust "
                    "numbers computed from this film"
                )
        return tuple(found)

    @property
    def held(self) -> frozenset[str]:
        """The parameters of a wingbeat that the film gives; none of them can be free in an orbit problem."""
        filmed = tuple(_SETTLED[name] for name in self.laws)
        return frozenset(name for name in FREE_NAMES if name.startswith(filmed)) | self.numbers.keys()

    def draws(self, wingbeat: Wingbeat, count: int = 32, seed: int = 0) -> list[Wingbeat]:
        """Return random wingbeats, such as other films of the same beat might have given.

        Parameters
        ----------
        wingbeat : the fitted wingbeat; it also gives what was not filmed.
        count : number of wingbeats; an impossible one, such as one without amplitude, is left out.
        seed : the same seed gives the same wingbeats.
        """
        random, found, span = np.random.default_rng(seed), [], _span_of(wingbeat)
        normal = random.multivariate_normal
        for _ in range(count):
            drawn = {name: normal(law.coefficients, law.covariance) for name, law in self.laws.items()}
            fields = _numbers(drawn, span)
            if "stroke_plane_deg" in drawn:
                moved = drawn["stroke_plane_deg"] - self.laws["stroke_plane_deg"].coefficients
                fields["stroke_plane_tilt"] = wingbeat.stroke_plane_tilt + math.radians(moved[0])
            if self.film.frequency is not None:
                fields["frequency"] = random.normal(self.film.frequency, self.film.frequency_se)
            with contextlib.suppress(InvalidInputError):
                found.append(dataclasses.replace(wingbeat, **fields))
        return found


def fit_film(film: Film) -> FilmedBeat:
    """Fit periodic laws to a film.

    Each law is a periodic smoothing spline. The penalty leaves the mean and the first harmonic free. Restricted
    maximum likelihood chooses the weight of the penalty.

    Parameters
    ----------
    film : one wingbeat, or several similar ones.

    Raises
    ------
    InvalidInputError : a flap angle that does not vary or has no beat (frames farther from the curve than its
        amplitude, or a curve that hardly repeats once a beat), a span fraction that is on average above 1 or below
        one half.

    >>> from wingbeat.experiment import synthetic_film
    >>> beat = fit_film(synthetic_film(Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3), frames=80, noise_deg=1.0))
    >>> round(beat.numbers["flap_amplitude"], 2), round(beat.laws["flap_deg"].residual_sd, 1)
    (0.8, 1.0)
    """
    faults, laws = FaultList(), {name: fit_law(*film.seen(name)) for name in FILMED if name in film.columns}
    if "flap_deg" in laws:
        where, once = f"{film.name}, flap_deg", math.hypot(*laws["flap_deg"].coefficients[1:3])
        size, rest = _amplitude(laws["flap_deg"]), laws["flap_deg"].residual_sd
        fix = "these frames are not of one wingbeat: are phases, times and frequency right?"
        if once < 1.0:
            fix = "is the phase right, and the column in degrees?"
            faults.add(where, f"{once:.2g} deg", "hardly swings", fix)
        elif rest > size:
            rule = f"is the scatter about the fitted wingbeat, more than its amplitude, {size:.2g} deg"
            faults.add(where, f"{rest:.2g} deg", rule, fix)
        elif once < _ONCE * size:
            rule = f"is the part of the flap that repeats once a beat, of an amplitude of {size:.2g} deg"
            faults.add(where, f"{once:.2g} deg", rule, fix)
    if "span_fraction" in laws:
        mean, error = laws["span_fraction"].coefficients[0], math.sqrt(laws["span_fraction"].covariance[0, 0])
        if not 0.5 < mean <= 1.0 + _NOISE * error:
            rule = "the mean of this column must be above 0.5 and at most 1"
            faults.add(f"{film.name}, span_fraction", float(mean), rule, "divide by the species' semi_span")
    faults.raise_if_any()
    return FilmedBeat(film, laws)


# A film must show this share of a beat in one piece: in a shorter piece, travel and periodic motion look alike.
_SHORTEST = 0.9


@dataclass(frozen=True)
class BodyPath:
    """Uniform travel of the body plus a periodic motion; made by `fit_body_path`.

    Parameters
    ----------
    frequency : wingbeats per second [Hz].
    velocity : of the travel, forward and up [m/s].
    series : x, z [m] and body pitch [rad] over the phase of the wingbeat, as mean, cosine and sine of order 1, of
        order 2 and so on up to 8, shape (3, 17); the place at phase 0 is the origin.
    """

    frequency: float
    velocity: tuple[float, float]
    series: Array

    def states(self, phase: Any) -> Array:
        """Return (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s].

        Parameters
        ----------
        phase : of the wingbeat, shape (K,).
        """
        phase = np.asarray(phase, dtype=float)
        place, rate = (self._series(phase, order) for order in (0, 1))
        place[:, :2] -= self._series(np.zeros(1), 0)[:, :2]
        travel = np.array([*self.velocity, 0.0])
        return np.hstack([place + travel * phase[:, None] / self.frequency, rate + travel])

    def accelerations(self, phase: Any) -> Array:
        """Return (x'', z'', psi''), shape (K, 3) [m/s2, m/s2, rad/s2].

        Parameters
        ----------
        phase : of the wingbeat, shape (K,).
        """
        return self._series(np.asarray(phase, dtype=float), 2)

    def _series(self, phase: Array, derivative: int) -> Array:
        """Return the series or one of their time derivatives, shape (K, 3)."""
        turning = 2 * math.pi * self.frequency * np.arange(1, HIGHEST_ORDER + 1)
        waves = self.series[:, 1::2] + 1j * self.series[:, 2::2]
        # Cosine and sine are the real part of (a + i b) exp(-i w t).
        waves = waves * (-1j * turning) ** derivative
        pairs = np.stack([waves.real, waves.imag], axis=-1).reshape(3, -1)
        mean = self.series[:, :1] * (derivative == 0)
        return fourier_columns(phase) @ np.hstack([mean, pairs]).T


def fit_body_path(
    beat: FilmedBeat, u: float | None = None, w: float | None = None, body_pitch: float | None = None
) -> BodyPath:
    """Fit the motion of a filmed body.

    Each coordinate, x and z, is uniform travel plus a periodic smoothing spline like those of the wings' laws. Body
    pitch is such a spline alone. A velocity or pitch that was not filmed is constant, and given by the caller.

    Parameters
    ----------
    beat : the fitted wingbeat of a film with any of ``body_x_m``, ``body_z_m`` and ``body_pitch_deg``.
    u, w : velocity forward and up, if x or z was not filmed [m/s]; w is 0 if not given.
    body_pitch : constant pitch, if it was not filmed [rad]; 0 if not given.

    Raises
    ------
    InvalidInputError : a film of less than nine tenths of a beat, a quantity that is both given and filmed, or no
        velocity.
    """
    film, faults = beat.film, FaultList()
    given = {"body_x_m": u, "body_z_m": w, "body_pitch_deg": body_pitch}
    for name, number in given.items():
        if name in film.columns and number is not None:
            faults.add(f"{film.name}, column {name}", number, "is filmed and given too", "give one of the two")
    if "body_x_m" not in film.columns and u is None:
        faults.add(f"{film.name}, body_x_m", "", "is missing", "add the column, or give the mean velocity u [m/s]")
    laws: list[Array] = []
    velocity = []
    frequency = film.frequency or math.nan
    for name in ("body_x_m", "body_z_m"):
        travel, series = (given[name] or 0.0) / frequency, np.zeros(2 * HIGHEST_ORDER + 1)
        if name in film.columns:
            phase, values = film.seen(name)
            covered = float(np.ptp(phase))
            if covered < _SHORTEST:
                rule = f"covers only {covered:.2g} beats: too little to separate travel from periodic motion"
                faults.add(f"{film.name}, column {name}", f"{len(phase)} frames", rule, "film a whole wingbeat")
            found = fit_law(phase, values - values.mean(), (phase - phase.mean())[:, None]).coefficients
            travel, series = float(found[0]), found[1:].copy()
            series[0] -= travel * phase.mean()
        velocity.append(travel * frequency)
        laws.append(series)
    faults.raise_if_any()
    pitch = np.array([body_pitch or 0.0, *[0.0] * 2 * HIGHEST_ORDER])
    if "body_pitch_deg" in film.columns:
        pitch = np.radians(fit_law(*film.seen("body_pitch_deg")).coefficients)
    moved = np.stack([from_phase(beat.shift, one) for one in (*laws, pitch)])
    return BodyPath(frequency, (velocity[0], velocity[1]), moved)
