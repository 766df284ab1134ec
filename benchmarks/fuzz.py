"""Mutated study and species files: is each accepted or explained, and how long does that take?

Run from the root of a clone; seeded, so that a number finds a file again::

    uv run python benchmarks/fuzz.py --count 10000
"""

from __future__ import annotations

import argparse
import random
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

import wingbeat as wb
from wingbeat.animal.species.reading import template

STUDIES = (
    """species = ["pigeon", "bat"]
aero = ["su-fan", "dickinson"]
starts = 2
seed = 3
[vary]
speed = { grid = [6.0, 8.0, 10.0] }
"wing.mass" = { relative = [0.8, 1.0, 1.2] }
""",
    """species = "pigeon"
extension = ["mirrored", "signed"]
minimise = ["frequency", "mean_positive_power"]
subject_to = ["peak_power<=300", "flap_amplitude<=60 deg"]
free = ["frequency", "flap_amplitude", "pitch_amplitude", "pitch_mean"]
most_starts = 4
advise = true
chain = "speed"
[bounds]
flap_amplitude_deg = [5.0, 60.0]
[set]
"air.density" = 1.0
"wing.shoulder" = [0.01, 0.0, 0.0]
[vary]
speed = { grid = [8.0, 9.0, 10.0] }
"body.pitch_inertia" = { relative_range = [0.8, 1.2] }
"aero.lift.amplitude" = { range = [1.0, 1.4] }
[sample]
method = "latin-hypercube"
n = 64
seed = 1
""",
    """species = ["bat"]
force_point = "centre-of-pressure"
strips = [10, 20]
climb = [-1.0, 0.0, 1.0]
payload = 0.001
[vary]
speed = { list = [6.0, 8.0, 10.0] }
"wing.chord" = { list = [[0.05, 0.04], [0.05, 0.03], [0.06, 0.02]] }
"bounds.flap_amplitude.upper" = { grid = [1.0, 1.1] }
""",
)
ODD = (
    *("", "-1", "0", "1.5", "nan", "-inf", "1e308", "5e-324", "9" * 400, "1_0", "0x10", "true", '""', '"x"', "''"),
    *("[]", "[[]]", "{}", "[1, 2]", "[1, 'a']", "[nan]", "1979-05-27", "{ value = 1 }", "{ grid = [] }", "[1,"),
    *("{ grid = [1.0, 1.0] }", "{ range = [2.0, 1.0] }", '"\\u0000"', '"../../x.toml"', '"mine.py:f"', "100000000"),
)
BYTES = (
    b"\x00",
    b"\xff",
    b"\xef\xbb\xbf",
    b"\r",
    b"[",
    b"]",
    b"{",
    b'"',
    b"=",
    b".",
    b"#",
    b"-",
    b"e",
    b"9",
    b"\n",
)

# Milliseconds that a file may take.
LONG = 50.0


class Mutant(NamedTuple):
    """A file: how it is read, what it was before, and its bytes now."""

    kind: str
    content: bytes


def mutants(count: int, seed: int = 0) -> Iterator[Mutant]:
    """Yield valid files with one to four changes each, studies and species in turn."""
    chance = random.Random(seed)
    box = files("wingbeat") / "data"
    species = [
        template(),
        *(entry.read_text() for entry in sorted(box.iterdir(), key=str) if entry.name[-5:] == ".toml"),
    ]
    for index in range(count):
        kind, valid = ("study", STUDIES) if index % 2 == 0 else ("species", tuple(species))
        text = chance.choice(valid)
        for _ in range(chance.choice((1, 1, 2, 4))):
            text = chance.choice((*[_value] * 6, _key, _key, _lines, _lines, _piece))(text, chance)
        content = bytearray(text.encode())
        if chance.random() < 0.1:
            for _ in range(chance.randint(1, 4)):
                place = chance.randrange(len(content) + 1)
                content[place : place + chance.choice((0, 0, 1, 9))] = chance.choice(BYTES)
        yield Mutant(kind, bytes(content))


def _value(text: str, chance: random.Random) -> str:
    """Put something odd in the place of a value."""
    lines = text.split("\n")
    here = [i for i, line in enumerate(lines) if "=" in line and not line.startswith("#")]
    if here:
        i = chance.choice(here)
        name, _, value = lines[i].partition("=")
        numbers = [n for n in value.replace(",", " ").replace("]", " ").split() if n[0].isdigit()]
        inner = value.replace(chance.choice(numbers), chance.choice(ODD), 1) if numbers else chance.choice(ODD)
        lines[i] = f"{name}= {inner if chance.random() < 0.5 else chance.choice(ODD)}"
    return "\n".join(lines)


def _key(text: str, chance: random.Random) -> str:
    """Misspell a key, or name it twice."""
    lines = text.split("\n")
    here = [i for i, line in enumerate(lines) if "=" in line and len(line) > 4]
    if here:
        i = chance.choice(here)
        place = chance.randrange(min(len(lines[i]), 12))
        changed = lines[i][:place] + chance.choice("xq._ =") + lines[i][place + 1 :]
        lines[i : i + 1] = [lines[i], changed] if chance.random() < 0.3 else [changed]
    return "\n".join(lines)


def _lines(text: str, chance: random.Random) -> str:
    """Drop, double or move a line, or cut the file short."""
    lines = text.split("\n")
    i, j = chance.randrange(len(lines)), chance.randrange(len(lines))
    how = chance.randrange(4)
    if how == 0:
        del lines[i]
    elif how == 1:
        lines.insert(j, lines[i])
    elif how == 2:
        lines[i], lines[j] = lines[j], lines[i]
    else:
        del lines[max(i, 1) :]
    return "\n".join(lines)


def _piece(text: str, chance: random.Random) -> str:
    """Put a piece of one place, or of another study, elsewhere, once or many times."""
    source = chance.choice((text, *STUDIES))
    begin = chance.randrange(max(len(source), 1))
    piece = source[begin : begin + chance.randint(1, 60)] * chance.choice((1, 1, 1, 2, 50))
    place = chance.randrange(len(text) + 1)
    return text[:place] + piece + text[place:]


def outcome(mutant: Mutant, folder: Path) -> str:
    """Return "accepted", or the words that the file is refused with; whatever else is raised passes through."""
    path = folder / "mutant.toml"
    path.write_bytes(mutant.content)
    try:
        if mutant.kind == "study":
            len(wb.plan_study(path))
        else:
            wb.load_species(path)
    except wb.WingbeatError as error:
        return str(error)
    return "accepted"


def _timed(mutant: Mutant, folder: Path) -> tuple[str, float]:
    """Return how a file ends, and milliseconds; asked again where it took long, for the machine has other work."""
    end, spent = "", []
    while not spent or (len(spent) < 3 and spent[-1] > LONG):
        begun = time.perf_counter()
        try:
            end = "accepted" if outcome(mutant, folder) == "accepted" else "explained"
        except Exception:
            end = "traceback"
            print(f"--- {mutant.kind}\n{mutant.content.decode(errors='replace')}")
            traceback.print_exc()
        spent.append(1e3 * (time.perf_counter() - begun))
    return end, min(spent)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--count", type=int, default=10_000)
    arguments.add_argument("--seed", type=int, default=0)
    given = arguments.parse_args()
    ends: dict[str, Counter[str]] = {"study": Counter(), "species": Counter()}
    spent: dict[str, list[float]] = {"study": [], "species": []}
    with tempfile.TemporaryDirectory() as name:
        for mutant in mutants(given.count, given.seed):
            end, milliseconds = _timed(mutant, Path(name))
            spent[mutant.kind].append(milliseconds)
            ends[mutant.kind][end] += 1
    for kind, times in spent.items():
        told = ", ".join(f"{count} {end}" for end, count in sorted(ends[kind].items()))
        over = sum(t > LONG for t in times)
        print(f"{kind}: {told}; median {sorted(times)[len(times) // 2]:.1f} ms, ", end="")
        print(f"longest {max(times):.1f} ms, {over} over {LONG:g} ms")


if __name__ == "__main__":
    main()
