"""A solver that gives up soon, for tests of what is done with a problem without an orbit, not of what is found."""

import functools

import wingbeat as wb

# Every change is still tried, each as far as the advice would move it; only the searches with it are cut short.
HASTY = wb.SolverOptions(
    search=wb.SearchOptions(most_starts=2),
    diagnosis=wb.DiagnosisOptions(far_iterations=2, back_iterations=2, back_times=1),
)


def make_hasty(monkeypatch):
    """Let the commands that search for orbits and curves do so with these options."""
    for command in ("orbit", "uncertainty"):
        solve = functools.partial(wb.solve_orbit, options=HASTY)
        monkeypatch.setattr(f"wingbeat.cli.{command}.solve_orbit", solve)
    monkeypatch.setattr("wingbeat.cli.curve.solve_curve", functools.partial(wb.solve_curve, options=HASTY))
