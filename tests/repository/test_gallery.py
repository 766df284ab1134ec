"""Each example of the gallery asks a question, answers it with a number, and draws a figure with labelled axes."""

import ast
import importlib.util
import runpy

import matplotlib
import matplotlib.pyplot as plt
import pytest

from tests.helpers.places import ROOT

GALLERY = ROOT / "examples" / "gallery"
EXAMPLES = sorted(GALLERY.glob("*.py"))
FEWEST = 15
MOST_LINES = 100


def names(path):
    return path.stem


@pytest.fixture
def drawn_nowhere(monkeypatch, tmp_path):
    """Draw without a screen, in the folder of the gallery as its builder does, and write to a folder that goes."""
    backend = matplotlib.get_backend()
    matplotlib.use("Agg")
    plt.close("all")
    monkeypatch.chdir(GALLERY)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    yield
    plt.close("all")
    matplotlib.use(backend)


@pytest.fixture(scope="module")
def runner():
    """The program that runs an example in a clone and saves its figures."""
    spec = importlib.util.spec_from_file_location("run_gallery", GALLERY.parent / "run_gallery.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def title_and_why(path):
    """Return the title of an example, the line below it, and the paragraph that follows."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))
    assert text is not None
    title, line, *rest = text.splitlines()
    return title, line, "\n".join(rest).strip()


def test_the_gallery_is_numbered_without_gaps():
    assert len(EXAMPLES) >= FEWEST
    assert [path.stem.split("_")[:2] for path in EXAMPLES] == [
        ["plot", f"{number:02}"] for number in range(1, len(EXAMPLES) + 1)
    ]
    assert len({title_and_why(path)[0] for path in EXAMPLES}) == len(EXAMPLES)


@pytest.mark.parametrize("path", EXAMPLES, ids=names)
def test_an_example_asks_a_question_and_says_why(path):
    title, line, why = title_and_why(path)
    assert title.endswith("?")
    assert line == "=" * len(title)
    assert why
    assert "\n\n" not in why, "one paragraph"


@pytest.mark.parametrize("path", EXAMPLES, ids=names)
def test_an_example_is_short_cells_that_check_and_print_an_answer(path):
    text = path.read_text(encoding="utf-8")
    asserts = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Assert)]
    assert len(text.splitlines()) <= MOST_LINES
    assert text.count("\n# %%\n") >= 3
    assert asserts
    *_, last = text.split("\n# %%\n")
    assert last.startswith("# The answer:")
    assert "print(" in last


@pytest.mark.slow
@pytest.mark.parametrize("path", EXAMPLES, ids=names)
def test_an_example_runs_and_draws_labelled_axes(path, runner, drawn_nowhere, capsys):
    values = runpy.run_path(str(path), run_name="__main__")
    figures = runner.figures_of(values)
    assert figures
    for figure in figures:
        figure.canvas.draw()
        assert figure.axes
        for axes in figure.axes:
            assert axes.get_xlabel() or axes.get_ylabel()
        assert any("[" in axes.get_xlabel() + axes.get_ylabel() for axes in figure.axes), "units"
    assert len(capsys.readouterr().out.splitlines()) >= 1


def test_a_clone_lists_the_examples_and_saves_the_figure_of_one(
    runner, drawn_nowhere, tmp_path, monkeypatch, capsys
):
    assert runner.main([]) == 0
    assert capsys.readouterr().out.splitlines()[3] == " 4  Does the pigeon beat as fast as the paper says?"
    quick = "import matplotlib.pyplot as plt\nfor _ in range(2):\n    plt.figure()\nprint('the answer')\n"
    (tmp_path / "plot_01_quick.py").write_text(quick)
    monkeypatch.setattr(runner, "GALLERY", tmp_path)
    monkeypatch.chdir(tmp_path)
    assert runner.main(["1"]) == 0
    told = "the answer\nwrote plot_01_quick_1.png\nwrote plot_01_quick_2.png\n"
    assert capsys.readouterr().out == told
    assert (tmp_path / "plot_01_quick_2.png").read_bytes().startswith(b"\x89PNG")
    assert runner.main(["7"]) == 2
    assert "no example has the number 7; use 1 to 1" in capsys.readouterr().err
