"""Keys of joints and sections of files that describe rows with bounds: one file a kind in `kinds`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Protocol

import msgspec

from symgen.base.registry import Registry
from symgen.describe.bounded import BoundedRow, RowFamily
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import OF_ANY_JOINT, value_in_words
from symgen.describe.parts.scope import Scope


class OfJoint(Protocol):
    """Reader of a key of joints."""

    def __call__(self, scope: Scope, joint: Joint, raw: object) -> tuple[BoundedRow, ...]:
        """Return the rows of a joint."""
        ...


class OfSection(Protocol):
    """Reader of an entry of a section."""

    def __call__(self, scope: Scope, raw: object) -> tuple[BoundedRow, ...]:
        """Return the rows of an entry."""
        ...


class KeyOfJoints(msgspec.Struct, frozen=True):
    """A key that joints may have, the words for its rows, the type of its table, and what reads it.

    `kinds` are the kinds of joints that have the key among their own; without any, joints of any kind may have it.
    """

    key: str
    family: RowFamily
    table: Any
    read: OfJoint
    kinds: tuple[str, ...] = ()


class SectionOfFiles(msgspec.Struct, frozen=True):
    """A section of files, the words for its rows and further ones, the table of an entry, and what reads that."""

    section: str
    family: RowFamily
    table: type[msgspec.Struct]
    read: OfSection
    further: tuple[RowFamily, ...] = ()


BOUNDS: Registry[KeyOfJoints | SectionOfFiles] = Registry("symgen.describe.bounds.kinds", "row with bounds")


def keys_of_joints() -> dict[str, KeyOfJoints]:
    """Return the kinds that are keys of joints, by their keys."""
    return {kind.key: kind for _, kind in BOUNDS.items() if isinstance(kind, KeyOfJoints)}


def sections_of_files() -> dict[str, SectionOfFiles]:
    """Return the kinds that are sections of files, by their sections."""
    return {kind.section: kind for _, kind in BOUNDS.items() if isinstance(kind, SectionOfFiles)}


def keys_of_any_joint() -> dict[str, Any]:
    """Return keys, with their types, that joints of any kind may have besides their own."""
    return {**OF_ANY_JOINT, **{key: kind.table for key, kind in keys_of_joints().items() if not kind.kinds}}


def all_families() -> tuple[RowFamily, ...]:
    """Return the families of all kinds."""
    return tuple(dict.fromkeys(kind.family for _, kind in BOUNDS.items()))


def nouns_of_families(word: str = "noun", joined: str = "and") -> str:
    """Return a word of all families as an enumeration: what rows with bounds are."""
    *words, last = (str(getattr(family, word)) for family in all_families())
    return f"{', '.join(words)} {joined} {last}"


def inspection_lines(facts: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines of ``symgen inspect`` on rows with bounds, from its facts."""
    further = (family for kind in sections_of_files().values() for family in kind.further)
    for family in (*all_families(), *further):
        yield from map(family.line, facts.get(family.fact, ()))


def rows_of_joint(scope: Scope, joint: Joint, raw: Mapping[str, Any]) -> Iterator[BoundedRow]:
    """Yield the rows with bounds that a joint's table describes.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    for key, kind in keys_of_joints().items():
        if key in raw and joint.kind in (kind.kinds or (joint.kind,)):
            yield from kind.read(scope, joint, raw[key])


def tables_by_coordinate(scope: Scope, joint: Joint, key: str, raw: object, example: str) -> Mapping[str, object]:
    """Return the table that a key of a joint holds for each of its coordinates.

    Parameters
    ----------
    scope : Scope
        The place of the joint.
    joint : Joint
        The joint.
    key : str
        The key.
    raw : object
        A table for its only coordinate, or a table of such tables.
    example : str
        A table for a coordinate.

    Raises
    ------
    InputError
        If it is no table, or the joint has no such coordinates.
    """
    if not isinstance(raw, Mapping):
        raise scope.error(key, f"a table such as {example}", value_in_words(raw))
    labels = dict(joint.coordinates)
    if not labels:
        raise scope.error(key, "a joint with a coordinate", f"a {joint.kind} joint, which reports none")
    if joint.kind == "driver":
        raise scope.error(key, "a joint whose coordinate is free", "a driver")
    if len(labels) == 1 and not set(raw) & set(labels):
        return {next(iter(labels)): raw}
    if not raw or not set(raw) <= set(labels):
        other = next((repr(label) for label in raw if label not in labels), "none")
        raise scope.error(key, f"coordinates of the joint ({', '.join(labels)})", other)
    return raw
