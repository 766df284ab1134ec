"""Species files: which keys they may have, messages about their faults, and their numbers. No physics."""

from wingbeat.species_schema.box import packaged_text, species_names, template
from wingbeat.species_schema.faults import check_value, shown, spoken
from wingbeat.species_schema.keys import COLOURS, COVERS, KEYS, LOOKS, PARTS, PLAUSIBLE, SHAPE, TAIL_PATHS, Key
from wingbeat.species_schema.models import json_schema
from wingbeat.species_schema.reading import (
    Alternative,
    Bound,
    Number,
    Numbers,
    Range,
    ShapeText,
    SpeciesText,
    display,
    number_from,
    parse_toml,
    read_species_text,
    to_si,
)

__all__ = [
    "COLOURS",
    "COVERS",
    "KEYS",
    "LOOKS",
    "PARTS",
    "PLAUSIBLE",
    "SHAPE",
    "TAIL_PATHS",
    "Alternative",
    "Bound",
    "Key",
    "Number",
    "Numbers",
    "Range",
    "ShapeText",
    "SpeciesText",
    "check_value",
    "display",
    "json_schema",
    "number_from",
    "packaged_text",
    "parse_toml",
    "read_species_text",
    "shown",
    "species_names",
    "spoken",
    "template",
    "to_si",
]
