"""Facts about emitted code besides its source: set where it is lowered, stored as JSON, read where it runs."""

from __future__ import annotations

from typing import Any

import msgspec

#: Variables of the derivatives of linearised functions: time, q, v, v', multipliers, parameters, states of the file.
BY = ("t", "q", "v", "a", "lam", "p", "z")


class Info(msgspec.Struct, frozen=True):
    """Facts about a module or a part of one."""

    def to_dict(self) -> dict[str, Any]:
        """Return the values as JSON can express them."""
        result: dict[str, Any] = msgspec.to_builtins(self)
        return result


class LinearisedInfo(Info, frozen=True):
    """Layout of the numbers of a descriptor form with its derivatives: all values, then their structural nonzeros.

    Parameters
    ----------
    sizes : tuple of (str, int)
        Groups of values in their order, and their lengths.
    functions : tuple of (str, str, int)
        Coordinates of joints and outputs of the file, whose values follow the groups, order by order: name, unit,
        and the number of value, rate and second rate. A quantity of positions has all three, one of velocities
        two, as the rate of v' is not known; one of accelerations or multipliers its value alone.
    pattern : tuple of (int, int, int)
        Value, which of `BY`, and index of each derivative.
    elements : tuple of (str, int)
        For each value of the group ``elements``, the force and the velocity whose balance has it; none on a tree.
    """

    sizes: tuple[tuple[str, int], ...] = ()
    functions: tuple[tuple[str, str, int], ...] = ()
    pattern: tuple[tuple[int, int, int], ...] = ()
    elements: tuple[tuple[str, int], ...] = ()


class LawInfo(Info, frozen=True, kw_only=True):
    """Facts about an emitted law besides its source; in looped code the sizes follow with a mechanism's tables.

    Parameters
    ----------
    method, key : str
        The method's name, and the file stem: it and its structural options.
    options : dict of str to str
        Structural options, complete.
    parameters : tuple of (name, default)
        Of the method.
    parameter_offset : int
        Their places in p: after the numbers that the law itself hoists.
    hoisted : int
        Numbers after the parameters, for corrections and descriptor forms.
    position_correction, velocity_correction, energy_correction : bool
        Corrections after each accepted step.
    nw : int
        Length of ``w``.
    unknowns : int
        Of a stage in the descriptor form, before q and v; 0 without one.
    level : str
        Of the constraints in the descriptor form.
    tangent : tuple of (int, int)
        Equation and unknown, in the descriptor form, of each number that the function of this name writes.
    operations : dict of str to int
        Of each function of straight code.
    modules : tuple of str
        File stems of the modules that hold the law's functions, beside its own.
    unique_multipliers : bool
        Whether multipliers are determined where rows depend on each other.
    """

    method: str
    key: str
    options: dict[str, str]
    parameters: tuple[tuple[str, float], ...]
    parameter_offset: int = 0
    hoisted: int = 0
    position_correction: bool
    velocity_correction: bool
    energy_correction: bool = False
    nw: int = 0
    unknowns: int = 0
    level: str = ""
    tangent: tuple[tuple[int, int], ...] = ()
    operations: dict[str, int] = {}  # msgspec copies it
    modules: tuple[str, ...] = ()
    unique_multipliers: bool = False
