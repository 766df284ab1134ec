"""Species: what flies and how it beats its wings by default, with the source of every number."""

from wingbeat.animal.species.animals import bat, bird, robot
from wingbeat.animal.species.loading import load_species
from wingbeat.animal.species.record import Species
from wingbeat.animal.species.settings import parse_setting
from wingbeat.animal.species.shape import Shape
from wingbeat.animal.species.writing import species_text
from wingbeat.animal.species_schema import Alternative, Bound, Number, Range, json_schema, species_names, template

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
