"""Starts of random mechanisms in both shapes and by sparse algebra, in a process in which nothing is compiled."""

import numpy as np

from support.emitted import mechanism_of
from support.random_closed import make
from symgen.api import Model, load
from symgen.base.errors import AssemblyError
from symgen.run.layout.compiled import CompiledModel
from symgen.run.starts import decisions
from symgen.run.starts.assembly import Held, Start

SEEDS = range(4)


def start_or_reason(model: Model, compiled: CompiledModel, held: Held | None) -> Start | str:
    """A start, or why there is none, but for by how much a joint stays open."""
    try:
        return model.assemble(compiled, held=held)
    except AssemblyError as error:
        return str(error).partition("stays open by")[0]


def differences(model: Model, straight: CompiledModel, looped: CompiledModel, held: Held | None) -> list[str]:
    """What differs between the starts of two shapes."""
    a, b = (start_or_reason(model, compiled, held) for compiled in (straight, looped))
    if isinstance(a, str) or isinstance(b, str):
        return [] if a == b else [f"{a} and {b}"]
    found = []
    if not np.allclose(a.y, b.y, rtol=0.0, atol=1e-8):
        found.append(f"y by {np.abs(a.y - b.y).max():.2g}")
    # which of several dependent rows counts as redundant is decided by the order of elimination, the shape's own
    if (a.rank, len(a.redundant_rows), len(a.notes)) != (b.rank, len(b.redundant_rows), len(b.notes)):
        found.append(f"{(a.rank, a.redundant_rows, a.notes)} and {(b.rank, b.redundant_rows, b.notes)}")
    # the shapes keep the angles in orders of their own
    turns = [np.sort(c.section(s.w, "winding")) for c, s in ((straight, a), (looped, b)) if c.info.windings]
    if turns and not np.allclose(*turns, rtol=0.0, atol=1e-8):
        found.append(f"angles {turns}")
    return found


def compare(name: str, model: Model, sparse: bool) -> None:
    """Print one line: straight against looped, with and without a held coordinate."""
    straight, looped = (model.compile("lagrange", shape=shape) for shape in ("straight", "looped"))
    found = []
    for held in (None, Held({0: float(model.assemble(straight).y[0]) + 0.05})):
        found += differences(model, straight, looped, held)
        if sparse:  # rows that depend on others are skipped there, not fitted: off the constraints that is another step
            largest, decisions.LARGEST_DENSE = decisions.LARGEST_DENSE, 0
            found += differences(model, straight, looped, held)
            decisions.LARGEST_DENSE = largest
    print(f"{name}: {'; '.join(found) or 'same'}")


def main() -> None:
    """Compare all of them."""
    for space in ("planar", "spatial"):
        for seed in SEEDS:
            for redundant in (False, True):
                for held_velocity in (False, True):
                    description = make(seed, space, redundant, held_velocity)
                    name = f"{space} {seed}{' redundant' * redundant}{' contradicting' * held_velocity}"
                    compare(name, load(mechanism_of(description)), sparse=not redundant)
