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

# What most users need, in groups; each of the other names of the stub is in one of the packages at the end.
__all__ = [  # pyright: ignore[reportUnsupportedDunderAll]
    *("Species", "bat", "bird", "load_species", "robot", "species_names"),
    *("Air", "Body", "Motor", "Muscle", "Springs", "Tail", "Vehicle", "Wing", "Wingbeat"),
    *(
        "Constraint",
        "FlightModel",
        "Orbit",
        "OrbitProblem",
        "State",
        "Status",
        "load_orbit",
        "solve_orbit",
        "solve_orbits",
    ),
    *("Curve", "Flight", "glide_polar", "load_curve", "pareto_front", "power_account", "simulate", "solve_curve"),
    *("export", "linearise", "feedback", "plan_study", "sensitivities", "trace_terms", "uncertainty_by_samples"),
    *("WingbeatError", "__version__"),
    *("aero", "experiment", "models", "objectives", "options", "plots", "stability", "studies", "viewer", "winds"),
]


def __getattr__(name: str) -> object:
    import lazy_loader  # not before it is needed: the command line must be ready for Ctrl-C

    load, _, names = lazy_loader.attach_stub(__name__, __file__)
    if name not in names:
        raise AttributeError(f"module 'wingbeat' has no attribute {name!r}")
    globals()["__getattr__"] = load
    return load(name)


def __dir__() -> list[str]:
    return sorted(__all__)
