"""Families of stiff and extreme cases, one file each: found by their names, as joints and methods are.

The file ``mass_ratio.py`` is the family ``mass-ratio``; its `KIND` is a `Family`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from symgen.registry import Registry
from symgen.study.stress.bench import Base, Level


@dataclass(frozen=True)
class Family:
    """What is varied, and the cases it makes of a base model.

    Parameters
    ----------
    title : str
        One line for people.
    axes : tuple of str
        What the values are, with units: one, or two for a plane.
    levels : callable
        (base, quick) -> cases; raises `symgen.study.stress.bench.NotApplicable` where a base has none.
    own : bool
        The family has a mechanism of its own: it is run once, whatever the base models.
    """

    title: str
    axes: tuple[str, ...]
    levels: Callable[[Base, bool], Sequence[Level]]
    own: bool = False


CASES: Registry[Family] = Registry(__name__, "family of cases")
