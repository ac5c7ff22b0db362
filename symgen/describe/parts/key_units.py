"""SI units of the quantities that keys of a mechanism file set, as far as the keys alone tell.

Keys of joints and forces have their units in the texts that describe them.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from typing import Any

from symgen.describe.modal_body import UNITS_OF_MODES
from symgen.describe.parts.kinds import FORCES, JOINTS

#: Units by the key of a body, or of the mechanism.
_OF_BODIES = {
    "gravity": "m/s^2",
    "mass": "kg",
    "inertia": "kg m^2",
    "centre_of_mass": "m",
    "points": "m",
    "position": "m",
    "angle": "rad",
    "velocity": "m/s",
    "angular_velocity": "rad/s",
    "damping": "s",
}
#: Units of keys that are read on their way to others, by the last part: those of bodies in space, of shapes, of beams.
_FURTHER = {
    "bodies": {
        **{"inertia_at": "m", "at": "m", "size": "m", "radius": "m", "length": "m"},
        **{"euler_angles": "rad", "rotation_vector": "rad", "start": "m", "end": "m"},
    },
    "beams": {
        **{"start": "m", "end": "m", "points": "m", "arc": "rad", "damping": "s", "axial": "N", "bending": "N m^2"},
        **{"torsion": "N m^2", "shear": "N", "mass": "kg/m", "rotary": "kg m", "young": "Pa", "density": "kg/m^3"},
        **{"poisson": "1", "width": "m", "height": "m", "diameter": "m", "thickness": "m", "load": "N/m"},
    },
    "outputs": {"at": "m", "reach": "m", "disc": "m", "segment": "m", "on": "m"},
    "contacts": {
        **{"at": "m", "on": "m", "disc": "m", "sphere": "m", "segment": "m", "capsule": "m", "box": "m"},
        **{"rolling": "m", "torsion": "m", "surface_speed": "m/s", "surface_velocity": "m/s"},
    },
    "outlines": {
        **{"to": "m", "radius": "m", "bulge": "1", "fillet": "m", "points": "m", "box": "m", "at": "m", "angle": "rad"},
        "module": "m",
    },
}
#: Units of what a joint has along a coordinate: of an angle, of a displacement.
_ALONG = {
    **{"sliding": ("N m", "N"), "static": ("N m", "N"), "viscous": ("N m s/rad", "N s/m"), "radius": ("m", "m")},
    **{"stribeck_speed": ("rad/s", "m/s"), "speed": ("rad/s", "m/s"), "lower": ("rad", "m"), "upper": ("rad", "m")},
    **{"coefficient": ("1", "1"), "static_coefficient": ("1", "1"), "restitution": ("1", "1")},
    **{"stribeck_exponent": ("1", "1"), "forwards": ("N m", "N"), "backwards": ("N m", "N")},
    **{"stiffness": ("N m/rad", "N/m"), "damping": ("N m s/rad", "N s/m")},
}


def unit_of_key(section: str, key: str, kind: str = "") -> str:
    """Return the SI unit of a key of an entry; empty where its text has none, or one for each of several.

    Parameters
    ----------
    section, key : str
        Section and key, without the entry's name; ``mechanism`` has keys of its own.
    kind : str
        Type of a joint or force.
    """
    if section in ("joints", "forces"):
        kinds = JOINTS if section == "joints" else FORCES
        return "m" if key == "at" else _units_of_kind(kinds.get(kind, section)).get(key, "")
    return _OF_BODIES.get(key, "") if section in ("mechanism", "bodies") else ""


def unit_of_number(path: str, key: str, kind: str, coordinates: Mapping[str, str]) -> str:
    """Return the SI unit of a number in a file, as `unit_of_key`, for keys in tables of tables too.

    Parameters
    ----------
    path, key : str
        The table, such as ``joints.knee``, and the key in it, such as ``start.angle.rate``.
    kind : str
        Type of a joint or force.
    coordinates : mapping of str to str
        Coordinates of the joint with their units, where the table is one of a joint that has been resolved.
    """
    section, parts = path.partition(".")[0], re.sub(r"\[\d+\]", "", key).split(".")
    inner = len(parts) > 1 and parts[-1] in _ALONG  # of a row with bounds
    if section == "joints" and (parts[0] == "start" or inner) and coordinates:
        return _unit_along_coordinate(parts, coordinates)
    if section in _FURTHER and parts[-1] in _FURTHER[section] and (section != "bodies" or parts[0] not in _OF_BODIES):
        return _FURTHER[section][parts[-1]]
    if section == "bodies" and parts[0] == "start":  # of modes
        return UNITS_OF_MODES.get(parts[-1].rstrip("0123456789"), "")
    if section == "states" and key == "start":
        return next(iter(coordinates.values()), "")
    if key == "restitution":
        return "1"
    return unit_of_key(section, parts[0], kind)


def _unit_along_coordinate(parts: list[str], coordinates: Mapping[str, str]) -> str:
    """Return the unit of a number along one of a joint's coordinates."""
    label = parts[1] if len(parts) > 1 and parts[1] in coordinates else next(iter(coordinates))
    unit = coordinates[label]
    if parts[0] == "start":
        return f"{unit}/s" if parts[-1] == "rate" else unit
    return _ALONG.get(parts[-1], ("", ""))[unit != "rad"]


@functools.cache
def _units_of_kind(kind: type[Any]) -> dict[str, str]:
    """Return the units of keys of a joint or a force, as the texts on its keys have these in brackets."""
    from symgen.describe.files.json_schema import key_texts  # which needs the sections, and these scopes

    units = dict[str, str]()
    for names, text in re.findall(r"^(\w+(?:, \w+)*) : .*\n((?:    .*\n?)+)", key_texts(kind), re.MULTILINE):
        keys, own = names.split(", "), re.findall(r"\[([^\]]+)\]", text)
        if len(keys) == len(own) and not any(" or " in unit or " with " in unit for unit in own):
            units |= dict(zip(keys, own, strict=True))
    return units
