"""Plant faults in the code, one at a time, and see whether the tests find them.

    python benchmarks/mutations.py draw 60 --seed 55 -o mutations.json    # in the code as it stands
    python benchmarks/mutations.py run mutations.json -o found.csv -- -m "not slow"

A fault changes one line: a sign, a factor, a bound, a count by one, or two swapped arguments. Lines are kept by
their text, so that the same faults can be planted after code has moved; a line that stands nowhere or twice is
reported as such. The words after ``--`` go to pytest, which stops at its first failure.
"""

from __future__ import annotations

import argparse
import ast
import csv
import json
import random
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
SWAPS: dict[type, type] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.Lt: ast.LtE,
    ast.LtE: ast.Lt,
    ast.Gt: ast.GtE,
    ast.GtE: ast.Gt,
    ast.And: ast.Or,
    ast.Or: ast.And,
}
LIMIT = 1500  # s for one run of the tests


def faults_of(line: str) -> Iterator[tuple[str, str]]:
    """Yield kind and new text for every fault of one line, without indentation, that can be read by itself."""
    text, comma = line.removesuffix(","), "," * line.endswith(",")
    try:
        tree = ast.parse(text)
    except SyntaxError:
        return
    if not tree.body or isinstance(tree.body[0], ast.Import | ast.ImportFrom):
        return
    for index, _ in enumerate(ast.walk(tree)):
        for kind, changed in _changes(text, index):
            yield kind, changed + comma


def _changes(text: str, index: int) -> Iterator[tuple[str, str]]:
    fresh = ast.parse(text)
    twin = list(ast.walk(fresh))[index]
    if isinstance(twin, ast.BinOp) and type(twin.op) in SWAPS:
        kind = "sign" if isinstance(twin.op, ast.Add | ast.Sub) else "factor"
        twin.op = SWAPS[type(twin.op)]()
        yield kind, ast.unparse(fresh)
    elif isinstance(twin, ast.Compare) and type(twin.ops[0]) in SWAPS:
        twin.ops[0] = SWAPS[type(twin.ops[0])]()
        yield "bound", ast.unparse(fresh)
    elif isinstance(twin, ast.BoolOp):
        twin.op = SWAPS[type(twin.op)]()
        yield "bound", ast.unparse(fresh)
    elif isinstance(twin, ast.Constant) and type(twin.value) is int and abs(twin.value) < 100:
        twin.value += 1
        yield "off by one", ast.unparse(fresh)
    elif isinstance(twin, ast.Constant) and type(twin.value) is float and twin.value:
        twin.value *= 1.3
        yield "factor", ast.unparse(fresh)
    elif (
        isinstance(twin, ast.Call) and len(twin.args) > 1 and not any(isinstance(a, ast.Starred) for a in twin.args)
    ):
        twin.args[0], twin.args[1] = twin.args[1], twin.args[0]
        if ast.dump(ast.parse(text)) != ast.dump(fresh):
            yield "swapped arguments", ast.unparse(fresh)


def places() -> dict[str, list[tuple[Path, int]]]:
    """Return where each line of the packages stands, by its text without indentation."""
    found: dict[str, list[tuple[Path, int]]] = {}
    for file in sorted((ROOT / "src").rglob("*.py")):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines()):
            found.setdefault(line.strip(), []).append((file, number))
    return found


def docstring_lines(file: Path) -> set[int]:
    """Return the lines of a file that belong to texts that stand alone."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    texts = [n for n in ast.walk(tree) if isinstance(n, ast.Expr) and isinstance(n.value, ast.Constant)]
    return {line for text in texts for line in range(text.lineno - 1, text.end_lineno or 0)}


def draw(count: int, seed: int) -> list[dict[str, str]]:
    """Draw faults: as many of each kind, at most two a file, from lines that stand once."""
    rng = random.Random(seed)
    lines, texts = places(), {}
    kinds = ("sign", "factor", "bound", "off by one", "swapped arguments")
    pool: dict[str, list[dict[str, str]]] = {kind: [] for kind in kinds}
    for text, found in lines.items():
        if len(found) != 1 or len(text) < 12 or text.startswith(("#", '"', "@", "def ", "class ")):
            continue
        file, number = found[0]
        texts.setdefault(file, docstring_lines(file))
        if number in texts[file]:
            continue
        for kind, changed in faults_of(text):
            package = file.relative_to(ROOT / "src").parts
            home = "/".join(package[:2]) if len(package) > 2 else package[0]
            pool[kind].append({"kind": kind, "home": home, "file": str(file.name), "old": text, "new": changed})
    drawn, homes = [], Counter()
    for turn in range(count):
        choices = pool[kinds[turn % len(kinds)]]
        rng.shuffle(choices)
        choices.sort(key=lambda fault: homes[fault["home"]])  # every package in turn
        fault = choices.pop(0)
        homes[fault["home"]] += 1
        drawn.append(fault)
    return drawn


def run(faults: list[dict[str, str]], words: list[str], out: Path) -> None:
    """Plant each fault, run the tests, and write what came of it."""
    with out.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["kind", "home", "old", "new", "outcome", "seconds", "first"])
        for fault in faults:
            found = places().get(fault["old"], [])
            if len(found) != 1:
                table.writerow(
                    [fault["kind"], fault["home"], fault["old"], fault["new"], f"stands {len(found)} times", 0, ""]
                )
                continue
            path, number = found[0]
            before = path.read_text(encoding="utf-8")
            lines = before.splitlines(keepends=True)
            indent = lines[number][: len(lines[number]) - len(lines[number].lstrip())]
            lines[number] = f"{indent}{fault['new'].strip()}\n"
            begun = time.monotonic()
            try:
                path.write_text("".join(lines), encoding="utf-8")
                done = subprocess.run(
                    [sys.executable, "-m", "pytest", "-x", "-q", *words],
                    cwd=ROOT,
                    capture_output=True,
                    text=True,
                    timeout=LIMIT,
                )
                failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
                outcome, first = ("found" if done.returncode else "missed"), (failed or [""])[0][:160]
            except subprocess.TimeoutExpired:
                outcome, first = "found", "the tests do not end"
            finally:
                path.write_text(before, encoding="utf-8")
            table.writerow(
                [
                    fault["kind"],
                    fault["home"],
                    fault["old"],
                    fault["new"],
                    outcome,
                    round(time.monotonic() - begun),
                    first,
                ]
            )
            file.flush()


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("draw", "run"))
    parser.add_argument("given", help="how many to draw, or the file of those to run")
    parser.add_argument("--seed", type=int, default=55)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("words", nargs="*")
    asked = parser.parse_args()
    if asked.what == "draw":
        asked.output.write_text(json.dumps(draw(int(asked.given), asked.seed), indent=1), encoding="utf-8")
    else:
        run(json.loads(Path(asked.given).read_text(encoding="utf-8")), asked.words, asked.output)


if __name__ == "__main__":
    main()
