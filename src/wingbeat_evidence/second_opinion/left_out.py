"""What each code leaves out, in words for a report."""

from __future__ import annotations

LATTICE = (
    "profile drag and every other effect of viscosity",
    "separation, stall and leading-edge vortices",
    "the roll-up of the wake, which stays where it was shed",
    "the body, the tail, and the thickness of the wings, and their camber but for the angle without lift",
)


def left_out(unsteady: str, inflow: str, wake: str = "none") -> dict[str, list[str]]:
    """Return the effects that our loads with these terms leave out, and those that the lattice leaves out.

    >>> left_out("thin-aerofoil", "momentum")["ours"]
    ['the wake of earlier parts of the beat (its lag)', "effect of one strip's loads on its neighbours"]
    >>> left_out("thin-aerofoil", "momentum", "jones-section")["ours"]
    ["effect of one strip's loads on its neighbours"]
    """
    ours = ["effect of one strip's loads on its neighbours"]
    if wake == "none":
        ours.insert(0, "the wake of earlier parts of the beat (its lag)")
    if inflow == "none":
        ours.insert(0, "induced flow, except what the measured coefficients contain")
    if unsteady == "none":
        ours.insert(0, "rotation and added mass")
    return {"ours": ours, "theirs": list(LATTICE)}
