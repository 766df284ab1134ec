"""Every number of the page which_claims_hold.md is counted again from data/assumptions.csv, none is left out.

Each function of `COUNTS` returns phrases with the numbers that the sets give. The page must hold all of them, and
every number of the page must lie in one of them. After a new sample, running this module
(`python -m tests.repository.test_which_claims_hold`) prints the phrases for the page; what they say in words beside
the numbers is asserted where it is counted.
"""

import re

import numpy as np
import pandas as pd
import pytest

from tests.helpers.phrases import WORDS, percent, short, spaced, uncounted, worded
from tests.helpers.places import ROOT
from wingbeat.aero import load_coefficients
from wingbeat.animal.species.making import load_species
from wingbeat.plots.published import (
    PAPER_BAT_FREQUENCY,
    PAPER_BAT_SPEEDS,
    PAPER_PEAK_POWER,
    PAPER_PITCH_RANGE_DEG,
    PIGEON_REFERENCES,
)
from wingbeat_evidence.paper.assumption_page import TRUSTED
from wingbeat_evidence.paper.assumption_study import ORBITS
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS
from wingbeat_evidence.paper.energy_claims import BATS_NEED
from wingbeat_evidence.paper.experiment_claims import REYNOLDS_FITTED
from wingbeat_evidence.paper.figure_cycle import STATIONS
from wingbeat_evidence.paper.pigeon_claims import AGREES
from wingbeat_evidence.paper.treatments import SAMPLE_SPEED

DOCS, TABLE = ROOT / "docs" / "evidence", ROOT / "data" / "assumptions.csv"
TRIPLE = ["twice-the-frequency", "pitch-range-su-fan", "power-exponent"]
PEAKS = ["peak-power-su-fan", "peak-power-dickinson"]
PIECE = 1000
# The assumptions that explain more than a tenth of some claim's number.
DECISIVE = {
    "shoulder_ahead",
    "shoulder_aside",
    "extension_su_fan",
    "extension_dickinson",
    "force_point",
    "trims",
    "flap_mean_deg",
    "flap_amplitude_deg",
    "pitch_phase_deg",
}


def read_sets():
    return pd.read_csv(TABLE)


def read_holds(sets):
    """Return whether each claim holds in each set: 1, 0, or not a number where it cannot be told."""
    columns = [name for name in sets if name.endswith(":holds")]
    return sets[columns].set_axis([name.removesuffix(":holds") for name in columns], axis=1)


def read_page():
    return " ".join((DOCS / "which_claims_hold.md").read_text().replace("**", "").split())


def under(holds, choice):
    """Return the mean over the sets with each choice of an assumption, in percent."""
    return holds.groupby(choice).mean().map(percent)


def span_of(name):
    return next((a.low, a.high) for a in ASSUMPTIONS if a.name == name)


def quarter(sets, name):
    """Return in which quarter of its range an assumption lies, 0 to 3."""
    low, high = span_of(name)
    return np.clip(np.floor(4 * (sets[name] - low) / (high - low)), 0, 3).astype(int)


def surfaces():
    """Return of each claim the quality of its surface, and the shares that the page names."""
    found = {}
    for line in (DOCS / "assumptions.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("| `") and cells[-1] != "-":
            shares = re.findall(r"(\w+) (\d\.\d+)", cells[-2])
            found[cells[0].split("`")[1]] = float(cells[-1]), {name: float(share) for name, share in shares}
    return found


def question(sets, holds):
    head = (DOCS / "assumptions.md").read_text()
    told = (r"version (\d+)\)", r"took ([\d.]+) core-hours", r"with (\d+) starts per orbit")
    version, hours, starts = (re.search(pattern, head).group(1) for pattern in told)
    low, high = (spaced(int(reynolds)) for reynolds in REYNOLDS_FITTED)
    return [
        "(arXiv 2302.09602)",
        f"on a plate at Reynolds numbers of {low} to {high} and",
        f"We therefore draw {spaced(len(sets))} sets of assumptions",
        f"which of {holds.shape[1]} claims",
        f"`wingbeat paper assumptions --sets {len(sets)} --piece {PIECE}` (numerical version {version}, {hours} "
        "core-hours)",
        f"from {WORDS[int(starts)]} initial guesses",
        f"the strips at {' and '.join(STATIONS)} span",
        f"below {100 * TRUSTED:.0f} % we do not say it",
    ]


def orbits_found(sets, holds):
    needed, told = ORBITS * len(sets), holds.notna().mean()
    found = sets.certified / ORBITS
    trims = under(found, sets.trims)
    ahead, aside = (
        found.groupby(quarter(sets, f"shoulder_{way}")).mean().map(percent) for way in ("ahead", "aside")
    )
    _, last = span_of("shoulder_aside")
    own = [load_species(name).vehicle.wing for name in ("pigeon", "bat")]
    pigeon, bat = (wing.shoulder[1] / wing.semi_span for wing in own)
    return [
        f"{short(pigeon, 3)} (pigeon) and {short(bat, 3)} (bat) of the semi-span; the sampled "
        f"range ends at {last:g}",
        f"Of the {spaced(needed)} orbits needed, {percent(found.mean())} % were found",
        f"all its orbits were found in {percent(told.min())} to {percent(told.max())} % of the sets",
        f"With both mean angles fixed, only {trims['none']} % of the orbits were found; with both free, "
        f"{trims['both']} % were",
        f"With the shoulder in the rear quarter of its range {ahead[0]} % were found, in the front quarter "
        f"{ahead[3]} %; nearest to the plane of symmetry, which our wings may not cross, {aside[0]} % were found, "
        f"in the farthest quarter {aside[3]} %",
    ]


def nearly_always(sets, holds):
    share, told = holds.mean(), holds.notna().sum()
    of = {name: percent(value) for name, value in share.items()}
    both = holds["hand-thrusts"].notna() & holds["arm-drags"].notna()
    for name in ("hand-thrusts", "arm-drags", "measured-power-below"):
        assert holds[name].dropna().all()
    off = holds[[f"pigeon-dickinson-off-{name}" for name in PIGEON_REFERENCES]]
    failing = int((off == 0).any(axis=1).sum())
    extension = under(holds["lower-power"], sets.extension_dickinson).astype(int)
    others = extension.drop("clipped-drag")
    closer = [holds[f"pigeon-closer-at-speed-{name}"] for name in PIGEON_REFERENCES]
    assert len({percent(one.mean()) for one in closer}) == 1
    unequal, at_centre = sets.extension_su_fan != "mirrored", sets.force_point == "centre-of-pressure"
    kinds = (~unequal & ~at_centre, unequal & at_centre)
    each = [[percent(one[kind].mean()) for kind in kinds] for one in closer]
    assert each[0] == each[1]
    assert closer[0].notna().sum() == closer[1].notna().sum()
    alike, apart = each[0]
    assert failing > 0
    assert (share[["hand-alpha", "smaller-alpha-3-of-4", "lower-power", closer[0].name]] > 0.8).all()
    return [
        f"(at {SAMPLE_SPEED:g} m/s): in all {spaced(both.sum())} sets",
        f"under {BATS_NEED:g} W, is below that of both models: in all {spaced(told['measured-power-below'])} sets",
        f"The lowest peak power is {sets['measured-power-below'].min():.0f} W",
        f"above {SAMPLE_SPEED:g} m/s agrees poorly with the live bird's (a mean deviation of more than "
        f"{percent(AGREES)} %): with each of the two references below, in all but {worded(failing)} of "
        f"{spaced(off.notna().all(axis=1).sum())} sets",
        f"larger angle of attack than its arm: in {of['hand-alpha']} %",
        "At 3/4 span the bat's angles of attack are smaller with the plate's coefficients: in "
        f"{of['smaller-alpha-3-of-4']} %",
        f"in {of['lower-power']} % of {spaced(told['lower-power'])} sets; half of the sets have a ratio below "
        f"{short(sets['lower-power'].median())}",
        f"in {extension['clipped-drag']} % of sets with clipped-drag for Dickinson's coefficients, and in "
        f"{others.min()} to {others.max()} % with each other rule",
        f"in {percent(closer[0].mean())} % of {spaced(closer[0].notna().sum())} sets, with each reference; in "
        f"{apart} % if the plate's force acts at the centre of pressure and its coefficients are not mirrored, in "
        f"{alike} % if the force acts at the quarter chord and they are",
    ]


def seldom(sets, holds):
    share, told = holds.mean(), holds.notna().sum()
    loaded, law = (f"pigeon-agrees-{name}" for name in ("usherwood", "pennycuick"))
    agreeing = sets[(holds[[loaded, law]] == 1).any(axis=1)]
    assert "mirrored" not in set(agreeing.extension_su_fan)
    species = load_species("pigeon")
    hertz = [band.value(species.vehicle, species.air, SAMPLE_SPEED) for band in PIGEON_REFERENCES.values()]
    twice = holds["twice-the-frequency"]
    ahead = under(twice, quarter(sets, "shoulder_ahead") >= 2)
    within = PAPER_PITCH_RANGE_DEG["su-fan"]
    few = ["twice-the-frequency", "power-exponent", "pitch-range-su-fan", "arm-lifts", loaded, law]
    assert (share[few] < 0.15).all()
    of = share.map(percent)
    return [
        f'Above {SAMPLE_SPEED:g} m/s the pigeon\'s computed frequency "agrees very well" with the live one: in '
        f"{of[loaded]} % of {spaced(told[loaded])} sets with the reference of {hertz[0]:.1f} Hz",
        f"in {of[law]} % with {hertz[1]:.1f} Hz",
        f"a flap amplitude of at least {np.floor(agreeing.flap_amplitude_deg.min()):.0f} degrees",
        f"*Very well* means a mean deviation of at most {percent(AGREES)} %",
        f"half of the sets deviate by {percent(sets[loaded].median())} % or more from the first reference, or by "
        f"{percent(sets[law].median())} % or more from the second",
        f'"almost twice the frequency" (bat near {SAMPLE_SPEED:g} m/s): in {percent(twice.mean())} % of sets: '
        f"{under(twice, sets.extension_su_fan)['mirrored']} % if the plate's coefficients are mirrored, "
        f"{under(twice, sets.extension_dickinson)['signed']} % if Dickinson's are signed; {ahead[False]} % with "
        f"the shoulder in the rear half of its range, {ahead[True]} % in the front half",
        f'"Power goes as frequency squared": in {of["power-exponent"]} % of sets',
        f"varies by at most {within:g} degrees in a wingbeat: in {of['pitch-range-su-fan']} %",
        f"In half of the sets it varies by more than {sets['pitch-range-su-fan'].median():.0f} degrees",
        f'"The arm lifts" more than the hand, with both models: in {of["arm-lifts"]} %',
    ]


def under_one_choice(sets, holds):
    of, at = holds.mean().map(percent), np.radians([-40.0])
    powers = {
        name: under(holds[name], sets[f"extension_{model}"]).astype(int)
        for name, model in (
            ("four-times", "su_fan"),
            ("peak-power-su-fan", "su_fan"),
            ("peak-power-dickinson", "dickinson"),
        )
    }
    four, plate = (powers[name].drop("mirrored") for name in ("four-times", "peak-power-su-fan"))
    fly = powers["peak-power-dickinson"]
    (signed, mirrored), (fly_signed, fly_mirrored) = (
        [short(float(load_coefficients(model, extension).drag(at)[0])) for extension in ("signed", "mirrored")]
        for model in ("su-fan", "dickinson")
    )
    agrees = under(holds["bat-agrees"], quarter(sets, "shoulder_aside")).astype(int)
    pitching = under(holds["less-pitching-bat"], quarter(sets, "shoulder_ahead"))
    (slow, fast) = PAPER_BAT_SPEEDS
    about_half = ["smaller-horizontal-force", "smaller-vertical-force", "smaller-alpha-1-of-4", "arm-pitches-least"]
    assert ((holds[about_half].mean() - 0.5).abs() < 0.1).all()
    tests = (ROOT / "data" / "claims.json").read_text()
    assert "the ratio is between 3 and 5" in tests
    assert tests.count("our peak power is within 25 % of the paper's") == len(PEAKS)
    of_peaks = PAPER_PEAK_POWER["dickinson"] / PAPER_PEAK_POWER["su-fan"]
    return [
        f"The bat's peak power at {SAMPLE_SPEED:g} m/s",
        f"a ratio of the peaks from 3 to 5; the paper's own peaks have a ratio of {of_peaks:g}",
        "otherwise), within 25 %",
        f'"Four times the power": in {of["four-times"]} % of sets ({powers["four-times"]["mirrored"]} % if the '
        f"plate's coefficients are mirrored, {four.min()} to {four.max()} % otherwise)",
        f"The plate's peak of {PAPER_PEAK_POWER['su-fan']:g} W: in {of['peak-power-su-fan']} % of sets "
        f"({powers['peak-power-su-fan']['mirrored']} % if the plate's coefficients are mirrored, {plate.min()} to "
        f"{plate.max()} % otherwise)",
        f"Half of the sets need more than {sets['peak-power-su-fan'].median():.0f} W",
        f"Dickinson's {PAPER_PEAK_POWER['dickinson']:g} W: in {of['peak-power-dickinson']} % of sets "
        f"({fly['clipped-drag']} % with clipped-drag, {fly['mirrored']} % with mirrored, "
        f"{fly['signed']} % with signed, {fly['signed-drag']} % with signed-drag)",
        f"at -40 degrees the plate's C_D is {signed} if signed and {mirrored} if mirrored. Dickinson's C_D is "
        f"{fly_signed} if signed and {fly_mirrored} if mirrored",
        f"The bat's {PAPER_BAT_FREQUENCY:g} Hz from {slow:g} to {fast:g} m/s: in {of['bat-agrees']} % of sets "
        f"({agrees[0]} % if the shoulder is in the quarter of its range nearest to the plane of symmetry, "
        f"{min(agrees[2], agrees[3])} to {max(agrees[2], agrees[3])} % if it is in the outer half",
        f"does not change with speed: in {of['bat-invariant']} % of sets",
        f"A frequency of the bat closer to {PAPER_BAT_FREQUENCY:g} Hz with the plate's than with Dickinson's "
        f"coefficients: in {of['bat-closer-at-speed']} %",
        f"At {slow:g} m/s the models give the bat a similar frequency: in "
        f"{of['bat-slow-alike']} % of sets. Above this speed the frequencies diverge: in {of['bat-parts']} %",
        f"make the bat's body pitch less: in {of['less-pitching-bat']} % of sets ({pitching[0]} % with the "
        f"shoulder in the rear quarter of its range, {pitching[3]} % in the front quarter), and the pigeon's: in "
        f"{of['less-pitching-pigeon']} %. The bat pitches by {PAPER_PITCH_RANGE_DEG['dickinson']:g} degrees with "
        f"Dickinson's coefficients: in {of['pitch-range-dickinson']} %",
        f"horizontal forces at {' and '.join(STATIONS)} span in {of['smaller-horizontal-force']} % of sets, "
        f"vertical forces in {of['smaller-vertical-force']} %, angles of attack at 1/4 span in "
        f"{of['smaller-alpha-1-of-4']} %, pitching of the arm in {of['arm-pitches-least']} %",
    ]


def together(sets, holds):
    satisfied, testable = holds.sum(axis=1), holds.notna().all(axis=1)
    three, common = WORDS[len(TRIPLE)], holds[TRIPLE].dropna()
    each = [spaced(count) for count in common.sum().astype(int)]
    found = (holds[TRIPLE] == 1).all(axis=1)
    alone = len(common) * common.mean().prod()
    four, both = found & (holds["four-times"] == 1), found & (holds[PEAKS] == 1).all(axis=1)
    assert (four & both).any()  # "in some sets"
    pairs = (holds == 1).astype(int)
    assert ((pairs.T @ pairs) > 0).all(axis=None)  # "every pair"
    plate, fly = (f"{PAPER_PEAK_POWER[model]:g} W" for model in ("su-fan", "dickinson"))
    return [
        f"No set satisfies more than {satisfied.max():.0f} of the {holds.shape[1]} claims",
        f"In {spaced(testable.sum())} sets all claims can be tested; half of these satisfy "
        f"{satisfied[testable].median():.0f} or fewer",
        f"The paper's bat at {SAMPLE_SPEED:g} m/s satisfies {three} claims at once. In {spaced(len(common))} of "
        f'our sets, all {three} can be tested: {each[0]} satisfy "twice the frequency", {each[1]} "pitches within '
        f'{PAPER_PITCH_RANGE_DEG["su-fan"]:g} degrees", {each[2]} "power goes as frequency squared", and '
        f"{found.sum()} satisfy all {three} ({alone:.0f} if the claims were independent). Of these, "
        f"{worded(four.sum())} also have four times the power, {worded(both.sum())} have both the plate's peak "
        f"power of {plate} and Dickinson's of {fly}, and {worded((four & both).sum())} have all of these",
    ]


def what_matters(sets, holds):
    quality = {name: told for name, (told, _) in surfaces().items()}
    trusted = [shares for told, shares in surfaces().values() if told >= TRUSTED]
    assert {name for shares in trusted for name, share in shares.items() if share > 0.1} == DECISIVE
    assert quality["power-exponent"] < TRUSTED <= min(quality["lower-power"], quality["bat-agrees"])
    of_the_bat = [told < 0.5 for name, told in quality.items() if "pigeon" not in name and name != "lower-power"]
    assert np.mean(of_the_bat) > 0.5  # "for most of the bat's claims"
    return []


def how_sure(sets, holds):
    share, told = holds.mean(), holds.notna().sum()
    error = np.sqrt(share * (1 - share) / told)
    open_ones = error > 1e-3  # the others hold nearly always or never
    pieces = holds.loc[:, open_ones].groupby(np.arange(len(holds)) // PIECE)
    errors = np.sqrt((share * (1 - share))[open_ones] / pieces.count())
    away = ((pieces.mean() - share[open_ones]).abs() / errors).to_numpy()
    assert len(away) == 20
    assert 2.5 < away.max() < 4.3  # "as expected": of 520 normal deviations, the largest is 3.2 give or take 0.4
    return [
        f"Behind the overall shares are {spaced(told.min())} to {spaced(told.max())} sets: a standard error of at "
        f"most {short(100 * error.max(), 1)} percentage points",
        "The shares of the twenty pieces of the sample deviate from the whole by at most "
        f"{away.max():.1f} standard errors, as expected for the largest of {away.size} deviations",
    ]


COUNTS = (question, orbits_found, nearly_always, seldom, under_one_choice, together, what_matters, how_sure)


@pytest.fixture(scope="module")
def counted():
    sets = read_sets()
    holds = read_holds(sets)
    return {count.__name__: count(sets, holds) for count in COUNTS}


@pytest.mark.parametrize("name", [count.__name__ for count in COUNTS])
def test_the_page_says_what_the_sets_do(counted, name):
    assert [phrase for phrase in counted[name] if phrase not in read_page()] == []


def test_no_number_of_the_page_is_left_uncounted(counted):
    phrases, page = [phrase for part in counted.values() for phrase in part], read_page()
    assert uncounted(page, phrases) == []
    assert uncounted(f"{page} It is so in 42 % of them.", phrases)
    assert uncounted(f"{page} It is so in three of them.", phrases)


if __name__ == "__main__":
    every = read_sets()
    told = read_holds(every)
    print(*(phrase for count in COUNTS for phrase in count(every, told)), sep="\n")
