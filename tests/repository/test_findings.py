"""Every number of docs/findings.md is counted again, from the sets in data/assumptions.csv, and none is left out.

Each function of `COUNTS` returns phrases with the numbers that the sets give. The page must hold all of them, and
every number of the page must lie in one of them. After a new sample `python -m tests.repository.test_findings`
prints the phrases as they are to stand in the page; what they say in words beside the numbers is asserted where it
is counted.
"""

import re

import numpy as np
import pandas as pd
import pytest

from tests.helpers.places import ROOT
from wingbeat.aero import load_coefficients
from wingbeat.paper.assumption_page import TRUSTED
from wingbeat.paper.assumption_study import ORBITS
from wingbeat.paper.energy_claims import BATS_NEED
from wingbeat.paper.experiment_claims import REYNOLDS_FITTED
from wingbeat.paper.measured_bands import (
    PAPER_BAT_FREQUENCY,
    PAPER_BAT_SPEEDS,
    PAPER_PEAK_POWER,
    PAPER_PITCH_RANGE_DEG,
)
from wingbeat.paper.treatments import SAMPLE_SPEED

DOCS, TABLE = ROOT / "docs", ROOT / "data" / "assumptions.csv"
TRIPLE = ["twice-the-frequency", "pitch-range-su-fan", "power-exponent"]
PEAKS = ["peak-power-su-fan", "peak-power-dickinson"]
PIECE = 1000
SMALL = "none one two three four five six seven eight nine ten"
WORDS = dict(enumerate(SMALL.split(" "))) | {
    18: "eighteen",
    19: "Nineteen",
}
# Digits, and numbers in words but for one, which is a pronoun as well, and for shares such as half.
NUMBER = re.compile(
    r"\d+|\b(?:two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|thirteen|fourteen|fifteen|sixteen"
    r"|seventeen|eighteen|nineteen|twenty|thirty|forty|fifty|hundred|thousand|twice)\b",
    re.IGNORECASE,
)


def read_sets():
    return pd.read_csv(TABLE)


def read_holds(sets):
    """Return whether each claim holds in each set: 1, 0, or not a number where it cannot be told."""
    columns = [name for name in sets if name.endswith(":holds")]
    return sets[columns].set_axis([name.removesuffix(":holds") for name in columns], axis=1)


def read_page():
    return " ".join((DOCS / "findings.md").read_text().replace("**", "").split())


def spaced(count):
    return f"{count:,}".replace(",", " ")


def percent(share):
    return f"{100 * share:.0f}"


def short(number, digits=2):
    return f"{number:.{digits}f}"


def named(table, name):
    """Return the columns of a claim: its own, or one for each animal or reference that it is judged by."""
    return [column for column in table if re.fullmatch(rf"{name}(-[a-z]+)?", column)]


def extension_of(sets, model):
    """Return how a model's coefficients are extended: a choice of its own where both are not extended alike."""
    own = f"extension_{model.replace('-', '_')}"
    return sets[own if own in sets else "extension"]


def question(sets, holds):
    head = (DOCS / "assumptions.md").read_text()
    told = (r"version (\d+)\)", r"took ([\d.]+) core-hours", r"with (\d+) starts per orbit")
    version, hours, starts = (re.search(pattern, head).group(1) for pattern in told)
    low, high = (spaced(int(reynolds)) for reynolds in REYNOLDS_FITTED)
    plate, fly = (load_coefficients(model, "signed") for model in ("su-fan", "dickinson"))
    plain = [load_coefficients(model) for model in ("su-fan", "dickinson")]
    at = np.radians([-40.0])
    (signed, other), (mirrored, own) = (
        [short(float(m.drag(at)[0])) for m in pair] for pair in ((plate, fly), plain)
    )
    return [
        "(arXiv 2302.09602)",
        f"on a plate at Reynolds numbers of {low} to {high} with",
        f"We therefore draw {spaced(len(sets))} sets of assumptions",
        f"which of {holds.shape[1]} claims",
        f"`wingbeat paper assumptions --sets {len(sets)} --piece {PIECE}` (numerical version {version}, {hours} "
        "core-hours)",
        f"the lowest of {WORDS[int(starts)]} starts, one of them from the previous speed",
        f"the plate's C_D at -40 degrees is then {signed} instead of {mirrored}, and Dickinson's {other} instead "
        f"of {own}",
        f"where the surface explains under {100 * TRUSTED:.0f} % we make none",
        f"(bat, {SAMPLE_SPEED:g} m/s)",
    ]


def shares(sets, holds):
    share, told = holds.mean(), holds.notna().sum()
    of = {name: percent(value) for name, value in share.items()}
    (slow, fast), speed, orbits = PAPER_BAT_SPEEDS, f"{SAMPLE_SPEED:g} m/s", ORBITS * len(sets)
    within = f"{PAPER_PITCH_RANGE_DEG['su-fan']:g} degrees"
    return [
        f"Of the {spaced(orbits)} orbits needed, {percent(sets.certified.sum() / orbits)} % were found",
        f"in {of['lower-power']} % of {spaced(told['lower-power'])} sets",
        *(f"in {of[name]} % of {spaced(told[name])} sets" for name in named(holds, "pigeon-closer-at-speed")),
        f"At 3/4 span the plate's angles of attack are smaller: in {of['smaller-alpha-3-of-4']} %",
        f"The hand has the larger angle of attack: in {of['hand-alpha']} %",
        f'"The arm lifts" more than the hand: in {of["arm-lifts"]} %',
        f"The bat with plate coefficients pitches within {within} in a wingbeat: in {of['pitch-range-su-fan']} %",
        *_less_pitching(of),
        f'"Almost twice the frequency" (bat near {speed}): in {of["twice-the-frequency"]} %',
        f'"Four times the power": in {of["four-times"]} %',
        f"The plate's peak of {PAPER_PEAK_POWER['su-fan']:g} W: in {of['peak-power-su-fan']} %",
        f"Dickinson's {PAPER_PEAK_POWER['dickinson']:g} W: in {of['peak-power-dickinson']} %",
        f"The bat's {PAPER_BAT_FREQUENCY:g} Hz from {slow:g} to {fast:g} m/s: in {of['bat-agrees']} %",
        f"does not change with speed: in {of['bat-invariant']} %",
        f"with the plate: in {of['smaller-horizontal-force']} and {of['smaller-vertical-force']} %",
        f"Angles at 1/4 span are smaller: in {of['smaller-alpha-1-of-4']} %",
        f"With {spaced(told.min())} to {spaced(told.max())} sets behind each share",
    ]


def _less_pitching(of):
    if "less-pitching" in of:
        return [f"for both animals: in {of['less-pitching']} %"]
    return [f"the {animal}'s: in {of[f'less-pitching-{animal}']} %" for animal in ("pigeon", "bat")]


def always_or_never(sets, holds):
    told = holds["hand-thrusts"].notna() & holds["arm-drags"].notna()
    broken = ((holds["hand-thrusts"] == 0) | (holds["arm-drags"] == 0)).sum()
    assert holds["measured-power-below"].dropna().all()
    return [
        f"in all but {WORDS[broken]} of the {spaced(told.sum())} sets that have both orbits",
        f"The lowest peak power is {sets['measured-power-below'].min():.0f} W",
        f"under {BATS_NEED:g} W, is below that of both models: in all {spaced(told.sum())} sets",
        f"half of the sets have a ratio below {short(sets['lower-power'].median())}",
        *(phrase for name in named(holds, "pigeon-closer-at-speed") for phrase in _exceptions(sets, holds, name)),
        *(phrase for name in named(holds, "pigeon-agrees") for phrase in _never(sets, holds, name)),
        f"Half of the sets pitch by more than {sets['pitch-range-su-fan'].median():.0f} degrees",
        f"half of the sets need more than {sets['peak-power-su-fan'].median():.0f} W",
    ]


def _exceptions(sets, holds, name):
    missed = sets[holds[name] == 0]
    no_flap = ~missed.trims.isin(["flap-mean", "both"])
    return [f"{no_flap.sum()} of the {len(missed)} exceptions have no free mean flap angle"]


def _never(sets, holds, name):
    off = sets[name].dropna()
    assert holds[name].sum() == 0, "the page says that it never holds"
    nearest = f"The closest of {spaced(len(off))} sets deviates by {percent(off.min())} % on average"
    return [
        f"Above {SAMPLE_SPEED:g} m/s the pigeon's computed frequency",
        f"{nearest}; half of them deviate by {percent(off.median())} % or more",
    ]


def under_one_choice(sets, holds):
    alike = extension_of(sets, "su-fan") == extension_of(sets, "dickinson")

    def under(claim, choice):
        return holds[claim][alike].groupby(choice[alike]).mean().map(percent)

    twice, four = (under(name, extension_of(sets, "su-fan")) for name in ("twice-the-frequency", "four-times"))
    plate, fly = (under(claim, extension_of(sets, claim.removeprefix("peak-power-"))) for claim in PEAKS)
    others = plate.drop("mirrored").astype(int)
    trims = {
        name: holds[name].groupby(sets.trims).mean().map(percent)
        for name in ("hand-alpha", "twice-the-frequency", "bat-agrees", "bat-invariant")
    }
    assert four["signed"] == four["signed-drag"]
    certified = sets.certified.groupby(sets.trims).mean()
    assert certified["both"] > 0.98 * ORBITS  # "nearly all"
    one_free = certified[["flap-mean", "pitch-mean"]].round().astype(int)
    constant = trims["bat-invariant"]
    return [
        f"and in {trims['hand-alpha']['both']} % if both mean angles are free",
        f"Of these sets, {twice['signed-drag']} to {twice['signed']} % satisfy the claim",
        f'If both sides of the wing are equal ("mirrored"), {twice["mirrored"]} % do',
        f'if the drag keeps its value at 0 ("clipped-drag"), {twice["clipped-drag"]} % do',
        f"If only the mean flap angle is free, {trims['twice-the-frequency']['flap-mean']} % do",
        f"if only the mean pitch angle is free, {trims['twice-the-frequency']['pitch-mean']} % do",
        f"({four['mirrored']} % mirrored, {four['signed']} % signed or signed-drag)",
        f"({plate['mirrored']} % mirrored, {others.min()} to {others.max()} % otherwise)",
        f"({fly['clipped-drag']} % clipped, {fly['signed']} to {fly['signed-drag']} % signed)",
        f"in {trims['bat-agrees']['flap-mean']} % if only the mean flap angle is free, "
        f"and in {trims['bat-agrees']['none']} % if neither is free",
        f"in {constant['flap-mean']} % if only the mean flap angle is free, "
        f"and in {constant['pitch-mean']} % if only the mean pitch is free",
        f"only {percent(certified['none'] / ORBITS)} % of the orbits were found",
        f"({one_free.min()} to {one_free.max()} of the {ORBITS} orbits of a set if one is free",
    ]


def together(sets, holds):
    satisfied = holds.sum(axis=1)
    each = [spaced(count) for count in holds[TRIPLE].sum().astype(int)]
    found = (holds[TRIPLE] == 1).all(axis=1)
    told = holds[TRIPLE].notna().all(axis=1).sum()
    assert set(sets.force_point[found]) == {"centre-of-pressure"}
    four, both = found & (holds["four-times"] == 1), found & (holds[PEAKS] == 1).all(axis=1)
    free = sets.trims[four] == "both"
    for model in ("su-fan", "dickinson"):
        assert set(extension_of(sets, model)[four]) == {"mirrored"}
        assert "mirrored" not in set(extension_of(sets, model)[both])
    assert set(sets.trims[both]) <= {"flap-mean", "pitch-mean"}
    pairs = (holds == 1).astype(int)
    pairs = pairs.T @ pairs
    some = np.diag(pairs) > 0
    assert (pairs.loc[some, some] > 0).all(axis=None)  # "none is without a set that satisfies both"
    plate, fly = (f"{PAPER_PEAK_POWER[model]:g} W" for model in ("su-fan", "dickinson"))
    return [
        f"No set satisfies more than {satisfied.max():.0f} of the {holds.shape[1]}",
        f"half satisfy {satisfied.median():.0f} or fewer",
        f'The paper\'s bat at {SAMPLE_SPEED:g} m/s has "twice the frequency", "pitches within '
        f'{PAPER_PITCH_RANGE_DEG["su-fan"]:g} degrees"',
        f"These claims hold in {each[0]}, {each[1]} and {each[2]} sets, respectively. "
        f"All {WORDS[len(TRIPLE)]} hold together in {found.sum()} of {spaced(told)} sets, each with the force at "
        "the centre of pressure",
        f"Of the sets with all {WORDS[len(TRIPLE)]} claims",
        f"{WORDS[four.sum()]} of these also have four times the power",
        f"{WORDS[free.sum()]} have both mean angles free",
        f"Another {WORDS[both.sum()]} have both the plate's peak power of {plate} and Dickinson's of {fly}. "
        f"All {WORDS[both.sum()]} have only one mean angle free",
        f"{WORDS[(found & ~four & ~both).sum()]} has neither the power ratio nor the peaks, and "
        f"{WORDS[(four & both).sum()]} has both",
    ]


def how_sure(sets, holds):
    share, told = holds.mean(), holds.notna().sum()
    error = np.sqrt(share * (1 - share) / told)
    open_ones = error > 1e-3  # the others hold nearly always or never
    off = ((share - 0.5).abs() / error)[open_ones]
    pieces = holds.loc[:, open_ones].groupby(np.arange(len(holds)) // PIECE)
    errors = np.sqrt((share * (1 - share))[open_ones] / pieces.count())
    away = ((pieces.mean() - share[open_ones]).abs() / errors).to_numpy()
    assert len(away) == 20
    return [
        f"at most {short(100 * error.max(), 1)} percentage points",
        f"The share closest to one half, {percent(share[off.idxmin()])} %, is {WORDS[round(off.min())]} standard "
        "errors",
        "the shares of the twenty pieces with those of the whole sample: the largest deviation is "
        f"{away.max():.1f} standard errors of a piece, as expected for the largest of {away.size} deviations",
    ]


COUNTS = (question, shares, always_or_never, under_one_choice, together, how_sure)


def uncounted(page, phrases):
    """Return the sentences of a page with a number that lies in none of the phrases."""
    covered = np.zeros(len(page), dtype=bool)
    for phrase in phrases:
        for at in (match.start() for match in re.finditer(re.escape(phrase), page)):
            covered[at : at + len(phrase)] = True
    missed = [match for match in NUMBER.finditer(page) if not covered[match.start() : match.end()].all()]
    return sorted({page[max(m.start() - 60, 0) : m.end() + 40] for m in missed})


@pytest.fixture(scope="module")
def counted():
    sets = read_sets()
    holds = read_holds(sets)
    return {count.__name__: count(sets, holds) for count in COUNTS}


@pytest.mark.parametrize("name", [count.__name__ for count in COUNTS])
def test_the_page_says_what_the_sets_do(counted, name):
    page = read_page()
    assert [phrase for phrase in counted[name] if phrase not in page] == []


def test_no_number_of_the_page_is_left_uncounted(counted):
    phrases = [phrase for part in counted.values() for phrase in part]
    page = read_page()
    assert uncounted(page, phrases) == []
    # A sentence more, in digits or in words, is seen.
    assert uncounted(f"{page} It is so in 42 % of them.", phrases)
    assert uncounted(f"{page} It is so in three of them.", phrases)


if __name__ == "__main__":
    every = read_sets()
    told = read_holds(every)
    print(*(phrase for count in COUNTS for phrase in count(every, told)), sep="\n")
