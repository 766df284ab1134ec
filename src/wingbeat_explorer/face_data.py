"""What the explorer shows of an orbit: a sentence, two lights, gauges, numbers, warnings and the viewer's scene.

`measured_points` adds what was measured on live animals, which the page draws behind its curve against speed.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import Any

from wingbeat._base import NOMENCLATURE, FileError, cf, for_people
from wingbeat.animal.species.building import NOT_MEASURED
from wingbeat.animal.species.species import Species
from wingbeat.orbits.options import Status
from wingbeat.records.judgements import JUDGED_NAMES, set_by_limit, statements
from wingbeat.records.numbers import SPENT, beat_mean
from wingbeat.results.orbit import Orbit
from wingbeat.viewer import scene
from wingbeat.words.orbit_words import FREQUENCY_BASES, frequency_in_words, limits_in_words, mass_of
from wingbeat_evidence.whole_flights import Measurement, measured_animals, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import ends_of, name_of
from wingbeat_explorer.models import EXPLORER_MODELS

# Numbers of the record or its wingbeat that are listed, and how they are called; those that it lacks are left out.
_LISTED = {
    "mean_positive_power": "mechanical power at the wing hinges, mean of the positive part",
    "metabolic_power": "metabolic power of the flight muscle alone",
    "metabolic_rate": "metabolic rate of the whole animal, an estimate",
    "electrical_power": "electrical power",
    "cost_of_transport": "cost of transport",
    "reduced_frequency": "reduced frequency",
    "body_pitch_range": "range of body pitch within a beat",
    "hinge_stiffness": "stiffness of the pitch hinges",
    "hinge_damping": "damping of the pitch hinges",
    "hinge_rest_angle": "rest angle of the pitch hinges",
    "hinge_amplitude": "amplitude of the wing's pitch",
    "hinge_lead": "lead of the wing's pitch over its flap",
}
_MUSCLE = "positive_power_per_mass"
_NUMBERS = ("value", "low", "high")


def face_of(orbit: Orbit, model: str) -> dict[str, Any]:
    """Return what the explorer shows of an orbit, fit for JSON.

    The keys are species, title, kind, model, model_title, speed and climb [m/s], status, power [W], frequency
    [Hz], sentence, spent, mass, lights, gauges, numbers, warnings and scene. Power is the mean of the positive part
    at the wing hinges. What is spent on the air (profile, induced, parasite and unsteady) are means over the beat
    [W], or None without a certified beat. The mass is in kg. Gauges and numbers are in the units that readers
    prefer. The scene is None if the flight tumbles before there is anything to show; a certified flight never does.

    Parameters
    ----------
    orbit : certified or not.
    model : the explorer's name of the model that made the problem, see `wingbeat_explorer.models`.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> face_of(orbit, "paper")["sentence"].split(" and ")[0]
    'A rock pigeon at 12 m/s beats 9.5 times a second (set by a limit)'
    """
    record, species = orbit.record(), orbit.problem.species
    title = species.common_name or species.name
    certified, limits = orbit.status is Status.CONVERGED, limits_in_words(record)
    spent = {name: beat_mean(orbit.dataset[series].values) for name, series in SPENT.items()} if certified else None
    warnings = [f"set by limits, not predicted: {limits}"] if limits else []
    if given := frequency_in_words(record) if certified else "":
        warnings.insert(0, f"{given}: given, not predicted")
    return {
        "species": species.name,
        "title": title,
        "kind": species.kind,
        "model": model,
        "model_title": EXPLORER_MODELS[model].title if model in EXPLORER_MODELS else model,
        "speed": record["speed"],
        "climb": record["climb"],
        "status": record["status"],
        "power": record["mean_positive_power"],
        "frequency": record["wingbeat"]["frequency"],
        "spent": spent,
        "mass": mass_of(record["vehicle"]),
        "sentence": sentence_of(record, title),
        "lights": lights_of(record),
        "gauges": gauges_of(record),
        "numbers": numbers_of(record),
        "warnings": [_sentence(_shorter(text)) for text in (*warnings, *record["warnings"])],
        "scene": _scene_of(orbit, title),
    }


def _scene_of(orbit: Orbit, title: str) -> dict[str, Any] | None:
    """Return what the viewer draws, or None for a beat that is no orbit and tumbles at once."""
    try:
        return scene([(title, orbit.dataset)])
    except FileError:
        if orbit.status is Status.CONVERGED:
            raise
        return None


def sentence_of(record: dict[str, Any], title: str) -> str:
    """Return one sentence on an orbit: who flies how fast, how often it beats, what it needs, and what is amiss."""
    who = f"{_article(title)} {title} {_place(record)}"
    if record["status"] == "infeasible":
        which = "that closes within its limits" if record.get("constraints") else "that closes"
        return f"In this model, {who[0].lower()}{who[1:]} has no wingbeat {which}."
    if record["status"] != "converged":
        return f"No wingbeat that closes was found for {who[0].lower()}{who[1:]}."
    beats, power = _short(record["wingbeat"]["frequency"]), _short(record["mean_positive_power"])
    why = FREQUENCY_BASES.get(record.get("frequency_basis", "free"), "")
    why = " (set by a limit)" if "frequency" in set_by_limit(record) else f" (given: {why})" if why else ""
    sentence = f"{who} beats {beats} times a second{why} and needs {power} W"
    judged = {one["name"]: one for one in record.get("plausibility") or []}
    limit = judged.get(_MUSCLE, {}).get("high")
    if limit is not None:
        share = judged[_MUSCLE]["value"] / limit
        times = f"{share:.2g}"
        over = "more than" if share < 1.05 else "twice" if times == "2" else f"{times} times"
        sentence += ", within what its muscle gives" if share <= 1 else f", {over} what its muscle gives"
    amiss = [one["label"] for one in gauges_of(record) if one["inside"] is False and one["name"] != _MUSCLE]
    if amiss and (limit is None or judged[_MUSCLE]["within"]):
        sentence += f", but its {_lower(amiss[0])} is implausible"
    return f"{sentence}."


def lights_of(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the two lights: whether the flight closes, and whether its numbers are those of flying animals.

    Each has name, good, known and text. What is not known is not good either, but no fault.
    """
    said = statements(record)
    certified = record["status"] == "converged"
    why_not = said.closes.removeprefix("does not close: ")  # the light itself says that it does not
    closes = f"flown again, it {said.closes}" if certified else f"{why_not}. {_sentence(record['message'])}"
    # The statement is "plausible: yes", "plausible: no: frequency 12 above 10 Hz" or "plausible: not known: ...".
    verdict, why = (*re.split("[:;] ", said.plausible.removeprefix("plausible: "), maxsplit=1), "")[:2]
    words = f"every number is inside its plausible range{f'; {why}' if why else ''}" if verdict == "yes" else why
    if not certified:
        verdict, words = "not known", "there is no certified wingbeat to judge"
    return [
        {"name": "closes", "good": certified, "known": True, "text": _sentence(closes)},
        {"name": "plausible", "good": verdict == "yes", "known": verdict != "not known", "text": _sentence(words)},
    ]


def is_plausible(lights: list[dict[str, Any]]) -> bool | None:
    """Return whether a flight closes and its numbers are plausible; None if it closes and too little is known."""
    closes, plausible = lights
    return None if closes["good"] and not plausible["known"] else closes["good"] and plausible["good"]


def numbers_of(record: dict[str, Any]) -> list[list[str]]:
    """Return label, value and unit of the main numbers, as texts; a number without a value is left out."""
    mass, beat = mass_of(record["vehicle"]), record["wingbeat"]
    rows = [["mass", f"{1e3 * mass:.4g}", "g"], ["wingbeat frequency", f"{beat['frequency']:.4g}", "Hz"]]
    for name, label in _LISTED.items():
        value = record.get(name, beat.get(name))
        if value is not None:
            factor, unit = for_people(NOMENCLATURE[name].unit)
            rows.append([label, f"{factor * value:.4g}", unit])
    if record.get("stable") is not None:
        rows.append(["a small disturbance", "decays" if record["stable"] else "grows", ""])
    return rows


def _place(record: dict[str, Any]) -> str:
    climb = record["climb"]
    where = f"at {record['speed']:g} m/s" if record["speed"] else "in hover"
    return where + (f", {'climbing' if climb > 0 else 'sinking'} {abs(climb):g} m/s," if climb else "")


def _article(title: str) -> str:
    """Return A or An; a European bird begins with the sound of y."""
    return "An" if re.match(r"(?i)[aeio]|u(?!ni)", title) and not re.match(r"(?i)eu", title) else "A"


def _short(value: float) -> str:
    """Return a number with two digits, or three from 100 on, without an exponent."""
    digits = 2 if abs(value) < 100 else 3
    return f"{float(f'{value:.{digits}g}'):g}"


def _lower(label: str) -> str:
    """Return a label within a sentence; names of people keep their capital."""
    return label if label.startswith(("Strouhal", "Reynolds")) else f"{label[:1].lower()}{label[1:]}"


def _shorter(warning: str) -> str:
    """Return a warning; of numbers that scaling laws gave, only how many there are of each part."""
    if not warning.startswith(NOT_MEASURED):
        return warning
    parts = Counter(path.partition(".")[0] for path in warning.removeprefix(NOT_MEASURED).split(", "))
    listed = ", ".join(f"{count} of the {part}" for part, count in parts.items())
    return f"numbers from scaling laws, not measured: {listed}"


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}" + ("" if text.endswith(".") else ".")


def gauges_of(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the gauges of an orbit record: one for each number of its ``plausibility``.

    Each has name, label, value, unit, low, high, inside, limited, given and source. Angles are in degrees. An
    end of a range that is open or unknown is None. `inside` is None if the number has no value, such as the
    Strouhal number in hover, or if nothing is known of its range. `limited` says whether a limit has set the
    number, or it follows from a limit; `given`, whether it is a frequency that was not searched for.

    >>> judged = {"name": "frequency", "value": 12.0, "unit": "Hz", "low": 4.0, "high": 10.0, "within": False}
    >>> gauge = gauges_of({"plausibility": [judged | {"source": "a law"}]})[0]
    >>> gauge["label"], gauge["value"], gauge["inside"]
    ('Wingbeat frequency', 12.0, False)
    """
    limited = set_by_limit(record)
    given = {"frequency"} if record.get("frequency_basis", "free") in FREQUENCY_BASES else set()
    judged = record.get("plausibility") or []
    return [_gauge(one, one["name"] in limited, one["name"] in given) for one in judged]


def _gauge(judged: dict[str, Any], limited: bool, given: bool) -> dict[str, Any]:
    factor, unit = for_people(cf(judged["unit"]))
    value, low, high = (None if part is None else factor * part for part in (judged[n] for n in _NUMBERS))
    known = low is not None or high is not None
    label = JUDGED_NAMES[judged["name"]]
    return {
        "name": judged["name"],
        "label": "Wingbeat frequency" if label == "frequency" else label[:1].upper() + label[1:],
        "value": value,
        "unit": unit,
        "low": low,
        "high": high,
        "inside": judged["within"] if known else None,
        "limited": limited,
        "given": given,
        "source": " ".join(judged["source"].split()),
    }


def measured_points(species: Species) -> list[dict[str, Any]]:
    """Return what the package holds of a species' flights, for a curve of power or frequency; often nothing.

    Each has ``speed`` [m/s], ``power`` [W] or ``frequency`` [Hz], all as a lowest and a highest value, and basis,
    label and source. Powers per mass are multiplied by the mass of the species. The speed of minimum power has
    neither power nor frequency.

    Parameters
    ----------
    species : the animal.

    >>> import wingbeat as wb
    >>> points = measured_points(wb.load_species("pigeon"))
    >>> points[0]["frequency"], [round(watt, 1) for watt in points[3]["power"]]
    ([7.33, 8.71], [14.6, 17.8])
    """
    if species.name not in measured_animals():
        return []
    found = [_point(one, species.vehicle.mass) for one in read_measured_flights(species.name).measurements]
    return [one for one in found if one is not None]


def _point(one: Measurement, mass: float) -> dict[str, Any] | None:
    about = {
        "basis": one.basis,
        "label": f"{name_of(one.quantity)}, {one.basis}: {ends_of(one.values)}. {one.what}",
        "source": one.source,
    }
    if one.speeds is None:
        return about | {"speed": list(one.values)}
    if one.quantity == "frequency":
        return about | {"speed": list(one.speeds), "frequency": list(one.values)}
    if one.quantity == "positive_power_per_mass":
        return about | {"speed": list(one.speeds), "power": [mass * value for value in one.values]}
    return None
