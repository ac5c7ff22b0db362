"""Runs in joint coordinates: the start of bodies as a start of joints, and the motion of joints as one of bodies.

A run in joint coordinates begins where one in the bodies' own coordinates does: both are assembled in those, so that
what is held, noted and refused is the same. What it gives is carried back to the bodies, where results, reactions,
violations and outputs are read as of any other run.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.compiling.choose_tree import on_tree
from symgen.describe.mechanism import Topology
from symgen.describe.topology import known_coordinates, state_names
from symgen.lower.windings import winding_order
from symgen.run_setup import compiled_for, ready
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.assembly import Start
from symgen.runtime.joint_starts import joint_values
from symgen.runtime.outcome import Outcome
from symgen.runtime.probe import Ready
from symgen.runtime.tree_start import Carrying, settle_tree

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]

#: What both descriptions of a motion measure alike, taken over from the run.
_SCALES = (abi.LENGTH, abi.SPEED, abi.MEAN_MASS)


@dataclass(frozen=True)
class TreeRun:
    """A run in joint coordinates, and what carries it to bodies.

    Attributes
    ----------
    whole, mechanism : Mechanism
        As described, and with its tree.
    compiled, start : CompiledModel, Start
        In joint coordinates.
    bodies : CompiledModel
        In the bodies' own.
    body_start : Start
        Where the same run would begin there.
    """

    whole: Mechanism
    mechanism: Mechanism
    compiled: CompiledModel
    start: Start
    bodies: CompiledModel
    body_start: Start

    @property
    def topology(self) -> Topology:
        """The tree."""
        assert self.mechanism.topology is not None, "the mechanism has a tree"
        return self.mechanism.topology

    # -- the motion of bodies ------------------------------------------------------------------------------------------

    def positions(self, outcome: Outcome) -> Array:
        """Return the coordinates of bodies at the outputs, shape (k, nq)."""
        return self._moving(outcome)[:, : self.bodies.info.nq]

    def carried(self, outcome: Outcome) -> CarriedOutcome:
        """Return what a run gave as the motion of bodies."""
        info, own = self.bodies.info, self.compiled.info
        moving = self._moving(outcome)
        k, n = len(outcome.times), info.nq + info.nv
        states = np.zeros((k, info.ny))
        states[:, :n] = moving[:, :n]
        states[:, n:] = outcome.states[:, own.work :]
        status = np.zeros((k, abi.N_STATUS + info.windings))
        status[:, : abi.N_STATUS] = outcome.status_columns[:, : abi.N_STATUS]
        # the joints of the tree hold by construction: their rows count as independent
        status[:, abi.RANK] += self.body_start.rank - self.start.rank
        for i, turned in enumerate(self._turns(outcome.states, outcome.status_columns[:, abi.N_STATUS :])):
            status[:, abi.N_STATUS + i] = turned
        w = self.body_start.w.copy()
        w[list(_SCALES)] = outcome.w[list(_SCALES)]
        for i in range(info.windings):
            w[abi.WINDING + i] = status[-1, abi.N_STATUS + i] if k else w[abi.WINDING + i]
        values = {f.name: getattr(outcome, f.name) for f in fields(Outcome)}
        happened = tuple(replace(event, state=self._of_bodies(event.t, event.state)) for event in outcome.happened)
        values |= {"states": states, "status_columns": status, "compiled": self.bodies, "start": self._noted(outcome)}
        values |= {"p": self._parameters(outcome.p), "w": w, "happened": happened}
        values["held"] = tuple((t, self._parameters(numbers)) for t, numbers in outcome.held)
        last = outcome.simulation.state.y
        return CarriedOutcome(
            **values, inner=outcome, end_state=self._of_bodies(outcome.end, last), work=last[own.work]
        )

    def _noted(self, outcome: Outcome) -> Start:
        """Return the start of bodies with what was said of that of the run."""
        return replace(self.body_start, notes=outcome.start.notes)

    def _parameters(self, numbers: Array) -> Array:
        """Return the parameters of a piece of the run as the code for bodies takes them, prepared."""
        p = self.body_start.p.copy()
        count = len(self.bodies.info.parameters)
        if np.array_equal(p[:count], numbers[:count]):
            return p
        p[:count] = numbers[:count]
        for module in (self.bodies.model, self.bodies.law_module):
            Ready(module.prepare, e.PREPARE)(p)
        return p

    def _moving(self, outcome: Outcome) -> Array:
        info = self.bodies.info
        found = outcome.observed(self.compiled.model.bodies, info.nq + 2 * info.nv)
        for first, _ in info.spins:  # Euler parameters have two signs
            if len(found) and found[0, first : first + 4] @ self.body_start.y[first : first + 4] < 0.0:
                found[:, first : first + 4] *= -1.0
        return found

    def _of_bodies(self, t: float, y: Array) -> Array:
        """Return coordinates and velocities of bodies at one state."""
        own, info = self.compiled.info, self.bodies.info
        state, out = np.zeros(own.ny), np.zeros(info.nq + 2 * info.nv)
        state[: own.work] = y[: own.work]
        observe = Ready(self.compiled.model.bodies, abi.OBSERVE)
        observe(t, state, self.start.p, self.start.w.copy(), np.zeros(own.ny), out)
        return out[: info.nq + info.nv]

    def _turns(self, states: Array, windings: Array) -> list[Array]:
        """Return the angles that count turns as the code for bodies remembers them, at the outputs."""
        known = known_coordinates(self.mechanism, self.topology)
        own = {m: i for i, m in enumerate(winding_order(self.mechanism, "straight"))}
        found = list[Array]()
        for measure in winding_order(self.whole, self.bodies.shape):
            if measure in known:
                i, _, sign = known[measure]
                found.append(sign * states[:, i])
            else:
                found.append(windings[:, own[measure]])
        return found


@dataclass(frozen=True, kw_only=True, repr=False)
class CarriedOutcome(Outcome):
    """What a run in joint coordinates gave, as the motion of bodies.

    Attributes
    ----------
    inner : Outcome
        What its loop left.
    end_state : Array, shape (nq + nv,)
        Coordinates and velocities of bodies in the last state that was accepted.
    work : float
        Work done until there [J].
    """

    inner: Outcome = field(repr=False)
    end_state: Array = field(repr=False)
    work: float


def tree_run(
    mechanism: Mechanism, plan: Plan, parameters: Mapping[str, float] | None = None, strict: bool = False
) -> TreeRun:
    """Return what a run in joint coordinates begins with.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    plan : Plan
        How it is run.
    parameters, strict
        As for `symgen.run_setup.ready`.
    """
    bodies, start = ready(mechanism, plan, parameters, strict)
    return begin_on_tree(mechanism, *tree_code(mechanism, plan.choice, bodies), bodies, start, plan.method_parameters)


def tree_code(mechanism: Mechanism, choice: MethodChoice, bodies: CompiledModel) -> tuple[Mechanism, CompiledModel]:
    """Return a mechanism with its tree, and its compiled model for the method that bodies are run with.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    choice : MethodChoice
        The method.
    bodies : CompiledModel
        In the bodies' own coordinates; its solver is the tree's.
    """
    carried = on_tree(mechanism)
    weight = {name: value for name, value in choice.options.items() if name == "weight"}
    return carried, compiled_for(carried, replace(choice, options={**bodies.law.options, **weight}, shape="straight"))


def begin_on_tree(
    mechanism: Mechanism,
    carried: Mechanism,
    compiled: CompiledModel,
    bodies: CompiledModel,
    start: Start,
    method_parameters: Mapping[str, float],
) -> TreeRun:
    """Return what a run in joint coordinates begins with, from a start of bodies.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    carried, compiled : Mechanism, CompiledModel
        From `tree_code`.
    bodies, start : CompiledModel, Start
        In the bodies' own coordinates.
    method_parameters : mapping
        Values of the method's parameters that differ from the defaults.
    """
    assert carried.topology is not None, "it was put on a tree"
    info, own = bodies.info, compiled.info
    q, v = _state(carried, carried.topology, bodies, start)
    p = compiled.parameter_array(dict(zip((x.name for x in info.parameters), start.p, strict=False)), method_parameters)
    turned = _windings(mechanism, carried, bodies, start)
    y = np.zeros(own.ny)
    y[: own.work] = np.concatenate([q, v])
    y[own.work :] = start.y[info.work :]
    scales = float(start.w[abi.LENGTH]), float(start.w[abi.SPEED]), _gauge(carried, bodies, start.w)
    w, rank, redundant = settle_tree(compiled, y, p, start.t, turned, scales)
    notes = start.notes, start.changes, start.light, start.warnings
    found = Start(y, p, w, rank, redundant, *notes, t=start.t, work=start.work)
    return TreeRun(mechanism, carried, compiled, found, bodies, start)


def _state(carried: Mechanism, topology: Topology, bodies: CompiledModel, start: Start) -> tuple[Array, Array]:
    """Return the coordinates and velocities of a tree from a start of bodies."""
    info = bodies.info
    values = joint_values(bodies, start.t, start.y, start.p, start.w.copy())
    known = {x.name: float(start.y[i]) for i, x in enumerate(info.coordinates)}
    known |= {x.name: float(start.y[info.nq + i]) for i, x in enumerate(info.velocities)}
    for k, x in enumerate(info.joint_coordinates):
        known |= {x.name: float(values[2 * k]), f"{x.name}.rate": float(values[2 * k + 1])}
    names, speeds = state_names(carried, topology)
    return np.array([known[name] for name, _ in names]), np.array([known[name] for name, _ in speeds])


def carrying_of(mechanism: Mechanism, carried: Mechanism, bodies: CompiledModel, compiled: CompiledModel) -> Carrying:
    """Return where what stands in rows of bodies and of a tree."""
    assert carried.topology is not None, "it was put on a tree"
    info, own = bodies.info, compiled.info
    known = {x.name: (0, i) for i, x in enumerate((*info.coordinates, *info.velocities))}
    for k, x in enumerate(info.joint_coordinates):
        known |= {x.name: (1, info.m + 2 * k), f"{x.name}.rate": (1, info.m + 2 * k + 1)}
    names, speeds = state_names(carried, carried.topology)
    turned = {m: abi.WINDING + i for i, m in enumerate(winding_order(mechanism, bodies.shape))}
    first = info.sections["gauge"][0]

    def integers(found: Iterable[int]) -> NDArray[np.int64]:
        return np.array(list(found), dtype=np.int64)

    return Carrying(
        *(0, own.work, info.m + 2 * len(info.joint_coordinates)),
        places=integers(x for name, _ in (*names, *speeds) for x in known[name]),
        windings=integers(turned[m] for m in winding_order(carried, "straight")),
        gauges=integers(-1 if j is None else first + j for j in _levers(carried, info)),
        dependent=integers(()),
    )


def _windings(mechanism: Mechanism, carried: Mechanism, bodies: CompiledModel, start: Start) -> list[float]:
    """Return the angles whose turns the code for the tree counts, at the start."""
    places = {m: i for i, m in enumerate(winding_order(mechanism, bodies.shape))}
    return [float(start.w[abi.WINDING + places[m]]) for m in winding_order(carried, "straight")]


def _gauge(carried: Mechanism, bodies: CompiledModel, w: Array) -> Array:
    """Return what makes translations of the velocities of a tree: 1, or 1 / l^2 with the length of the body turned."""
    gauge = bodies.section(w, "gauge")
    return np.array([1.0 if j is None else float(gauge[j]) for j in _levers(carried, bodies.info)])


def _levers(carried: Mechanism, info: ModelInfo) -> list[int | None]:
    """Return the velocity whose length each velocity of a tree has, None for those that are no angles."""
    assert carried.topology is not None, "it has a tree"
    found = list[int | None]()
    for link in carried.topology.links:
        alone = msgspec.structs.replace(carried.topology, links=(link,))
        own = [j for j, x in enumerate(info.velocities) if x.name.startswith(f"{link.body}.") and x.unit == "rad/s"]
        found += [own[0] if unit == "rad/s" else None for _, unit in state_names(carried, alone)[1]]
    return found
