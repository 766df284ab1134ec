"""What docs/findings.md says is counted again from the sets in docs/assumptions.csv, number by number."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

DOCS = Path(__file__).parents[1] / "docs"
TRIPLE = ["twice-the-frequency", "pitch-range-su-fan", "power-exponent"]
PEAKS = ["peak-power-su-fan", "peak-power-dickinson"]
PIECE = 1000
WORDS = {0: "none", 1: "one", 3: "three", 4: "four", 18: "eighteen", 19: "Nineteen"}


@pytest.fixture(scope="module")
def sets():
    return pd.read_csv(DOCS / "assumptions.csv")


@pytest.fixture(scope="module")
def holds(sets):
    """Whether each claim holds in each set: 1, 0, or not a number where it cannot be told."""
    columns = [name for name in sets if name.endswith(":holds")]
    return sets[columns].set_axis([name.removesuffix(":holds") for name in columns], axis=1)


@pytest.fixture(scope="module")
def page():
    return " ".join((DOCS / "findings.md").read_text().replace("**", "").split())


def spaced(count):
    return f"{count:,}".replace(",", " ")


def percent(share):
    return f"{100 * share:.0f}"


def test_shares(sets, holds, page):
    share, told = holds.mean(), holds.notna().sum()
    of = {name: percent(value) for name, value in share.items()}
    told_page = [
        f"{percent(sets.certified.sum() / (14 * len(sets)))} % of the {spaced(14 * len(sets))} orbits asked for",
        f"in {of['lower-power']} % of {spaced(told['lower-power'])} sets",
        f"in {of['pigeon-closer-at-speed']} % of {spaced(told['pigeon-closer-at-speed'])} sets",
        f"At 3/4 span the plate's angles of attack are the smaller: {of['smaller-alpha-3-of-4']} %",
        f"the hand meets the air at the larger angle: {of['hand-alpha']} %",
        f'"The arm lifts", more than the hand does: {of["arm-lifts"]} %',
        f"pitches within 10 degrees in a beat: {of['pitch-range-su-fan']} %",
        f"for both animals: {of['less-pitching']} %",
        f'"Almost twice the frequency" (bat near 10 m/s): {of["twice-the-frequency"]} %',
        f'"Four times the power": {of["four-times"]} %',
        f"The plate's peak of 30 W: {of['peak-power-su-fan']} %",
        f"Dickinson's 150 W: {of['peak-power-dickinson']} %",
        f"The bat's 6 Hz from 5 to 10 m/s: {of['bat-agrees']} %",
        f"does not change with speed: {of['bat-invariant']} %",
        f"with the plate: {of['smaller-horizontal-force']} and {of['smaller-vertical-force']} %",
        f"angles at 1/4 span smaller: {of['smaller-alpha-1-of-4']} %",
        f"With {spaced(told.min())} to {spaced(told.max())} sets behind each share",
    ]
    assert [phrase for phrase in told_page if phrase not in page] == []


def test_what_holds_always_or_never(sets, holds, page):
    told = holds["hand-thrusts"].notna() & holds["arm-drags"].notna()
    broken = ((holds["hand-thrusts"] == 0) | (holds["arm-drags"] == 0)).sum()
    assert f"in all but {WORDS[broken]} of the {spaced(told.sum())} sets that have both orbits" in page
    assert holds["measured-power-below"].dropna().all()
    assert f"The lowest peak is {sets['measured-power-below'].min():.0f} W" in page
    assert f"under 4 W, lies below what either model gives: in all {spaced(told.sum())} sets" in page
    assert f"half of the sets have a ratio below {sets['lower-power'].median():.2f}".replace("0.", ".") in page
    missed = sets[holds["pigeon-closer-at-speed"] == 0]
    no_flap = ~missed.trims.isin(["flap-mean", "both"])
    assert f"{no_flap.sum()} of the {len(missed)} exceptions lack a free mean flap angle" in page
    off = sets["pigeon-agrees"].dropna()
    assert holds["pigeon-agrees"].sum() == 0
    nearest = f"The nearest of {spaced(len(off))} sets is off by {percent(off.min())} % on average"
    assert f"{nearest}, half of them by {percent(off.median())} % or more" in page
    assert f"Half of the sets pitch by more than {sets['pitch-range-su-fan'].median():.0f} degrees" in page
    assert f"half of the sets need more than {sets['peak-power-su-fan'].median():.0f} W" in page


def test_shares_under_one_choice(sets, holds, page):
    def under(claim, choice):
        return holds[claim].groupby(sets[choice]).mean().map(percent)

    twice, four = under("twice-the-frequency", "extension"), under("four-times", "extension")
    plate, fly = (under(claim, "extension") for claim in PEAKS)
    trims = {claim: under(claim, "trims") for claim in ("hand-alpha", "twice-the-frequency", "bat-agrees")}
    constant = under("bat-invariant", "trims")
    told_page = [
        f"and {trims['hand-alpha']['both']} % where both mean angles are free",
        f"{twice['signed-drag']} to {twice['signed']} % of the sets show it",
        f'or the drag held at its value at 0 ("clipped-drag"), {twice["mirrored"]} and {twice["clipped-drag"]} %',
        f"With a free mean flap angle alone {trims['twice-the-frequency']['flap-mean']} % do",
        f"with a free mean pitch angle alone {trims['twice-the-frequency']['pitch-mean']} %",
        f"({four['mirrored']} % mirrored, {four['signed']} % signed or signed-drag)",
        f"({plate['mirrored']} % mirrored, {plate.drop('mirrored').astype(int).min()} to "
        f"{plate.drop('mirrored').astype(int).max()} % otherwise)",
        f"({fly['clipped-drag']} % clipped, {fly['signed']} to {fly['signed-drag']} % signed)",
        f"and {trims['bat-agrees']['flap-mean']} % if the mean flap angle is free but the mean pitch is not, "
        f"{trims['bat-agrees']['none']} % if neither is",
        f"and {constant['flap-mean']} % if the mean flap angle alone is free, "
        f"{constant['pitch-mean']} % if it is the pitch",
    ]
    assert [phrase for phrase in told_page if phrase not in page] == []
    assert four["signed"] == four["signed-drag"]
    certified = sets.certified.groupby(sets.trims).mean()
    assert f"only {percent(certified['none'] / 14)} % of the orbits were found" in page
    one_free = certified[["flap-mean", "pitch-mean"]].round().astype(int)
    assert f"{one_free.min()} to {one_free.max()} of 14 where one is free" in page
    assert certified["both"] > 13.8  # "nearly all"


def test_what_goes_together(sets, holds, page):
    satisfied = holds.sum(axis=1)
    assert f"No set satisfies more than {satisfied.max():.0f} of the {holds.shape[1]}" in page
    assert f"half satisfy {satisfied.median():.0f} or fewer" in page
    each = [spaced(count) for count in holds[TRIPLE].sum().astype(int)]
    found = (holds[TRIPLE] == 1).all(axis=1)
    told = holds[TRIPLE].notna().all(axis=1).sum()
    assert f"of {each[0]}, {each[1]} and {each[2]} sets that show one of them" in page
    assert f"{found.sum()} of {spaced(told)} show all three, each with the force at the centre of pressure" in page
    assert set(sets.force_point[found]) == {"centre-of-pressure"}
    four, both = found & (holds["four-times"] == 1), found & (holds[PEAKS] == 1).all(axis=1)
    free = sets.trims[four] == "both"
    assert set(sets.extension[four]) == {"mirrored"}
    assert "mirrored" not in set(sets.extension[both])
    assert set(sets.trims[both]) <= {"flap-mean", "pitch-mean"}
    assert f"{WORDS[four.sum()]} of these have four times the power" in page
    assert f"{WORDS[free.sum()]} with both mean angles free" in page
    assert f"{WORDS[both.sum()]} the plate's peak power of 30 W and Dickinson's of 150 W" in page
    assert f"{WORDS[(found & ~four & ~both).sum()]} neither; {WORDS[(four & both).sum()]} has both" in page
    together = (holds == 1).astype(int)
    together = together.T @ together
    some = np.diag(together) > 0
    assert (together.loc[some, some] > 0).all(axis=None)  # "none is now without a set that satisfies both"


def test_how_sure_the_shares_are(holds, page):
    share, told = holds.mean(), holds.notna().sum()
    error = np.sqrt(share * (1 - share) / told)
    assert f"at most {100 * error.max():.1f} percentage points".replace("0.", ".") in page
    open_ones = error > 1e-3  # the others hold nearly always or never
    off = ((share - 0.5).abs() / error)[open_ones]
    assert f"The nearest to one half, {percent(share[off.idxmin()])} %, lies eight errors off" in page
    assert round(off.min()) == 8
    pieces = holds.loc[:, open_ones].groupby(np.arange(len(holds)) // PIECE)
    errors = np.sqrt((share * (1 - share))[open_ones] / pieces.count())
    away = ((pieces.mean() - share[open_ones]).abs() / errors).to_numpy()
    assert f"lies {away.max():.1f} standard errors of a piece away, as the furthest of {away.size} may" in page
    assert len(away) == 20
    assert "Of the twenty pieces' shares" in page
