"""The birds whose airspeed was measured, each flown over a range of speeds from its mass, span and area alone."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import wingbeat as wb
from wingbeat._base import FileError, read_text
from wingbeat._workers.pool import in_processes
from wingbeat.models import MODELS, model_of
from wingbeat.orbits.solve import Progress

AIRSPEEDS = "bird_airspeed_alerstam2007.csv"
FREQUENCIES, LEVEL_FLIGHT, AMPLITUDES = (
    "check_frequency.csv",
    "alcid_level_flight.csv",
    "alcid_stroke_amplitude.csv",
)
# Of the speed at which a wing at lift coefficient 1 carries the bird; measured airspeeds play no part in them.
SPEEDS = (0.65, 0.8, 0.95, 1.1, 1.25, 1.4, 1.6)
# A power curve that rises by more than this share above the line between neighbours is no power curve.
ROUGH = 0.01
POWER, FREQUENCY, HELD = "least power", "least frequency", "least power, amplitude held"
PAPER, ANIMAL = MODELS
ENGLISH = {
    "Uria aalge": "Common murre",
    "Fratercula corniculata": "Horned puffin",
    "Fratercula cirrhata": "Tufted puffin",
    "Cepphus columba": "Pigeon guillemot",
}


@dataclass(frozen=True)
class Bird:
    """A species: biometry and airspeed [m/s]; of a few, measured frequency [Hz] and half amplitude [deg]."""

    name: str
    mass: float
    span: float
    area: float
    airspeed: float
    airspeed_sd: float = math.nan
    frequency: float = math.nan
    frequency_sd: float = math.nan
    amplitude_deg: float = math.nan

    @property
    def species(self) -> wb.Species:
        """The bird as the scaling laws have it."""
        return wb.bird(mass=self.mass, wing_span=self.span, wing_area=self.area, name=self.name)


@dataclass(frozen=True)
class Point:
    """What came out for one bird at one speed by one model; not-a-number where no orbit was certified.

    `power` is what least power minimises: by the paper's model the positive hinge power, by `animal` the metabolic
    power. `hinge_power` is the positive hinge power by both.
    """

    model: str
    species: str
    asked: str
    speed: float
    status: str
    power: float
    hinge_power: float
    frequency: float
    amplitude_deg: float
    active_bounds: str


def read_rows(path: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV file whose comments begin with #."""
    if not path.is_file():
        raise FileError(f"cannot find {path.name} in {str(path.parent)!r}; the data are not part of this project")
    return list(csv.DictReader(line for line in read_text(path).splitlines() if line and not line.startswith("#")))


def csv_of(kind: type[Any], rows: list[Any], digits: int) -> str:
    """Return objects of one dataclass as a CSV file's text, a row each; numbers have so many significant digits."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(kind.__dataclass_fields__)
    for row in rows:
        values = vars(row).values()
        writer.writerow([f"{value:.{digits}g}" if isinstance(value, float) else value for value in values])
    return text.getvalue()


def _number(text: str) -> float:
    return float(text) if text else math.nan


def radar_birds(folder: Path) -> list[Bird]:
    """Return the species of Alerstam et al. 2007 with mass, span, area and airspeed."""
    found = []
    for row in read_rows(folder / AIRSPEEDS):
        size = [row[key] for key in ("mass_kg", "wingspan_m", "wing_area_m2", "Ue_m_s")]
        if all(size):
            found.append(Bird(row["species"], *map(float, size), _number(row["Ue_sd_m_s"])))
    return found


def timed_birds(folder: Path) -> list[Bird]:
    """Return the few birds of measured wingbeat frequency, at the speed at which it was measured."""
    speeds, strokes = read_rows(folder / LEVEL_FLIGHT), read_rows(folder / AMPLITUDES)

    def mean(rows: list[dict[str, str]], key: str) -> float:
        return sum(float(row[key]) for row in rows) / len(rows)

    found = []
    for row in read_rows(folder / FREQUENCIES):
        if not row["frequency_kind"].startswith("measured"):
            continue
        name = row["species"]
        size = [float(row[key]) for key in ("mass_kg", "wingspan_m", "wing_area_m2")]
        beat = float(row["f_Hz"]), float(row["f_sd_Hz"])
        if name in ENGLISH:
            speed = mean([r for r in speeds if r["species"] == ENGLISH[name]], "ground_speed_m_s")
            own = [r for r in strokes if r["species"] == ENGLISH[name] and r["fluid"] == "Air"]
            found.append(Bird(name, *size, speed, math.nan, *beat, 0.5 * mean(own, "stroke_amplitude_deg")))
        else:  # the pigeon, in slow flight at 4.46 m/s with its load
            found.append(Bird(name, *size, 4.46, 0.27, *beat))
    return found


def speed_at_lift_one(bird: Bird) -> float:
    """Return the speed at which a wing of lift coefficient 1 carries the bird [m/s]."""
    air = bird.species.air
    return math.sqrt(2 * bird.mass * air.gravity / (air.density * bird.area))


def problems(radar: list[Bird], timed: list[Bird], model: str = PAPER) -> list[tuple[str, wb.OrbitProblem]]:
    """Return every problem of the study by one model, with the name of what it asks."""
    asked = []
    for bird in radar:
        at_one = speed_at_lift_one(bird)
        for speed in (*(factor * at_one for factor in SPEEDS), bird.airspeed):
            asked.append((POWER, problem_of(model, bird, speed)))
        asked.append((FREQUENCY, problem_of(model, bird, bird.airspeed, minimise="frequency")))
    for bird in timed:
        asked.append((POWER, problem_of(model, bird, bird.airspeed)))
        asked.append((FREQUENCY, problem_of(model, bird, bird.airspeed, minimise="frequency")))
        if math.isfinite(bird.amplitude_deg):
            held = f"flap_amplitude={bird.amplitude_deg} deg"
            asked.append((HELD, problem_of(model, bird, bird.airspeed, subject_to=[held])))
    return asked


def problem_of(model: str, bird: Bird, speed: float, **changes: Any) -> wb.OrbitProblem:
    """Return the problem of a bird's flight at a speed [m/s], of least power unless `changes` say otherwise.

    By the model `animal` the frequency is the bird's own, unless the least frequency is asked for.
    """
    species = bird.species
    least = "mean_positive_power" if model == PAPER else "metabolic_power"
    return model_of(model, species).problem(species, speed, **{"minimise": least, **changes})


def fly(asked: list[tuple[str, wb.OrbitProblem]], processes: int, progress: Progress | None = None) -> list[Point]:
    """Solve all of it in one batch."""
    problems = [problem for _, problem in asked]
    orbits = wb.solve_orbits(problems, starts=1, processes=processes, progress=progress, most_starts=8)
    return [point_of(PAPER, what, problem, orbit) for (what, problem), orbit in zip(asked, orbits, strict=True)]


def curves(points: list[Point]) -> dict[str, list[Point]]:
    """Return the points of least power of each species, by rising speed; what was not certified is left out."""
    found: dict[str, list[Point]] = {}
    for point in sorted(points, key=lambda point: point.speed):
        if point.asked == POWER and math.isfinite(point.power):
            found.setdefault(point.species, []).append(point)
    return found


def rough(curve: list[Point]) -> bool:
    """Say whether a point lies above its neighbours as power curves do not, or one was not certified.

    Such a point is a poorer optimum, or of another family of orbits.
    """
    if not all(math.isfinite(point.power) for point in curve):
        return True
    speeds = [point.speed for point in curve]
    logs = [math.log(point.power) for point in curve]
    for i in range(1, len(curve) - 1):
        share = (speeds[i] - speeds[i - 1]) / (speeds[i + 1] - speeds[i - 1])
        if logs[i] > logs[i - 1] + share * (logs[i + 1] - logs[i - 1]) + ROUGH:
            return True
    return False


def fly_again(
    points: list[Point], radar: list[Bird], processes: int, progress: Progress | None = None
) -> list[Point]:
    """Search the rough curves again, each speed from its neighbours' answers; keep what costs less power."""
    by_name, own = {bird.name: bird for bird in radar}, curves(points)
    poor = [
        by_name[name] for name in by_name if name not in own or rough(own[name]) or len(own[name]) <= len(SPEEDS)
    ]
    again = [[problem for what, problem in problems([bird], []) if what == POWER] for bird in poor]
    series = [point for found in in_processes(fly_series, again, processes, progress) for point in found]
    least = {(p.species, p.asked, round(p.speed, 9)): p for p in series}
    return [_better(point, least.get((point.species, point.asked, round(point.speed, 9)))) for point in points]


def _better(one: Point, other: Point | None) -> Point:
    return (
        one if other is None or not other.power < (one.power if math.isfinite(one.power) else math.inf) else other
    )


def fly_series(asked: list[wb.OrbitProblem]) -> list[Point]:
    """Fly one bird's problems of least power, each speed helped by its neighbours; by rising speed."""
    asked = sorted(asked, key=lambda problem: problem.speed)
    orbits = wb.solve_orbits(asked, starts=2, most_starts=8, in_order=True)
    return [point_of(PAPER, POWER, problem, orbit) for problem, orbit in zip(asked, orbits, strict=True)]


def point_of(model: str, what: str, problem: wb.OrbitProblem, orbit: wb.Orbit) -> Point:
    """Return the row of an orbit."""
    named = model, problem.species.name, what, problem.speed, orbit.status.value
    if orbit.status is not wb.Status.CONVERGED:
        return Point(*named, math.nan, math.nan, math.nan, math.nan, "")
    record = orbit.record()
    beat, bounds = record["wingbeat"], " ".join(record["active_bounds"])
    hinge = record["mean_positive_power"]
    power = hinge if model == PAPER else record["metabolic_power"]
    return Point(*named, power, hinge, beat["frequency"], math.degrees(beat["flap_amplitude"]), bounds)


def from_csv(path: Path) -> list[Point]:
    """Return the points that `csv_of` wrote."""
    return [
        Point(**{key: float(value) if key in _FLOATS else value for key, value in row.items()})  # type: ignore[arg-type]
        for row in read_rows(path)
    ]


_FLOATS = ("speed", "power", "hinge_power", "frequency", "amplitude_deg")
