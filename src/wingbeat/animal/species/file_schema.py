"""What a species file may hold, as pydantic models made from the numbers' keys, and its faults in our own words."""

from __future__ import annotations

import functools
import json
import re
from collections.abc import Callable, Iterable
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, TypeAdapter, ValidationError, create_model

from wingbeat._base import FaultList, suggest
from wingbeat.animal.species.numbers import (
    COLOUR,
    COVERS,
    FREE,
    KEYS,
    LOOKS,
    NO_COLOUR,
    NOTHING,
    PARTS,
    PATH,
    PLAUSIBLE,
    SHAPE,
    Key,
    Shown,
    shown,
)

_STRICT = ConfigDict(strict=True, extra="forbid")
_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Pair = Annotated[list[_Finite], Field(min_length=2, max_length=2)]
# Tags appear in pydantic's error paths; the blank keeps them apart from any key of a file.
TAGS = NUMBER, LIST, TABLE = " number", " list", " table"
KINDS = ("bird", "bat", "robot")
NUMBER_FIELDS = ["value", "unit", "source", "range"]


def _kind(value: Any) -> str:
    return TABLE if isinstance(value, dict) else LIST if isinstance(value, list) else NUMBER


_SHAPES: dict[str, Any] = {
    "number": _Finite,
    "stations": Annotated[
        Annotated[_Finite, Tag(NUMBER)] | Annotated[list[_Finite], Field(min_length=2), Tag(LIST)],
        Discriminator(_kind),
    ],
    "vector": Annotated[list[_Finite], Field(min_length=3, max_length=3)],
    "list": list[_Finite],
    "edge": Annotated[list[_Finite], Field(min_length=2)],
    "cover": Literal[COVERS],
    "colour": Annotated[str, Field(pattern=f"^{COLOUR}$")],
}
_ADAPTERS = {shape: TypeAdapter(kind, config=ConfigDict(strict=True)) for shape, kind in _SHAPES.items()}


def _bare_or_table(bare: Any, table: type[BaseModel]) -> Any:
    kind = Discriminator(lambda value: TABLE if isinstance(value, dict) else NUMBER)
    return Annotated[Annotated[bare, Tag(NUMBER)] | Annotated[table, Tag(TABLE)], kind]


@functools.cache
def _sourced(shape: str) -> Any:
    """Return the type of a number: bare, or a table with unit, source and plausible range."""
    plausible = Field(default=None, description="lowest and highest plausible value")
    kinds = [(_SHAPES[shape], ...), (str, ""), (str, ""), (_Pair, plausible)]
    fields: dict[str, Any] = dict(zip(NUMBER_FIELDS, kinds, strict=True))
    table = create_model(f"Sourced_{shape}", __config__=_STRICT, **fields)
    return _bare_or_table(_SHAPES[shape], table)


class BoundTable(BaseModel):
    """Bounds with their unit and reason."""

    model_config = _STRICT
    bounds: _Pair
    unit: str = ""
    reason: str = ""
    guessed: bool = Field(default=False, description="true: a warning names this bound if an orbit is at it")


class RangeTable(BaseModel):
    """A plausible range, open at an end that is not given, with its unit and source."""

    model_config = _STRICT
    low: _Finite | None = None
    high: _Finite | None = None
    unit: str = ""
    source: str = ""
    speeds: _Pair | None = Field(
        default=None,
        description="lowest and highest flight speed at which this range applies [m/s]; all speeds if not given",
    )


class FrequencyTable(BaseModel):
    """A frequency at which the animal beats, with its band and the speeds at which it does."""

    model_config = _STRICT
    value: _Finite
    range: _Pair
    basis: Literal["measured", "law"] = Field(description="measured on the animal, or a law of its kind")
    unit: str = ""
    source: str = ""
    speeds: _Pair | None = Field(default=None, description="lowest and highest flight speed [m/s]; default all")


def _table(name: str, fields: dict[str, Any], required: list[str], **extra: Any) -> type[BaseModel]:
    """Return a model in which all fields are optional; only the JSON schema marks the required ones.

    The module `reading` notes missing fields, because an angle may have either of two names.
    """
    rules = [{"oneOf": [{"required": [n]} for n in names.split()]} for names in required]
    schema: dict[str, Any] = ({"allOf": rules} if rules else {}) | extra
    return create_model(name, __config__=_STRICT | {"json_schema_extra": schema}, **fields)


def _leaves(keys: Iterable[Key], kind_of: Callable[[Key], Any]) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    for key in keys:
        kind = kind_of(key)
        for path in key.spellings:
            unit = "deg" if path != key.path else key.unit
            text = f"{key.meaning} [{unit}]" if unit else key.meaning
            fields[path.rsplit(".", 1)[1]] = (kind, Field(default=None, description=text))
    return fields


def _sections(complete: bool) -> dict[str, Any]:
    """Return the fields of vehicle, wingbeat and air; a complete file must have the numbers that are required.

    TOML has no null, so an absent table is simply not checked.
    """

    def section(prefix: str, inner: dict[str, Any]) -> Any:
        own = [key for key in KEYS if key.path.rpartition(".")[0] == prefix]
        required = [" ".join(p.rpartition(".")[2] for p in key.spellings) for key in own if key.required]
        required += [part for part in inner if part not in PARTS]
        name = prefix.replace(".", " ").title().replace(" ", "") + ("" if complete else "Change")
        fields = _leaves(own, lambda key: _sourced(key.shape)) | inner
        return _table(name, fields, required if complete else []), None

    parts = {part: section(f"vehicle.{part}", {}) for part in ("body", "wing", *PARTS)}
    return {"vehicle": section("vehicle", parts), "wingbeat": section("wingbeat", {}), "air": section("air", {})}


def _shape() -> Any:
    """Return the field of the table that says how the animal looks; its texts stand alone, without a source."""
    texts = _leaves(LOOKS, lambda key: _SHAPES[key.shape])
    fields = {"cover": texts.pop("cover"), **_leaves(SHAPE, lambda key: _sourced(key.shape))}
    fields["colours"] = (_table("Colours", texts, [*texts]), None)
    required = ["cover", *(key.name for key in SHAPE if key.required), "colours"]
    return _table("Shape", fields, required), None


@functools.cache
def species_file() -> type[BaseModel]:
    """Return the model of a species file, which takes 0.1 s to make."""
    alternative = create_model(
        "Alternative",
        __config__=_STRICT,
        reason=(str, Field(default="", description="one line: why to try this")),
        **_sections(complete=False),
    )
    return _table(
        "SpeciesFile",
        {
            "name": (str, Field(default=None, min_length=1)),
            "common_name": (str, ""),
            "scientific_name": (str, ""),
            "kind": (Literal[KINDS], Field(default=None, description="kind of flyer; selects the scaling laws")),
            **_sections(complete=True),
            "free": (_table("Free", _leaves(FREE, lambda _: _bare_or_table(_Pair, BoundTable)), []), None),
            "path": (_table("Path", _leaves(PATH, lambda _: _bare_or_table(_Pair, BoundTable)), []), None),
            "plausible": (_table("Plausible", _leaves(PLAUSIBLE, lambda _: RangeTable), []), None),
            "frequencies": (
                list[FrequencyTable],
                Field(default=None, description="of its flights, measured or by a law; default wingbeat.frequency"),
            ),
            "shape": _shape(),
            "alternatives": (dict[str, alternative], None),
        },
        ["vehicle", "wingbeat"],
        title="wingbeat species file",
        description="Values are in SI units and radians; a key that ends in _deg is in degrees. Give either "
        "vehicle.mass or vehicle.body.mass, and vehicle.wing.mass or its station_masses.",
    )


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a species file, for editors that complete and check TOML.

    >>> json_schema()["title"]
    'wingbeat species file'
    """
    return species_file().model_json_schema()


MAX_FAULTS = 100


def dotted(path: Iterable[Any]) -> str:
    """Return a path of keys and list indices as TOML would write it, on one line."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        elif part not in TAGS:
            bare = re.fullmatch(r"[A-Za-z0-9_-]+", part)
            text += "." * bool(text) + (part if bare else json.dumps(part))[:80]
    return text


def check_shape(raw: dict[str, Any], faults: FaultList) -> None:
    """Note every wrong key, type and shape in the content of a TOML file."""
    try:
        species_file().model_validate(raw)
    except ValidationError as error:
        _translate(error, "", faults)


def has_shape(shape: str, value: Any, where: str = "", faults: FaultList | None = None) -> bool:
    """Return whether a value has one of the shapes of a `Key`; note what is wrong with it if faults are wanted."""
    try:
        _ADAPTERS[shape].validate_python(value)
    except ValidationError as error:
        if faults is not None:
            _translate(error, where, faults)
        return False
    return True


def _translate(error: ValidationError, where: str, faults: FaultList) -> None:
    """Note pydantic's errors at or below `where` as our faults."""
    found = error.errors(include_url=False)
    for fault in found[:MAX_FAULTS]:
        value, loc = fault["input"], fault["loc"]
        rule, fix = rule_of(fault["type"], value, fault.get("ctx", {}))
        if fault["type"] == "missing":
            value = NOTHING
        elif fault["type"] == "extra_forbidden":
            fix = suggest(str(loc[-1]), _known_keys(loc[:-1]))
        faults.add(where + dotted(loc), shown(value), rule, fix)
    if len(found) > MAX_FAULTS:
        faults.add("file", Shown(f"{len(found)} faults"), "too many to list", "is it a species file?")


_RULES = {
    "missing": ("must be given", ""),
    "extra_forbidden": ("is not a known key", ""),
    "float_type": ("must be a number", ""),
    "finite_number": ("must be finite", ""),
    "string_type": ("must be a text", "put it in quotes"),
    "string_pattern_mismatch": NO_COLOUR,
    "string_too_short": ("must not be empty", ""),
    "bool_type": ("must be true or false", ""),
    "list_type": ("must be a list of numbers", ""),
    "model_type": ("must be a table", ""),
    "dict_type": ("must be a table", ""),
}


def rule_of(kind: str, value: Any, context: dict[str, Any]) -> tuple[str, str]:
    """Return the rule and the fix for one of pydantic's kinds of error."""
    match kind:
        case "float_type" if isinstance(value, int) and not isinstance(value, bool):
            return "is too large a number", ""
        case "float_type" if isinstance(value, str):
            return "must be a number", "write the number without quotes; its unit goes into unit = ..."
        case "literal_error":
            return f"must be one of {context['expected']}".replace("'", ""), ""
        case "too_short":
            return f"must hold at least {context.get('min_length')} numbers", ""
        case "too_long":
            return f"must hold at most {context.get('max_length')} numbers", ""
    return _RULES.get(kind, (f"does not match the schema ({kind})", ""))


def _known_keys(loc: tuple[Any, ...]) -> list[str]:
    """Return the keys that the table at this place may have."""
    place = [part for part in loc if isinstance(part, str)]
    if place[:1] == ["alternatives"] and len(place) > 1:
        if len(place) == 2:
            return ["reason", "vehicle", "wingbeat", "air"]
        place = place[2:]
    if TABLE in place:
        return list(BoundTable.model_fields) if place[0] in ("free", "path") else NUMBER_FIELDS
    if len(place) == 2 and place[0] == "plausible":
        return list(RangeTable.model_fields)
    paths = [path for key in (*KEYS, *SHAPE, *LOOKS, *FREE, *PLAUSIBLE, *PATH) for path in key.spellings]
    if not place:
        return list(species_file().model_fields)
    parts = [path.split(".") for path in paths]
    return list(dict.fromkeys(part[len(place)] for part in parts if part[: len(place)] == place))
