"""What a device does around the loops of single runs: watching, integrating, observing.

Plain Python, which `symgen.runtime.device` instantiates; what is imported from the runtime means its instance there.
"""

from __future__ import annotations

from typing import Any

from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.bare import part
from symgen.runtime.explicit import adaptive_steps, fixed_steps
from symgen.runtime.observe import fill_rates, fill_rows
from symgen.runtime.watch import watch

#: Numbers of `events` on a device: the passage that is going on, and the narrowest one so far.
N_EVENTS = 2 * abi.N_EVENT
_N_EVENT, _MAX_EVENTS, _PIVOT, _EVENTS = abi.N_EVENT, abi.MAX_EVENTS, abi.EVENT_PIVOT, abi.EVENTS
_NQ, _MULTIPLIERS, _N_STATUS = e.NQ, e.MULTIPLIERS, abi.RANK + 1


def identity(array: Any) -> Any:
    """Stand in for `symgen.runtime.bare.bare`: CUDA counts no references."""
    return array


def cut(array: Any, first: int, size: int) -> Any:
    """Stand in for `symgen.runtime.bare.part`."""
    return array[first : first + size]


def watch_passages(t: float, y: Any, nq: int, w: Any, gauges: Any, control: Any, events: Any) -> int:
    """Watch as on a processor; of all passages only the one that is going on and the narrowest are kept."""
    code = watch(t, y, nq, w, gauges, control, events)
    if 0 < control[_EVENTS] <= _MAX_EVENTS and not events[_N_EVENT + _PIVOT] <= events[_PIVOT]:
        for i in range(_N_EVENT):
            events[_N_EVENT + i] = events[i]
    return code


def confirm_nothing(t: float, y: Any, p: Any, w: Any, iw: Any, ydot: Any) -> int:
    """Stand in for ``confirm`` in a law whose ``rhs`` never asks for it."""
    return 0


def fixed(
    rhs: Any,
    confirm: Any,
    accept: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    weights: Any,
    dense: Any,
    integers: Any,
    numbers: Any,
    nq: int,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    gauges: Any,
    control: Any,
    events: Any,
    room: Any,
) -> int:
    """Integrate with a constant step; the arguments as for `adaptive`."""
    return int(
        fixed_steps(
            rhs,
            confirm,
            accept,
            start,
            column,
            value,
            nodes,
            integers[0],
            nq,
            y,
            p,
            w,
            iw,
            0.0,
            numbers[0],
            numbers[2],
            times,
            states,
            status,
            gauges,
            control,
            events,
            room,
        )
    )


def adaptive(
    rhs: Any,
    confirm: Any,
    accept: Any,
    start: Any,
    column: Any,
    value: Any,
    nodes: Any,
    weights: Any,
    dense: Any,
    integers: Any,
    numbers: Any,
    nq: int,
    y: Any,
    p: Any,
    w: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    gauges: Any,
    control: Any,
    events: Any,
    room: Any,
) -> int:
    """Integrate with steps chosen from the error estimate.

    Parameters
    ----------
    integers : Array of int
        Stages, error estimates and their order.
    numbers : Array
        First, or constant, step; largest step; end [s]; relative and absolute tolerance.
    rhs, confirm, ... :
        As for the loops of `symgen.runtime.explicit`.
    """
    return int(
        adaptive_steps(
            rhs,
            confirm,
            accept,
            start,
            column,
            value,
            nodes,
            integers[0],
            nq,
            weights,
            integers[1],
            integers[2],
            dense,
            y,
            p,
            w,
            iw,
            0.0,
            numbers[0],
            numbers[1],
            numbers[2],
            numbers[3],
            numbers[4],
            times,
            states,
            status,
            gauges,
            control,
            events,
            room,
        )
    )


def observe_nothing(
    rates: Any,
    confirm: Any,
    accept: Any,
    observe: Any,
    sizes: Any,
    k: int,
    p: Any,
    w: Any,
    kept: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    room: Any,
) -> None:
    """Stand in for `observe_rates` where neither accelerations nor what rests on them are asked for."""


def observe_rates(
    rates: Any,
    confirm: Any,
    accept: Any,
    observe: Any,
    sizes: Any,
    k: int,
    p: Any,
    w: Any,
    kept: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    room: Any,
) -> None:
    """Evaluate v' and lambda at the `k` outputs, from the scratch that the run began with."""
    for i in range(iw.shape[0]):
        iw[i] = 0
    ny = states.shape[1]
    fill_rates(
        rates,
        confirm,
        accept,
        times[:k],
        states[:k],
        status[:k, _N_STATUS:],
        p,
        kept,
        iw,
        sizes[_NQ],
        sizes[_MULTIPLIERS],
        accelerations[:k],
        multipliers[:k],
        part(room, 0, ny),
        part(room, ny, ny),
    )


def observe_joints(
    rates: Any,
    confirm: Any,
    accept: Any,
    observe: Any,
    sizes: Any,
    k: int,
    p: Any,
    w: Any,
    kept: Any,
    iw: Any,
    times: Any,
    states: Any,
    status: Any,
    accelerations: Any,
    multipliers: Any,
    observed: Any,
    room: Any,
) -> None:
    """Evaluate what `observe_rates` does, and the joint coordinates."""
    observe_rates(
        rates,
        confirm,
        accept,
        observe,
        sizes,
        k,
        p,
        w,
        kept,
        iw,
        times,
        states,
        status,
        accelerations,
        multipliers,
        observed,
        room,
    )
    ny = states.shape[1]
    fill_rows(
        observe,
        times[:k],
        states[:k],
        accelerations[:k],
        status[:k, _N_STATUS:],
        p,
        w,
        sizes[_NQ],
        observed[:k],
        part(room, 0, ny),
        part(room, ny, ny),
        part(room, 2 * ny, observed.shape[1]),
    )
