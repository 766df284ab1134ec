"""From a film to a wingbeat, with errors: a periodic spline for each column.

The result is a `Wingbeat` with harmonics up to order 8, even if they are zero, so that one compiled program serves
all films.
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
from wingbeat.animal.kinematics import FREE_NAMES, Wingbeat, recovery, span_ratio
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
# A filmed fold that differs from its law by this and by so many errors does not follow it [deg].
_LEAST_FOLD, _SURE_FOLD = 2.0, 4.0
# A length of the filmed animal that differs from the species' by more than this share is said.
_UNLIKE = 0.05


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
        if self.film.wrist is not None and "fold_deg" in self.laws:
            known["wrist"] = self.film.wrist
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
        if law is not None and law.varies:
            notes.append(
                f"{self.film.name}, column stroke_plane_deg: the angle varies by {2 * _amplitude(law):.2g} degrees "
                "over the beat, more than the noise; a wingbeat has a fixed stroke plane, so the mean angle is used"
            )
        if "fold_deg" in self.laws:
            where = "the wrist is the species'; the film's line '# wrist = 0.5' would state it"
            if self.film.wrist is not None:
                where = f"the wrist is at {self.film.wrist:.3g} of the span, as the film says"
            notes.append(f"{self.film.name}, column fold_deg: {where}")
        return (*notes, *self.misfits.values(), *self._misfold)

    @property
    def warnings(self) -> tuple[str, ...]:
        """Those notes that may change every number computed from the film."""
        return (*self.film.warnings, *self.misfits.values(), *self._misfold)

    @functools.cached_property
    def misfits(self) -> dict[tuple[str, str], str]:
        """Sentences by column and fault: "far", a few frames are far from the curve, or "scattered", all are."""
        found = {}
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
                found[name, "far"] = (
                    f"{where}: {len(far)} of {len(off)} frames are far from the fitted curve, by up to "
                    f"{off[worst]:.2g} {unit} at phase {phase[worst]:.3f}{time}; did the tracker follow another "
                    "point? Leave such cells empty"
                )
            if law.residual_sd > max(_LARGE * size, least):
                found[name, "scattered"] = (
                    f"{where}: the frames lie {law.residual_sd:.2g} {unit} from the fitted wingbeat, whose "
                    f"amplitude is {size:.2g} {unit}: the beats are not alike, or the clock is wrong; do not trust "
                    "numbers computed from this film"
                )
        return found

    @functools.cached_property
    def _misfold(self) -> tuple[str, ...]:
        """Say where the filmed fold differs from the law by which the hand folds, that of the span's retraction."""
        if "fold_deg" not in self.laws:
            return ()
        law, phase = self.laws["fold_deg"], np.arange(64) / 64
        filmed, error = law.curve(phase + self.shift)
        size = math.degrees(self.numbers["fold_amplitude"])
        off = size * np.asarray(recovery(phase)) - filmed
        worst = int(np.argmax(np.abs(off) / error))
        way = "more" if off[worst] > 0 else "less"
        if abs(off[worst]) < max(_SURE_FOLD * float(error[worst]), _LEAST_FOLD):
            return ()
        return (
            f"{self.film.name}, column fold_deg: the model folds the hand by {size:.3g} deg (1 - sin)/2, which is "
            f"{abs(off[worst]):.2g} +- {error[worst]:.1g} deg {way} than filmed at "
            f"phase {phase[worst]:.2f} (0 is the top of the stroke); the filmed fold does not follow this law",
        )

    def differences(self, vehicle: Vehicle, wingbeat: Wingbeat) -> tuple[str, ...]:
        """Return a sentence for each length that was measured, is not used, and differs by more than a twentieth.

        Parameters
        ----------
        vehicle, wingbeat : with the semi-span and the wrist that are used.
        """
        pairs = {"wing.semi_span": (self.film.semi_span, vehicle.wing.semi_span)}
        if "fold_deg" not in self.laws and wingbeat.fold_amplitude:
            pairs["wingbeat.wrist"] = self.film.wrist, wingbeat.wrist
        return tuple(
            f"{self.film.name}: {path} is {measured:.4g}{' m' * (path == 'wing.semi_span')} in the film, and "
            f"{own:.4g} is used; --set {path}={measured:.4g} would use the film's"
            for path, (measured, own) in pairs.items()
            if measured is not None and abs(measured - own) > _UNLIKE * own
        )

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
