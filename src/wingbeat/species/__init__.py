"""Species: what flies and how it beats its wings by default, with the source of every number."""

from wingbeat.species.animals import bat, bird, robot
from wingbeat.species.loading import load_species
from wingbeat.species.record import Species
from wingbeat.species.settings import parse_setting
from wingbeat.species.shape import Shape
from wingbeat.species.writing import species_text
from wingbeat.species_schema import Alternative, Bound, Number, Range, json_schema, species_names, template

__all__ = [
    "Alternative",
    "Bound",
    "Number",
    "Range",
    "Shape",
    "Species",
    "bat",
    "bird",
    "json_schema",
    "load_species",
    "parse_setting",
    "robot",
    "species_names",
    "species_text",
    "template",
]
