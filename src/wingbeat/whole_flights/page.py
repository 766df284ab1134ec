"""Pages on whole flights, in Markdown: one for each animal, and an overview of all of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wingbeat.style import in_words
from wingbeat.whole_flights.comparison import AGREES, Score, compared, ends_of, name_of, words_of
from wingbeat.whole_flights.measured import COMPARED
from wingbeat.whole_flights.prediction import FEWEST_DRAWS, Flown, Prediction

_FIT = (
    "Nothing is fitted to the measurements below. The polars of the wings are fitted to measured wings "
    "([animal wings](animal_wings.md)), and scaling laws give what the species file lacks "
    "([models](../guide/models.md))."
)


_SUMMARY = """## What the comparisons say

- **Power agrees best.** The pigeon at 4.5 m/s needs 1.5 times the measured power. The cockatiel's muscle gives 54
  to 85 W/kg from 7 to 11 m/s, within the 40 to 120 W/kg that were measured over all speeds. At 3 and 14 m/s the
  predicted power is too high. The predicted curves of power against speed are U-shaped. The predicted minimum is
  at 9 m/s for the cockatiel (measured: 10 m/s) and at 12 m/s for the pigeon (estimated: 8 to 9 m/s).
- **Frequency agrees worst.** In slow flight the predicted frequency is about twice that of live animals. At medium
  speed, the predicted frequencies of pigeon and zebra finch are about half of those of live animals. No
  single number of the muscle explains these differences ([what sets the frequency](frequency_trials.md)).
- **The predicted murre and puffins beat twice as fast as measured**, and their amplitudes are smaller than
  measured. Their wings are small. To carry the weight at 16 m/s without flapping, they need a mean lift
  coefficient of 1.0 to 1.25, and our gliding wings stall at 1.4. Perhaps the puffins flew faster than the 14 to
  18.6 m/s that the authors of the measurements assume. We have not tested that.
- **The predicted muscle is too efficient**: its efficiency is 0.5. The measured or estimated efficiency is 0.06 to
  0.11. The measured metabolic power includes the rest of the body and the recovery of the muscle. The predicted
  metabolic power includes neither."""


_RATIO = " *Ratio* is the prediction divided by the middle of the measured range."
# The quantities that are compared by a factor, in few words.
IN_SHORT = {
    "frequency": "frequency",
    "flap_amplitude_deg": "flap amplitude",
    "positive_power_per_mass": "hinge power",
    "muscle_power_per_mass": "muscle power",
    "muscle_efficiency": "muscle efficiency",
}
_WITHOUT_DRAWS = (
    "The column *draws that fly* is empty, because this page was written without `--draws`. A draw takes random "
    "values, within their ranges, for all numbers of the animal."
)
_ABOUT_DRAWS = (
    "Each draw takes random values, within their ranges, for all numbers of the animal; the draw flies if its "
    f"orbit is certified. If at least {FEWEST_DRAWS} draws fly, the range of the middle 80 % of these draws stands "
    "in parentheses."
)


def flight_text(prediction: Prediction, figure: str, common_name: str) -> str:
    """Return the page of an animal.

    Parameters
    ----------
    prediction : from `predict_flights`.
    figure : file name of its figure.
    common_name : of the animal, for the heading.
    """
    flights, drawn = prediction.flights, max(one.drawn for one in prediction.flown)
    option, objective = f" --draws {drawn}" if drawn else "", in_words(prediction.objective)
    parts = [
        f"# Whole flights: {common_name}",
        f"`uv run wingbeat validate {flights.species}{option} -o PAGE.md` writes this page. It computes the "
        f"animal's flight at each speed with the model `{prediction.model}`, which minimises the "
        f"{objective}. {_FIT}",
        f"![Power, frequency and flap amplitude against speed, with measured values]({figure})",
        "## Compared with measurements",
        _score_table(compared(prediction)),
        _how_to_read() + _RATIO,
        "## The flights",
        _flown_table(prediction.flown),
        "`activation` is the largest share of the flight muscle's fibres that the beat uses; above 1, the model's "
        "muscle is too weak. " + (_ABOUT_DRAWS if drawn else _WITHOUT_DRAWS),
    ]
    if any(one.due_to for one in prediction.flown):
        parts += ["## What the bands depend on", _due_text(prediction.flown)]
    return "\n\n".join(parts) + "\n"


def overview_text(predictions: Sequence[Prediction]) -> str:
    """Return the page that lists all animals.

    Parameters
    ----------
    predictions : of all animals.
    """
    rows = [
        f"| [{p.flights.species}](flight_{p.flights.species}.md) | {name_of(one.measurement.quantity)} | "
        f"{one.measurement.basis} | {ends_of(one.measurement.values)} | {_speeds(one)} | "
        f"{ends_of(one.predicted)} | {words_of(one)} |"
        for p in predictions
        for one in compared(p)
    ]
    scores = [score for p in predictions for score in compared(p)]
    known = [one for one in scores if one.agrees is not None]
    agree = sum(one.agrees is True for one in known)
    return "\n\n".join(
        [
            "# Whole flights against measurements",
            "`python validation/whole_flights.py` writes this page and those of the animals. Each animal is flown "
            f"with the model `animal` at the speeds of its measurements. {_FIT}",
            f"**{agree} of {len(known)} comparisons agree.** {_how_to_read()}",
            "| animal | quantity | basis | measured | at [m/s] | predicted | agrees |\n"
            "| --- | --- | --- | --- | --- | --- | --- |\n" + "\n".join(rows),
            _SUMMARY,
        ]
    )


def _how_to_read() -> str:
    by_factor: dict[float, list[str]] = {}
    for name, words in IN_SHORT.items():
        by_factor.setdefault(AGREES[name], []).append(words)
    factors = ", and ".join(f"{factor:g} for {_listed(names)}" for factor, names in by_factor.items())
    near = AGREES["minimum_power_speed"]
    return (
        "A prediction agrees if, at every speed, it is within the measured range or differs from the nearer end of "
        f"the range by at most a factor. This factor is {factors}. If the range begins at 0, its upper end is a "
        f"limit, and no factor applies. The speed of minimum power agrees if it is at most {near:g} m/s outside "
        "the range. *Basis* is one of three: a *measured* range was measured on the animal; an *estimated* range "
        "also comes from a model; a *law* was fitted to other animals."
    )


def _listed(names: Sequence[str]) -> str:
    return " and ".join(", ".join(names).rsplit(", ", 1))


def _score_table(scores: Iterable[Score]) -> str:
    lines = [
        "| quantity | basis | measured | at [m/s] | predicted | ratio | agrees | what was measured, and by whom |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for one in scores:
        known = one.measurement
        lines.append(
            f"| {name_of(known.quantity)} | {known.basis} | {ends_of(known.values)} | {_speeds(one)} | "
            f"{ends_of(one.predicted)} | {ends_of(one.ratio)} | {words_of(one)} | {known.what} ({known.source}) |"
        )
    return "\n".join(lines)


def _flown_table(flown: Sequence[Flown]) -> str:
    names = [name for name in COMPARED if any(name in one.values for one in flown)]
    heads = ["speed [m/s]", *(name_of(name) for name in names), "activation", "at the bound of", "draws that fly"]
    lines = ["| " + " | ".join(heads) + " |", "| " + " | ".join("---" for _ in heads) + " |"]
    for one in flown:
        if not one.values:
            lines.append(f"| {one.speed:g} | {one.status}: {one.message} |" + " |" * (len(heads) - 2))
            continue
        cells = [f"{one.values[name]:.3g}" + _band(one, name) for name in names]
        activation = "-" if one.peak_activation is None else f"{one.peak_activation:.2g}"
        bounds = ", ".join(name.replace("_", " ") for name in one.active_bounds) or "-"
        draws = f"{one.certified} of {one.drawn}" if one.drawn else "-"
        lines.append(f"| {one.speed:g} | " + " | ".join([*cells, activation, bounds, draws]) + " |")
    return "\n".join(lines)


def _band(one: Flown, name: str) -> str:
    return f" ({one.low[name]:.3g} to {one.high[name]:.3g})" if name in one.low else ""


def _due_text(flown: Sequence[Flown]) -> str:
    lines = [
        "For each quantity, the table names the numbers of the animal that are most correlated with it over the "
        "draws. After each number stands the square of its rank correlation. A better measurement of the first "
        "number would narrow the band most.",
        "",
        "| speed [m/s] | quantity | depends on |",
        "| --- | --- | --- |",
    ]
    for one in flown:
        for name, shares in one.due_to.items():
            said = ", ".join(f"`{path}` {share:.2f}" for path, share in shares.items() if share >= 0.02)
            lines.append(f"| {one.speed:g} | {name_of(name)} | {said or 'no number of the animal'} |")
    return "\n".join(lines)


def _speeds(score: Score) -> str:
    return "-" if not score.speeds else ends_of((score.speeds[0], score.speeds[-1]))
