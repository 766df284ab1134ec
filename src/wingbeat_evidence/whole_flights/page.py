"""Pages on whole flights, in Markdown: one for each animal, and an overview of all of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wingbeat._base import in_words
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.whole_flights.comparison import AGREES, Score, compared, ends_of, name_of, words_of
from wingbeat_evidence.whole_flights.measured import COMPARED
from wingbeat_evidence.whole_flights.prediction import FEWEST_DRAWS, Flown, Prediction

_FIT = (
    "Nothing is fitted to these measurements; the wings' polars are fitted to "
    "[measured wings](animal_wings.md), and [scaling laws](../guide/models.md) give what the species file lacks."
)
_OVERVIEW = """# Whole flights against measurements

`python validation/whole_flights.py` writes this page. Each animal is flown with the model `animal`, at minimum
metabolic power of the flight muscle, at the speeds of its measurements. {fit}

**{agree} of {known} comparisons agree.** {rule}

- **Power agrees best.** The pigeon at 4.5 m/s needs 1.5 times the measured power. The cockatiel's muscle gives 54
  to 85 W/kg from 7 to 11 m/s (measured: 40 to 120 over all speeds) and too much at 3 and 14 m/s. Predicted power is
  least at 9 m/s for the cockatiel (measured: 10) and 12 m/s for the pigeon (estimated: 8 to 9).
- **Frequency agrees worst.** It is about twice that of live animals in slow flight, and half of it at medium speed
  for pigeon and zebra finch. No single number of the muscle explains this
  ([what sets the frequency](frequency_trials.md)).
- **The murre and puffins beat twice as fast as measured**, with smaller amplitudes. To carry their weight at 16 m/s
  without flapping, their small wings need a mean lift coefficient of 1.0 to 1.25; our gliding wings stall at 1.4.
  They may have flown faster than the 14 to 18.6 m/s that the authors assume; we have not tested that.
- **The predicted muscle is too efficient**: 0.5, against 0.06 to 0.11. Measured metabolic power includes the rest
  of the body and the recovery of the muscle, the predicted power does not.
- **The muscle is too weak** where activation, the largest share of its fibres that a beat uses, exceeds 1: for
  every animal at some speed, for murre, puffins and guillemot at all.

{table}

Sources:

{sources}

Flights at each speed are in `data/whole_flights`; `wingbeat validate ANIMAL -o PAGE.md` tabulates them.

{flights}

{figures}
"""
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
    "net_muscle_efficiency": "net efficiency of the muscle",
    "flight_efficiency": "efficiency of the flight",
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


def overview_text(predictions: Sequence[Prediction], figures: Sequence[str] = ()) -> str:
    """Return the page of all animals.

    Parameters
    ----------
    predictions : of all animals.
    figures : file names of their figures, in the same order; none are shown if not given.
    """
    scores = [(p.flights.species, score) for p in predictions for score in compared(p)]
    known = [one.agrees for _, one in scores if one.agrees is not None]
    sources = list(dict.fromkeys(one.measurement.source for _, one in scores))
    heads = ["animal", "quantity", "basis", "measured", "at [m/s]", "predicted", "agrees", "source"]
    rows = []
    for species, one in scores:
        measured = one.measurement
        cells = [IN_SHORT[measured.quantity], measured.basis, ends_of(measured.values), _speeds(one)]
        rows.append(
            [species, *cells, ends_of(one.predicted), words_of(one), str(1 + sources.index(measured.source))]
        )
    return _OVERVIEW.format(
        fit=_FIT,
        agree=sum(known),
        known=len(known),
        rule=_rule(),
        table=markdown_table(heads, rows),
        sources="\n".join(f"{i}. {source}" for i, source in enumerate(sources, 1)),
        flights=markdown_table(
            ["animal", "flown at [m/s]", "certified", "activation"], map(_flights_of, predictions)
        ),
        figures="\n\n".join(
            f"![{p.flights.species}: predicted and measured flight against speed]({one})"
            for p, one in zip(predictions, figures, strict=False)
        ),
    )


def _flights_of(prediction: Prediction) -> list[str]:
    """Return what was flown, in a row: speeds, how many are certified, lowest and highest activation."""
    flown = prediction.flown
    active = [one.peak_activation for one in flown if one.values and one.peak_activation is not None]
    ends = f"{min(active):.2g} to {max(active):.2g}" if active else "-"
    certified = sum(bool(one.values) for one in flown)
    return [
        prediction.flights.species,
        ends_of((flown[0].speed, flown[-1].speed)),
        f"{certified} of {len(flown)}",
        ends,
    ]


def _rule() -> str:
    by_factor: dict[float, list[str]] = {}
    for name, words in IN_SHORT.items():
        if name != "minimum_power_speed":
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
