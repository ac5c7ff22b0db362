"""Entries of the catalogue with the coordinates that they have: modal bodies have those of bodies alone."""

from collections.abc import Iterable

from symgen import load


def in_coordinates(names: Iterable[str]) -> list[tuple[str, str]]:
    """Return each name with ``absolute``, and with ``joint`` where it has these."""
    kinds = {name: ("absolute",) if load(name).mechanism.has_modal_bodies else ("absolute", "joint") for name in names}
    return [(name, kind) for name, own in kinds.items() for kind in own]
