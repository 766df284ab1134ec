"""Pages on whole flights, in Markdown: one for each animal, and an overview of all of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wingbeat._base import in_words
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.whole_flights.comparison import AGREES, Score, compared, ends_of, name_of, words_of
from wingbeat_evidence.whole_flights.measured import BASES, COMPARED
from wingbeat_evidence.whole_flights.prediction import FEWEST_DRAWS, Flown, Prediction

_FIT = (
    "Nothing is fitted to these measurements; the wings' polars are fitted to "
    "[measured wings](animal_wings.md), and [scaling laws](../guide/models.md) give what the species file lacks."
)
_OVERVIEW = """# Whole flights against measurements

`python validation/whole_flights.py` writes this page. Each animal is flown with the model `animal`, at its own
frequency and at minimum metabolic power of the flight muscle, at the speeds of its measurements. {fit} All
comparisons were listed before any was flown; a measured frequency is an input, and is compared only where a law
gave the input.

**{agree} of {known} comparisons agree.** {rule}

{then}

{findings}

{table}

*Predicted*: lowest and highest over the speeds; in parentheses, over the range of the frequency too. Grades of
sources: A read in it, B in its abstract, C second-hand, D computed. Sources:

{sources}

## Inputs, strength and posture

{flights}

*Strong enough*: activation, the largest share of the muscle's fibres that a beat uses, is at most 1 wherever live
animals were seen to fly; these comparisons are counted above. *Body*: mean pitch at the slowest and the fastest
speed [deg]. Flights are in `data/whole_flights`; `wingbeat validate ANIMAL -o PAGE.md` tabulates them.

{figures}
"""
# What agreed when the frequency was searched for: of the comparisons of that time, by quantity.
_THEN = {
    "frequency": (0, 15),
    "flap_amplitude_deg": (1, 9),
    "positive_power_per_mass": (1, 1),
    "muscle_power_per_mass": (0, 2),
    "net_muscle_efficiency": (0, 2),  # then called muscle_efficiency
    "minimum_power_speed": (2, 2),
}
_FLIGHT = """# Whole flights: {name}

`wingbeat validate {species}{option} -o PAGE.md` writes this page. It computes the flight at each speed with the
model `{model}`, which minimises the {objective}. {fit}

![Power, frequency and flap amplitude against speed, with measured values]({figure})

## Compared with measurements

{scores}

{rule} *Ratio* is the prediction divided by the middle of the measured range.

## The flights

{flown}

*Activation* is the largest share of the flight muscle's fibres that the beat uses; above 1, the model's muscle is
too weak. {draws}
"""
_DUE = """
## What the bands depend on

The numbers of the animal whose rank correlation with the quantity is largest over the draws, with its square. A
better measurement of the first would narrow the band most.

{table}
"""
# The compared quantities in few words, with their units.
IN_SHORT = {
    "frequency": "frequency [Hz]",
    "flap_amplitude_deg": "flap amplitude [deg]",
    "positive_power_per_mass": "hinge power [W/kg]",
    "muscle_power_per_mass": "muscle power [W/kg]",
    "muscle_work_per_mass": "muscle work [J/kg]",
    "metabolic_rate": "metabolic rate [W]",
    "net_muscle_efficiency": "net efficiency of the muscle",
    "flight_efficiency": "efficiency of the flight",
    "peak_activation": "activation",
    "minimum_power_speed": "speed of minimum power [m/s]",
}
_ABOUT_DRAWS = (
    "A draw takes random values, within their ranges, for all numbers of the animal, and flies if its orbit is "
    f"certified. If at least {FEWEST_DRAWS} draws fly, the range of their middle 80 % stands in parentheses."
)


def flight_text(prediction: Prediction, figure: str, common_name: str) -> str:
    """Return the page of an animal.

    Parameters
    ----------
    prediction : from `predict_flights`.
    figure : file name of its figure.
    common_name : of the animal, for the heading.
    """
    flown, drawn = prediction.flown, max(one.drawn for one in prediction.flown)
    text = _FLIGHT.format(
        name=common_name,
        species=prediction.flights.species,
        option=f" --draws {drawn}" if drawn else "",
        model=prediction.model,
        objective=in_words(prediction.objective),
        fit=_FIT,
        figure=figure,
        scores=_score_table(compared(prediction)),
        rule=_rule(),
        flown=_flown_table(flown),
        draws=_ABOUT_DRAWS if drawn else "With `--draws`, the page shows what uncertain numbers do.",
    )
    due = [
        [f"{one.speed:g}", name_of(name), said or "no number of the animal"]
        for one in flown
        for name, shares in one.due_to.items()
        for said in [", ".join(f"`{path}` {share:.2f}" for path, share in shares.items() if share >= 0.02)]
    ]
    return text + (_DUE.format(table=markdown_table(["speed [m/s]", "quantity", "depends on"], due)) if due else "")


def overview_text(predictions: Sequence[Prediction], figures: Sequence[str] = (), findings: str = "") -> str:
    """Return the page of all animals.

    Parameters
    ----------
    predictions : of all animals.
    figures : file names of their figures, in the same order; none are shown if not given.
    findings : what follows from the comparisons, in Markdown.
    """
    scores = [(p.flights.species, score) for p in predictions for score in compared(p)]
    known = [one for _, one in scores if one.agrees is not None]
    listed = [one for one in scores if one[1].measurement.quantity != "peak_activation"]
    sources = list(dict.fromkeys(one.measurement.source for _, one in listed))
    heads = ["animal", "quantity", "basis", "measured", "at [m/s]", "predicted", "agrees", "source"]
    rows = []
    for species, one in listed:
        measured = one.measurement
        predicted = ends_of(one.predicted) + ("" if one.band is None else f" ({ends_of(one.band)})")
        cells = [IN_SHORT[measured.quantity], measured.basis, ends_of(measured.values), _speeds(one), predicted]
        rows.append([species, *cells, words_of(one), str(1 + sources.index(measured.source))])
    return _OVERVIEW.format(
        fit=_FIT,
        agree=sum(one.agrees is True for one in known),
        known=len(known),
        rule=_rule(),
        then=_then(known),
        findings=findings,
        table=markdown_table(heads, rows),
        sources="\n".join(f"{i}. {source}" for i, source in enumerate(sources, 1)),
        flights=markdown_table(
            ["animal", "frequency [Hz]", "basis", "certified", "activation", "strong enough", "body"],
            map(_flights_of, predictions),
        ),
        figures="\n\n".join(
            f"![{p.flights.species}: power and stroke against speed]({one})"
            for p, one in zip(predictions, figures, strict=False)
        ),
    )


def _then(known: Sequence[Score]) -> str:
    """Return how many comparisons agree, by quantity and by basis, beside those of a frequency searched for."""
    rows = []
    for name, words in IN_SHORT.items():
        now = [one.agrees for one in known if one.measurement.quantity == name]
        before = _THEN.get(name)
        if now or before:
            said = "-" if before is None else "{} of {}".format(*before)
            rows.append([words.split(" [")[0], said, f"{sum(map(bool, now))} of {len(now)}" if now else "input"])
    for basis in BASES:
        now = [one.agrees for one in known if one.measurement.basis == basis]
        rows.append([f"*{basis}*", "-", f"{sum(map(bool, now))} of {len(now)}"])
    return markdown_table(["agree", "frequency searched for", "at its own frequency"], rows)


def _flights_of(prediction: Prediction) -> list[str]:
    """Return what was flown, in a row: inputs, how many are certified, activation, posture."""
    flown = [one for one in prediction.flown if one.values]
    strong = [one for one in compared(prediction) if one.measurement.quantity == "peak_activation"]
    active = [one.peak_activation for one in flown if one.peak_activation is not None]
    pitches = [one.body_pitch_deg for one in flown if one.body_pitch_deg is not None]
    return [
        prediction.flights.species,
        _span([one.values["frequency"] for one in flown]),
        " and ".join(sorted({one.frequency_basis for one in flown})),
        f"{len(flown)} of {len(prediction.flown)}",
        "-" if not active else f"{min(active):.2g} to {max(active):.2g}",
        words_of(strong[0]) if strong else "-",
        f"{pitches[0]:.0f}, {pitches[-1]:.0f}" if pitches else "-",
    ]


def _span(values: Sequence[float]) -> str:
    return ends_of((min(values), max(values)) if values else None)


def _rule() -> str:
    by_factor: dict[float, list[str]] = {}
    for name, words in IN_SHORT.items():
        if name not in ("minimum_power_speed", "peak_activation"):
            by_factor.setdefault(AGREES[name], []).append(words.split(" [")[0])
    factors = ", and ".join(f"{factor:g} for {_listed(names)}" for factor, names in by_factor.items())
    return (
        "A prediction agrees if, at every speed, it is within the measured range or off its nearer end by at most "
        f"a factor: {factors}. A range that begins at 0 is a limit, without a factor. The speed of minimum power "
        f"may be {AGREES['minimum_power_speed']:g} m/s outside. *Basis*: *measured* on the animal; *estimated* "
        "with the help of a model; a *law* fitted to other animals."
    )


def _listed(names: Sequence[str]) -> str:
    return " and ".join(", ".join(names).rsplit(", ", 1))


def _score_table(scores: Iterable[Score]) -> str:
    heads = [
        "quantity",
        "basis",
        "measured",
        "at [m/s]",
        "predicted",
        "ratio",
        "agrees",
        "what was measured, by whom",
    ]
    rows = []
    for one in scores:
        known = one.measurement
        cells = [name_of(known.quantity), known.basis, ends_of(known.values), _speeds(one), ends_of(one.predicted)]
        rows.append([*cells, ends_of(one.ratio), words_of(one), f"{known.what} ({known.source})"])
    return markdown_table(heads, rows)


def _flown_table(flown: Sequence[Flown]) -> str:
    names = [name for name in COMPARED if any(name in one.values for one in flown)]
    heads = ["speed [m/s]", *(IN_SHORT[name] for name in names), "activation", "at the bound of", "draws that fly"]
    rows = []
    for one in flown:
        if not one.values:
            rows.append([f"{one.speed:g}", f"{one.status}: {one.message}", *[""] * (len(heads) - 2)])
            continue
        cells = [f"{one.values[name]:.3g}" + _band(one, name) for name in names]
        activation = "-" if one.peak_activation is None else f"{one.peak_activation:.2g}"
        bounds = ", ".join(name.replace("_", " ") for name in one.active_bounds) or "-"
        draws = f"{one.certified} of {one.drawn}" if one.drawn else "-"
        rows.append([f"{one.speed:g}", *cells, activation, bounds, draws])
    return markdown_table(heads, rows)


def _band(one: Flown, name: str) -> str:
    return f" ({one.low[name]:.3g} to {one.high[name]:.3g})" if name in one.low else ""


def _speeds(score: Score) -> str:
    return "-" if not score.speeds else ends_of((score.speeds[0], score.speeds[-1]))
