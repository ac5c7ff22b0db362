"""What depends on time in an analysis: drivers that move, beside which nothing rests, and forces, which are held."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Call, Expr, moving_quantities, names_in_expression
from symgen.base.vocabulary.measures import FormulaMeasure, Holonomic
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.mechanism import Mechanism
from symgen.run.breaks.in_time import InTime

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]

#: A rate is a difference over this part of the run; it counts above this part of the mean speed of the run.
_NEAR, _SLOW = 1e-6, 1e-5
_SAMPLES = 33


def moving_drivers(mechanism: Mechanism, compiled: CompiledModel, p: Array, t: float) -> dict[str, str]:
    """Return the drivers that move at a time, and joints whose rows do, by name, with formulas of time.

    Parameters
    ----------
    mechanism : Mechanism
        With inputs in their places.
    compiled, p
        Its compiled model and the parameters.
    t : float
        Time [s].
    """
    formulas = [(name, e) for name, e in _driver_formulas(mechanism) if "t" in names_in_expression(e)]
    names = (q.name for q in compiled.info.parameters)
    in_time = InTime(mechanism, dict(zip(names, map(float, p), strict=False)))
    moving = dict[str, str]()
    for name, e in formulas:
        if name not in moving and _has_rate(in_time, e, t, mechanism.defaults.until):
            moving[name] = to_text(e)
    return moving


def _driver_formulas(mechanism: Mechanism) -> Iterator[tuple[str, Expr]]:
    """Yield drivers with their formulas, of rows and of coordinates of a tree, and parts of rows that are of time."""
    for joint in mechanism.joints:
        if joint.kind == "driver":
            yield from ((joint.name, row.value) for row in joint.rows if isinstance(row, Holonomic))
            continue
        of_time = (row.measure for row in joint.rows if isinstance(row, Holonomic))
        for measure in of_time:
            if isinstance(measure, FormulaMeasure):
                yield from ((joint.name, part) for part in _parts_of_time(measure.of))
    if mechanism.topology is not None:
        yield from ((x.driver, x.value) for x in mechanism.topology.prescribed)


def _parts_of_time(e: Expr) -> Iterator[Expr]:
    """Yield the largest parts of a formula that depend on the time and not on the motion."""
    if not moving_quantities(e):
        yield from (e,) if "t" in names_in_expression(e) else ()
    elif isinstance(e, Call):
        for argument in e.arguments:
            yield from _parts_of_time(argument)


def _has_rate(in_time: InTime, e: Expr, t: float, until: float) -> bool:
    """Return whether the rate of a formula is not 0; False where it is undefined."""
    h = _NEAR * until
    rate = (in_time.value_at(e, t + h) - in_time.value_at(e, t - h)) / (2.0 * h)
    samples = [in_time.value_at(e, t + until * k / (_SAMPLES - 1)) for k in range(_SAMPLES)]
    return abs(rate) > _SLOW * (max(samples) - min(samples)) / until


def refuse_moving_drivers(where: str, mechanism: Mechanism, compiled: CompiledModel, p: Array, t: float) -> None:
    """Refuse motions about an equilibrium beside which a driver moves.

    Raises
    ------
    InputError
        With the driver and its formula.
    """
    for name, formula in moving_drivers(mechanism, compiled, p, t).items():
        expected = "drivers at rest, as the motions asked for are those about an equilibrium"
        got = f"driver '{name}', which moves at t = {t:g} s by '{formula}'"
        raise InputError(where, expected, got, "give it a constant value, or ask for a steady motion")


def note_on_moving_drivers(mechanism: Mechanism, compiled: CompiledModel, p: Array, t: float) -> tuple[str, ...]:
    """Return a sentence about drivers that move and are held in an equilibrium; none without such drivers."""
    moving = moving_drivers(mechanism, compiled, p, t)
    verb, them = ("moves", "it") if len(moving) == 1 else ("move", "them")
    return (f"{', '.join(moving)} {verb} at t = {t:g} s; the equilibrium holds {them} there",) if moving else ()


def note_on_forces_of_time(mechanism: Mechanism, t: float) -> tuple[str, ...]:
    """Return a sentence about forces and states whose formulas read the time and are held; none without such ones."""
    named = [
        f"force '{x.name}'" for x in mechanism.forces if any("t" in names_in_expression(e.magnitude) for e in x.efforts)
    ]
    named += [f"state '{x.name}'" for x in mechanism.states if "t" in names_in_expression(x.rate)]
    verb, it = ("depends", "it counts") if len(named) == 1 else ("depend", "they count")
    return (f"{', '.join(named)} {verb} on t: {it} as at t = {t:g} s",) if named else ()
