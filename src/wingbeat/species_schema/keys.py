"""The numbers of a species: their paths, units and meanings. The one list that all else is made from."""

from __future__ import annotations

from typing import NamedTuple

from wingbeat.harmonics import HARMONIC_NAMES, HIGHEST_ORDER

__all__ = ["FREE", "FREE_UNITS", "KEYS", "PATH", "PLAUSIBLE", "Key"]


class Key(NamedTuple):
    """One number of a species: its path as in the orbit record, SI unit, meaning and shape."""

    path: str
    unit: str
    meaning: str
    required: bool = True
    shape: str = "number"  # or "stations" (a number or a list), "vector" (three numbers), "list" (any count)

    @property
    def name(self) -> str:
        """The last part of the path."""
        return self.path.rpartition(".")[2]

    @property
    def spellings(self) -> tuple[str, ...]:
        """The paths a file may use: an angle also goes by its name in degrees."""
        return (self.path, f"{self.path}_deg") if self.unit == "rad" else (self.path,)


KEYS = (
    Key("vehicle.mass", "kg", "whole mass, body and both wings; in place of body.mass", False),
    Key("vehicle.body.mass", "kg", "mass without the wings; in place of vehicle.mass", False),
    Key("vehicle.body.pitch_inertia", "kg m2", "of the body alone, pitch axis, own centre of mass"),
    Key("vehicle.body.drag_area", "m2", "drag coefficient times frontal area; 0 is no body drag", False),
    Key("vehicle.wing.semi_span", "m", "shoulder to tip at mid-downstroke"),
    Key("vehicle.wing.chord", "m", "one number, or stations from root to tip", shape="stations"),
    Key("vehicle.wing.mass", "kg", "mass of one wing"),
    Key("vehicle.wing.mass_exponent", "1", "p in the strip masses (1 - s/L)^p; 0 is uniform", False),
    Key("vehicle.wing.shoulder", "m", "forward, left, up of the body's centre of mass", False, "vector"),
    Key("vehicle.wing.stroke_plane_angle", "rad", "from the body axis; a quarter turn is vertical", False),
    Key("wingbeat.frequency", "Hz", "wingbeats per second"),
    Key("wingbeat.flap_mean", "rad", "mean flap angle, wing up positive"),
    Key("wingbeat.flap_amplitude", "rad", "half of peak to peak"),
    Key("wingbeat.pitch_mean", "rad", "mean wing pitch at the root, leading edge up positive"),
    Key("wingbeat.pitch_amplitude", "rad", "half of peak to peak"),
    Key("wingbeat.span_retraction", "1", "share of the span drawn in at mid-upstroke", False),
    Key("wingbeat.twist_ratio", "1", "pitch at the tip over that at the root; 1 is no twist", False),
    Key("wingbeat.fold_amplitude", "rad", "drop of the hand below the arm at mid-upstroke", False),
    Key("wingbeat.wrist", "1", "span fraction of the wrist", False),
    Key("wingbeat.pitch_phase", "rad", "by how much of a turn wing pitch runs ahead of flap", False),
    Key("wingbeat.downstroke_fraction", "1", "share of the beat that the downstroke takes", False),
    Key("wingbeat.sweep_mean", "rad", "mean angle of the span ahead of the stroke plane", False),
    Key("wingbeat.sweep_amplitude", "rad", "half of peak to peak; ahead at mid-downstroke (protraction)", False),
    Key("wingbeat.sweep_phase", "rad", "by how much of a turn sweep runs ahead of that", False),
    Key("wingbeat.stroke_plane_tilt", "rad", "is added to the wing's stroke-plane angle", False),
    Key("wingbeat.flap_harmonics", "rad", f"cosine, sine of order 2, 3, .. {HIGHEST_ORDER}", False, "list"),
    Key("wingbeat.pitch_harmonics", "rad", f"cosine, sine of order 2, 3, .. {HIGHEST_ORDER}", False, "list"),
    Key("wingbeat.span_harmonics", "1", f"of span over full span: order 1, 2, .. {HIGHEST_ORDER}", False, "list"),
    Key("air.density", "kg/m3", "density of the air", False),
    Key("air.viscosity", "m2/s", "kinematic viscosity of the air", False),
    Key("air.gravity", "m/s2", "pull of the planet", False),
)
# Limits along the whole path, not only at its start.
PATH = (
    Key("path.body_pitch", "rad", "body pitch, nose up, along the whole path"),
    Key("path.flap", "rad", "flap angle of arm and hand, wing up positive, along the whole stroke"),
)
# Strips are arm or hand as a whole, so an orbit changes in steps with the wrist: no derivative, no search.
FREE = (
    *(
        Key(f"free.{key.name}", key.unit, key.meaning)
        for key in KEYS
        if key.path.startswith("wingbeat.") and key.path != "wingbeat.wrist" and key.shape == "number"
    ),
    *(
        Key(f"free.{name}", "1" if name.startswith("span") else "rad", "one number of the harmonics")
        for name in HARMONIC_NAMES
    ),
)
# What is read off a beat and judged beside the certificate. The ranges of frequency and flap amplitude stand with
# their numbers, under wingbeat.
PLAUSIBLE = (
    Key("plausible.positive_power_per_mass", "W/kg", "mean positive hinge power over the whole mass", False),
    Key("plausible.peak_force_over_weight", "1", "largest air load on the whole vehicle over its weight", False),
    Key("plausible.body_pitch_range", "rad", "largest less smallest body pitch within a beat", False),
    Key("plausible.strouhal", "1", "2 f semi_span sin(flap_amplitude) / U", False),
    Key("plausible.reynolds", "1", "U times mean chord over viscosity", False),
)
FREE_UNITS = {key.name: key.unit for key in FREE}
