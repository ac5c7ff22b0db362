"""What a run keeps before it has a start: its arrays, the sizes that loops have to know, how far it goes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import abi
from symgen.runtime.model_arrays import lengths_of
from symgen.runtime.padding import padded
from symgen.runtime.records import Outputs, Sizes, Span, State

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel, ModelInfo
    from symgen.runtime.integrator import Setup
    from symgen.runtime.run import RunSpec

Array = NDArray[np.float64]


def span_of(spec: RunSpec, setup: Setup, until: float | None = None, pause: float = np.inf) -> Span:
    """Return how far a loop goes, to the end of the run by default, and by which steps."""
    end = spec.until if until is None else until
    numbers = setup.step, spec.largest_step, end, spec.until, spec.scale_time, spec.rtol, spec.atol, spec.relative
    return Span(*(float(number) for number in (*numbers, setup.safety, spec.max_attempts, pause)))


def sizes_of(compiled: CompiledModel) -> Sizes:
    """Return what loops have to know of a model."""
    info, sections = compiled.info, compiled.info.sections
    names = "pivot", "multipliers", "mask", "change", "gauge", "row_weight", "jacobian"
    places = (sections.get(name, (0, 0))[0] for name in names)
    lengths = info.nq, info.nv, info.m, info.ny, padded(info.ny), max(1, info.ny - 1), compiled.law.unknowns
    auxiliary = sections.get("auxiliary", (abi.POWER, 1))[0]
    return Sizes._make((*lengths, *places, auxiliary))


def share_of(sizes: Sizes) -> Array:
    """Return 1 for elements of a state that take part in error control, else 0: the work, which is controlled apart."""
    share = np.zeros(sizes.width)
    share[: sizes.ny] = 1.0
    share[sizes.nq + sizes.nv] = 0.0
    return share


def scales_of(sizes: Sizes) -> Array:
    """Return room for the scales of a state; integrals of outputs have units of their own, of which 1 is the scale."""
    scales = np.zeros(sizes.width)
    scales[sizes.nq + sizes.nv + 1 : sizes.ny] = 1.0
    return scales


def metric_of(info: ModelInfo, sizes: Sizes) -> Array:
    """Return 1 for coordinates that are lengths, else 0; see `symgen.runtime.scales.settle` for the velocities."""
    metric = np.zeros(sizes.width)
    metric[: sizes.nq] = lengths_of(info)
    return metric


def new_outputs(info: ModelInfo, times: Array) -> Outputs:
    """Return room for the outputs of a run at some times [s]."""
    k, kept = len(times), abi.N_STATUS + info.windings
    return Outputs(np.ascontiguousarray(times, dtype=np.float64), np.empty((k, info.ny)), np.empty((k, kept)))


def new_state(compiled: CompiledModel, sizes: Sizes, memory: int, room: int) -> State:
    """Return what a run keeps, before it has a start.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    sizes : Sizes
        From `sizes_of`.
    memory, room : int
        As in `symgen.runtime.integrator.Setup`.
    """
    law = compiled.law
    control, counters = np.zeros(abi.N_CONTROL, dtype=np.int64), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    p = np.zeros(max(1, law.parameter_offset + len(law.parameters) + law.hoisted))
    return State(
        *(np.zeros(sizes.width), p, np.zeros(max(1, law.nw)), counters, np.zeros(abi.N_CLOCK)),
        *(np.zeros(abi.N_GAUGES), control, np.zeros(abi.MAX_EVENTS * abi.N_EVENT)),
        *(np.zeros(memory), share_of(sizes), metric_of(compiled.info, sizes), scales_of(sizes)),
        np.zeros(sizes.width + room),
    )


def is_as_kept(compiled: CompiledModel, memory: int, arrays: Mapping[str, NDArray[Any]]) -> bool:
    """Return whether what another run kept has the lengths that a run has here; another version may have had others.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    memory : int
        As in `symgen.runtime.integrator.Setup`.
    arrays : mapping of str to array
        What it kept, by name. What is kept of events, and room for factors, may have any length.
    """
    own = new_state(compiled, sizes_of(compiled), memory, 0)._asdict()
    return all(name in arrays and arrays[name].shape == a.shape for name, a in own.items() if name != "room")
