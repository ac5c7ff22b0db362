"""Runs that keep the stages of their steps and their passages, for the way back (`symgen.run.directions.adjoint`)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.padding import aligned
from symgen.run.directions.passages import PassingSimulation, RunPassage
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Outputs
    from symgen.run.loops.integrator import Integrator, Setup
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Numbers of steps that are kept in one page, passages in a page, and bytes of all that is kept.
_PIECE, _PASSAGES, MOST_KEPT = 1 << 20, 64, 4 << 30


class Uncovered(InputError):
    """A run has no adjoint; says what has one."""


def reason_against_adjoint(expected: str, got: str, hint: str = "") -> Uncovered:
    """Return the error on a run without an adjoint."""
    return Uncovered("adjoint", expected, got, hint or "forward directions take it")


def renewed_modes(spec: RunSpec, compiled: CompiledModel) -> range:
    """Return the places of the numbers of modes in the scratch, if steps renew any: directions of slip in space."""
    rows = None if spec.events is None else spec.events.bounded
    if rows is None or not rows.paired:
        return range(0)
    first, size = compiled.info.sections["modes"]
    return range(first, first + size)


@dataclass(frozen=True)
class Recorder:
    """An explicit scheme that keeps its stages.

    Parameters
    ----------
    integrator : Integrator
        The scheme.
    """

    integrator: Integrator

    def __getattr__(self, name: str) -> Any:
        return getattr(self.integrator, name)

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop, which keeps steps after the memory of the scheme."""
        from symgen.run.loops.schemes import adjoint

        plain = self.integrator.setup(compiled, spec, w)
        return replace(
            plain,
            loop=adjoint.adaptive if spec.adaptive else adjoint.constant,
            memory=plain.memory + adjoint.HEAD,
        )


class KeptRun(PassingSimulation):
    """A run that keeps its stages.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `Simulation`.
    pages : list of Array
        Memory for records, of an earlier run or empty.

    Attributes
    ----------
    first : Array
        Record of the start, whose state was corrected.
    course : list of (Array or Passage)
        Records of `symgen.run.loops.schemes.adjoint`, each part of them after a record of where it begins, and the
        passages between them.
    renewed : range
        Places of numbers of modes that are kept with each step.
    corrected : int
        Number of passages before the state at the start was corrected.
    bytes_kept : int
        Their bytes.
    """

    def __init__(
        self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec, pages: list[Array]
    ) -> None:
        from symgen.run.loops.schemes.adjoint import HEAD, PLACE, RENEWED, TURNING, record_size

        super().__init__(compiled, Recorder(integrator), start, spec)
        self._head, angles, self.renewed = (
            self.setup.memory - HEAD,
            compiled.info.windings,
            renewed_modes(spec, compiled),
        )
        count = len(self.renewed)
        self.size = record_size(self.sizes.width, int(self.scheme.stages), angles + count)
        self.state.memory[self._head + TURNING], self.state.memory[self._head + RENEWED] = angles, count
        self.state.memory[self._head + PLACE] = self.renewed.start
        self._capacity = _PIECE // self.size
        self.first, self.corrected, self.bytes_kept = np.zeros(0), 0, 0
        self.course = list[Array | RunPassage]()
        self._pages, self._turned, self._begins, self._left = pages, 0, 0, 0
        if self._capacity < 1:
            raise reason_against_adjoint("a smaller mechanism", f"one with {self.sizes.ny} numbers in its state")

    def enter(
        self, outputs: Outputs, until: float | None = None, pause: float = np.inf, most: float | None = None
    ) -> int:
        """Continue, and keep all steps."""
        end = self.spec.until if until is None else until
        while True:
            begun = len(self.first) > 0
            if begun:
                self._close_page()
                self._turn_page(self._record(self._count - 1).copy() if self._turned else self.first)
            seam = next((seam.t for seam in self.spec.seams if self.is_ahead(seam.t)), end)
            here = self.state.control[abi.STEPS]
            code = super().enter(outputs, min(seam, end), min(pause, here + self._capacity * begun), most)
            if not begun:
                self.first, self.corrected = self._present_state(float(self.state.iw[abi.ITERATIONS])), len(self.course)
                self._keep_step(self.first)
            elif self._has_changed():
                self._pass_event((), self._present_moment()._replace(p=self._p))
            if code == abi.DONE and seam < end:
                continue
            if code != abi.PAUSED or self.state.control[abi.STEPS] >= pause:
                self._close_page()
                return code

    def note_passed(self, passage: RunPassage) -> None:
        """Keep a passage; the steps after it begin anew."""
        self._close_page()
        self.course.append(passage)
        self._keep_step(passage.before.y, passage.before.w, passage.after.y, passage.after.w)
        if len(self.first) == 0:  # the run has not begun
            return
        if self._left == 0:
            self._turn_page(self._present_state())
            return
        self._left -= 1
        self._begins = self._count
        self.state.memory[self._head] += 1.0
        self._record(self._begins)[:] = self._present_state()

    def _note_end(self, code: int, until: float) -> int | None:
        if code != abi.CHOOSE:
            return super()._note_end(code, until)
        before = self._present_moment()
        ended = super()._note_end(code, until)
        self._pass_event((), before)
        return ended

    @property
    def _count(self) -> int:
        """Number of records in the present page."""
        return int(self.state.memory[self._head])

    def _record(self, number: int) -> Array:
        from symgen.run.loops.schemes.adjoint import HEAD

        record: Array = self.state.memory[self._head + HEAD :][number * self.size : (number + 1) * self.size]
        return record

    def _present_state(self, corrections: float = 0.0) -> Array:
        """Return the record of the present state."""
        from symgen.run.loops.schemes.adjoint import ANGLES, CORRECTIONS, TIME, state_at

        record, angles = np.zeros(self.size), self.compiled.info.windings
        record[TIME], record[CORRECTIONS] = self.state.clock[abi.TIME], corrections
        record[state_at(angles + len(self.renewed)) :][: self.sizes.width] = self.state.y
        record[ANGLES : ANGLES + angles] = self.state.w[abi.WINDING : abi.WINDING + angles]
        record[ANGLES + angles :][: len(self.renewed)] = self.state.w[self.renewed.start : self.renewed.stop]
        return record

    def _has_changed(self) -> bool:
        """Whether time or inputs have changed since the last step."""
        from symgen.run.loops.schemes.adjoint import TIME

        last = self._record(self._count - 1)
        return bool(last[TIME] != self.state.clock[abi.TIME]) or not np.array_equal(self._p, self.state.p)

    def _keep_step(self, *arrays: Array) -> None:
        self.bytes_kept += sum(array.nbytes for array in arrays)
        if self.bytes_kept > MOST_KEPT:
            raise reason_against_adjoint(
                f"stages of at most {MOST_KEPT >> 30} GiB", "more", "take larger tolerances or steps"
            )

    def _close_page(self) -> None:
        """Keep the steps since the last passage, or since the page was turned."""
        from symgen.run.loops.schemes.adjoint import HEAD

        if self._turned and self._count - self._begins > 1:
            records = self.state.memory[self._head + HEAD :][self._begins * self.size : self._count * self.size]
            self.course.append(records)
            self._keep_step(records)
            self._begins = self._count - 1

    def _turn_page(self, first: Array) -> None:
        """Let the loop write its next steps to another page, after a record of where they begin."""
        from symgen.run.loops.schemes.adjoint import HEAD

        head = self._head
        if len(self._pages) <= self._turned:
            self._pages.append(aligned(head + HEAD + (1 + self._capacity + _PASSAGES) * self.size))
        page = self._pages[self._turned]
        page[: head + HEAD] = self.state.memory[: head + HEAD]
        page[head] = 1.0
        page[head + HEAD :][: self.size] = first
        self._turned, self._begins, self._left = self._turned + 1, 0, _PASSAGES
        self.state = self.state._replace(memory=page)
        if self._prepared is not None:
            self._prepared[1].take_state(self.state)
