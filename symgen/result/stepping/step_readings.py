"""Present values of a run, by the names that results have for them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base import arguments
from symgen.result.stepping.advance import Advance
from symgen.result.stepping.history import History
from symgen.result.stepping.meter import Meter
from symgen.result.stepping.named import Named
from symgen.run.layout import abi
from symgen.run.planning.restarts import Restarts
from symgen.run.single.events import EventRecord, record_of

if TYPE_CHECKING:
    from symgen.base.vocabulary.quantities import Quantity
    from symgen.result.result import Result
    from symgen.result.stepping.derivatives import StepDerivatives, StepDirections
    from symgen.run.planning.prepare import Prepared

# looked up at every step
_TIME, _STEPS = abi.TIME, abi.STEPS


class StepReadings:
    """A run between its steps, as far as it is read and not changed.

    Parameters
    ----------
    prepared : Prepared
        The run.
    free : bool
        Whether the first call of `step` decides the length of steps.
    hidden : set of str
        Parameters that replace parts of formulas of inputs.
    """

    def __init__(self, prepared: Prepared, free: bool, hidden: set[str]) -> None:
        info = prepared.compiled.info
        self._origin: Mapping[str, float] | Prepared = prepared
        self._compiled, self._tree, self._restarts = prepared.compiled, prepared.tree, Restarts(prepared)
        self._free, self._hidden, self._version = free, hidden, 0
        self._loop = prepared.simulation()
        self._directions: StepDirections | None = None
        state = self._loop.state
        self._clock, self._control = state.clock.data, state.control.data
        self._advance, self._history, self._shown = Advance(self._loop), History(self._loop), (-1.0, -1, -1)
        self.q = _read_only_view(state.y, 0, info.coordinates)
        self.v = _read_only_view(state.y, info.nq, info.velocities)
        self.state = _read_only_view(state.y, 0, (*info.coordinates, *info.velocities))
        self.states = _read_only_view(state.y, info.work + 1, info.states)

    @property
    def t(self) -> float:
        """Time of the state [s]."""
        return self._clock[_TIME]

    @property
    def steps(self) -> int:
        """Steps that have been accepted."""
        return self._control[_STEPS]

    @property
    def bodies(self) -> dict[str, float]:
        """Present coordinates and velocities of bodies by name, in joint coordinates as well."""
        if self._tree is None:
            return self.state.to_dict()
        state = self._loop.state
        return dict(
            zip(self._tree.names, self._tree.bodies_at(self.t, state.y, state.p, state.w).tolist(), strict=True)
        )

    @property
    def parameters(self) -> dict[str, float]:
        """Present values of all parameters."""
        numbers = zip(self._compiled.info.parameters, self._loop.state.p.tolist(), strict=False)
        return {q.name: x for q, x in numbers if q.name not in self._hidden}

    @property
    def events(self) -> tuple[EventRecord, ...]:
        """Events since the start, as in results; after `restore`, those before the present time."""
        events = self._loop.events
        return () if events is None else tuple(record_of(self._compiled.info, event) for event in events.happened)

    @property
    def outputs(self) -> dict[str, float]:
        """Present values of the formulas of the file's ``[outputs]`` by name, integrals among them."""
        return self._now.outputs.row(0)

    @property
    def points(self) -> dict[str, float]:
        """Present places, velocities and accelerations of named points: ``arm.tip.x``, ``.vx``, ``.ax``, ..."""
        return self._now.points.row(0)

    @property
    def elements(self) -> dict[str, float]:
        """Present forces, lengths and powers of force elements and drivers: ``spring.force``, ``motor.effort``, ..."""
        return self._now.elements.row(0)

    @property
    def reactions(self) -> dict[str, float]:
        """Present reactions of joints, as results have them: ``A.Fx`` [N], ``A.M`` [N m], ..."""
        return self._now.reactions.row(0)

    def __getitem__(self, name: str) -> float:
        """Return the present value of a column of results: ``sim["motor.effort"]``, ``sim["arm.tip.x"]``.

        Raises
        ------
        InputError
            If there is no such column.
        """
        return float(self._now[name][0])

    def meter(self, formulas: Sequence[str]) -> Callable[[], NDArray[np.float64]]:
        """Return a function that evaluates formulas at the present state, compiled: sensors of a controller.

        Parameters
        ----------
        formulas : sequence of str
            Names of columns of results, such as ``"arm.tip.ax"``, and formulas of them.

        Raises
        ------
        InputError
            If one is no formula of the motion, or reads an integral.
        """
        meter = Meter(self._prepared, self._loop, arguments.words("meter", formulas), "meter")

        def values() -> NDArray[np.float64]:
            self._advance.recover()
            if not self._free:
                self._advance.begin()
            return meter()

        return values

    def derivatives(self) -> StepDerivatives:
        """Return the derivatives of the last step, with its scheme, constraints and corrections: A, B and C.

        They are of the last call of `step`, or of its last part where Ctrl-C was listened for in between; `t` and `dt`
        of the result say which. Impacts and changes of modes inside move with the state and the inputs; a coordinate
        at rest is held where the state has it.

        Raises
        ------
        InputError
            If no step was made, inputs jumped during it, or the scheme, the shape of the code or a formula has none.
        """
        self._advance.recover()
        return (self._directions or self._make_directions()).last()

    def _make_directions(self) -> StepDirections:
        """Make what has derivatives of steps; its import would take longer than many of its calls."""
        from symgen.result.stepping.derivatives import StepDirections

        self._directions = StepDirections(self._prepared, self._loop)
        return self._directions

    @property
    def _prepared(self) -> Prepared:
        """The run from where it began last, prepared when something of it is read."""
        if isinstance(self._origin, Mapping):
            self._origin = self._restarts.start_at(self._origin)
        self._loop.start, self._tree = self._origin.start, self._origin.tree
        return self._origin

    @property
    def _now(self) -> Result:
        """The present state as a result, computed once for a state."""
        key = (self.t, self.steps, self._version)
        if key != self._shown:
            self._advance.recover()
            if not self._free:
                self._advance.begin()
            self._present, self._shown = self._history.present(self._prepared), key
        return self._present


def _read_only_view(y: np.ndarray, first: int, quantities: Iterable[Quantity]) -> Named:
    """Return a named view of a part of the state."""
    quantities = tuple(quantities)
    names, units = tuple(q.name for q in quantities), tuple(q.unit for q in quantities)
    return Named.of(y[first : first + len(names)], names, units)
