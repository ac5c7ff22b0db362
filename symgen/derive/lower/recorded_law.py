"""A recorded law: its functions as formulas before layout, and what they are called."""

from __future__ import annotations

from dataclasses import dataclass, replace

from symgen.derive.methods._tape import ALTERNATIVES, FormulaStep

#: Groups of equations of a descriptor form: kinematic, dynamic, then up to three rows for each constraint.
EQUATIONS = ("q", "v", "first", "second", "third")
#: Levels with equations after those of a stage, and their number in multiples of m.
BEHIND = {"projected": 2, "explicit": 1}
#: Arguments of the functions of a law.
ARGUMENTS = {
    **dict.fromkeys(("rhs", "rates"), ("t", "y", "p", "w", "iw", "ydot")),
    **dict.fromkeys(("begin", "aim", "geometry"), ("t", "y", "p", "w")),
    **dict.fromkeys(("iterate", "weigh", "expand", "refactor", "spread"), ("p", "w")),
    **dict.fromkeys(("finish", "balance"), ("t", "y", "p", "w", "ydot")),
    "strike": ("w",),
}


@dataclass(frozen=True)
class Part:
    """A function of a law.

    Parameters
    ----------
    name, purpose : str
        Of the emitted function.
    outputs : tuple of (str, int)
        Target of each value: a section of ``w``, ``status.NAME``, ``rates.q``, ``rates.v`` or ``rates.work`` of the
        state, a group of `EQUATIONS`; and its operation.
    flag : int, optional
        The operation that flags suspicious pivots.
    role : {"acceleration", "iteration", "balance", "metric", "form"}
        Part of the law.
    velocities : int, optional
        The operation that computes v where the state does not hold it.
    factors : tuple of (str, int)
        Outputs that nothing reads but solutions by factors of D W D^T, see `RecordedLaw.resolved`.
    """

    name: str
    purpose: str
    outputs: tuple[tuple[str, int], ...]
    flag: int | None = None
    role: str = "acceleration"
    velocities: int | None = None
    factors: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class RecordedLaw:
    """A law as formulas.

    Parameters
    ----------
    operations : tuple of FormulaStep
        Recorded operations, in order.
    parts : tuple of Part
        The functions, in the order of their text.
    sections : tuple of (str, tuple of str)
        The law's own sections of ``w``, and the sizes to multiply; none: the number of its outputs.
    form : str
        Computation of v': ``direct``, ``iterated``, ``dense`` or ``tangent``; of a descriptor form its level.
    """

    operations: tuple[FormulaStep, ...]
    parts: tuple[Part, ...]
    sections: tuple[tuple[str, tuple[str, ...]], ...] = ()
    form: str = ""

    @property
    def output_operations(self) -> list[int]:
        """Operations whose values the functions return."""
        return [
            index for part in self.parts for index in (*(i for _, i in part.outputs), part.flag) if index is not None
        ]

    def choose_solution(self, schur: bool, apart: frozenset[str] = frozenset()) -> RecordedLaw:
        """Return the same with one way to what may be solved in two: by factors of D W D^T, or by fixed velocities.

        Parameters
        ----------
        schur : bool
            Whether by factors.
        apart : set of str
            Kinds of operations that choose a way themselves.
        """
        if schur:
            kinds = ALTERNATIVES - apart
            same = {i: o.operands[0] for i, o in enumerate(self.operations) if o.kind in kinds}
            chosen = (replace(o, operands=o.operands[1:]) if o.kind in apart else o for o in self.operations)
            operations = (replace(o, operands=tuple(same.get(i, i) for i in o.operands)) for o in chosen)
            parts = (
                replace(part, outputs=tuple((place, same.get(i, i)) for place, i in part.outputs))
                for part in self.parts
            )
            return replace(self, operations=tuple(operations), parts=tuple(parts))
        operations = (replace(o, operands=o.operands[1:]) if o.kind in ALTERNATIVES else o for o in self.operations)
        parts = (
            replace(part, outputs=tuple(output for output in part.outputs if output not in part.factors))
            for part in self.parts
        )
        return replace(self, operations=tuple(operations), parts=tuple(part for part in parts if part.outputs))
