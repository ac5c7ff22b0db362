"""The loops of `symgen.runtime.explicit` on CUDA devices: the same source, instantiated for a law.

CUDA has no first-class functions, so a kernel is built for a law, with one thread for each run: `on_device` takes the
plain Python of a loop, gives it device functions under the names of its helpers, and hands it to Numba's CUDA compiler.
Nothing is written twice, so a device takes the steps that a processor takes.

What a run works on (state, scratch, stages) is local memory of its thread: the hardware interleaves it so that
neighbouring threads touch neighbouring words, its addresses are constants, and it stays in the first-level cache. What
enters and leaves (starts, parameters, outputs) is global memory with the run as the fastest index.

Importing this module imports ``numba.cuda``; nothing else in symgen does.
"""

from __future__ import annotations

import math
import types as python
from dataclasses import dataclass
from typing import Any

from numba import config, cuda, float64, int64, types

from symgen.runtime import abi, batch_rows, explicit, observe, steps, watch
from symgen.runtime import device_stages as stages
from symgen.runtime import ensemble_abi as e

_A, _I, _M, _T = types.float64[::1], types.int64[::1], types.float64[:, ::1], types.float64[:, :, ::1]
#: Types of a kernel's arguments; see `make_kernel`.
SIGNATURE = types.void(*(_M,) * 3, *(_I, _I), *(_A,) * 4, *(_I, _A, _I, _A, _A, _I), *(_T,) * 5, *(_M,) * 2)
_N_EVENT, _STOP, _OUTPUTS, _ENERGY_START = abi.N_EVENT, abi.STOP, abi.OUTPUTS, abi.ENERGY_START
_NQ, _ROWS = e.NQ, e.M


def simulated() -> bool:
    """Return whether Numba's simulator stands in for a device (``NUMBA_ENABLE_CUDASIM=1``)."""
    return bool(config.ENABLE_CUDASIM)


def on_device(function: Any, inline: bool = False, **names: Any) -> Any:
    """Return a function of the runtime as a device function.

    Parameters
    ----------
    function : compiled or plain function
        Its Python source is what counts.
    inline : bool
        Whether it is copied into its callers before types are inferred, as a function that returns a view must be.
    **names
        What global names in it mean on the device: helpers, and sizes that differ there.

    Raises
    ------
    ValueError
        If it would call a function that is compiled for the processor.
    """
    plain = getattr(function, "py_func", function)
    for name in set(plain.__code__.co_names) - set(names):
        if getattr(plain.__globals__.get(name), "py_func", None) is not None:
            raise ValueError(f"{plain.__name__} needs '{name}' as a device function")
    meaning = {**plain.__globals__, **names}
    if simulated():
        meaning["math"] = ForgivingMath()
    copy = python.FunctionType(plain.__code__, meaning, plain.__name__)
    copy.__module__, copy.__qualname__ = plain.__module__, plain.__qualname__
    return cuda.jit(device=True, inline="always" if inline else "never")(copy)


class ForgivingMath:
    """``math`` as compiled code has it, for the simulator: undefined results are nan or infinite, not exceptions."""

    def __getattr__(self, name: str) -> Any:
        found = getattr(math, name)
        if not callable(found):
            return found

        def forgiving(*arguments: float) -> Any:
            try:
                return found(*arguments)
            except ValueError:
                return math.nan
            except OverflowError:
                return math.inf

        return forgiving


@dataclass(frozen=True)
class Need:
    """What shapes a kernel beside its law: sizes in numbers, and what is asked of it.

    Attributes
    ----------
    ny, n_p, nw : int
        Lengths of the state, of the parameters and of the scratch array.
    nv, m : int
        Velocities and constraint rows.
    room : int
        Working memory of the scheme.
    rows : int
        What ``observe`` writes at an output.
    adaptive, rates, joints : bool
        Whether steps are adaptive, accelerations or multipliers asked for, and joint coordinates.
    """

    ny: int
    n_p: int
    nw: int
    nv: int
    m: int
    room: int
    rows: int
    adaptive: bool
    rates: bool
    joints: bool

    @property
    def working(self) -> int:
        """Numbers of working memory: the scheme's, or what observing needs."""
        return max(self.room, 2 * self.ny + self.rows)

    @property
    def kept(self) -> int:
        """Length of the copy of the scratch array that observing begins with."""
        return self.nw if self.rates else 1

    @property
    def local_bytes(self) -> int:
        """Local memory of a thread for its run."""
        own = self.ny + self.n_p + self.nw + self.kept + self.working
        return 8 * (own + abi.N_COUNTERS + abi.N_GAUGES + e.N_CONTROL + stages.N_EVENTS)


def make_kernel(law: Any, model: Any, need: Need) -> Any:
    """Return the plain Python of the kernel that runs one law, for ``cuda.jit`` or ``cuda.compile_ptx``.

    Parameters
    ----------
    law, model : module
        Emitted for CUDA.
    need : Need
        What is asked of it.

    Returns
    -------
    function
        ``kernel(ys, ps, ws, start, column, value, nodes, weights, dense, integers, numbers, sizes, limits, times,
        picks, states, status, accelerations, multipliers, observed, values, summary)``, of the types in `SIGNATURE`;
        every array of runs has the run as its last index, and none is empty: what is not asked for has one element.
    """
    same, view = on_device(stages.identity, inline=True), on_device(stages.cut, inline=True)
    maxima = on_device(watch.keep_maxima)
    watched = on_device(stages.watch_passages, watch=on_device(watch.watch, keep_maxima=maxima, _N_EVENT=0))
    name = "adaptive_steps" if need.adaptive else "fixed_steps"
    integrated = on_device(
        getattr(explicit, name),
        **{"bare": same, "part": view, "watch": watched, "keep_maxima": maxima},
        **{helper: on_device(getattr(steps, helper)) for helper in ("combine", "error_norm", "store")},
        **{helper: on_device(getattr(watch, helper)) for helper in ("approach", "begin")},
    )
    integrate = on_device(stages.adaptive if need.adaptive else stages.fixed, **{name: integrated})
    begin_run, pick = on_device(batch_rows.begin_run), on_device(batch_rows.pick)
    summarise = on_device(batch_rows.summarise, _MAX_EVENTS=1)  # the narrowest passage is kept alone
    observe_after = on_device(stages.observe_nothing)
    if need.rates:
        rates_after = on_device(stages.observe_rates, fill_rates=on_device(observe.fill_rates), part=view)
        rows_of = {"fill_rows": on_device(observe.fill_rows), "observe_rates": rates_after, "part": view}
        observe_after = on_device(stages.observe_joints, **rows_of) if need.joints else rates_after
    nothing = on_device(stages.confirm_nothing)
    rhs, accept, confirm = law.rhs, law.accept, getattr(law, "confirm", nothing)
    rates, observed_by = getattr(law, "rates", law.rhs), model.observe if need.joints else nothing
    ny, n_p, nw, n_room, n_kept = need.ny, max(1, need.n_p), need.nw, need.working, need.kept
    n_counters, n_gauges, n_control = abi.N_COUNTERS, abi.N_GAUGES, e.N_CONTROL
    n_events, keeps, nv, m, rows = stages.N_EVENTS, need.rates, need.nv, need.m, need.rows

    def kernel(
        ys: Any,
        ps: Any,
        ws: Any,
        start: Any,
        column: Any,
        value: Any,
        nodes: Any,
        weights: Any,
        dense: Any,
        integers: Any,
        numbers: Any,
        sizes: Any,
        limits: Any,
        times: Any,
        picks: Any,
        states: Any,
        status: Any,
        accelerations: Any,
        multipliers: Any,
        observed: Any,
        values: Any,
        summary: Any,
    ) -> None:
        i = cuda.grid(1)
        if i >= ys.shape[1]:
            return
        y, p, w = cuda.local.array(ny, float64), cuda.local.array(n_p, float64), cuda.local.array(nw, float64)
        kept, room = cuda.local.array(n_kept, float64), cuda.local.array(n_room, float64)
        gauges, events = cuda.local.array(n_gauges, float64), cuda.local.array(n_events, float64)
        iw, control = cuda.local.array(n_counters, int64), cuda.local.array(n_control, int64)
        for j in range(ny):
            y[j] = ys[j, i]
        for j in range(ps.shape[0]):
            p[j] = ps[j, i]
        for j in range(nw):
            w[j] = ws[j, i]
            if keeps:
                kept[j] = w[j]
        for j in range(n_events):
            events[j] = math.nan
        control[_STOP] = 0  # which `begin_run` leaves as it is
        begin_run(y, w, iw, sizes, limits, gauges, control)
        times_asked = times.shape[0]
        outputs, columns = states[:times_asked, :, i], status[:times_asked, :, i]
        code = integrate(
            rhs,
            confirm,
            accept,
            start,
            column,
            value,
            nodes,
            weights,
            dense,
            integers,
            numbers,
            sizes[_NQ],
            y,
            p,
            w,
            iw,
            times,
            outputs,
            columns,
            gauges,
            control,
            events,
            room,
        )
        summarise(code, summary[:, i], w, iw, gauges, control, events[_N_EVENT:])
        k = control[_OUTPUTS]
        rate, lam, joint = accelerations[:, :nv, i], multipliers[:, :m, i], observed[:, :rows, i]
        observe_after(
            rates,
            confirm,
            accept,
            observed_by,
            sizes,
            k,
            p,
            w,
            kept,
            iw,
            times,
            outputs,
            columns,
            rate,
            lam,
            joint,
            room,
        )
        pick(values[:, i], 0, k, picks, outputs, columns, rate, lam, joint, sizes[_ROWS], gauges[_ENERGY_START])

    return kernel
