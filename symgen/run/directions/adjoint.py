"""Adjoints of runs: derivatives of one number at the end by everything that a run begins with.

A run keeps its stages, and is passed through once more, backwards. Its cost does not depend on how many numbers the
result is differentiated by.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.native import types
from symgen.compile.native.accesses import Accesses, array_accesses
from symgen.compile.native.compiler import is_by_numba
from symgen.compile.native.read_values import Foreign
from symgen.compile.native.straightening import has_early_end, straight_correction
from symgen.compile.store.emitted import AdjointFunction, EmittedFunction
from symgen.run.directions.directed_model import DirectedModel, Seeds, form_for_derivatives, lanes_for_directions
from symgen.run.directions.kept_stages import KeptRun, reason_against_adjoint, renewed_modes
from symgen.run.directions.moments import Moments
from symgen.run.directions.passages import RunPassage
from symgen.run.directions.series_directions import ImpactsAhead
from symgen.run.directions.transfer import Transfer
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import CONSTANT, LIMIT
from symgen.run.single.run import Progress, complete_run

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.outcome import Outcome
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Iterations of rates in an adjoint, at least.
ITERATIONS = 6
_HINT = "lagrange and direct-correction have one; forward directions take all methods"


def check_covered(compiled: CompiledModel, integrator: Integrator, spec: RunSpec, start: Start) -> None:
    """Refuse a run that has no adjoint.

    Raises
    ------
    Uncovered
        With what has one.
    """
    from symgen.run.loops.schemes import explicit

    if integrator.loop(spec.adaptive) not in (explicit.constant, explicit.adaptive):
        raise reason_against_adjoint("an explicit Runge-Kutta scheme", f"'{integrator.name}'", "take dop853")
    if start.saved is not None:
        raise reason_against_adjoint("a run from its start", "one that goes on from another run")
    law = compiled.law_module
    if is_by_numba():
        raise reason_against_adjoint("symgen's own compiler, which derives functions", "SYMGEN_COMPILER=numba")
    if not isinstance(law.rhs, EmittedFunction):
        raise reason_against_adjoint("compiled functions", "NUMBA_DISABLE_JIT, where plain Python runs")
    _check_functions(
        form_for_derivatives(law, "rhs"),
        law.accept,
        compiled.law.method,
        compiled.info.windings,
        renewed_modes(spec, compiled),
    )


@functools.lru_cache(maxsize=256)
def _check_functions(rhs: EmittedFunction, accept: EmittedFunction, law: str, windings: int, renewed: range) -> None:
    """Refuse functions without an adjoint, and those that keep numbers from step to step; compile the adjoints.

    Parameters
    ----------
    rhs, accept : EmittedFunction
        Of the law.
    law : str
        Its method.
    windings : int
        Number of angles that count turns.
    renewed : range
        Places of numbers of modes that are kept: on what they were before, a run depends no more than on the velocity
        that leads slip out of rest.
    """
    from symgen.run.loops.schemes.adjoint import CORRECTION, RATES

    method = f"the method {law}"
    own, other = _accesses_of_law(rhs, abi.RHS), _accesses_of_law(accept, abi.ACCEPT)
    _compile(_adjoint_function(rhs, _count_iterations(rhs)), RATES, f"accelerations of {method}")
    angles = {("w", abi.WINDING + i) for i in range(windings)}
    passing = {place for place in own.stored | other.stored if place[0] == "w"} - (angles - own.stored)
    passing -= {("w", place) for place in renewed}
    read = own.read
    if _has_correction(accept):
        _compile(_adjoint_function(accept, 0), CORRECTION, f"corrections of {method}")
        read |= _correction_accesses(accept).read
    if read & passing or ("w", -1) in own.read | own.stored:
        raise reason_against_adjoint("rates of the state alone", f"{method}, which keeps numbers from step to step")


@functools.lru_cache(maxsize=256)
def _has_iterations(rhs: EmittedFunction) -> bool:
    """Whether rates of the state are found by iteration."""
    return has_early_end(rhs.read(abi.RHS.signature.arguments))


def _count_iterations(rhs: EmittedFunction, mean: float = 0.0) -> int | None:
    """Return the iterations of rates in an adjoint, one more than a run takes as a mean; None without any.

    Derivatives converge as fast as values, an iteration behind.
    """
    return max(ITERATIONS, math.ceil(mean) + 1) if _has_iterations(rhs) else None


@functools.lru_cache(maxsize=256)
def _has_correction(accept: EmittedFunction) -> bool:
    """Whether a function that accepts states changes them."""
    return any(array == "y" for array, _ in _accesses_of_law(accept, abi.ACCEPT).stored)


@functools.lru_cache(maxsize=256)
def _accesses_of_law(function: EmittedFunction, kind: types.FunctionType) -> Accesses:
    try:
        return array_accesses(function.read(kind.signature.arguments).body)
    except Foreign as foreign:
        raise reason_against_adjoint("functions of the state in closed form", str(foreign)) from None


@functools.lru_cache(maxsize=256)
def _correction_accesses(accept: EmittedFunction) -> Accesses:
    return array_accesses(straight_correction(accept.read(abi.ACCEPT.signature.arguments), 0).body)


@functools.lru_cache(maxsize=256)
def _adjoint_function(function: EmittedFunction, rounds: int | None = None) -> AdjointFunction:
    """Return the adjoint of a function, the same one for all runs."""
    return AdjointFunction(function, rounds)


def _compile(function: AdjointFunction, kind: types.FunctionType, what: str) -> None:
    """Compile an adjoint, or say why there is none."""
    try:
        function.address(kind.signature)
    except InputError as error:
        raise reason_against_adjoint(
            "functions of the state in closed form", f"{what} with {error.got}", _HINT
        ) from None


@dataclass(frozen=True)
class Adjoint:
    """A run that was made, and can be passed through backwards.

    Attributes
    ----------
    outcome : Outcome
        Of the run.
    run : KeptRun
        Its steps and passages.
    """

    outcome: Outcome
    run: KeptRun

    def derivatives_by_start(self, end: Array, seeds: Seeds) -> tuple[Array, list[str]]:
        """Return the derivatives of a number at the end by directions of the start, shape (n,).

        With these what may be in doubt of some directions, which runs with these directions decide.

        Parameters
        ----------
        end : Array, shape (ny,)
            Derivatives of the number by the state at the end.
        seeds : Seeds
            Directions of the start and of the parameters.
        """
        run, way = self.run, WayBack(self.run, end, seeds)
        for item in reversed(run.course[run.corrected :]):
            way.go_back_through(item)
        way.undo_correction()
        for item in reversed(run.course[: run.corrected]):
            way.go_back_through(item)
        return way.slopes_of_end(), way.doubts


class WayBack:
    """The way back through a run.

    Parameters
    ----------
    run : KeptRun
        The run.
    end : Array, shape (ny,)
        Derivatives of a number by the state at the end.
    seeds : Seeds
        Directions of the start and of the parameters.
    """

    def __init__(self, run: KeptRun, end: Array, seeds: Seeds) -> None:
        from symgen.run.loops.schemes.adjoint import transpose_tableau

        self.run, self.seeds, state = run, seeds, run.state
        law, width, sizes = run.compiled.law_module, run.sizes.width, (len(state.p), len(state.w))
        self._bars = np.zeros(width + sum(sizes))
        self._bars[: len(end)] = end
        self._y, self._p = self._bars[:width], self._bars[width : width + sizes[0]]
        self._w = self._bars[width + sizes[0] :]
        self._room = np.zeros((int(run.scheme.stages) + 4) * width)
        self._now = state.p.copy(), state.w.copy(), state.iw.copy()
        rhs, mean = (
            form_for_derivatives(law, "rhs"),
            state.iw[abi.LAW_ITERATIONS] / max(1, state.control[abi.EVALUATIONS]),
        )
        self._rates, self._table = _adjoint_function(rhs, _count_iterations(rhs, mean)), transpose_tableau(run.scheme)
        self._angles = run.compiled.info.windings
        self._corrections = self._correction_of_step() if _has_correction(law.accept) else None
        self._found = np.zeros(seeds.count)

    def _correction_of_step(self) -> Any:
        """Return the adjoints of ``accept`` with the numbers of rounds that the run has."""
        from symgen.run.loops.schemes.adjoint import CORRECTIONS, Corrections

        run, most, accept = self.run, len(Corrections._fields), self.run.compiled.law_module.accept
        pieces = [run.first, *(x for x in run.course if not isinstance(x, RunPassage))]
        counts = sorted({int(k) for piece in pieces for k in np.unique(piece[CORRECTIONS :: run.size])})
        if counts[-1] >= most:
            expected = f"at most {most - 1} rounds of corrections in a step"
            raise reason_against_adjoint(expected, f"a step with {counts[-1]}", "take smaller steps or tolerances")
        made = {k: _adjoint_function(accept, k) for k in counts}
        return Corrections(*(made.get(k, made[counts[0]]) for k in range(most)))

    def go_back_through(self, item: Array | RunPassage) -> None:
        """Go back through some steps, or a passage."""
        if isinstance(item, RunPassage):
            self._through_passage(item)
        else:
            self._through_steps(item)

    def _through_steps(self, records: Array) -> None:
        from symgen.run.loops.schemes.adjoint import RecordSizes, back_through, back_through_corrected

        run, own = self.run, self._corrections
        back = back_through if own is None else back_through_corrected
        sizes = RecordSizes(run.sizes.width, self._angles, len(run.renewed), run.renewed.start)
        back(self._rates, own or 0, run.scheme, self._table, sizes, records, *self._now, self._bars, self._room)

    def undo_correction(self) -> None:
        """Take back the correction of the state at the start."""
        from symgen.run.loops.schemes.adjoint import CORRECTION, CORRECTIONS

        if self._corrections is None:
            return
        run, y = self.run, np.zeros(self.run.sizes.width)
        y[: len(run.start.y)] = run.start.y
        if run.corrected:
            passage = run.course[run.corrected - 1]
            assert isinstance(passage, RunPassage), "there are no steps before the start"
            y[:] = passage.after.y
        call = self._corrections[int(run.first[CORRECTIONS])].caller(CORRECTION.signature.arguments)
        call(run.start.t, y, *self._now, self._y, self._p, self._w)

    @property
    def doubts(self) -> list[str]:
        """What may be in doubt."""
        return self._transfer.doubts if "_transfer" in vars(self) else []

    # -- passages ------------------------------------------------------------------------------------------------------

    def _through_passage(self, passage: RunPassage) -> None:
        """Go back through a passage: the transposed derivative of what it changes."""
        before = passage.before
        if passage.numbers or passage.effects or self._places:
            own, n, place = self._elements, self.seeds.count, self._transfer.moments.place_of_modes()
            c, count = len(own), len(own) + n + len(self._places)
            y, modes = np.zeros((self.run.sizes.ny, count)), np.zeros((place.stop - place.start, count))
            y[own, np.arange(c)] = modes[self._places, np.arange(c + n, count)] = 1.0
            transfer, impacts = self._transfer, self._impacts
            by = self._along(transfer.transfer_through(passage, y, modes)) + impacts.derivatives_here(count)
            for units in impacts.units_of_impacts(count, [*range(c), *range(c + n, count)]):
                impacts.add(units, self._along(transfer.transfer_impacts_alone(passage, y, modes)))
            self._y[own], self._w[place] = by[:c], 0.0
            self._found += by[c : c + n]
            self._w[place][self._places] = by[c + n :]
        p, w, _ = self._now
        if not np.array_equal(p, before.p):
            self._take_parameters()
            p[:] = before.p
        w[:] = before.w

    def _along(self, after: tuple[Array, Array]) -> Array:
        """Return the derivatives of the number along directions of state and modes after a passage."""
        y, modes = after
        return np.asarray(self._y[: len(y)] @ y + self._w[self._transfer.moments.place_of_modes()] @ modes)

    @functools.cached_property
    def _impacts(self) -> ImpactsAhead:
        """Impacts that the rest of later ones depends on."""
        return ImpactsAhead()

    @functools.cached_property
    def _elements(self) -> list[int]:
        """Elements of the state that a passage may depend on: work and integrals go on from what they are."""
        info = self.run.compiled.info
        return [*range(info.work), *range(info.own_states.start, info.own_states.stop)]

    @functools.cached_property
    def _places(self) -> list[int]:
        """Numbers of modes that depend on others: where rows are held, and the bounds of their forces."""
        info = self.run.compiled.info
        rows = [info.switchable.index(row) for row in info.bounded]
        return [MODE_NUMBERS * row + k for row in rows for k in (CONSTANT, LIMIT)]

    @functools.cached_property
    def _transfer(self) -> Transfer:
        """What takes directions of the state, of the numbers, and of modes through passages."""
        run, n, c = self.run, self.seeds.count, len(self._elements)
        columns = np.zeros((len(self.seeds.p), c + n + len(self._places) + 1))
        columns[:, c : c + n] = self.seeds.p
        return Transfer(Moments(run.compiled, columns), run.spec, False, impacts=self._impacts)

    # -- numbers -------------------------------------------------------------------------------------------------------

    def _take_parameters(self) -> None:
        """Add what the parameters of the present part of the run contribute, and begin anew for those before."""
        p, (model, seeds), bar = self._now[0], self._model, self._p
        for first in range(0, seeds.count, model.lanes):
            directions = model.directions_after(model.parameters(p, seeds.seeds_of_part(first, model.lanes).p), "p")
            self._found[first : first + model.lanes] += (bar @ directions)[: seeds.count - first]
        bar[:] = 0.0

    @functools.cached_property
    def _model(self) -> tuple[DirectedModel, Seeds]:
        return DirectedModel(self.run.compiled, lanes_for_directions(self.seeds.count)), self.seeds

    def slopes_of_end(self) -> Array:
        """Return the derivatives by the directions of the start."""
        self._take_parameters()
        run, (model, seeds) = self.run, self._model
        for first in range(0, seeds.count, model.lanes):
            part = seeds.seeds_of_part(first, model.lanes)
            w = model.scratch(model.parameters(run.start.p, part.p), run.start.w)
            slope = self._y[: run.sizes.ny] @ part.y + self._w @ model.directions_after(w, "w")
            self._found[first : first + model.lanes] += slope[: seeds.count - first]
        return self._found


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
    return Adjoint(complete_run(run, progress), run)
