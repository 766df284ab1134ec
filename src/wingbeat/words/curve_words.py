"""What power curves and Pareto fronts say to a reader, as the blocks of a report."""

from __future__ import annotations

import functools
import itertools
import math
from typing import Any

from wingbeat._base import (
    PLURALS,
    Block,
    Line,
    Notes,
    Report,
    Row,
    Table,
    climb_text,
    find,
    for_people,
    in_words,
    over_of,
    plain_unit,
    written,
    written_range,
)
from wingbeat.orbits.problem.quantity import LASTING
from wingbeat.records.judgements import called, set_by_limit
from wingbeat.words.orbit_words import DEFAULT_AIR, FREQUENCY_BASES, air_in_words, other_frequency

# Of characteristic speeds that do not say it by their name.
_LABELS = {
    "maximum_range": "greatest range",
    "fastest_sustained": "fastest within the power limit",
    "slowest_sustained": "slowest within the power limit",
    "best_range": "greatest range",
}
_RANGE = "maximum_range", True  # of power over speed
# What measured powers are compared with; they are not the same quantities.
_AGAINST = {
    "mechanical_power": ", beside the mean positive hinge power",
    "metabolic_rate": ", beside the estimate for the whole animal",
}
_HEADINGS = ("U\n[m/s]", "f\n[Hz]", "P+\n[W]", "CoT\n[-]", "flap\n[deg]", "optima", "at the limit of")
_OWN = "given, not predicted: the frequency, the animal's own"
_OVER_FREQUENCY = ("f\n[Hz]", "P+\n[W]", "flap\n[deg]", "optima", "at the limit of")
_OF_MUSCLE = ("activation\n[-]", "work\n[J/kg]")  # of a curve over frequency, before the optima
_NEAR = 0.02  # share of a speed within which the lowest computed point stands for the minimum
_MINIMISED_AT = 3  # column of the minimised quantity, after the power


def curve_report(record: dict[str, Any]) -> Report:
    """Return a row for each speed, changes of the best orbit between them, characteristic speeds and warnings.

    A curve over frequency has a row for each frequency, and says what is known of the frequency.
    """
    points, over = record["points"], over_of(record)
    animal, minimised = record["species"] + climb_text(record["climb"]), in_words(record["objective"])
    certified = len(points) - len(record["gaps"])
    headings: list[str] = list(_HEADINGS)
    factor, unit = _unit(record["objective"])
    other = record["objective"] not in ("frequency", "mean_positive_power")  # which have columns of their own
    if over == "frequency":
        animal += f" at {record['speed']:g} m/s"
        headings = list(_OVER_FREQUENCY)
        if "activation" in record["characteristic_frequencies"]:
            headings[3:3] = _OF_MUSCLE
    if other:
        headings.insert(_MINIMISED_AT - (over == "frequency"), f"minimised\n[{unit or '-'}]")
    row = _row if over == "speed" else functools.partial(_frequency_row, cells=len(headings))
    rows = tuple(Row(row(point, factor if other else None)) for point in points)
    blocks: list[Block] = [
        Line(f"{animal}, minimum {minimised}: {certified} of {len(points)} {PLURALS[over]} certified"),
        *([Line(f"air: {air_in_words(record['air'])}")] if record["air"] != DEFAULT_AIR else []),
        *([Line(_OWN)] if record.get("own_frequency") and over == "speed" else []),
        *(Line(note, tone="warning") for note in other_frequency(record)),
        Table(rows, tuple(headings), "r" * (len(headings) - 1) + "l"),
        *([Line("* added to find the characteristic speeds")] if any(point["refined"] for point in points) else []),
        *_limited(record, over),
        *_implausible(points, over),
        Line(""),
        Line(f"changes from one {over} to the next", tone="title"),
    ]
    for mark in record["marks"]:
        where = f"{mark[f'lower_{over}']:g} to {mark[f'upper_{over}']:g} {plain_unit(over)}"
        text = f"  {mark['kind']}, {where}: {mark['what']}"
        blocks.append(Line(text, tone="" if mark["kind"] == "bounds" else "warning"))
    if not record["marks"]:
        blocks.append(Line("  one branch, always at the same bounds"))
    blocks += _characteristic(record) if over == "speed" else _of_frequency(record)
    if record.get("measured"):
        blocks += _measured(record["measured"])
    if record["warnings"]:
        blocks += [Line("warnings", tone="title"), Notes(tuple(record["warnings"]))]
    return blocks


def _measured(beside: dict[str, Any]) -> list[Block]:
    """Return a table for each measured quantity, with what the curve has at its speeds, and the differences."""
    blocks: list[Block] = []
    for quantity in dict.fromkeys(point["quantity"] for point in beside["points"]):
        points = [point for point in beside["points"] if point["quantity"] == quantity]
        unit = plain_unit("frequency" if quantity == "frequency" else "metabolic_rate")
        name = quantity.replace("_", " ")
        against = _AGAINST.get(quantity, "")
        title = f"{beside['file']}: measured {name} [{unit}]{against}"
        blocks += [Line(""), Line(title, tone="title")]
        rows, left = [], dict[str, list[float]]()
        for point in points:
            computed, residual, error = point["computed"], point["residual"], point["error"]
            if computed is None:
                left.setdefault(point["not_compared"], []).append(point["speed"])
                continue
            within = "" if error is None else ("yes" if abs(residual) <= error else "no")
            cells = (f"{point['speed']:g}", f"{point['measured']:.4g}", "" if error is None else f"{error:.3g}")
            cells += (f"{computed:.4g}{'*' if point['set_by_limit'] else ''}", f"{residual:+.3g}")
            rows.append(
                Row((*cells, f"{100 * residual / computed:+.0f}" if computed else "", within, point["label"]))
            )
        if rows:
            head = ("U\n[m/s]", "measured", "error", "computed", "residual", "residual\n[%]", "within\nerror", "")
            blocks.append(Table(tuple(rows), head, "rrrrrrll"))
            sums = beside["residuals"][quantity]
            share = "" if sums["mean_share"] is None else f" ({100 * sums['mean_share']:+.0f} %)"
            mean = f"mean {sums['mean']:+.3g} {unit}{share}, rms {sums['rms']:.3g} {unit}"
            blocks.append(Line(f"  residual = measured - computed: {mean}, of {sums['count']}"))
        if any(point["set_by_limit"] for point in points):
            blocks.append(Line("  * set by a limit, so not predicted"))
        for why, speeds in left.items():
            shown = ", ".join(f"{speed:g}" for speed in speeds)
            blocks.append(Line(f"  not compared at {shown} m/s: {why}"))
    return [*blocks, *([Notes(tuple(beside["notes"]))] if beside["notes"] else [])]


def _implausible(points: list[dict[str, Any]], over: str) -> list[Block]:
    """Say where the best orbit is outside which plausible ranges; nothing if no point has an orbit."""
    judged = [(point[over], point["optima"][0]["outside_ranges"]) for point in points if point["optima"]]
    if not judged:
        return []
    lines: list[Block] = [Line(""), Line("outside plausible ranges", tone="title")]
    for names, group in itertools.groupby(judged, key=lambda one: one[1]):
        where = f"{span_in_words([value for value, _ in group])} {plain_unit(over)}"
        if names:
            lines.append(Line(f"  at {where}: {str(names).replace('_', ' ')}", tone="warning"))
    return lines if len(lines) > 2 else [*lines, Line(f"  at no {over}")]


def _limited(record: dict[str, Any], over: str) -> list[Block]:
    """Say where limits have set which numbers of the best orbit, which are then no predictions."""
    spans: dict[tuple[str, str], list[list[float]]] = {}
    for place, point in enumerate(record["points"]):
        if not point["optima"]:
            continue
        best = point["optima"][0]
        names = [name for name in str(best["active_bounds"]).split(", ") if name]
        found = set_by_limit({"active_bounds": names, "objective": record["objective"], "wingbeat": best})
        for name, what in found.items():
            own = what.by == (name,)  # also of a limit along the path, whose value the curve does not hold
            runs = spans.setdefault((called(name), "set by the limit" if own else what.words), [])
            if not runs or runs[-1][-1] != record["points"][place - 1][over]:
                runs.append([])
            runs[-1].append(point[over])
    if not spans:
        return []
    told = [
        Line(f"  {name} {words} at {' and '.join(map(span_in_words, runs))} {plain_unit(over)}")
        for (name, words), runs in spans.items()
    ]
    return [Line(""), Line("set by limits, so not predicted", tone="title"), *told]


def span_in_words(speeds: list[float]) -> str:
    """Return the first and the last of some speeds."""
    return f"{speeds[0]:g}" if len(speeds) == 1 else f"{speeds[0]:g} to {speeds[-1]:g}"


def _of_frequency(record: dict[str, Any]) -> list[Block]:
    """Say what is known of the frequency: the animal's own, where the objective is least, what muscle allows."""
    known, least = record["characteristic_frequencies"], record["characteristic_frequencies"]["least"]
    objective = in_words(record["objective"])
    lines: list[Block] = [
        Line("frequency", tone="title"),
        Line(f"  the animal's own: {own_in_words(known['own'])}"),
    ]
    if least is not None:
        factor, unit = _unit(record["objective"])
        value = written(factor * least["value"], unit=unit)
        near = least["within_5_percent"]
        text = f"  least {objective}: {least['frequency']:g} Hz, {value}; within 5 % of it {ranges_in_words(near)}"
        ends = [point["frequency"] for point in (record["points"][0], record["points"][-1])]
        if reached := [f"{end:g}" for end in ends if any(end in span for span in near)]:
            text += f"; the curve ends at {' and '.join(reached)} Hz"
        lines.append(Line(text))
    if "activation" in known:
        lines.append(Line(f"  activation at most 1: {ranges_in_words(known['activation']['ranges'])}"))
        lines.append(Line("  work per beat of the depressors, as measured of the pectoralis:"))
    for band in known.get("work_per_beat", ()):
        where = ranges_in_words(band["ranges"])
        lines.append(Line(f"    {band['name']}, {work_in_words(band)}: {where}"))
    return lines


def own_in_words(own: dict[str, Any]) -> str:
    """Return the animal's own frequency, with its band and where it comes from."""
    low, high = own["range"]
    band = written_range(low, high, "Hz", own["value"]) if low < high else written(own["value"], unit="Hz")
    return f"{band}, {FREQUENCY_BASES[own['basis']]}"


def work_in_words(band: dict[str, Any]) -> str:
    """Return a measured work per beat, or its range."""
    low, high = band["low"], band["high"]
    return f"{low:g} J/kg" if low == high else f"{low:g} to {high:g} J/kg"


def ranges_in_words(ranges: list[list[float]]) -> str:
    """Return ranges of frequency."""
    if not ranges:
        return "at no frequency"
    spans = [f"at {low:.3g}" if low == high else f"from {low:.3g} to {high:.3g}" for low, high in ranges]
    return f"{' and '.join(spans)} Hz"


def _characteristic(record: dict[str, Any]) -> list[Block]:
    """Return a line for each characteristic speed, and what to minimise to get those of power."""
    objective = in_words(record["objective"])
    lines: list[Block] = [Line(f"characteristic speeds, of the least {objective}", tone="title")]
    speeds = record["characteristic_speeds"]
    for name, found in speeds.items():
        over = " over speed" if name == "best_range" or (name, "minimum_power" in speeds) == _RANGE else ""
        of = (found or {}).get("quantity", record["objective"])
        over = "" if of in LASTING else over
        by = "" if of == record["objective"] else f" of the {'battery' if of in LASTING else in_words(of)}"
        lines.append(Line(f"  {speed_label(name)}{by}: {_told(found, in_words(of) + over, of)}"))
    if not {"minimum_power", "maximum_range"} & speeds.keys():
        why = f"not given, because {objective} was minimised; to get them add --minimise positive-power"
        lines.append(Line(f"  speeds of minimum power and greatest range: {why}"))
    return lines


def speed_label(name: str) -> str:
    """Return a characteristic speed's name in words."""
    return _LABELS.get(name, name.replace("_", " "))


def speed_in_words(found: dict[str, Any] | None) -> str:
    """Return a characteristic speed with its error bar, or why none is given."""
    if found is None:
        return "none"
    if found["status"] == "found":
        low, high = found["interval"]
        return written_range(low, high, "m/s", found["speed"])
    if found["status"] in ("at_or_below", "at_or_above"):
        (end,) = (speed for speed in found["interval"] if speed is not None)
        where = "in hover" if end == 0 else f"{found['status'].replace('_', ' ')} {end:g} m/s"
        return f"{where}, where the curve {'begins' if end == 0 else 'ends'}"
    return {
        "beside_jump": "none is given, because the best wingbeat changes branch there",
        "beside_gap": "none is given, because a speed without an orbit is beside it",
        "set_by_limit": "none is given, because the limit has set the minimised quantity",
    }[found["status"]]


def _unit(objective: str) -> tuple[float, str]:
    """Return the factor to the reader's unit of the minimised quantity, and that unit; a user's own has none."""
    term = find(objective)
    return for_people(term.unit) if term is not None else (1.0, "")


def _row(point: dict[str, Any], factor: float | None) -> tuple[str, ...]:
    """Return the cells of a speed; with a factor to its unit, also the minimised quantity."""
    shown = f"{point['speed']:g}{'*' if point['refined'] else ''}"
    if not point["optima"]:
        none = ("",) * (4 if factor is None else 5)
        return (shown, *none, "0", f"{point['status']}: {point['message']}")
    best = point["optima"][0]
    cost = best["cost_of_transport"]
    minimised = () if factor is None else (f"{best['objective_value'] * factor:.4g}",)
    return (
        shown,
        f"{best['frequency']:.4g}",
        f"{best['mean_positive_power']:.4g}",
        *minimised,
        "-" if cost is None else f"{cost:.3g}",
        f"{math.degrees(best['flap_amplitude']):.3g}",
        f"{point['distinct_optima']}",
        best["active_bounds"] or "nothing",
    )


def _frequency_row(point: dict[str, Any], factor: float | None, cells: int) -> tuple[str, ...]:
    """Return the cells of a frequency; with a factor to its unit, also the minimised quantity."""
    shown = f"{point['frequency']:g}"
    if not point["optima"]:
        return (shown, *[""] * (cells - 3), "0", f"{point['status']}: {point['message']}")
    best = point["optima"][0]
    muscle = [best[name] for name in ("peak_activation", "muscle_work_per_mass") if name in best]
    return (
        shown,
        f"{best['mean_positive_power']:.4g}",
        *(() if factor is None else (f"{best['objective_value'] * factor:.4g}",)),
        f"{math.degrees(best['flap_amplitude']):.3g}",
        *(f"{value:.3g}" for value in muscle),
        f"{point['distinct_optima']}",
        best["active_bounds"] or "nothing",
    )


def _told(found: dict[str, Any] | None, quantity: str, objective: str) -> str:
    text = speed_in_words(found)
    if found is None:
        return text
    factor, unit = _unit(objective)
    value = written(factor * found["value"], unit=unit)
    if "lowest" not in found:
        return f"{text}, {value}" if found["status"] == "found" else text
    near = found["speed"] is not None and abs(found["speed"] - found["lowest"]) <= _NEAR * found["speed"]
    least, minimum = ("longest", "maximum") if objective in LASTING else ("least", "minimum")
    text += f", {value}" if near else f"; the {least} computed is {value} at {found['lowest']:g} m/s"
    if found["status"] in ("found", "at_or_below", "at_or_above"):
        low, high = found["within_2_percent"]
        text += f"; {quantity} is within 2 % of its {minimum} from {written_range(low, high, 'm/s')}"
    if found["rivals"]:
        others = " and ".join(f"{speed:g}" for speed in found["rivals"])
        text += f"; other minima within 1 % at {others} m/s"
    both = [name for name in found["limits"] if name not in found["changed_limits"]]
    if both and found["status"] != "set_by_limit":
        text += f"; with {_at_limits(both)}"
    if found["changed_limits"]:
        text += f"; a limit chose it: {_at_limits(found['changed_limits'])} on one side of it only"
    return text


def _at_limits(names: list[str]) -> str:
    return f"{' and '.join(map(called, names))} at {'its limit' if len(names) == 1 else 'their limits'}"


def pareto_report(record: dict[str, Any]) -> Report:
    """Return a row for each limit: what is reached, and what it costs."""
    minimised, limited = (in_words(record[kind]) for kind in ("objective", "quantity"))
    where = f"{record['species']} at {record['speed']:g} m/s{climb_text(record['climb'])}"
    factor, unit = for_people(record["quantity_unit"])
    of_objective, objective_unit = for_people(record["objective_unit"])
    headings = (f"limit [{unit or '-'}]", "reached", f"{minimised} [{objective_unit or '-'}]", "rise [%]")
    rows = tuple(Row(_front_cells(record, point, factor, of_objective)) for point in record["points"])
    return [
        Line(f"{where}: least {minimised} for each limit of the {limited}", wraps=False),
        Table(rows, (*headings, "f [Hz]", "P+ [W]", ""), "rrrrrrl"),
    ]


def _front_cells(
    record: dict[str, Any], point: dict[str, Any], factor: float, of_objective: float
) -> tuple[str, ...]:
    """Return the cells of a point; factors turn the limited and the minimised quantity into units of the reader."""
    shown = "none" if point["limit"] is None else f"{factor * point['limit']:.4g}"
    if point["objective_value"] is None:
        return (shown, *[""] * 5, f"{point['status']}: {point['message']}")
    of_point = {"active_bounds": point["active_bounds"], "objective": record["objective"], "wingbeat": point}
    # The limit of the front has a column of its own.
    names = [called(name) for name in set_by_limit(of_point) if name != record["quantity"]]
    remarks = ["dominated" if point["dominated"] else ("stable" if point["stable"] else "unstable")]
    remarks += [f"set by limits: {', '.join(names)}"] if names else []
    return (
        shown,
        f"{factor * point['quantity_value']:.4g}",
        f"{of_objective * point['objective_value']:.4g}",
        "" if point["rise"] is None else f"{100 * point['rise']:.2f}",
        f"{point['frequency']:.4g}",
        f"{point['mean_positive_power']:.4g}",
        "; ".join(remarks),
    )
