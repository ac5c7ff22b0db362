"""Words that people bring along from other programs and textbooks for what a mechanism file calls otherwise."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from symgen.base.errors import suggest
from symgen.base.vocabulary.measures import GROUND

#: Keys of tables.
_KEYS: Final = {
    **dict.fromkeys(("theta", "phi", "rotation", "orientation"), "angle"),
    **dict.fromkeys(("omega", "theta_dot", "angular_speed", "spin"), "angular_velocity"),
    **dict.fromkeys(("pos", "location", "origin", "xy", "coordinates"), "position"),
    **dict.fromkeys(("j", "i", "izz", "moment_of_inertia"), "inertia"),
    **dict.fromkeys(("com", "cg", "cog", "center_of_mass", "centre_of_gravity", "center_of_gravity"), "centre_of_mass"),
    **dict.fromkeys(("end", "end_time", "duration", "time", "t_end", "tmax"), "until"),
    **dict.fromkeys(("dt", "timestep", "time_step"), "step"),
    **dict.fromkeys(("bodies", "links", "connects", "body1", "parent", "child"), "between"),
    **dict.fromkeys(("k", "rate", "spring_constant"), "stiffness"),
    **dict.fromkeys(("l0", "rest_length", "natural_length", "length"), "free_length"),
    **dict.fromkeys(("motion", "function", "speed", "formula", "law"), "value"),
    **{"m": "mass", "weight": "mass", "v": "velocity", "vel": "velocity", "g": "gravity", "kind": "type"},
    **{"c": "damping", "damper": "damping", "direction": "axis", "mu": "sliding", "coefficient": "sliding"},
}
#: Sections, and what shows which section a table without one belongs to.
_SECTIONS: Final = {
    **dict.fromkeys(("links", "parts", "rods", "bars"), "bodies"),
    **dict.fromkeys(("constraints", "connections", "motors", "drivers"), "joints"),
    **dict.fromkeys(("springs", "loads", "dampers"), "forces"),
    **dict.fromkeys(("settings", "simulation", "solver"), "run"),
    **dict.fromkeys(("system", "model", "machine"), "mechanism"),
    **dict.fromkeys(("variables", "constants"), "parameters"),
}
_KEYS_OF_ENTRIES: Final = {"mass": "bodies", "between": "joints", "stiffness": "forces", "force": "forces"}
_KEYS_OF_HEADS: Final = {
    "mechanism": ("name", "title", "gravity", "space", "remarks"),
    "run": ("until", "step", "method", "integrator", "rtol", "atol"),
}
_LISTED: Final = re.compile(
    r"\s*[\[(]?\s*[-+.\d]+(?:[eE][-+]?\d+)?(?:\s*[,;\s]\s*[-+.\d]+(?:[eE][-+]?\d+)?)+\s*[\])]?\s*"
)
_GROUNDS: Final = ("world", "frame", "base", "earth", "inertial", "fixed", "origin", "environment", "0")


def hint_on_key(key: str, names: Iterable[str]) -> str:
    """Return the hint on an unknown key of a table, empty where no key is near."""
    known, word = list(names), _KEYS.get(key.lower(), "")
    hint = f"did you mean '{word}'?" if word in known else suggest(key, known)
    return "" if hint.startswith("known") else hint


def hint_on_section(name: str, content: object, sections: Iterable[str]) -> str:
    """Return the hint on an unknown section: another word, or the entry of a section whose name was left out."""
    known = list(sections)
    if (word := _SECTIONS.get(name.lower(), "")) in known:
        return f"did you mean '{word}'?"
    if hint := hint_on_key(name, known):
        return hint
    if not isinstance(content, Mapping):
        own = next((section for section, keys in _KEYS_OF_HEADS.items() if name in keys), "")
        return f"did you mean '{name}' below the header '[{own}]'?" if own else ""
    section = next((part for key, part in _KEYS_OF_ENTRIES.items() if key in content), "")
    return f"did you mean '[{section}.{name}]'?" if section else ""


def hint_on_body(name: str, names: Iterable[str]) -> str:
    """Return the hint on an unknown body, which may be the ground by another name."""
    known = list(names)
    hint = suggest(name, known)
    return f"did you mean '{GROUND}'?" if GROUND in known and name.lower() in _GROUNDS else hint


def hint_on_vector(components: Sequence[float | str], count: int) -> str:
    """Return the hint on a list of another length than `count`: decimal commas, or three numbers in the plane."""
    whole = [int(each) for each in components if isinstance(each, float) and each.is_integer()]
    if len(whole) == len(components) == 2 * count:
        pairs = ", ".join(f"{a}.{abs(b)}" for a, b in zip(whole[::2], whole[1::2], strict=True))
        return f"numbers have a decimal point: did you mean [{pairs}]?"
    return (
        "a mechanism with [x, y, z] has space = 'spatial' in [mechanism]" if (count, len(components)) == (2, 3) else ""
    )


def hint_on_list(value: object) -> str:
    """Return the hint on a text that holds the numbers of a list, empty for anything else."""
    if not isinstance(value, str) or not _LISTED.fullmatch(value):
        return ""
    parts = re.split(r"[,;\s]+", value.strip(" []()"))
    return f"did you mean [{', '.join(parts)}]?"
