"""Adjoints of runs: derivatives of one number at the end by everything that a run begins with.

A run keeps its stages, and is passed through once more, backwards. Its cost does not depend on how many numbers the
result is differentiated by.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compile.loopcode.padding import aligned
from symgen.compile.native.adjoints import Accesses, accesses, correction
from symgen.compile.native.read_values import Foreign
from symgen.compile.store.emitted import AdjointFunction, EmittedFunction
from symgen.run.layout import abi
from symgen.run.single.directed_model import for_derivatives
from symgen.run.single.run import Progress, completed
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Outputs
    from symgen.run.loops.integrator import Integrator, Setup
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.outcome import Outcome
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Numbers of a part of a run that is kept in one piece, and bytes of all parts together.
_PIECE, MOST_KEPT = 1 << 20, 4 << 30


_HINT = "lagrange and direct-correction have one; forward directions take all methods"


class Uncovered(InputError):
    """A run has no adjoint; says what has one."""


def _refusal(expected: str, got: str, hint: str = "") -> Uncovered:
    return Uncovered("adjoint", expected, got, hint or "forward directions take it")


def check_covered(compiled: CompiledModel, integrator: Integrator, spec: RunSpec, start: Start) -> None:
    """Refuse a run that has no adjoint.

    Raises
    ------
    Uncovered
        With what has one.
    """
    from symgen.run.loops.schemes import explicit

    if integrator.loop(spec.adaptive) not in (explicit.constant, explicit.adaptive):
        raise _refusal("an explicit Runge-Kutta scheme", f"'{integrator.name}'", "take dop853")
    if spec.events is not None or spec.seams or start.saved is not None:
        raise _refusal("a run without events, jumps at known times, or a past", "one with some")
    law = compiled.law_module
    if not isinstance(law.rhs, EmittedFunction):
        raise _refusal("compiled functions", "NUMBA_DISABLE_JIT, where plain Python runs")
    _check_functions(for_derivatives(law, "rhs"), law.accept, compiled.law.method, compiled.info.windings)


@functools.lru_cache(maxsize=256)
def _check_functions(rhs: EmittedFunction, accept: EmittedFunction, law: str, windings: int) -> None:
    """Refuse functions without an adjoint, and those that keep numbers from step to step; compile the adjoints.

    Parameters
    ----------
    rhs, accept : EmittedFunction
        Of the law.
    law : str
        Its method.
    windings : int
        Number of angles that count turns.
    """
    from symgen.run.loops.schemes.adjoint import ANGLES, CORRECTION, HEAD, RATES

    method = f"the method {law}"
    own, other = _accesses(rhs, abi.RHS), _accesses(accept, abi.ACCEPT)
    _compile(_adjoint(rhs), RATES, f"accelerations of {method}")
    angles = {("w", abi.WINDING + i) for i in range(min(windings, HEAD - ANGLES))}
    passing = {place for place in own.stored | other.stored if place[0] == "w"} - (angles - own.stored)
    read = own.read
    if _corrects(accept):
        _compile(_adjoint(accept, 0), CORRECTION, f"corrections of {method}")
        read |= _correction_accesses(accept).read
    if read & passing and windings > HEAD - ANGLES:
        raise _refusal(f"at most {HEAD - ANGLES} angles that count turns", f"{windings}")
    if read & passing or ("w", -1) in own.read | own.stored:
        raise _refusal("rates of the state alone", f"{method}, which keeps numbers from step to step")


@functools.lru_cache(maxsize=256)
def _corrects(accept: EmittedFunction) -> bool:
    """Whether a function that accepts states changes them."""
    return any(array == "y" for array, _ in _accesses(accept, abi.ACCEPT).stored)


@functools.lru_cache(maxsize=256)
def _accesses(function: EmittedFunction, kind: Any) -> Accesses:
    try:
        return accesses(function.read(kind.signature.arguments).body)
    except Foreign as foreign:
        raise _refusal("functions of the state in closed form", str(foreign)) from None


@functools.lru_cache(maxsize=256)
def _correction_accesses(accept: EmittedFunction) -> Accesses:
    return accesses(correction(accept.read(abi.ACCEPT.signature.arguments), 0).body)


@functools.lru_cache(maxsize=256)
def _adjoint(function: EmittedFunction, rounds: int | None = None) -> AdjointFunction:
    """Return the adjoint of a function, the same one for all runs."""
    return AdjointFunction(function, rounds)


def _compile(function: AdjointFunction, kind: Any, what: str) -> None:
    """Compile an adjoint, or say why there is none."""
    try:
        function.address(kind.signature)
    except InputError as error:
        raise _refusal("functions of the state in closed form", f"{what} with {error.got}", _HINT) from None


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
        """Return the arguments of the loop, which keeps steps behind the memory of the scheme."""
        from symgen.run.loops.schemes import adjoint

        plain = self.integrator.setup(compiled, spec, w)
        return replace(
            plain,
            loop=adjoint.adaptive if spec.adaptive else adjoint.constant,
            memory=plain.memory + adjoint.HEAD,
        )


class KeptRun(Simulation):
    """A run that keeps its stages.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `Simulation`.
    pages : list of Array
        Memory for records, of an earlier run or empty.

    Attributes
    ----------
    pieces : list of Array
        Records of `symgen.run.loops.schemes.adjoint`: the start alone, then parts of the run, each behind the last
        record before it.
    bytes_of_steps : int
        Their bytes.
    """

    def __init__(
        self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec, pages: list[Array]
    ) -> None:
        from symgen.run.loops.schemes.adjoint import HEAD, record_size

        super().__init__(compiled, Recorder(integrator), start, spec)
        self._first = self.setup.memory - HEAD
        self.size = record_size(self.sizes.width, int(self.scheme.stages))
        self._capacity = _PIECE // self.size
        self.pieces, self._pages, self.bytes_of_steps = list[Array](), pages, 0
        if self._capacity < 1:
            raise _refusal("a smaller mechanism", f"one with {self.sizes.ny} numbers in its state")

    def enter(
        self, outputs: Outputs, until: float | None = None, pause: float = np.inf, most: float | None = None
    ) -> int:
        """Continue, and keep all steps."""
        from symgen.run.loops.schemes.adjoint import ANGLES, CORRECTIONS, HEAD, TIME

        while True:
            if self.pieces:
                self._turn_page()
            here = self.state.control[abi.STEPS]
            code = super().enter(outputs, until, min(pause, here + self._capacity * bool(self.pieces)), most)
            if not self.pieces:  # the start was corrected
                first = np.zeros(self.size)
                first[TIME], first[CORRECTIONS] = self.state.clock[abi.TIME], self.state.iw[abi.ITERATIONS]
                first[HEAD : HEAD + self.sizes.width] = self.state.y
                own = self.state.w[abi.WINDING :][: HEAD - ANGLES]
                first[ANGLES : ANGLES + len(own)] = own
                self._append(first)
            elif (count := int(self.state.memory[self._first])) > 1:
                self._append(self.state.memory[self._first + HEAD :][: count * self.size])
            if self.bytes_of_steps > MOST_KEPT:
                raise _refusal(f"stages of at most {MOST_KEPT >> 30} GiB", "more", "take larger tolerances or steps")
            if code != abi.PAUSED or self.state.control[abi.STEPS] >= pause:
                return code

    def _append(self, piece: Array) -> None:
        self.pieces.append(piece)
        self.bytes_of_steps += piece.nbytes

    def _turn_page(self) -> None:
        """Let the loop write its next steps to another page, behind a copy of the last one."""
        from symgen.run.loops.schemes.adjoint import HEAD

        first, place = self._first, len(self.pieces) - 1
        if len(self._pages) <= place:
            self._pages.append(aligned(first + HEAD + (1 + self._capacity) * self.size))
        page = self._pages[place]
        page[: first + HEAD] = self.state.memory[: first + HEAD]
        page[first] = 1.0
        page[first + HEAD :][: self.size] = self.pieces[-1][-self.size :]
        self.state = self.state._replace(memory=page)
        if self._prepared is not None:
            self._prepared[1].take_state(self.state)


@dataclass(frozen=True)
class Adjoint:
    """A run that was made, and can be passed through backwards.

    Attributes
    ----------
    outcome : Outcome
        Of the run.
    run : KeptRun
        Its steps.
    """

    outcome: Outcome
    run: KeptRun

    def back(self, end: Array) -> tuple[Array, Array, Array]:
        """Return the adjoints of the state at the start, the parameters and the scratch.

        Parameters
        ----------
        end : Array, shape (ny,)
            Adjoint of the state at the end.
        """
        from symgen.run.loops.schemes.adjoint import (
            ANGLES,
            CORRECTION,
            CORRECTIONS,
            HEAD,
            Corrections,
            back_through,
            transposed,
        )
        from symgen.run.loops.schemes.adjoint import back_through_corrected as corrected

        run, state = self.run, self.run.state
        law, width, sizes = run.compiled.law_module, run.sizes.width, (len(state.p), len(state.w))
        bars, room = np.zeros(width + sum(sizes)), np.zeros((int(run.scheme.stages) + 4) * width)
        bars[: len(end)] = end
        parts = bars[:width], bars[width : width + sizes[0]], bars[width + sizes[0] :]
        p, w, iw = state.p.copy(), state.w.copy(), state.iw.copy()
        most, own, functions = len(Corrections._fields), _corrects(law.accept), None
        if own:
            counts = sorted({int(k) for piece in run.pieces for k in np.unique(piece[CORRECTIONS :: run.size])})
            if counts[-1] >= most:
                expected = f"at most {most - 1} rounds of corrections in a step"
                raise _refusal(expected, f"a step with {counts[-1]}", "take smaller steps or tolerances")
            made = {k: _adjoint(law.accept, k) for k in counts}
            functions = Corrections(*(made.get(k, made[counts[0]]) for k in range(most)))
        back, rates, table = (
            corrected if own else back_through,
            _adjoint(for_derivatives(law, "rhs")),
            transposed(run.scheme),
        )
        angles = min(run.compiled.info.windings, HEAD - ANGLES)
        for records in reversed(run.pieces[1:]):
            back(rates, functions or 0, run.scheme, table, width, angles, records, p, w, iw, bars, room)
        if functions is not None:
            first, y = run.pieces[0], np.zeros(width)
            y[: len(run.start.y)] = run.start.y
            call = functions[int(first[CORRECTIONS])].caller(CORRECTION.signature.arguments)
            call(run.start.t, y, p, w, iw, *parts)
        return parts[0][: run.sizes.ny], parts[1], parts[2]


def run_for_adjoint(
    compiled: CompiledModel,
    integrator: Integrator,
    start: Start,
    spec: RunSpec,
    progress: Progress | None = None,
    pages: list[Array] | None = None,
) -> Adjoint:
    """Integrate and keep all stages.

    Parameters
    ----------
    compiled, integrator, start, spec, progress
        As for `symgen.run.single.run.integrate`.
    pages : list of Array, optional
        Memory of an earlier run of the same model and scheme, which is written over: new memory costs as much as a run.

    Raises
    ------
    Uncovered
        If the run has no adjoint.
    """
    check_covered(compiled, integrator, spec, start)
    run = KeptRun(compiled, integrator, start, spec, [] if pages is None else pages)
    return Adjoint(completed(run, progress), run)
