"""Species files: which keys they may have, messages about their faults, and their numbers. No physics."""

from wingbeat.species_schema.box import packaged_text, species_names, template
from wingbeat.species_schema.faults import check_value, shown, spoken
from wingbeat.species_schema.keys import KEYS, PARTS, PLAUSIBLE, TAIL_PATHS, Key
from wingbeat.species_schema.models import json_schema
from wingbeat.species_schema.reading import (
    Alternative,
    Bound,
    Number,
    Numbers,
    Range,
    SpeciesText,
    display,
    parse_toml,
    read_species_text,
    to_si,
)

__all__ = [
    "KEYS",
    "PARTS",
    "PLAUSIBLE",
    "TAIL_PATHS",
    "Alternative",
    "Bound",
    "Key",
    "Number",
    "Numbers",
    "Range",
    "SpeciesText",
    "check_value",
    "display",
    "json_schema",
    "packaged_text",
    "parse_toml",
    "read_species_text",
    "shown",
    "species_names",
    "spoken",
    "template",
    "to_si",
]
