"""``wingbeat bench``: how fast this machine solves."""

from __future__ import annotations

from typing import Annotated, Any

from wingbeat._base import FaultList
from wingbeat.cli.arguments import Whole, flag, option
from wingbeat.cli.terminal import deliver, plain_console, progress_bar


def bench(
    *,
    batch: Annotated[Whole, option("Mixed problems in the batch.")] = 1024,
    json: Annotated[bool, flag("Print JSON alone.")] = False,
) -> None:
    """Measure how fast this machine solves orbits, on one core, in about a minute.

    No orbit starts from the result of another. The time of an orbit includes its certificate.
    """
    from wingbeat.bench import measure

    faults = FaultList()
    faults.whole("--batch", batch, 1, 100_000)
    faults.raise_if_any()
    with progress_bar("measuring") as progress:
        found = measure(batch, progress)
    deliver(found, lambda: _print(found), json=json)


def _print(found: dict[str, Any]) -> None:
    from rich.table import Table

    table = Table(box=None, show_header=False, padding=(0, 2))
    rows = [
        ("equations of motion once, per flight, 1024 at once", f"{found['rhs_ns']:.0f} ns"),
        ("flight with derivatives", f"{found['jacobian_ms']:.2f} ms"),
    ]
    for animal in found["solve_ms"]:
        rows += [
            (f"one orbit, {animal}", f"{found[f'{animal}_ms']:.1f} ms"),
            ("  solver and correction", f"{found['solve_ms'][animal]:.1f} ms"),
            ("  certificate", f"{found['certify_ms'][animal]:.1f} ms"),
        ]
    rows += [
        (f"one orbit in a batch of {found['batch']} mixed problems", f"{found['batch_ms']:.1f} ms"),
        ("certified orbits of the batch", str(found["batch_certified"])),
        *((name, version) for name, version in found["versions"].items()),
        ("device", found["device"]),
    ]
    for row in rows:
        table.add_row(*row)
    plain_console().print(table)
