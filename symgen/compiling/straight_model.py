"""A compiled model in the straight shape, and what is known of emitted modules beside their source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

import msgspec
import numpy as np

from symgen.runtime.compiled import Array, CompiledModel, ModelInfo, RowInfo
from symgen.store.modules import load_module
from symgen.vocabulary.infos import LawInfo
from symgen.vocabulary.quantities import Quantity

if TYPE_CHECKING:
    from symgen.formulate.equations import Equations
    from symgen.ir.program import ModelProgram


@final
@dataclass(frozen=True, repr=False)
class StraightModel(CompiledModel):
    """A compiled model in the straight shape: code for one mechanism alone."""

    shape, sparse = "straight", False

    def scratch(self) -> Array:
        """Return a new scratch array ``w``; scales are 1 until a start finds them."""
        return self.with_scales(np.zeros(max(1, self.law.nw)))


def load_compiled(
    folder: Path,
    stem: str,
    model: Mapping[str, Any],
    law: Mapping[str, Any],
    derive_seconds: float = 0.0,
    emit_seconds: float = 0.0,
    shared: str = "model",
) -> StraightModel:
    """Load the emitted modules of a folder.

    Parameters
    ----------
    folder : Path
        Holds ``<shared>.py`` and ``<stem>.py``.
    stem : str
        File stem of the law.
    model, law : mapping
        Their metadata.
    derive_seconds, emit_seconds : float
        What generating them took, 0 if they were found.
    shared : str
        File stem of the module that all laws share.
    """
    return StraightModel(
        info=msgspec.convert(model, ModelInfo),
        law=msgspec.convert(law, LawInfo),
        model=load_module(folder / f"{shared}.py"),
        law_module=load_module(folder / f"{stem}.py"),
        derive_seconds=derive_seconds,
        emit_seconds=emit_seconds,
    )


def model_info(program: ModelProgram, equations: Equations) -> ModelInfo:
    """Collect the metadata of a program."""
    return ModelInfo(
        name=program.name,
        digest=program.digest,
        parameters=equations.parameters,
        coordinates=equations.coordinates,
        velocities=equations.velocities,
        rows=tuple(RowInfo(r.name, r.joint, r.unit, r.phi is not None) for r in equations.rows),
        joint_coordinates=tuple(Quantity(c.name, c.unit) for c in equations.joint_coordinates),
        sections=dict(program.layout.sections),
        jacobian=tuple((e.row, e.column, e.constant, e.slot) for e in program.jacobian),
        hoisted=program.hoisted,
        dropped_rows=equations.dropped_rows,
        massless=tuple(
            j for b in equations.mass for i, j in enumerate(b.columns) if equations.graph.value(b.entries[i][i]) == 0.0
        ),
        windings=len(equations.windings),
        spins=equations.spins,
        operations={b.name: b.operations for b in program.blocks},
        inputs=equations.inputs,
        alone=_alone(program, len(equations.rows)),
    )


def _alone(program: ModelProgram, rows: int) -> tuple[int, ...]:
    """Return the rows whose pivot is the same everywhere, so that ``geometry`` has nothing to say of it."""
    said = {
        target.index
        for block in program.blocks
        if block.name == "geometry"
        for target, _ in block.outputs
        if target.space == "pivot"
    }
    return tuple(i for i in range(rows) if i not in said)
