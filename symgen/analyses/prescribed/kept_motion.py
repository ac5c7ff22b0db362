"""A driven motion for many values of its parameters: code is kept, and each motion has derivatives by some of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.prescribed import NotPrescribed, PrescribedRun, make_driven
from symgen.analyses.prescribed.tracing import Traced, trace_motion
from symgen.base.errors import quote, suggest
from symgen.describe.formulas.duals import Dual, ParameterDuals, dual_slopes
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.holds import read_holds
from symgen.run.compiling.side import Side, compile_side
from symgen.run.directions.directed_model import DirectedModel, lanes_for_directions
from symgen.run.directions.driven_directions import DrivenDirections, DrivenStates
from symgen.run.planning.starts import DescribedStart

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.base.vocabulary.expressions import Expr
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]


@dataclass(frozen=True)
class KeptPoint:
    """The motion for some values of parameters.

    Attributes
    ----------
    run : PrescribedRun
        With the start and the parameters of this motion.
    traced : Traced
        The motion, up to where it ended.
    directions : DrivenDirections
        Its directions, evaluated at the first use.
    """

    run: PrescribedRun
    traced: Traced
    directions: DrivenDirections


class KeptMotion:
    """A driven motion for many values of parameters.

    Parameters
    ----------
    where : str
        Name of the caller, for messages.
    mechanism : Mechanism
        The description.
    settings : Settings
        As for `symgen.analyses.prescribed.driven_motion.driven_motion`.
    keys : sequence of str
        Parameters that motions are differentiated by.
    until : float
        Last time [s].

    Raises
    ------
    NotPrescribed
        If forces act that depend on more than the state, or inputs vary by pieces.
    InputError, AssemblyError
        As `symgen.analyses.prescribed.prescribed.make_driven`.
    """

    def __init__(self, where: str, mechanism: Mechanism, settings: Settings, keys: Sequence[str], until: float) -> None:
        self.keys = tuple(keys)
        if mechanism.states:
            raise NotPrescribed(where, "forces that follow from positions and velocities", "states of the file's own")
        self.run = run = make_driven(mechanism, settings, until, where, directed=True)
        if run.held or run.p is not run.start.p:
            raise NotPrescribed(where, "inputs that one formula describes", "inputs that change by pieces")
        self.mechanism = run.mechanism
        own = {p.name: p.unit for p in self.mechanism.parameters if not p.input}
        for key in self.keys:
            if key not in own:
                raise NotPrescribed(where, "parameters of the mechanism", quote(key), suggest(key, own))
        self.units = tuple(own[key] for key in self.keys)
        self._model = DirectedModel(run.compiled, lanes_for_directions(len(self.keys)))
        self._holds, self._branch = read_holds(self.mechanism), bool(settings.start)
        self._values = parameter_values(self.mechanism, run.plan.parameters)
        self._duals = ParameterDuals(self.mechanism, run.plan.parameters, self.keys)
        self._described = DescribedStart(self.mechanism, run.compiled, run.plan.parameters)
        self._names = [q.name for q in run.compiled.info.parameters]

    def side(self, name: str, formulas: Sequence[tuple[str, Expr]]) -> Side:
        """Return a function that evaluates formulas of outputs along a motion."""
        return compile_side(self.mechanism, self.run.compiled, name, f"the quantities of {name}", formulas)

    def at(self, x: Array, times: Array) -> KeptPoint:
        """Return the motion with values of the parameters that it is differentiated by.

        Parameters
        ----------
        x : Array, shape (n,)
            Values, in the order of `keys`.
        times : Array
            Increasing [s].

        Raises
        ------
        InputError, AssemblyError
            If a formula of parameters is undefined, or the mechanism cannot be closed.
        """
        compiled, described = self.run.compiled, self._described
        duals = self._duals.at(self._values | dict(zip(self.keys, x.tolist(), strict=True)))
        described.take_values({name: number.value for name, number in duals.items()})
        if self._branch:
            start = described.start(self._holds, self.run.start.y[: compiled.info.nq])
        else:
            now, _ = described.state(self._holds)
            start = replace(self.run.start, y=now.y.copy(), p=now.p.copy(), w=now.w.copy())
        run = replace(self.run, start=start, p=start.p)
        traced = trace_motion(run, times, crosses=False)
        return KeptPoint(run, traced, self._directions(run, traced, duals))

    def here(self, traced: Traced) -> DrivenDirections:
        """Return the directions of a motion with the values of the settings."""
        return self._directions(self.run, traced, self._duals.at(self._values))

    def _directions(self, run: PrescribedRun, traced: Traced, duals: Mapping[str, Dual]) -> DrivenDirections:
        motion = DrivenStates(traced.times, np.ascontiguousarray(traced.states), np.ascontiguousarray(traced.status))
        seeds = np.zeros((self._model.sizes["p"], len(self.keys)))
        seeds[: len(self._names)] = [*dual_slopes([duals[name] for name in self._names], len(self.keys))]
        return DrivenDirections(self._model, run.start, motion, seeds)
