"""Directions of steps that a run has made, with the events in them: the same steps once more from the state before.

The run itself is the one without directions, so its steps and events are the same to the bit. Directions follow step
by step (`symgen.run.directions.stage_directions`), and through each passage (`symgen.run.directions.transfer`). At the
beginning, rows at rest are held where the state has them: the number at which a row is held follows the state.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.run.directions.directed_model import Seeds
from symgen.run.directions.moments import Directions, Moments
from symgen.run.directions.passages import PassingSimulation, RunPassage
from symgen.run.directions.stage_directions import DifferentiatedStep, ExplicitStages, ImplicitStages
from symgen.run.directions.transfer import Transfer
from symgen.run.layout import abi
from symgen.run.layout.scheme_records import Stages

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Ends of loops after which a run goes on.
_ENDS = (abi.DONE, abi.MET, abi.PAUSED)


class StepsAgain(PassingSimulation):
    """Steps made once more, with the directions of each.

    Parameters
    ----------
    compiled, integrator, start, spec
        As for `Simulation`.
    seeds : Seeds
        Directions of the state and of the parameters.

    Attributes
    ----------
    slopes : Array, shape (ny, k)
        Directions after the steps.
    transfer : Transfer
        Takes directions through passages.
    """

    def __init__(
        self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec, seeds: Seeds
    ) -> None:
        super().__init__(compiled, integrator, start, spec)
        columns = np.hstack([seeds.p, np.zeros((len(seeds.p), 1))])
        moments = Moments(compiled, columns)
        self._seeds, self._place, count = seeds, moments.place_of_modes(), seeds.count
        self.transfer = Transfer(moments, spec, consistent=False)
        self._stages = (ImplicitStages if isinstance(self.scheme, Stages) else ExplicitStages)(moments, self.scheme)
        self.slopes, self._modes = seeds.y.copy(), np.zeros((self._place.stop - self._place.start, count))
        self._later, self._motion = np.zeros(count), np.zeros(len(seeds.y))

    def repeat_steps(self, before: Mapping[str, NDArray[Any]], until: float) -> bool:
        """Make the steps from a state before up to a time [s]; return whether a loop takes them to their end.

        Parameters
        ----------
        before : mapping of str to array
            All arrays of the state of the run at the beginning of its steps.
        until : float
            Their end [s].
        """
        state, code = self.state, abi.DONE
        for name, array in before.items():
            getattr(state, name)[:] = array
        self.transfer.begin_anew()
        if self.events is not None:
            self.events.happened.clear()
        self._p, self._until = state.p.copy(), until
        self.slopes, self._modes[:], self._later[:] = self._seeds.y.copy(), 0.0, 0.0
        self._begin()
        if self.has_modes:
            here = self._present_moment()
            self.note_passed(RunPassage((), here, here, starts=True))
        while self.is_ahead(until) and code in _ENDS:
            code = self.enter(self._nothing, until, float(state.control[abi.STEPS] + 1))
            self._follow()
        return code in _ENDS

    def _begin(self) -> None:
        self._first, self._made = self._present_moment(), int(self.state.control[abi.STEPS])

    def _follow(self, ends_in_event: bool = False) -> None:
        """Take the directions through the step made since the last call, if one was made."""
        if self.state.control[abi.STEPS] > self._made:
            h = float(self.state.clock[abi.STEP])
            self._first.w[abi.STEP_STATUS] = h
            # the last step goes up to a given time; others have their length, and begin later with an event before
            fixed = ends_in_event or not self.is_ahead(self._until)
            longer = np.append(-self._later if fixed else np.zeros_like(self._later), 1.0)
            by = Directions(*(_add_motion(x) for x in (self.slopes, self._later, self._modes)))
            after = self._stages.directions_after_step(DifferentiatedStep(self._first, h, by, longer), self.state)
            self.slopes, self._motion = after[:, :-1], after[:, -1]
            if fixed:
                self._later[:] = 0.0
        self._begin()

    def note_passed(self, passage: RunPassage) -> None:
        """Take the directions through a passage, whose events give directions to the time from then on."""
        self._follow(bool(passage.numbers))
        self.slopes, self._modes, later = self.transfer.transfer_at_event(
            passage, self.slopes, self._modes, self._motion
        )
        self._later = self._later + later


def _add_motion(x: Array) -> Array:
    """Return directions with one of the motion, which does not move the beginning of a step."""
    return np.concatenate([x, np.zeros((*x.shape[:-1], 1))], axis=-1)
