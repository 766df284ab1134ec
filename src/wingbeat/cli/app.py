"""The commands by name, and the one place where errors become lines on stderr and exit codes."""

from __future__ import annotations

import errno
import re
import sys
from collections.abc import Sequence

from cyclopts import App, CycloptsError, UnknownCommandError, UnusedCliTokensError

from wingbeat._base import WingbeatError, __version__, suggest
from wingbeat._base.files import POLAR_SUFFIXES
from wingbeat.cli.process import (
    EXIT_BAD_INPUT,
    EXIT_BROKEN_PIPE,
    EXIT_GOOD,
    EXIT_INTERRUPTED,
    EXIT_SYSTEM,
    StdoutError,
    drop_stdout,
    memory_shortage,
)

HELP = """How an animal or a flapping robot must beat its wings to fly.

Exit codes: 0 success, 2 bad input, 3 no certified orbit (infeasible or not converged)."""

# Import strings and help texts side by side: `--help` must not import a command to describe it.
COMMANDS = {
    "orbit": "Find and certify the wingbeat that flies at a given speed.",
    "uncertainty": "Compute the uncertainty of an orbit's frequency, power and stability.",
    "glide": "Find the steady glides with the wings held still: sink, glide ratio, trim.",
    "curve": "Compute power and frequency against speed, and the characteristic speeds.",
    "pareto": "Compute what a limit costs, such as power for stability: a Pareto front.",
    "terms": "Follow the best wingbeat while the share of a term of the air loads rises from 0 to 1.",
    "stability": "Find what grows and what decays when an orbit is disturbed.",
    "feedback": "Compute the feedback that holds an orbit, and fly it through a gust.",
    "manoeuvre": "Fly from one speed to another: the commands of each beat, and feedback on the way.",
    "study": "Solve a grid or sample of problems; an interrupted study resumes.",
    "simulate": "Fly from a given state with a given wingbeat.",
    "species": "Show the built-in animals, or your own species file, with the source of every number.",
    "polar": "Print or save the lift and drag coefficients over angle of attack.",
    "film": "Turn tracked points into the angles of a wing: a film.",
    "reduce": "Turn load-cell records into lift, drag, moment and centre-of-pressure coefficients.",
    "fit": "Fit a coefficient model to measured coefficients, with confidence intervals.",
    "validate": "Compare computed air loads, or an animal's computed flights, with measurements.",
    "show": "Print a saved result.",
    "plot": "Draw a saved result.",
    "compare": "Compare the air loads of a saved orbit with those of a vortex lattice.",
    "export": "Write the gait of a saved orbit for robots, MATLAB, motion capture or MuJoCo.",
    "view": "Show a saved flight in motion, in a page or an animated picture.",
    "explore": "Write an explorer that needs no server: drag along the power curve, and the animal flies.",
    "app": "Open the explorer in a browser: choose an animal, drag its speed, and see it fly.",
    "paper": "Draw the figures of Su et al. and judge their claims.",
    "bench": "Measure how fast this machine solves.",
}

# Limits of one word of the command line: its length (longer than any path), and how deep its lists are nested.
_LONGEST = 10_000
_DEEPEST = 50
# Longest line on stderr, and longest word in it, most often a value of the user's; the middle of a longer one
# is left out. Lists of known names are long lines of short words.
_LINE, _WORD = 2000, 400
_LONG_WORD = re.compile(rf"\S{{{_WORD},}}")

# Commands of the two packages that know this one; this one knows them by these names alone.
_COMPANIONS = {
    "paper": "wingbeat_evidence",
    "validate": "wingbeat_evidence",
    "compare": "wingbeat_evidence",
    "explore": "wingbeat_explorer",
    "app": "wingbeat_explorer",
}


def module_of(name: str) -> str:
    """Return the module of a command."""
    return f"{_COMPANIONS[name]}.commands.{name}" if name in _COMPANIONS else f"wingbeat.cli.{name}"


def build_app(chosen: str = "") -> App:
    """Return the command line with every command registered and none imported.

    Only the chosen command is imported. Its help is then its own docstring, not its line in the list of commands.
    """
    app = App(name="wingbeat", version=__version__, help=HELP, suppress_keyboard_interrupt=False)
    for name, text in COMMANDS.items():
        app.command(f"{module_of(name)}:{name}", name=name, **({} if name == chosen else {"help": text}))
    return app


def main(argv: Sequence[str] | None = None, *, app: App | None = None) -> int:
    """Run one command line and return its exit code: 0 good, 2 bad input, 3 nothing certified.

    Parameters
    ----------
    argv : the words after the program's name; those of the process if not given.
    app : the commands to choose from; all of them if not given.

    Returns
    -------
    The exit code: the one that the command returns, or 0 if it returns none.
    """
    try:
        code = _outcome(list(sys.argv[1:] if argv is None else argv), app)
        sys.stdout.flush()
    except StdoutError as error:
        drop_stdout()
        if error.number == errno.EPIPE:
            return EXIT_BROKEN_PIPE
        return _complain([f"cannot write to standard output: {error}"], EXIT_SYSTEM)
    return code


def _outcome(argv: list[str], app: App | None) -> int:
    """Run a command line; print what goes wrong on stderr, one line for each fault."""
    for word in argv:
        rule = ""
        if len(word) > _LONGEST:
            rule = f"has {len(word)} characters, more than {_LONGEST}; put long values into a file"
        elif word.startswith("[" * _DEEPEST):
            rule = f"is a list nested more than {_DEEPEST} levels deep; give a plain list of numbers"
        if rule:
            return _complain([f"the argument {word[:40]!r}... {rule}"], EXIT_BAD_INPUT)
    if argv and argv[0] in COMMANDS and (shortage := memory_shortage(argv[0])) is not None:
        return _complain([shortage], EXIT_SYSTEM)
    try:
        return _run(_with_families(argv), app)
    except MemoryError:
        fix = "close other programs or choose a smaller problem"
        return _complain([f"there is not enough memory; {fix}"], EXIT_SYSTEM)
    except KeyboardInterrupt:
        return _complain(["interrupted"], EXIT_INTERRUPTED)
    except WingbeatError as error:
        return _complain(str(error).splitlines() or [type(error).__name__], EXIT_BAD_INPUT)
    except SystemExit as error:
        return error.code if isinstance(error.code, int) else EXIT_GOOD if error.code is None else 1


def _with_families(argv: list[str]) -> list[str]:
    """Return the words with ``--aero a.pol b.pol`` written as ``--aero a.pol --aero b.pol``.

    A shell turns ``--aero *.pol`` into such words, and an option that took all words would take the species, too.
    """
    words: list[str] = []
    for i, word in enumerate(argv):
        follows = i > 1 and argv[i - 1].lower().endswith(POLAR_SUFFIXES) and word.lower().endswith(POLAR_SUFFIXES)
        words += ["--aero", word] if follows and words[-2] == "--aero" else [word]
    return words


def _run(argv: list[str], app: App | None) -> int:
    app = app or build_app(argv[0] if argv else "")
    try:
        result = app(argv, exit_on_error=False, print_error=False, result_action="return_value")
    except CycloptsError as error:
        text = " ".join(str(error).split())
        if isinstance(error, UnknownCommandError) and not error.command_chain and error.unused_tokens:
            # cyclopts would import every command to look for the nearest: seconds for a slip of the finger.
            word = error.unused_tokens[0]
            kind = "option" if word.startswith("-") else "command"
            text = f"unknown {kind} {word!r}; {suggest(word, COMMANDS, most=1)}"
        elif isinstance(error, UnusedCliTokensError) and error.unused_tokens:
            words = " ".join(repr(word) for word in error.unused_tokens)
            fix = "leave out what is too much, or write the option before it; a name with spaces needs quotes"
            text = f"{argv[0]} has no place for {words}; {fix}"
        return _complain([text], EXIT_BAD_INPUT)
    except ImportError as error:
        absent = error.__cause__.name if isinstance(error.__cause__, ModuleNotFoundError) else None
        for name in COMMANDS:
            if absent == module_of(name):
                return _complain([f"the command '{name}' is not part of this installation"], EXIT_BAD_INPUT)
        raise
    return result if isinstance(result, int) else EXIT_GOOD


def _complain(lines: list[str], code: int) -> int:
    for line in lines:
        shown = "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in line)
        shown = _LONG_WORD.sub(lambda found: f"{found[0][: _WORD // 2]} ... {found[0][-_WORD // 2 :]}", shown)
        if len(shown) > _LINE:
            shown = f"{shown[: _LINE // 2]} ... {shown[-_LINE // 2 :]}"
        print(f"error: {shown}", file=sys.stderr)
    return code
