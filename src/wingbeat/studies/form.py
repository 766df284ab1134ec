"""The form of a study: the keys and values that a TOML file or a Python dictionary may have."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Discriminator, Field, Tag, ValidationError

from wingbeat._base import WHOLE, FaultList, is_number, suggest
from wingbeat.aero.blade_element import OF_ELEMENTS, BladeElement
from wingbeat.animal.species.file_schema import LIST, MAX_FAULTS, TABLE, dotted, rule_of
from wingbeat.animal.species.numbers import NOTHING, shown

_STRICT = ConfigDict(strict=True, extra="forbid")
METHODS = ("sobol", "latin-hypercube")
# How the values of a varied parameter may be given.
SPREADS = ("grid", "relative", "list", "range", "relative_range")


def _listed(value: Any) -> Any:
    return value if isinstance(value, list) else [value]


def _twice_listed(value: Any) -> Any:
    """Return limits as a list of sets; a single text is a set of one limit, and a list of texts is one set."""
    listed = _listed(value)
    return listed if listed and all(isinstance(item, list) for item in listed) else [listed]


_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Text = Annotated[str, Field(min_length=1)]
_Some = Field(min_length=1)
_Texts = Annotated[list[_Text], BeforeValidator(_listed), _Some]
_Numbers = Annotated[list[_Finite], BeforeValidator(_listed), _Some]
_Counts = Annotated[list[int], BeforeValidator(_listed), _Some]
_Pair = Annotated[list[_Finite], Field(min_length=2, max_length=2)]
# Pairs by name, or the word "plausible". `dotted` leaves the tags out, so that the paths in faults are those of the
# file.
_Bounds = Annotated[
    Annotated[dict[str, _Pair], Tag(TABLE)] | Annotated[Literal["plausible"], Tag(LIST)],
    Discriminator(lambda value: LIST if isinstance(value, str) else TABLE),
]
_Values = Annotated[list[Any], _Some]


def _key(default: Any, text: str, alias: str | None = None) -> Any:
    """Return a key that may be left out; if Python already uses its name, the field has another one."""
    return Field(default=default, description=text, alias=alias)


class Vary(BaseModel):
    """The values of one varied parameter, given in exactly one of five ways."""

    model_config = _STRICT
    grid: _Values | None = _key(None, "these values, each combined with those of the other grids")
    relative: Annotated[list[_Finite], _Some] | None = _key(
        None, "multiples of the species' own value, combined in the same way as grids"
    )
    rows: _Values | None = _key(None, "lists are combined row by row and must have equal length", alias="list")
    ends: _Pair | None = _key(None, "sampled between the two ends, jointly with all other ranges", alias="range")
    relative_range: _Pair | None = _key(
        None, "sampled in the same way between two multiples of the species' own value"
    )

    @property
    def given(self) -> tuple[str, ...]:
        """Which of the five ways are used."""
        return tuple(self.model_dump(by_alias=True, exclude_none=True))

    @property
    def how(self) -> str:
        """The one way that is used; valid only after a check that exactly one is given."""
        return self.given[0]

    @property
    def values(self) -> list[Any]:
        """The values, factors or ends that are given."""
        return self.model_dump(by_alias=True)[self.how]


class Sample(BaseModel):
    """How ranges are sampled."""

    model_config = _STRICT
    n: int = Field(description="number of points")
    method: str = _key("sobol", "`sobol` or `latin-hypercube`")
    seed: int | None = _key(None, "of the sample; default the seed of the study")


class StudyForm(BaseModel):
    """A study of all combinations of the lists outside `vary`; ``free`` and a set of limits count as one value."""

    model_config = _STRICT
    species: _Texts = Field(description="names of species, or paths of species files beside the study")
    model: _Texts = _key(
        ["paper"], "`paper` or `animal`; sets air loads and objective, unless the study gives them"
    )
    aero: _Texts = _key(["su-fan"], "coefficient models: names, or files beside the study")
    extension: _Texts = _key(["mirrored"], "how coefficients continue outside the angles of the fit")
    blend_width_deg: _Numbers = _key([1.0], "half width of the blends where pieces of the coefficients meet [deg]")
    strips: _Counts = _key([BladeElement.strips], "number of strips of a wing")
    force_point: _Texts = _key([BladeElement.force_point], "where on the chord the air load acts")
    airspeed: _Texts = _key([BladeElement.airspeed], "airspeed that determines the loads of a strip")
    unsteady: _Texts = _key([BladeElement.unsteady], "unsteady terms of the air loads")
    wake: _Texts = _key([BladeElement.wake], "lag of the wake")
    inflow: _Texts = _key([BladeElement.inflow], "induced flow")
    induced_factor: _Numbers = _key(
        [BladeElement.induced_factor], "ratio of induced power to that of an ideal disc"
    )
    hand: _Texts = _key([BladeElement.hand], "coefficient models of the hand")
    hand_from: _Numbers = _key(
        [BladeElement.hand_from], "fraction of the span at which the hand's coefficients begin"
    )
    upstroke_factor: _Numbers = _key(
        [BladeElement.upstroke_factor], "factor on lift and drag where air meets the wing from above"
    )
    speed: _Numbers | None = _key(None, "mean horizontal speeds [m/s]")
    climb: _Numbers = _key([0.0], "mean vertical speeds [m/s]")
    payload: _Numbers = _key([0.0], "masses added at the body's centre of mass [kg]")
    altitude: _Numbers | None = _key(None, "heights above sea level, which set the air's density and viscosity [m]")
    temperature: _Numbers | None = _key(
        None, "temperatures of the air [deg C]; default that of the standard atmosphere"
    )
    minimise: _Texts = _key(["frequency"], "objectives: names, or functions of a file, such as `mine.py:lift`")
    subject_to: Annotated[list[list[_Text]], BeforeValidator(_twice_listed)] = _key(
        [[]], "limits; one list is one set, a list of lists several sets"
    )
    starts: _Counts | None = _key(None, "numbers of starts; default as in `wingbeat orbit`")
    seed: _Counts = _key([0], "seeds of the random starts")
    most_starts: _Counts | None = _key(None, "while no start leads to an orbit, more follow, up to this many")
    free: Annotated[list[_Text], _Some] | None = _key(
        None, "names of the free parameters; default those of the species"
    )
    bounds: _Bounds = _key({}, "bounds of free parameters by name, or `plausible`")
    settings: dict[str, Any] = _key({}, "changes of numbers for all points, by path", alias="set")
    advise: bool = _key(False, "whether points without an orbit list the changes that would give one")
    explain: bool = _key(True, "whether points without an orbit name the balance that fails")
    chain: str | None = _key(
        None, "`speed`: points that differ only in speed are solved in order and start from one another"
    )
    vary: dict[str, Vary] = _key({}, "values of varied numbers, by path")
    sample: Sample | None = _key(None, "how ranges are sampled")


def check_form(raw: Mapping[str, Any]) -> tuple[StudyForm | None, FaultList]:
    """Return the form of a dictionary, and the faults in its structure; None if there are any faults."""
    faults = FaultList()
    try:
        form = StudyForm.model_validate(_plain(raw))
    except ValidationError as error:
        _translate(error, raw, faults)
        return None, faults
    _check_vary(form, faults)
    _check_numbers(form, faults)
    return form, faults


def _plain(value: Any) -> Any:
    """Return a value with lists and tables in place of tuples, arrays, paths and other mappings."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, Path):
        return str(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value


def _translate(error: ValidationError, raw: Mapping[str, Any], faults: FaultList) -> None:
    found = error.errors(include_url=False)
    for fault in found[:MAX_FAULTS]:
        loc, value = fault["loc"], fault["input"]
        *place, last = loc
        held: Any = raw
        try:
            for part in place:
                held = held[part]
        except (LookupError, TypeError):
            held = None
        # One value in the place of a list has no index of its own.
        if place and isinstance(last, int) and not isinstance(held, list | tuple):
            loc = tuple(place)
        rule, fix = rule_of(fault["type"], value, fault.get("ctx", {}))
        if fault["type"] == "missing":
            value = NOTHING
        elif fault["type"] == "extra_forbidden":
            fields = (Sample if place[:1] == ["sample"] else StudyForm).model_fields
            names = [field.alias or name for name, field in fields.items()]
            fix = suggest(str(last), SPREADS if place[:1] == ["vary"] else names)
        elif fault["type"] == "literal_error":
            rule = "is not a known choice"
            fix = f"use {fault.get('ctx', {}).get('expected')}, or a table of [lower, upper] pairs"
        elif fault["type"] == "int_type":
            rule = WHOLE
        elif fault["type"] == "list_type":
            rule = "must be a list"
        elif fault["type"] in ("model_type", "dict_type") and loc[:1] == ("vary",) and len(loc) == 2:
            fix = "for example { grid = [6.0, 8.0] }"
        where = dotted(part if isinstance(part, int) else str(part) for part in loc)
        faults.add(where, shown(value), rule.replace("numbers", "values"), fix)
    if len(found) > MAX_FAULTS:
        faults.add("file", f"{len(found)} faults", "too many to list", "is it a study file?")


def _check_vary(form: StudyForm, faults: FaultList) -> None:
    """Note faults in how the parameters are varied, and a chain or advice that the other keys do not allow."""
    ranged, rows = [], {}
    for path, vary in form.vary.items():
        where, given = dotted(("vary", path)), vary.given
        if len(given) != 1:
            rule = f"must be given by exactly one of {', '.join(SPREADS)}"
            faults.add(where, ", ".join(given) or NOTHING, rule, "for example { grid = [6.0, 8.0] }")
            continue
        values, where = vary.values, f"{where}.{given[0]}"
        if given[0] == "list":
            rows[path] = len(values)
        elif "range" in given[0]:
            ranged.append(path)
            if not values[0] < values[1]:
                faults.add(where, values, "must be [lowest, highest]", "exchange them")
        elif _repeats(values):
            faults.add(where, shown(values), "names a value twice", "keep one of them")
    if len(set(rows.values())) > 1:
        lengths = ", ".join(f"{path} {count}" for path, count in rows.items())
        rule = "has lists of unequal length, but lists are combined row by row"
        faults.add("vary", lengths, rule, "make them equally long, or give grid instead of list")
    if ranged and form.sample is None:
        fix = 'add [sample] with method = "sobol" and n = 256'
        faults.add("sample", NOTHING, f"must be given, since {ranged[0]} has a range", fix)
    if form.sample is not None:
        if not ranged:
            fix = "write range = [lowest, highest] for a parameter, or leave sample out"
            faults.add("sample", form.sample.method, "has no range to sample", fix)
        faults.choice("sample.method", form.sample.method, METHODS)
        for name, count, least in (("n", form.sample.n, 1), ("seed", form.sample.seed, 0)):
            if count is not None:
                faults.whole(f"sample.{name}", shown(count), least, 1_000_000)
    if form.chain is not None and (form.chain not in form.vary or "range" in "".join(form.vary[form.chain].given)):
        gridded = [path for path, vary in form.vary.items() if vary.given in (("grid",), ("relative",))]
        fix = f"chain along {' or '.join(gridded)}" if gridded else "leave chain out"
        faults.add("chain", form.chain, "is not a parameter varied by grid or relative", fix)
    elif form.chain is not None and form.vary[form.chain].given == ("list",):
        rule = "is varied by a list, which is combined with other lists row by row"
        faults.add("chain", form.chain, rule, "give it as grid")
    if form.advise and not form.explain:
        faults.add("advise", True, "cannot be combined with explain = false", "leave one of them out")


def number(value: Any) -> Any:
    """Return a number as a float, so that 1 and 1.0 are equal; anything else, or too large a number, unchanged."""
    with suppress(OverflowError):
        # Adding 0 takes the sign off a zero.
        return float(value) + 0.0 if is_number(value) else value
    return value


def _repeats(values: list[Any]) -> bool:
    return len({repr(number(value)) for value in values}) < len(values)


def _check_numbers(form: StudyForm, faults: FaultList) -> None:
    """Note counts out of range, and keys whose list names a value twice."""
    for name, least in (("starts", 1), ("seed", 0), ("most_starts", 1)):
        for count in getattr(form, name) or ():
            faults.whole(name, shown(count), least, 100_000)
    for name in StudyForm.model_fields:
        values = getattr(form, name)
        if isinstance(values, list) and name != "free" and _repeats(values):
            faults.add(name, shown(values), "names a value twice", "keep one of them")
    for name in ("speed", "climb", "payload", "extension", "blend_width_deg", *OF_ELEMENTS):
        if {name, f"aero.{name}"} & form.vary.keys() and name in form.model_fields_set:
            faults.add(name, shown(getattr(form, name)), "is also varied", "keep one of the two")
    if form.altitude is not None or form.temperature is not None:
        for path in ("air.density", "air.viscosity"):
            for key, there in (("set", form.settings), ("vary", form.vary)):
                if path in there:
                    rule = "is what altitude and temperature set too"
                    faults.add(f"{key}.{path}", shown(there[path]), rule, "keep one of the two")
    for name in ("altitude", "temperature"):
        if name in form.vary:
            rule = "sets two numbers of the air, so it is no number to vary"
            faults.add(dotted(("vary", name)), NOTHING, rule, f"list its values above [vary]: {name} = [0, 20]")
    if form.speed is None and "speed" not in form.vary:
        fix = "write speed = 10.0, or under [vary] speed = { grid = [8.0, 10.0] }"
        faults.add("speed", NOTHING, "must be given", fix)
