"""Arrays of the physics have the shapes that their annotations say, in every call of every kernel."""

import functools
import importlib
import inspect
import pkgutil
import subprocess
import sys
import types
import typing
from typing import Any

import jax
import numpy as np
import pytest
from jaxtyping import AbstractArray, jaxtyped

import wingbeat as wb
from wingbeat import aero, mechanics
from wingbeat._jax import shapes
from wingbeat._jax.exported import StoredFunction
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel
from wingbeat.animal.vehicle import Wing
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.orbits import flight
from wingbeat.orbits.problem.outputs import ALL_FIELDS

PIGEON = wb.load_species("pigeon")
# What is no array, such as a user's function, or an array of any shape.
NO_ARRAY = {
    "about",
    "aero",
    "args",
    "fit",
    "function",
    "given",
    "kernel",
    "like",
    "model",
    "numbers",
    "stages",
    "torques",
    "vectors",
    "xp",
}
# What is refused unless it is a number, a pair or a name.
CHECKED_FIRST = {"blend_width_deg", "extension", "hinge", "limits"}
# `padded` adds strips; those of `air_forces` come with the axes of time first, for all others these are the last.
OTHER_STRIPS = {"air_forces", "padded"}


def modules():
    names = ["wingbeat.animal.kinematics"]
    for package in (aero, mechanics, flight):
        names += [f"{package.__name__}.{info.name}" for info in pkgutil.iter_modules(package.__path__)]
    return [importlib.import_module(name) for name in names]


def plain(function):
    """Return the Python function inside one that JAX or the store of programs wraps."""
    return inspect.unwrap(function)


@functools.cache
def hints_of(thing):
    for_hints_only = {"Kernel": Kernel, "CoefficientModel": CoefficientModel, "Wing": Wing}
    return typing.get_type_hints(thing, localns={**vars(shapes), **for_hints_only})


def fits(value, hint) -> bool:
    """Say whether a value has the shape of its annotation, and all that it holds have theirs."""
    if hint is Any:
        return True
    if isinstance(hint, types.UnionType):
        return any(fits(value, one) for one in typing.get_args(hint))
    if hint is types.NoneType:
        return value is None
    if isinstance(hint, type) and issubclass(hint, AbstractArray):
        return isinstance(np.asarray(value) if isinstance(value, float) else value, hint)
    if typing.get_origin(hint) is tuple:
        if value is None:
            return False
        kinds, values = typing.get_args(hint), tuple(value)
        kinds = kinds[:1] * len(values) if kinds[-1:] == (Ellipsis,) else kinds
        return len(kinds) == len(values) and all(map(fits, values, kinds))
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        left_out = {name for name, default in value._field_defaults.items() if default is getattr(value, name)}
        # Alternatives last: the others tell which of them it must be.
        kinds = sorted(hints_of(type(value)).items(), key=lambda one: isinstance(one[1], types.UnionType))
        return all(name in left_out or fits(getattr(value, name), kind) for name, kind in kinds)
    return True


def checked(function, calls):
    """Return the function with every argument and result compared with its annotation."""
    inner = plain(function)
    hints, signature, name = hints_of(inner), inspect.signature(inner), inner.__qualname__

    @functools.wraps(inner)
    def check(*args, **kwargs):
        with jaxtyped("context"):
            for key, value in signature.bind(*args, **kwargs).arguments.items():
                variadic = signature.parameters[key].kind is inspect.Parameter.VAR_POSITIONAL
                for one in value if variadic else (value,):
                    assert fits(one, hints.get(key, Any)), f"{name}: {key} is {jax.tree.map(np.shape, one)}"
            result = body(*args, **kwargs)
            if name not in OTHER_STRIPS:
                assert fits(result, hints["return"]), f"{name} returns {jax.tree.map(np.shape, result)}"
        calls.add(f"{inner.__module__}.{name}")
        return result

    # Traced here and now: a program in memory or on disk would not call the kernels again.
    body = inner if isinstance(function, StoredFunction) else function
    check.bind = lambda *first, **static: functools.partial(check, *first, **static)
    return check


@pytest.fixture
def calls(monkeypatch):
    """Check every call of the kernels from now on; return the names of those that were called."""
    seen, wrappers = set(), {}
    own = [module.__name__ for module in modules()]
    for module in modules():
        for name, thing in list(vars(module).items()):
            inner = plain(thing) if callable(thing) and not isinstance(thing, type) else None
            if inspect.isfunction(inner) and inner.__module__ in own:
                wrappers.setdefault(inner, checked(thing, seen))
                monkeypatch.setattr(module, name, wrappers[inner])
    return seen


WINGBEATS = {
    "paper": {},
    "every law": {
        "fold_amplitude": 0.3,
        "pitch_phase": 0.2,
        "downstroke_fraction": 0.55,
        "sweep_mean": 0.1,
        "sweep_amplitude": 0.2,
        "stroke_plane_tilt": 0.1,
        "flap_harmonics": (0.05, 0.02),
        "span_harmonics": (0.02, 0.01),
    },
}
AIR = {
    "paper": {},
    "every law": {
        "airspeed": "full",
        "force_point": "centre-of-pressure",
        "unsteady": "thin-aerofoil",
        "inflow": "momentum",
    },
}


@pytest.fixture(params=WINGBEATS)
def flown(request):
    """A flight model and a wingbeat: the paper's alone, and every law at once."""
    loads = aero.BladeElement(aero.SuFan(), **AIR[request.param])
    values = {name: WINGBEATS[request.param].get(name, value) for name, value in vars(PIGEON.wingbeat).items()}
    return wb.FlightModel(PIGEON.vehicle, loads, velocity=(10.0, 0.0)), wb.Wingbeat(**values)


def traced(name, *args, **static):
    """Trace a kernel, which calls all those below it; nothing is compiled."""
    module, _, function = name.rpartition(".")
    kernel = getattr(importlib.import_module(module), function)
    return jax.eval_shape(functools.partial(kernel, **static), *args)


@pytest.mark.slow
def test_every_kernel_gets_and_gives_the_shapes_it_says(flown, calls):
    model, wingbeat = flown
    phases, q = np.linspace(0.0, 1.0, 5), np.zeros((5, 5))
    state = wb.State(*(np.zeros(5) for _ in wb.State._fields))
    traced("wingbeat.mechanics.flight_loads.flight_loads", model, wingbeat, state, phases)
    traced("wingbeat.mechanics.wing_points.strip_corners", model, wingbeat, state, phases)
    traced("wingbeat.mechanics.flights._fly", model, wingbeat, np.zeros(6), phases, np.array(1e-10))
    many = np.zeros((6, 3)), np.zeros(3), np.zeros((3, 9, 2)), np.array(0.01), np.zeros(5)
    traced("wingbeat.mechanics.flights.fly_beat_in_steps", model, wingbeat, *many)
    traced("wingbeat.mechanics.glide._required", model, wingbeat, np.zeros(5))
    eom = importlib.import_module("wingbeat.mechanics.equations_of_motion")
    for function, rows in ((eom._terms, 0), (eom._air_forces, 0), (eom._torque, 1)):
        jax.eval_shape(lambda *a, f=function: f(model, wingbeat, *a), *q[:2], np.array(0.1), *q[:rows])
    torques = np.zeros(()), np.zeros(())
    jax.eval_shape(eom.accelerations_from_torques, model, wingbeat, *q[:2], np.array(0.1), torques)

    free = ("frequency", "flap_mean")
    step = np.zeros(2), np.zeros(4), np.array(0.0), np.array(1.0)
    traced("wingbeat.orbits.flight.period.fly_part", model, wingbeat, *step, free=free, components=1, stroke=True)
    path, tangents = np.zeros((4, 33)), np.zeros((6, 4, 33))
    part = np.zeros(2), path, tangents, np.zeros(2), np.zeros(2)
    traced("wingbeat.orbits.flight.time_series._part", model, wingbeat, *part, free=free, fields=ALL_FIELDS)
    traced(
        "wingbeat.orbits.flight.time_series.flown_beat", model, wingbeat, np.linspace(0, 1, 33), path.T, np.zeros(2)
    )
    traced(
        "wingbeat.orbits.flight.certificate._state_maps",
        model,
        wingbeat,
        np.zeros(64),
        np.ones(64),
        np.zeros((64, 4)),
    )
    for kernel in ("highest", "peaks"):
        traced(f"wingbeat.orbits.flight.beat.{kernel}", np.zeros((33, 7)))

    for name in (
        "wingbeat.aero.strip_forces.strip_forces",
        "wingbeat.animal.kinematics.with_harmonics",
        "wingbeat.animal.kinematics.unpack",
        "wingbeat.mechanics.flight_model.accelerations",
        "wingbeat.mechanics.wing_shape.lateral_corner",
        "wingbeat.mechanics.hinge_torques.hinge_loads",
        "wingbeat.mechanics.wing_motion.wing_motion",
        "wingbeat.mechanics.wing_points.point_motion",
        "wingbeat.orbits.flight.beat.mean_positive",
        "wingbeat.orbits.flight.period._chain",
        "wingbeat.orbits.flight.period.least_distances",
    ):
        assert name == "wingbeat.orbits.flight.beat.mean_positive" or name in calls, name
    assert len(calls) > 60


@pytest.mark.parametrize("extension", aero.EXTENSIONS)
def test_coefficients_have_the_shape_of_the_angles(extension):
    kernels = [aero.Wang2004(extension).kernel(), aero.coefficients_of(lambda a: (jax.numpy.sin(a), 1.0)).kernel()]
    for kernel in kernels:
        for alpha in (np.array(0.1), np.zeros(3), np.zeros((2, 3))):
            for method in ("lift_drag", "centre_of_pressure"):
                with jaxtyped("context"):
                    hints = hints_of(getattr(Kernel, method))
                    assert fits(alpha, hints["alpha"])
                    assert fits(getattr(kernel, method)(alpha), hints["return"])


@pytest.mark.slow
def test_a_wrong_shape_is_found(flown, calls):
    model, wingbeat = flown
    body = importlib.import_module("wingbeat.mechanics.state_rates").body_rates
    table = motion_table(model, wingbeat, np.linspace(0.0, 1.0, 5))
    body(model, table, np.zeros((4, 5)))
    with pytest.raises(AssertionError, match=r"body_rates: state is \(4, 6\)"):
        body(model, table, np.zeros((4, 6)))
    with pytest.raises(AssertionError, match="body_rates: motion"):
        body(model, table._replace(pitch=table.pitch[:3]), np.zeros((4, 5)))


def test_dimensions_of_one_name_have_one_size():
    with jaxtyped("context"):
        assert fits(np.zeros((3, 5)), shapes.PerStrip)
        assert fits(np.zeros((3, 1)), shapes.PerStripBroadcast)
        assert not fits(np.zeros((4, 5)), shapes.PerStrip)
        assert not fits(np.zeros(6), shapes.Phases)
    with jaxtyped("context"):
        assert not fits(np.zeros(3, dtype=int), shapes.Phases)


def test_every_array_of_the_physics_is_annotated():
    """`Any` is left for what is no array, such as a user's function, or has no shape of its own."""
    bare = []
    for module in modules():
        for name, thing in vars(module).items():
            if getattr(thing, "__module__", None) != module.__name__ or not callable(thing):
                continue
            of_record = isinstance(thing, type) and issubclass(thing, tuple)
            if of_record or inspect.isfunction(plain(thing)):
                hints = hints_of(thing if of_record else plain(thing))
                bare += [
                    f"{module.__name__}.{name}: {key}"
                    for key, hint in hints.items()
                    if hint is Any and key != "return"
                ]
    assert [one for one in bare if one.split(": ")[1] not in NO_ARRAY | CHECKED_FIRST] == []


def test_the_physics_starts_without_the_library_of_shapes():
    code = "import sys, wingbeat.results.orbit; print([name for name in sys.modules if 'jaxtyping' in name])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout == "[]\n"
