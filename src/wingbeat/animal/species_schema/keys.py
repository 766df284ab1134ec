"""The numbers of a species: their paths and shapes, with units and meanings from the table of names."""

from __future__ import annotations

from typing import NamedTuple

from wingbeat._base import FIRST_ORDER, HARMONIC_NAMES, find, plain


class Key(NamedTuple):
    """One number of a species: its path as in the orbit record, SI unit, meaning and shape."""

    path: str
    unit: str
    meaning: str
    required: bool = True
    # or "stations" (a number or a list), "vector" (three numbers), "list" (any count), "edge" (at least two),
    # "cover" and "colour" (texts)
    shape: str = "number"

    @property
    def name(self) -> str:
        """The last part of the path."""
        return self.path.rpartition(".")[2]

    @property
    def part(self) -> str:
        """The part of the vehicle, or the record, that it belongs to."""
        return self.path.split(".")[-2]

    @property
    def spellings(self) -> tuple[str, ...]:
        """The paths that a file may use; an angle may also have its name in degrees."""
        return (self.path, f"{self.path}_deg") if self.unit == "rad" else (self.path,)


def _key(path: str, required: bool = True, shape: str = "number") -> Key:
    """Return the key of a path, with unit and meaning from the nomenclature."""
    term = find(path)
    assert term is not None, path
    return Key(path, plain(term.unit), term.definition, required, shape)


KEYS = (
    _key("vehicle.mass", False),
    _key("vehicle.body.mass", False),
    _key("vehicle.body.pitch_inertia"),
    _key("vehicle.body.drag_area", False),
    _key("vehicle.wing.semi_span"),
    _key("vehicle.wing.chord", shape="stations"),
    _key("vehicle.wing.mass"),
    _key("vehicle.wing.mass_exponent", False),
    _key("vehicle.wing.shoulder", False, "vector"),
    _key("vehicle.wing.stroke_plane_angle", False),
    *(_key(f"vehicle.tail.{name}") for name in ("area", "arm", "lift_slope")),
    *(_key(f"vehicle.tail.{name}", False) for name in ("drag_coefficient", "height", "incidence")),
    *(_key(f"vehicle.muscle.{name}") for name in ("mass", "elevator_share", "strain_per_angle", "max_strain_rate")),
    *(_key(f"vehicle.muscle.{name}", False) for name in ("isometric_stress", "curvature")),
    *(_key(f"vehicle.motor.{name}") for name in ("torque_constant", "resistance", "gear_ratio")),
    *(
        _key(f"vehicle.motor.{name}", False)
        for name in ("rotor_inertia", "no_load_current", "gear_efficiency", "crank")
    ),
    *(_key(f"vehicle.springs.{name}", False) for name in ("stiffness", "rest_angle", "series_compliance")),
    *(
        _key(f"wingbeat.{name}")
        for name in ("frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")
    ),
    *(
        _key(f"wingbeat.{name}", False)
        for name in (
            *("span_retraction", "twist_ratio", "fold_amplitude", "wrist", "pitch_phase", "downstroke_fraction"),
            *("sweep_mean", "sweep_amplitude", "sweep_phase", "stroke_plane_tilt", "tail_tilt"),
            *("chord_retraction", "twist_mean"),
        )
    ),
    *(_key(f"wingbeat.{law}_harmonics", False, "list") for law in FIRST_ORDER),
    *(_key(f"air.{name}", False) for name in ("density", "viscosity", "gravity")),
)
# Parts that a vehicle may lack; a vehicle without a part has none of the part's numbers.
PARTS = {
    part: tuple(key for key in KEYS if key.path.startswith(f"vehicle.{part}."))
    for part in ("tail", "muscle", "motor", "springs")
}
TAIL_PATHS = (*(key.path for key in PARTS["tail"]), "wingbeat.tail_tilt")
# Limits along the whole path, not only at its start.
PATH = (_key("path.body_pitch"), _key("path.flap"))
# The wrist cannot be free: each strip is wholly arm or hand, so an orbit changes in steps with the wrist and has no
# derivative by which to search.
FREE = (
    *(
        _key(f"free.{key.name}")
        for key in KEYS
        if key.path.startswith("wingbeat.") and key.path != "wingbeat.wrist" and key.shape == "number"
    ),
    *(_key(f"free.{name}") for name in HARMONIC_NAMES),
)
# How the animal looks. No model reads it.
TRUNK = ("body_length", "body_width", "body_depth")
EXTREMITIES = ("head_length", "bill_length", "ear_length", "tail_length", "tail_width")  # 0 without one
SHAPE = (
    *(_key(f"shape.{name}", shape="edge") for name in ("leading_edge", "trailing_edge")),
    *(_key(f"shape.{name}", False) for name in ("camber", "thickness")),
    *(_key(f"shape.{name}") for name in TRUNK),
    *(_key(f"shape.{name}", False) for name in EXTREMITIES),
)
COVERS = ("feathers", "membrane", "film")
COLOURS = ("back", "breast", "head", "wing", "wing_tip", "bill")
COLOUR = "#[0-9a-fA-F]{6}"  # the form of each, as a regular expression
NO_COLOUR = ("must be a colour", 'write it as "#rrggbb"')  # the fault of another form, and how to fix it
LOOKS = (
    _key("shape.cover", shape="cover"),
    *(_key(f"shape.colours.{name}", shape="colour") for name in COLOURS),
)
# What is read off a beat and judged beside the certificate. The ranges of frequency and flap amplitude stand with
# their numbers, under wingbeat.
PLAUSIBLE = tuple(
    _key(f"plausible.{name}", False)
    for name in (
        *("positive_power_per_mass", "peak_activation", "peak_force_over_weight", "mean_body_pitch"),
        *("body_pitch_range", "strouhal", "reynolds"),
    )
)
