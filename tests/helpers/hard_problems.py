"""Random problems that mostly have no answer: any speed and climb there may be, tight bounds, odd vehicles."""

import numpy as np

import wingbeat as wb

MAKERS = (wb.bird, wb.bat, wb.robot)
# Decades that a number of the vehicle or the air is moved by, at most down and up.
_ODD = {
    "body.pitch_inertia": (-6.0, 3.0),
    "body.mass": (-1.0, 1.5),
    "wing.mass": (-1.0, 0.3),
    "wing.semi_span": (-0.5, 0.5),
    "air.density": (-2.0, 1.0),
    "air.gravity": (-2.0, 1.0),
}
_LIMITS = (
    ("peak_power<=", -3.0, 3.0),
    ("mean_positive_power<=", -3.0, 2.0),
    ("cost_of_transport<=", -3.0, 1.0),
    ("frequency>=", 0.0, 1.7),
    ("frequency<=", -0.7, 0.7),
    ("peak_flap_torque<=", -4.0, 0.0),
    ("mean_power>=", -1.0, 3.0),
)
_OBJECTIVES = ("frequency", "frequency", "frequency", "mean_positive_power", "cost_of_transport", "peak_power")


def odd_species(random):
    """Return a built-in species, or a derived one of any size, some of its numbers moved by decades."""
    if random.random() < 0.4:
        species = wb.load_species(str(random.choice(["pigeon", "bat", "barn-swallow", "common-murre"])))
    else:
        mass = 10 ** random.uniform(-3.5, 1.0)
        span = 1.1 * mass**0.38 * 2 ** random.uniform(-1.0, 1.0)
        make = MAKERS[random.integers(len(MAKERS))]
        species = make(mass=mass, wing_span=span, wing_area=span**2 / random.uniform(2.0, 14.0))
    for path, (down, up) in _ODD.items():
        if random.random() < 0.15:
            species = species.with_values(
                {path: species.numbers[_full(path)].value * 10 ** random.uniform(down, up)}
            )
    if random.random() < 0.1:
        species = species.with_values(
            {"wing.shoulder": [random.uniform(-0.2, 0.2), 0.0, random.uniform(-0.1, 0.1)]}
        )
    return species.with_values({"air.gravity": 0.0}) if random.random() < 0.04 else species


def _full(path):
    return path if path.startswith("air") else f"vehicle.{path}"


def hard_problem(random, objectives=_OBJECTIVES):
    """Return a random problem, None where what was drawn is refused."""
    try:
        species = odd_species(random)
        speed = random.choice([0.0, 1e-6, random.uniform(0, 20), random.uniform(0, 100), 99.99, 100.0])
        climb = random.choice([0.0, random.uniform(-5, 5), random.uniform(-100, 100), -100.0, 100.0])
        bounds, limits = {}, []
        for name, (low, high) in species.bounds.items():
            if random.random() < 0.35:
                width = (high - low) * 10 ** random.uniform(-4.0, 0.0)
                lower = random.uniform(low, high - width)
                bounds[name] = (lower, lower + width)
        if random.random() < 0.2:
            bounds["body_pitch"] = (-random.uniform(0.0, 0.3), random.uniform(0.01, 0.3))
        for _ in range(random.integers(0, 3) if random.random() < 0.4 else 0):
            text, least, most = _LIMITS[random.integers(len(_LIMITS))]
            limits.append(f"{text}{10 ** random.uniform(least, most):g}")
        if random.random() < 0.2:
            name = str(random.choice(list(species.bounds)))
            limits.append(f"{name}={random.uniform(*species.bounds[name]):.6g}")
            bounds.pop(name, None)
        free = ()
        if random.random() < 0.1:
            free, bounds["stroke_plane_tilt"] = (*species.free, "stroke_plane_tilt"), (-0.3, 0.3)
        return wb.OrbitProblem(
            species,
            float(speed),
            climb=float(climb),
            bounds=bounds,
            subject_to=limits,
            minimise=str(random.choice(objectives)),
            aero=wb.aero.SuFan() if random.random() < 0.5 else wb.aero.Dickinson(),
            free=free,
        )
    except wb.InvalidInputError:
        return None


def hard_problems(count, seed, objectives=_OBJECTIVES):
    """Yield so many random problems."""
    drawn = 0
    while count:
        drawn += 1
        problem = hard_problem(np.random.default_rng([seed, drawn]), objectives)
        if problem is not None:
            count -= 1
            yield problem
