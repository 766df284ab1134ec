"""Run programs of the gallery by their numbers: each prints its answer, and its figures are saved in this folder.

For example, ``uv run python examples/run_gallery.py 4`` writes ``plot_04_pigeon_as_in_the_paper.png``. The programs
themselves draw for a notebook and for the site, so they neither show nor save a figure.
"""

import runpy
import sys
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

GALLERY = Path(__file__).resolve().parent / "gallery"


def figures_of(values: dict[str, Any]) -> list[Figure]:
    """Return the figures of an example, those of pyplot and those that wingbeat's own pages are."""
    pages = [value for value in values.values() if isinstance(value, Figure)]
    found = [*map(plt.figure, plt.get_fignums()), *pages]
    return list({id(figure): figure for figure in found}.values())


def run(example: Path, folder: Path) -> list[Path]:
    """Run an example, save its figures in a folder, and return their paths."""
    plt.close("all")
    figures = figures_of(runpy.run_path(str(example), run_name="__main__"))
    ends = [""] if len(figures) == 1 else [f"_{i}" for i in range(1, len(figures) + 1)]
    written = []
    for figure, end in zip(figures, ends, strict=True):
        written.append(folder / f"{example.stem}{end}.png")
        figure.savefig(written[-1], dpi=200)
    return written


def main(numbers: list[str]) -> int:
    """Run the examples with these numbers; without a number, list them."""
    examples = {int(path.stem.split("_")[1]): path for path in sorted(GALLERY.glob("plot_*.py"))}
    if not numbers:
        for number, path in examples.items():
            print(f"{number:2}  {path.read_text(encoding='utf-8').splitlines()[1]}")
        return 0
    unknown = [text for text in numbers if not text.isdecimal() or int(text) not in examples]
    if unknown:
        print(f"error: no example has the number {', '.join(unknown)}; use 1 to {len(examples)}", file=sys.stderr)
        return 2
    matplotlib.use("Agg")
    for text in numbers:
        for path in run(examples[int(text)], Path.cwd()):
            print(f"wrote {path.name}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
