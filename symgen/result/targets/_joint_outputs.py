"""Outputs of emitted code in joint coordinates: coordinates and rates of joints, and what exerts along them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import msgspec

from symgen.base.vocabulary.expressions import Reading
from symgen.describe.formulas.readings import RATE
from symgen.describe.formulas.reported_columns import columns_of_force_elements
from symgen.describe.mechanism import Mechanism, Output

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo

#: Units of what exerts.
_EFFORTS = ("N", "N m")


def with_joint_outputs(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism with outputs of its joints after its own, by the names of results.

    These are the coordinates that joints report and their rates, and forces and torques of force elements.
    """
    own = {output.name for output in mechanism.outputs}
    further = tuple(output for output in _outputs_of_joints(mechanism) if output.name not in own)
    return msgspec.structs.replace(mechanism, outputs=(*mechanism.outputs, *further))


def _outputs_of_joints(mechanism: Mechanism) -> Iterator[Output]:
    for joint in mechanism.joints:
        for label, measure in joint.coordinates:
            name, unit = f"{joint.name}.{label}", joint.unit(label)
            yield Output(name, Reading(name, measure), unit)
            yield Output(f"{name}{RATE}", Reading(f"{name}{RATE}", measure, 1), f"{unit}/s")
    for column in columns_of_force_elements(mechanism):
        if column.unit in _EFFORTS:
            yield Output(column.name, column.formula, column.unit)


def names_of_states(info: ModelInfo, count: int) -> list[str]:
    """Return the names of an importer's states: names in the code, if all states there are independent, else numbers.

    Parameters
    ----------
    info : ModelInfo
        Of the code.
    count : int
        Number of the importer's states.
    """
    own = [q.name for q in (*info.coordinates, *info.velocities, *info.states)]
    own += [f"integral.{i + 1}" for i in range(info.integrals)]
    return own if len(own) == count else [str(i + 1) for i in range(count)]
