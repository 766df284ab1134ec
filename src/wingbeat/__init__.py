"""wingbeat: how an animal or a flapping robot must beat its wings to fly, and how sure we are.

`dir(wingbeat)` lists where to begin; `wingbeat.options`, `wingbeat.stability`, `wingbeat.studies` and the other
packages hold the rest. `__init__.pyi` says where every name lives; a name is loaded when it is first used, so that
importing wingbeat is cheap.

>>> import wingbeat as wb
>>> wb.load_species("pigeon").vehicle.wing.semi_span
0.279
"""

from __future__ import annotations

from wingbeat._version import __version__ as __version__

# What most users need, in groups. Each of the other names of the stub is in one of the packages at the end.
_GROUPS = {
    "an animal or a robot": "load_species species_names bird bat robot Species",
    "its parts": "Vehicle Body Wing Tail Muscle Motor Springs Air Wingbeat",
    "a wingbeat that carries it": "OrbitProblem Constraint solve_orbit solve_orbits Orbit Status load_orbit",
    "many of these": "solve_curve Curve load_curve glide_polar pareto_front plan_study",
    "what it depends on": "sensitivities uncertainty_by_samples power_account trace_terms",
    "flight and control": "FlightModel State simulate Flight linearise feedback",
    "results elsewhere": "export",
    "errors": "WingbeatError",
    "packages": "aero experiment models objectives options plots stability studies viewer winds",
}
__all__ = [name for names in _GROUPS.values() for name in names.split()]  # pyright: ignore
_LISTED = "\n".join(f"* {title}: {names}" for title, names in _GROUPS.items())
__doc__ = f"{__doc__ or ''}\nWhere to begin:\n\n{_LISTED}\n"


def __getattr__(name: str) -> object:
    import lazy_loader  # not before it is needed: the command line must be ready for Ctrl-C

    load, _, names = lazy_loader.attach_stub(__name__, __file__)
    if name not in names:
        raise AttributeError(f"module 'wingbeat' has no attribute {name!r}")
    globals()["__getattr__"] = load
    return load(name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
