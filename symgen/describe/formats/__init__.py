"""Formats of other programs: a robot's file in, the nested dictionary of a mechanism file out.

A module is one format, found by its file: how a file is recognised and what reads it. Readers build a `Robot` of links
and connections; `symgen.describe.formats._raw` makes bodies, joints and forces of it, the same for every format.

In: the path of a URDF, MJCF or SDF file.
Out: an `Import`: the description, not yet validated, and what it leaves out.
Imports: mujoco for MJCF, where it is used; `parts`, `formulas`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, Protocol

from symgen.base.registry import Registry
from symgen.describe.formats._robot import LeftOut, Robot


class Format(Protocol):
    """Interface of a format."""

    #: Ends of file names.
    SUFFIXES: ClassVar[tuple[str, ...]]
    #: The outermost element of a file.
    ROOT: ClassVar[str]

    @staticmethod
    def read(path: Path, floating: bool) -> Robot:
        """Return the robot of a file; `floating` leaves its base free where the file does not say."""
        ...


@dataclass(frozen=True)
class Import:
    """A file of another program in symgen's words.

    Attributes
    ----------
    raw : dict
        The description as nested tables, not yet validated.
    left_out : tuple of LeftOut
        What the file says and the description does not.
    format : str
        Name of the format.
    folder : Path
        The folder that meshes are named from: the file's, or the root of its package.
    """

    raw: dict[str, Any]
    left_out: tuple[LeftOut, ...]
    format: str
    folder: Path


FORMATS: Registry[type[Format]] = Registry("symgen.describe.formats", "file format")


def format_of(path: Path) -> str | None:
    """Return the name of the format of a file by the end of its name; None for a file of symgen's own.

    An end that several formats have, as ``.xml``, is settled by the outermost element.
    """
    from symgen.describe.formats._xml import outermost_tag

    suffix = path.suffix.lower()
    names = [name for name, kind in FORMATS.items() if suffix in kind.SUFFIXES]
    if len(names) < 2:
        return names[0] if names else None
    root = outermost_tag(path)
    return next((name for name in names if FORMATS.get(name).ROOT == root), names[0])


def read_robot(path: Path, name: str, *, floating: bool = False, stops: bool = False, contacts: bool = False) -> Import:
    """Return the description of a file of the format `name`.

    Parameters
    ----------
    path : Path
        The file.
    name : str
        Its format, from `format_of`.
    floating : bool
        Whether the base moves freely where the file does not say; it is fixed to the ground otherwise.
    stops : bool
        Whether limits of joints become stops without restitution.
    contacts : bool
        Whether spheres, capsules, boxes and wheels of collision become contacts with the ground.

    Raises
    ------
    InputError
        If the file is not of the format, or says what no mechanism can.
    """
    from symgen.describe.formats._raw import describe_robot

    robot = FORMATS.get(name).read(path, floating)
    raw, left_out, folder = describe_robot(robot, f"{path.name} ({name.upper()})", stops, contacts)
    if remarks := [f"left out, and the motion may depend on it: {item}" for item in left_out if item.moves]:
        raw["mechanism"]["remarks"] = remarks
    return Import(raw, left_out, name, folder)


__all__ = ["FORMATS", "Import", "LeftOut", "format_of", "read_robot"]
