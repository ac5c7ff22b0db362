"""The velocities that loops in closed form leave free, by the determinants of the loops at the described start.

Which two velocities a loop is solved for is part of a law's code, and of its name in the cache: a start that needs
another choice gets another module. The described start decides, with the described values of parameters, so that runs,
sweeps, packages and continued runs of a file have the same code. Other starts are right with it, too: where a
determinant gets small, the right-hand side goes back to pivots.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import combinations
from math import comb
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.loop_order import loop_order
from symgen.compile.store.entries import Entries
from symgen.compile.store.loaded_modules import load_module, plain_function
from symgen.derive.methods._base import Method
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import state_names
from symgen.describe.remembered import compute_once
from symgen.run.compiling.folders import folder_of
from symgen.run.compiling.method_choice import MethodChoice
from symgen.run.compiling.straight import StraightStages
from symgen.run.layout.compiled import ModelInfo

if TYPE_CHECKING:
    from symgen.base.ir.program import LawProgram, ModelProgram
    from symgen.derive.formulate.equations import Equations

Array = NDArray[np.float64]

#: Most choices of free velocities that are tried.
MOST_CHOICES = 500
#: Least squared sine of the angle between the two columns of a loop at the start; see `PARALLEL`.
LEAST_SINE = 0.02
#: Least singular value of rows that are independent, over their largest entry.
DEPENDENT = 1e-9
#: The first choice with this part of the best one's least squared sine is taken.
NEARLY_BEST = 0.25


def choice_at_start(mechanism: Mechanism, choice: MethodChoice) -> MethodChoice:
    """Return a choice with the velocities that stay free, where a mechanism's loops are closed by determinants."""
    if choice.implicit or choice.shape != "straight":
        return choice
    closed = replace(choice, free=free_velocities(mechanism))
    if not closed.free or _is_stored(mechanism, closed):
        return closed
    return closed if _eliminates_multipliers(choice.method, tuple(choice.options.items())) else choice


def _is_stored(mechanism: Mechanism, choice: MethodChoice) -> bool:
    """Whether the cache has the code of a choice, which then eliminates: recording its law takes longer."""
    return Entries().get(folder_of(mechanism), choice.stem) is not None


@lru_cache(maxsize=64)
def _eliminates_multipliers(method: Method, options: tuple[tuple[str, str], ...]) -> bool:
    """Whether a method solves M v' + D^T lambda = f, D v' = gamma in its right-hand side."""
    from symgen.derive.lower.record import record_law

    record = record_law(method, dict(options))
    direct = record.form == "direct" and method.integrates != "independent"
    return direct and any(operation.kind == "constrained" for operation in record.operations)


def law_at_start(mechanism: Mechanism, equations: Equations, program: ModelProgram, choice: MethodChoice) -> LawProgram:
    """Return the program of a method, without a form for implicit integrators, with the loops that runs close."""
    from symgen.derive.lower.law import lower_law
    from symgen.derive.lower.plans import closing_plan

    choice = choice_at_start(mechanism, choice)
    closing = closing_plan(equations, program.plan, choice.free)
    return lower_law(equations, program, choice.method, choice.options, closing=closing, suffix=choice.suffix)


@compute_once
def free_velocities(mechanism: Mechanism) -> tuple[int, ...]:
    """Return the velocities that no loop is solved for; none where loops are not closed."""
    info, model = _model_at_start(mechanism)
    every = {c for _, columns in info.pairs for c in columns}
    count = len(every) - 2 * len(info.pairs)
    if not info.pairs or count < 1 or comb(len(every), count) > MOST_CHOICES:
        return ()
    try:
        d = _jacobian_at_start(mechanism, info, model)
    except (ArithmeticError, ValueError, InputError):  # of a start that is refused elsewhere
        return ()
    own = [i for i in range(info.m) if i not in info.bounded]
    if np.linalg.matrix_rank(d[own], DEPENDENT * np.abs(d).max()) < len(own):
        return ()  # a row that is left out may be that of a loop
    left = _eliminate_fixed(info, d)
    sines = {free: _least_sine(info, left, free) for free in combinations(sorted(every), count)}
    best = max(sines.values())
    if not best > LEAST_SINE:
        return ()
    return next(free for free, sine in sines.items() if sine >= max(NEARLY_BEST * best, LEAST_SINE))


def _model_at_start(mechanism: Mechanism) -> tuple[ModelInfo, Any]:
    """Return description and module of a mechanism's own functions, emitted where the cache does not have them."""
    stages = StraightStages(mechanism, ())
    with stages.store.completing(stages.folder, stages.stems) as stages.described:
        if not stages.described:
            stages.keep(stages.emit(stages.lower(stages.formulate())))
    metadata, path = stages.described["model"], stages.store.path(stages.folder, "model")
    return msgspec.convert(metadata, ModelInfo), load_module(path)


def _jacobian_at_start(mechanism: Mechanism, info: ModelInfo, model: Any) -> Array:
    """Return D at the described start."""
    values = parameter_values(mechanism)
    q = described_start(mechanism, scalar_values(values))[0]
    if mechanism.topology is not None:
        q = _coordinates_on_joints(mechanism, q)
    sections = info.sections.values()
    y, w = [*map(float, q), *[0.0] * (info.ny - info.nq)], [0.0] * max(first + size for first, size in sections)
    for name in ("gauge", "row_weight"):
        first, size = info.sections[name]
        w[first : first + size] = [1.0] * size
    p = [*(float(values[x.name]) for x in info.parameters), *[0.0] * (info.hoisted + 1)]
    plain_function(model.prepare)(p)
    plain_function(model.geometry)(0.0, y, p, w)
    d, first = np.zeros((info.m, info.nv)), info.sections["jacobian"][0]
    for row, column, constant, slot in info.jacobian:
        d[row, column] = w[first + slot] if constant is None and slot is not None else constant
    return d


def _coordinates_on_joints(mechanism: Mechanism, q: Sequence[float]) -> list[float]:
    """Return coordinates of a tree that are coordinates of bodies.

    Raises
    ------
    ValueError
        If one is a displacement of a joint, which is not described.
    """
    assert mechanism.topology is not None, "it has a tree"
    described = (f"{body.name}.{c}" for body in mechanism.bodies for c in body.coordinates)
    of_bodies = dict(zip(described, q, strict=True))
    names, _ = state_names(mechanism, mechanism.topology)
    if missing := [name for name, _ in names if name not in of_bodies]:
        raise ValueError(missing[0])
    return [of_bodies[name] for name, _ in names]


def _eliminate_fixed(info: ModelInfo, d: Array) -> Array:
    """Return D with the fixed velocities eliminated."""
    columns = [c for block, _ in info.fixed for c in block]
    rows = [r for _, block in info.fixed for r in block]
    return d - d[:, columns] @ np.linalg.solve(d[np.ix_(rows, columns)], d[rows])


def _least_sine(info: ModelInfo, d: Array, free: Sequence[int]) -> float:
    """Return the least squared sine of the angle between the two columns of a loop; 0 where a loop is not closed."""
    loops, least = loop_order(info.pairs, free), 1.0
    if len(loops) < len(info.pairs):
        return 0.0
    for loop in loops:
        (a, b), (c, e) = d[np.ix_(loop.rows, loop.columns)]
        lengths = (a * a + c * c) * (b * b + e * e)
        least = min(least, (a * e - b * c) ** 2 / lengths) if lengths > 0.0 else 0.0
    return float(least)
