"""A recorded motion: coordinates, velocities and accelerations of a run, or of a file that a result was saved to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.describe.columns import PREFIX
from symgen.errors import InputError, quoted
from symgen.result.labelled import Array
from symgen.result.saved import read_saved

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Recorded:
    """A recorded motion.

    Attributes
    ----------
    whence : str
        Where it is from, for messages.
    t : Array, shape (k,)
        Times [s].
    columns : mapping of str to Array
        Coordinates, velocities and accelerations by name, each of shape (k,); coordinates of joints behind ``joint.``,
        where they are known: angles of these count turns.
    parameters : mapping of str to float
        Values that are known to have held.
    inputs : mapping of str to float or str
        The same of inputs, in words where they were no numbers.
    """

    whence: str
    t: Array
    columns: Mapping[str, Array]
    parameters: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, float | str] = field(default_factory=dict)

    def table(self, names: Sequence[str]) -> Array:
        """Return columns in an order, shape (k, n).

        Raises
        ------
        InputError
            If one is missing, or holds numbers that are not finite.
        """
        for name in names:
            if name not in self.columns:
                raise InputError(self.whence, "the motion of this mechanism", f"no column {quoted(name)}")
        found = np.zeros((len(self.t), len(names)))
        for i, name in enumerate(names):
            found[:, i] = self.columns[name]
        if not np.all(np.isfinite(found)):
            raise InputError(self.whence, "finite numbers", "others")
        return found


def recorded(motion: Any) -> Recorded:
    """Return the motion of a result, or of whatever has the tables ``q``, ``v`` and ``a`` over ``t``.

    Raises
    ------
    InputError
        If it has not.
    """
    if isinstance(motion, Recorded):
        return motion
    if not all(hasattr(motion, name) for name in ("t", "q", "v", "a")):
        raise InputError("motion", "a result of a run, or a motion of kinematics", f"a {type(motion).__name__}")
    tables = motion.q, motion.v, motion.a
    columns = {name: table.values[:, i] for table in tables for i, name in enumerate(table.names)}
    if hasattr(motion, "joint_coordinates"):
        joints, prefix = motion.joint_coordinates, PREFIX["joint_coordinates"]
        columns |= {f"{prefix}{name}": joints[name] for name in joints.names}
    parameters, inputs = getattr(motion, "parameters", {}), getattr(motion, "inputs", {})
    return Recorded("motion", np.asarray(motion.t, dtype=np.float64), columns, dict(parameters), dict(inputs))


def read_recorded(option: str, path: Path) -> Recorded:
    """Return the motion that a file of a result holds.

    Parameters
    ----------
    option : str
        Who asks, for messages.
    path : Path
        A ``.nc``, ``.parquet`` or ``.csv`` file with all columns of coordinates, velocities and accelerations.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """
    where = f"{option} '{path.name}'"
    return read_saved(
        option, path, lambda s: Recorded(where, s.t, s.columns, s.run.get("parameters", {}), s.run.get("inputs", {}))
    )
