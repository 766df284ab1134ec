"""What an orbit record says to a reader: rows of label and value in readable units, and the blocks of a report."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Mapping
from typing import Any

from wingbeat._base import (
    NOMENCLATURE,
    STATE_NAMES,
    Block,
    Line,
    Notes,
    Report,
    Tone,
    cf,
    find,
    for_people,
    grouped,
    in_words,
    plain_unit,
    readable_limit,
)
from wingbeat.animal.vehicle import Air
from wingbeat.orbits.problem.origin import loads_in_words, model_rows, place_in_words
from wingbeat.orbits.problem.quantity import OF_DRIVE
from wingbeat.records.judgements import OTHER_FREQUENCY, SetBy, called, set_by_limit, statements

Rows = list[tuple[str, str]]
# What the two metabolic powers of a record are.
_ABOUT = {
    "metabolic_power": ", without its activation and recovery",
    "metabolic_rate": ", an estimate of what a respirometer measures",
}
DEFAULT_AIR = dict(vars(Air()))  # of which nothing is said
Limited = Mapping[str, SetBy]  # numbers that a limit has set, by name
_NONE: Limited = {}

# Values that switch off a law that the paper does not have; a row with such a value is left out.
_OFF: dict[str, Any] = {
    **dict.fromkeys(
        ("pitch_phase", "sweep_mean", "sweep_amplitude", "sweep_phase", "stroke_plane_tilt", "tail_tilt"), 0.0
    ),
    **{name: [] for name in ("flap_harmonics", "pitch_harmonics", "span_harmonics")},
    **{"downstroke_fraction": 0.5, "hinge_stop_stiffness": 0.0, "hinge_twist_share": 0.0},
}


def orbit_groups(record: dict[str, Any]) -> dict[str, Rows]:
    """Return the groups of numbers in an orbit record, by title; an empty group has no rows."""
    place = place_in_words(record.get("species"), record.get("speed"), record.get("climb"))
    limited = set_by_limit(record)
    return {
        "flight": [
            ("species, mean speed", place),
            *(model_rows(record["model"]) if "model" in record else []),
            ("air loads", loads_in_words(record.get("aero", {}))),
            *([("air", air_in_words(air))] if (air := record.get("air") or DEFAULT_AIR) != DEFAULT_AIR else []),
            *flight_rows(record, limited),
        ],
        "unbalanced at the closest wingbeat": deficit_rows(record.get("failed_balance") or []),
        "smallest single changes that give an orbit": [
            ("or" if i else "either", change["text"]) for i, change in enumerate(record.get("relaxations") or [])
        ],
        "given start": start_rows(record.get("start")),
        "wingbeat": wingbeat_rows(record.get("wingbeat", {}), limited),
        "plausible ranges": plausible_rows(record.get("plausibility") or [], limited),
        "state at the top of the stroke": state_rows(record.get("initial_state", {})),
        "power, both wings": power_rows(record, limited),
        "pitch hinges, both wings": hinge_rows(record),
        "prescribed pitch: no part of this robot drives it": prescribed_rows(record),
        "certificate": certificate_rows(record, limited),
        "stability": stability_rows(record),
    }


def air_in_words(air: dict[str, Any]) -> str:
    """Return density and viscosity of a record's air."""
    return f"density {air['density']:.4g} kg/m3, kinematic viscosity {air['viscosity']:.4g} m2/s"


def limits_in_words(record: dict[str, Any]) -> str:
    """Return the numbers of an orbit that limits have set, each with its value, and what follows from them.

    Of what follows, only parameters of the wingbeat and the minimised quantity are named.
    """
    limited, beat = set_by_limit(record), record.get("wingbeat") or {}
    own, follows = [], []
    for name, what in limited.items():
        term = find(name)
        factor, unit = for_people(term.unit) if term is not None else (1.0, "")
        if name in what.by:
            shown = "" if what.limit is None else f" {_number(what.limit, unit, factor)}"
            own.append(f"{called(name)}{shown}")
        elif name in beat or name == record.get("objective"):
            follows.append(f"{called(name)} {_number(beat.get(name, record.get('objective_value')), unit, factor)}")
    then = f", and with {'it' if len(own) == 1 else 'them'} {' and '.join(follows)}" if follows else ""
    return f"{', '.join(own)}{then}"


FREQUENCY_BASES = {
    **{"measured": "measured on the animal", "law": "by a law of its kind"},
    **{"guess": "a guess", "given": "as asked for"},
}


def frequency_in_words(record: dict[str, Any]) -> str:
    """Return the frequency of an orbit that did not search for it, with where it comes from and its band."""
    basis = record.get("frequency_basis", "free")
    if basis not in FREQUENCY_BASES:
        return ""
    own = [one for one in record.get("plausibility") or () if one["name"] == "frequency" and one["low"] is not None]
    band = f", {_range(own[0]['low'], own[0]['high'], 'Hz', 1.0)}" if own and basis != "given" else ""
    return f"frequency {_number(record['wingbeat']['frequency'], 'Hz', 1.0)}, {FREQUENCY_BASES[basis]}{band}"


def other_frequency(record: Mapping[str, Any]) -> list[str]:
    """Return the warning that a bird's own frequency is not that of this load or air; none, if it is."""
    return [note for note in record.get("warnings") or () if OTHER_FREQUENCY in note]


def flight_rows(record: dict[str, Any], limited: Limited = _NONE) -> Rows:
    """Return the numbers of the flight as a whole."""
    names = ("strouhal", "reduced_frequency", "reynolds", "alpha_quarter_span", "alpha_three_quarter_span")
    rows = []
    for name in [name for name in (*names, "body_pitch_range", "detached_share") if name in record]:
        if name.startswith("alpha"):
            factor, unit = for_people(NOMENCLATURE[name].unit)
            low, high = record[name]
            rows.append((_label(name), _range(low, high, unit, factor)))
        else:
            rows.append((_label(name), _of(record, name, limited)))
    return rows


def plausible_rows(judged: list[dict[str, Any]], limited: Limited = _NONE) -> Rows:
    """Return each judged number with its plausible range, whether it is outside, and whether a limit has set it."""
    rows = []
    for one in judged:
        factor, unit = for_people(cf(str(one["unit"])))
        low, high = one["low"], one["high"]
        if low is None:
            known = "no range is known" if high is None else f"at most {_number(high, unit, factor)}"
        else:
            known = f"at least {_number(low, unit, factor)}" if high is None else _range(low, high, unit, factor)
        outside = ", outside" if one["within"] is False else ""
        by = limited[one["name"]].by if one["name"] in limited else ()
        why = ", set by the limit" if one["name"] in by else ", follows from a limit" if by else ""
        rows.append((called(one["name"]), f"{_number(one['value'], unit, factor)} ({known}{outside}{why})"))
    return rows


def start_rows(start: dict[str, Any] | None) -> Rows:
    """Return what the user's own start was, whether it led to the result, and what was changed or added."""
    if start is None:
        return []
    led = {True: "to this orbit", False: "elsewhere: this result comes from another start", None: "not known"}
    notes = [("and" if i else "note", note) for i, note in enumerate(start["notes"])]
    return [("kind", start["kind"]), ("led", led[start["led_here"]]), *notes]


def deficit_rows(deficits: list[dict[str, Any]]) -> Rows:
    """Return which balances fail, and by how much."""
    rows = []
    for short in deficits:
        of = "of weight times chord" if short["unit"] == "N m" else "of the weight"
        amount = _number(short["amount"], short["unit"], 1.0)
        rows.append((short["law"], f"{amount}, {100 * short['share']:.2g} % {of}"))
    return rows


def wingbeat_rows(beat: dict[str, Any], limited: Limited = _NONE) -> Rows:
    """Return the numbers of a wingbeat, except those of motions that are off."""
    shown = [name for name in beat if name not in _OFF or beat[name] != _OFF[name]]
    if beat.get("hinge_stop_stiffness") == 0 and "hinge_stop_angle" in shown:
        shown.remove("hinge_stop_angle")
    rows = [(name.replace("_", " "), _of(beat, name, limited)) for name in shown]
    return [(f"wing {label}" if label.startswith("pitch") else label, value) for label, value in rows]


def state_rows(state: dict[str, Any]) -> Rows:
    """Return the numbers of a state."""
    return [(_label(name), _of(state, name)) for name in state if name in STATE_NAMES]


def mass_of(vehicle: dict[str, Any]) -> float:
    """Return the mass of a record's vehicle [kg]."""
    return vehicle["body"]["mass"] + 2 * vehicle["wing"]["mass"]


def power_label(name: str) -> str:
    """Return a power's label without the word power: "hinges, mean" for "hinge power, mean"."""
    return _label(name).replace(" power,", "s,")


def power_rows(record: dict[str, Any], limited: Limited = _NONE) -> Rows:
    """Return means and peaks of power, also per mass if the record holds the mass."""
    hinges = ("mean_power", "mean_positive_power", "peak_power")
    vehicle = record.get("vehicle")
    mass = mass_of(vehicle) if vehicle else None
    rows = []
    unit = plain_unit("positive_power_per_mass")
    for name in (*hinges, "mean_actuator_power", "peak_actuator_power"):
        if name in record:
            each = f" ({_number(record[name], unit, 1 / mass)})" if mass and record[name] is not None else ""
            rows.append((power_label(name), f"{_of(record, name)}{each}{_why(name, limited)}"))
    about = dict(_ABOUT)
    for name, factor, unit in (("endurance", 1 / 60, "min"), ("flight_range", 1e-3, "km")):
        if record.get(name) is not None:
            about[name] = f", {_number(record[name], unit, factor)}"
    if record.get("pitching_power") is not None:
        about["electrical_power"] = (
            f", of which {_of(record, 'pitching_power')} would pitch the wings: no motor does"
        )
    others = [name for name in ("cost_of_transport", *itertools.chain(*OF_DRIVE.values())) if name in record]
    return [*rows, *((_label(name), _of(record, name, limited) + about.get(name, "")) for name in others)]


def hinge_rows(record: dict[str, Any]) -> Rows:
    """Return how hinges move that give way."""
    if record.get("hinge_amplitude") is None:
        return []
    ends = _range(record["least_hinge_angle"], record["largest_hinge_angle"], "deg", math.degrees(1.0))
    names = ("hinge_amplitude", "hinge_lead", "hinge_frequency_ratio", "damper_power", "peak_hinge_torque")
    rows = [
        ("hinge angle", ends),
        *((_label(name), _of(record, name)) for name in names),
    ]
    if (record.get("wingbeat") or {}).get("hinge_stop_stiffness"):
        rows.append((_label("share_at_stops"), f"{100 * record['share_at_stops']:.3g} %"))
    return rows


def prescribed_rows(record: dict[str, Any]) -> Rows:
    """Return what a robot's prescribed pitch needs, and how far hinges could give it, with the command for them."""
    if record.get("peak_pitch_torque") is None or "fitted_share" not in record:
        return []
    rows = [(_label(name), _of(record, name)) for name in ("peak_pitch_torque", "mean_pitch_power")]
    if record["fitted_share"] is None:
        return [*rows, ("nearest hinge", "none: the pitch does not move")]
    shares = [f"{100 * record[name]:.1f} %" for name in ("fitted_share", "fitted_share_undamped")]
    rows.append(("of its variance, a spring and damper give", f"{shares[0]} (a spring alone {shares[1]})"))
    own = [_of(record, f"fitted_{name}") for name in ("stiffness", "damping", "rest_angle")]
    rows.append(("their stiffness, damping, rest angle", ", ".join(own)))
    if record["fitted_damping"] < 0 or record["fitted_stiffness"] <= 0:
        lacks = "damping" if record["fitted_stiffness"] > 0 else "stiffness"
        return [*rows, (f"negative {lacks}", "this pitch is driven: no passive hinge gives it")]
    rest = math.degrees(record["fitted_rest_angle"])
    values = (f"{record['fitted_stiffness']:.4g}", f"{record['fitted_damping']:.4g}", f"{rest:.2f}")
    paths = zip(("stiffness", "damping", "rest_angle_deg"), values, strict=True)
    if (record.get("aero") or {}).get("force_point") == "quarter-chord":
        rows.append(("the air's part is left out", "for it, add --force-point centre-of-pressure"))
    return [*rows, ("fly them", "--set " + " ".join(f"pitch_hinge.{path}={value}" for path, value in paths))]


def certificate_rows(record: dict[str, Any], limited: Limited = _NONE) -> Rows:
    """Return the numbers of certificate and solver, which show how far to trust the orbit."""
    closure = record.get("closure") or {}
    rows = []
    if record.get("objective_value") is not None:
        least = f"{in_words(record['objective'])}, {record['objective_value']:.5g}"
        rows.append(("minimised", least + _why(record["objective"], limited)))
    for constraint, value in (record.get("constraints") or {}).items():
        name = re.split("[<>]=", constraint)[0]
        factor, unit = for_people(cf(plain_unit(name)))
        rows.append((f"limit {readable_limit(constraint)}", _number(value, unit, factor)))
    if record.get("price_of_stability") is not None:
        price = f"{100 * record['price_of_stability']:.2g} % more {in_words(record['objective'])}"
        rows.append(("price of stability", f"{price} than {record['free_objective']:.5g} without the limit"))
    if closure:
        worst = max(closure, key=lambda name: math.inf if closure[name] is None else abs(closure[name]))
        residual = "lost" if closure[worst] is None else f"{abs(closure[worst]):.1e} {plain_unit(worst)}"
        rows.append(("largest residual when re-flown", f"{residual}, in {worst.replace('_', ' ')}"))
    if record.get("optimality") is not None:
        rows.append(("optimality residual (0 is exact)", f"{record['optimality']:.1e}"))
    if "starts" in record:
        rows.append(("starts, of which at this optimum", f"{record['starts']}, {record.get('starts_at_best')}"))
        rows.append(("distinct optima found", str(record.get("distinct_optima"))))
    rows.append(("at the bound of", ", ".join(record.get("active_bounds") or []) or "nothing"))
    return rows


def stability_rows(record: dict[str, Any]) -> Rows:
    """Return what the Floquet multipliers say about stability."""
    pairs = record.get("floquet_multipliers") or []
    if not pairs or any(part is None for pair in pairs for part in pair):
        return []
    sizes = [math.hypot(*pair) for pair in pairs]
    rows = [("growth per beat (multipliers)", ", ".join(f"{size:.3g}" for size in sizes))]
    if record.get("stable") is None:
        return [*rows, ("stable", "unknown: the orbit is not certified")]
    rows.append(("stable", "yes" if record["stable"] else "no"))
    growth = math.log(max(sizes)) if max(sizes) > 0 else -math.inf
    if growth:
        what = "doubles" if growth > 0 else "halves"
        rows.append((f"a disturbance {what} in", f"{math.log(2.0) / abs(growth):.3g} beats"))
    return rows


def _label(name: str) -> str:
    return NOMENCLATURE[name].short_label


def _of(numbers: dict[str, Any], name: str, limited: Limited = _NONE) -> str:
    """Return one number of a record in a readable unit, and whether a limit has set it."""
    factor, unit = for_people(NOMENCLATURE[name].unit)
    return f"{_number(numbers.get(name), unit, factor)}{_why(name, limited)}"


def _why(name: str, limited: Limited) -> str:
    return f" ({limited[name].words})" if name in limited else ""


def _number(value: Any, unit: str, factor: float) -> str:
    if value is None:
        return "-"  # undefined, as a cost of transport in hover
    return f"{_digits(value, unit, factor)} {unit}".rstrip()


def _range(low: float | None, high: float | None, unit: str, factor: float) -> str:
    """Return two ends with one unit behind both."""
    return f"{'-' if low is None else _digits(low, unit, factor)} to {_number(high, unit, factor)}"


def _digits(value: Any, unit: str, factor: float) -> str:
    if isinstance(value, list | tuple):
        # Harmonics below a ten-thousandth of a degree are zero for a reader.
        return ", ".join(f"{each * factor:.3g}" if abs(each * factor) >= 1e-4 else "0" for each in value)
    shown = value * factor
    # Rounding of an angle that is at 0, or whose limit is.
    shown = 0.0 if unit == "deg" and abs(shown) < 1e-6 else shown
    return f"{shown:{'.0f' if 1e4 <= abs(shown) < 1e7 else '.4g'}}"


def orbit_report(record: dict[str, Any]) -> Report:
    """Return certificate, plausibility, what limits have set, every group of numbers, and warnings of an orbit."""
    lines: list[Block]
    if record.get("status") == "converged":
        said = statements(record)
        # The words are green only if both statements hold; each statement is a line of its own.
        lines = [
            status_line("certified", said.closes, "good" if said.good else "title"),
            status_line("plausible", said.plausible, "good" if said.good else "doubtful"),
        ]
        if frequency := frequency_in_words(record):
            lines.append(status_line("given, not predicted", frequency, "title"))
        lines += [Line(note, tone="warning") for note in other_frequency(record)]
        if limits := limits_in_words(record):
            lines.append(status_line("set by limits, not predicted", limits, "doubtful"))
    else:
        status = f"not certified, {record.get('status')}"
        lines = [status_line(status, str(record.get("message", "")), "bad")]
    groups = orbit_groups(record)
    certificate = {title: groups.pop(title) for title in ("certificate", "stability")}
    lines.append(grouped({**groups, **power_groups(record.get("power_account")), **certificate}))
    if warnings := record.get("warnings"):
        lines += [Line(""), Line("warnings", tone="title"), Notes(tuple(warnings))]
    return lines


def status_line(status: str, message: str, tone: Tone) -> Line:
    """Return a line of a status and what it means, which may begin with the status."""
    message = message.removeprefix(f"{status}: ")
    return Line(f": {message}" if message else "", status, tone)


def power_groups(account: dict[str, Any] | None) -> dict[str, Rows]:
    """Return a power account as groups of rows; no groups if there is no account."""
    if account is None:
        return {}
    fates = {-1.0: "if it costs as much as positive work", 0.0: "if it is lost"}
    costs = [
        (fates.get(share, f"if {share:.0%} of it is returned"), _watts(cost))
        for share, cost in account["cost_by_returned"]
    ]
    spring = account["best_spring"]
    if spring["rest_angle"] is None:
        springs = [("best stiffness", "none: no spring helps")]
    else:
        saved = 1.0 - spring["mean_positive_power"] / account["mean_positive_power"]
        springs = [
            ("best stiffness, both hinges together", f"{spring['stiffness']:.4g} N m/rad"),
            ("flap angle at rest", f"{math.degrees(spring['rest_angle']):.4g} deg"),
            ("remaining mean positive power", f"{_watts(spring['mean_positive_power'])} ({saved:.1%} less)"),
        ]
    return {
        "mean power, by what happens to negative work": [("negative work", _watts(account["braking"])), *costs],
        "parts of the hinge power: mean, minimum, maximum": _spreads(account["shares"]),
        "what the power of all actuators is spent on: mean, minimum, maximum": _spreads(account["spent"]),
        "springs at the flap hinges": springs,
    }


def _spreads(parts: dict[str, dict[str, float]]) -> Rows:
    shown = {name: [_watts(part[key]) for key in ("mean", "least", "most")] for name, part in parts.items()}
    return [(name, ", ".join(watts)) for name, watts in shown.items()]


def _watts(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g} W"
