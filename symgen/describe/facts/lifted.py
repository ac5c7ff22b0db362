"""Numbers of a file, named by their paths: a run can be differentiated by one, which becomes a parameter.

Only numbers that are named become parameters, so that code of other runs stays what it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.base.errors import InputError, quote, suggest
from symgen.describe.bounds.keys import sections_of_files
from symgen.describe.edits.new_numbers import put_at_path, value_at_path
from symgen.describe.files.origins import Origin, keep_origin, origin_of
from symgen.describe.files.validate import validate
from symgen.describe.formulas.identifiers import LONGEST
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.key_units import unit_of_key

#: Sections whose numbers have paths; those of parameters, inputs and starts have names.
SECTIONS = ("mechanism", "bodies", "beams", "joints", "forces", "states", "outlines", *sections_of_files())
#: Keys and indices from the file to a number.
Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Lifted:
    """A mechanism in which numbers of its file are parameters.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism with these parameters; without such numbers, `mechanism` itself.
    keys : mapping of str to str
        Names as typed, each with its name in the mechanism.
    """

    mechanism: Mechanism
    keys: Mapping[str, str]


def lift_numbers(where: str, mechanism: Mechanism, names: Sequence[str]) -> Lifted:
    """Return a mechanism in which the numbers that `names` has by their paths are parameters.

    Parameters
    ----------
    where : str
        Argument that has the names, for messages.
    mechanism : Mechanism
        The mechanism.
    names : sequence of str
        Paths such as ``bodies.crank.mass`` or ``bodies.crank.points.B[0]``; other names stay what they are.

    Raises
    ------
    InputError
        If a name comes twice, or a path leads to no number, or to one that has to be a number.
    """
    paths, keys = [name for name in names if is_path(name)], {name: name for name in names}
    if len(keys) < len(names):
        twice = next(name for i, name in enumerate(names) if name in names[:i])
        raise InputError(where, "each number once", f"{quote(twice)} twice")
    if not paths:
        return Lifted(mechanism, keys)
    origin = origin_of(mechanism)
    if origin is None:
        expected = "names of parameters, as the file of this model is not at hand"
        raise InputError(where, expected, quote(paths[0]), "load the file again")
    places, raw = {name: path for name, path, _ in numbers_of_file(origin.raw)}, [origin.raw]
    others = names_of_scalars(origin.raw)
    for name in paths:
        if name not in places:
            raise _no_such_number(where, name, origin, places)
        keys[name] = free_parameter_name(name, others)
        others.add(keys[name])
        raw.append(_put_parameter(raw[-1], places[name], keys[name], name))
    try:
        return Lifted(validate(raw[-1], origin.source), keys)
    except InputError:
        # one at a time, so that messages have the number that cannot vary
        for name, own in zip(paths, raw[1:], strict=True):
            try:
                validate(own, origin.source)
            except InputError as error:
                got = f"{quote(name)}, whose place takes {error.expected}"
                raise InputError(where, "numbers that a parameter may stand for", got) from None
        raise


def numbers_as_parameters(mechanism: Mechanism) -> Lifted:
    """Return a mechanism whose code stays what it is while a hand changes numbers of the file.

    Zeros stay: code is shorter with them.
    """
    origin = origin_of(mechanism)
    if origin is None:
        return Lifted(mechanism, {})
    names = [name for name in (name_of_changeable(*number) for number in numbers_of_file(origin.raw)) if name]
    try:
        return lift_numbers("numbers", mechanism, names)
    except InputError:  # a place that takes numbers alone
        return Lifted(mechanism, {})


def name_of_changeable(name: str, path: Path, value: float) -> str:
    """Return the name of a number that emitted code has and a hand changes; empty for others."""
    if value == 0.0:
        return ""
    if path[0] == "mechanism":
        return name if path[1] == "gravity" else ""
    key = path[2] if len(path) > 2 else ""
    keys = {"bodies": ("mass", "inertia", "points", "centre_of_mass"), "joints": ("at",)}
    forces = ("at", "stiffness", "damping", "free_length", "free_angle")
    return name if key in {**keys, "forces": forces}.get(str(path[0]), ()) else ""


def lifted_with_numbers(lifted: Lifted, values: Mapping[str, float]) -> Lifted | None:
    """Return a mechanism with other numbers of its file, which are parameters of it: nothing else is read again.

    Parameters
    ----------
    lifted : Lifted
        With the numbers as parameters.
    values : mapping of str to float
        The numbers in SI units, by their paths.

    Returns
    -------
    Lifted or None
        None where one of them is no parameter of it.
    """
    origin = origin_of(lifted.mechanism)
    own = {lifted.keys[name]: float(value) for name, value in values.items() if is_path(name) and name in lifted.keys}
    if origin is None or len(own) < len(values):
        return None
    if not own:
        return lifted
    raw: dict[str, Any] = {**origin.raw, "parameters": dict(origin.raw["parameters"])}
    for name, value in own.items():
        raw["parameters"][name] = {**raw["parameters"][name], "value": value}
    parameters = tuple(
        msgspec.structs.replace(p, value=own[p.name]) if p.name in own else p for p in lifted.mechanism.parameters
    )
    mechanism = msgspec.structs.replace(lifted.mechanism, parameters=parameters)
    return Lifted(keep_origin(mechanism, raw, origin.source), lifted.keys)


def literal_points_in_words(names: Sequence[str]) -> tuple[str, ...]:
    """Return a sentence on coordinates of points of bodies among names: nothing else of the body follows them."""
    literal = [name for name in names if re.fullmatch(r"bodies\.[^.\[\]]+\.points\.[^.\[\]]+\[\d\]", name)]
    if not literal:
        return ()
    which = ", ".join(literal)
    verb, them = ("moves", "it") if len(literal) == 1 else ("move", "them")
    return (
        f"{which} {verb} a point alone: mass, inertia and position of the body stay; "
        f"a parameter in place of {them}, with formulas for these, moves all of the body",
    )


def is_path(name: str) -> bool:
    """Whether a name is the path of a number: coordinates, velocities and joints have no such parts."""
    section, _, rest = name.partition(".")
    return (section in SECTIONS and ("." in rest or section == "mechanism")) or "[" in name


def numbers_of_file(raw: Mapping[str, Any]) -> Iterator[tuple[str, Path, float]]:
    """Yield all numbers of a description that have paths: each path as text and as keys, and the number."""
    stack: list[tuple[Path, object]] = [((name,), raw.get(name)) for name in SECTIONS]
    while stack:
        path, value = stack.pop()
        if isinstance(value, Mapping):
            stack.extend(((*path, key), item) for key, item in value.items())
        elif isinstance(value, list | tuple):
            stack.extend(((*path, i), item) for i, item in enumerate(value))
        elif isinstance(value, int | float) and not isinstance(value, bool):
            yield path_in_words(path), path, float(value)


def path_in_words(path: Path) -> str:
    """Return a path as a person names it, such as ``bodies.crank.points.B[0]``."""
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path).lstrip(".")


def _no_such_number(where: str, name: str, origin: Origin, places: Mapping[str, Path]) -> InputError:
    """Return the error about a path that leads to no number."""
    value: object = origin.raw
    for part in re.findall(r"[^.\[\]]+", name):
        if isinstance(value, Mapping):
            value = value.get(part)
        elif isinstance(value, list | tuple) and part.isdecimal() and len(part) < 9 and int(part) < len(value):
            value = value[int(part)]
        else:
            value = None
    expected = f"the path of a number in {origin.source}"
    if isinstance(value, str):
        return InputError(where, expected, f"{quote(name)}, which is {quote(value)}", "take the parameters in it")
    return InputError(where, expected, quote(name), suggest(name, places))


def names_of_scalars(raw: Mapping[str, Any]) -> set[str]:
    """Return the names that a new parameter of a description cannot have."""
    return {name for section in ("parameters", "inputs", "states", "tables") for name in raw.get(section, {})}


def free_parameter_name(name: str, others: set[str]) -> str:
    """Return a name of a parameter for a path."""
    own = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")[: LONGEST - 4]
    return next(x for k in range(len(others) + 1) if (x := own if not k else f"{own}_{k}") not in others)


def _put_parameter(raw: Mapping[str, Any], path: Path, parameter: str, name: str) -> dict[str, Any]:
    """Return a description in which a parameter replaces a number; other entries of its list keep theirs."""
    entry = {"value": float(value_at_path(raw, path)), "unit": _unit_of_path(raw, path), "note": name}
    result: dict[str, Any] = put_at_path(raw, path, parameter)
    result["parameters"] = {**raw.get("parameters", {}), parameter: entry}
    return result


def _unit_of_path(raw: Mapping[str, Any], path: Path) -> str:
    """Return the unit of a number; empty where the texts on its table have none, or one for each of several."""
    section, key = str(path[0]), str(path[1] if path[0] == "mechanism" else path[2] if len(path) > 2 else "")
    kind = str(raw[section][path[1]].get("type")) if section in ("joints", "forces") else ""
    return unit_of_key(section, key, kind)
