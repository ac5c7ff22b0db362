"""Output times of a run, and the memory that its outputs take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError
from symgen.base.memory import require_memory
from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS
from symgen.run.loops.integrator import chooses_steps
from symgen.run.single.run import Array

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism

#: An adaptive run has this many equidistant outputs where no times are given.
DEFAULT_OUTPUTS = 1001


def output_times(
    s: Settings, mechanism: Mechanism, span: tuple[float, float], step: float | None, adaptive: bool
) -> Array:
    """Return the output times of a run [s].

    Parameters
    ----------
    s : Settings
        Of which ``times`` or ``output_step`` count.
    mechanism : Mechanism
        Its own output step is the default.
    span : tuple of float
        Begin and end of the run [s].
    step : float or None
        Constant step [s].
    adaptive : bool
        Whether steps follow the error estimate.

    Raises
    ------
    InputError
        If the times are none of the run, or too many.
    """
    size, (begin, until) = output_size(mechanism), span
    if s.times is not None:
        try:
            instants = np.asarray(s.times, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError("times", "finite, increasing output times", kind_of_value(s.times)) from None
        if instants.ndim != 1 or not np.all(np.isfinite(instants)) or np.any(np.diff(instants) <= 0.0):
            raise InputError("times", "finite, increasing output times", "others")
        if len(instants) and (instants[0] < begin * (1.0 - 1e-12) or instants[-1] > until * (1.0 + 1e-12)):
            got = f"{instants[0]:g} to {instants[-1]:g}"
            raise InputError("times", f"output times from {begin:g} to {until:g}", got)
        require_memory("times", f"{len(instants):.3g} outputs of {mechanism.name}", size * len(instants))
        return np.clip(instants, begin, until)  # a multiple of a step may exceed the end by rounding
    every = s.output_step if s.output_step is not None else mechanism.defaults.output_step
    if every is None:
        if adaptive:
            require_memory("model", f"{DEFAULT_OUTPUTS} outputs of {mechanism.name}", size * DEFAULT_OUTPUTS)
            return np.linspace(begin, until, DEFAULT_OUTPUTS)
        assert step is not None, "a constant step is given"
        every = step
    times = multiples(every, until, size)
    return times if begin == 0.0 else np.concatenate([[begin], times[times > begin + 1e-9 * every]])


def output_size(mechanism: Mechanism, saved: bool = False) -> float:
    """Return about how much memory an output of a run takes [bytes].

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism of the run.
    saved : bool
        Whether all tables of it are made and put into a file, which is done in memory.
    """
    state = sum(len(b.coordinates) + len(b.speeds) for b in mechanism.bodies)
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    if not saved:
        return 8.0 * (state + len(mechanism.joints) + 16)  # status, energies, and angles that are counted
    reported = sum(2 * len(j.coordinates) + (6 if mechanism.space == "spatial" else 3) for j in mechanism.joints)
    entries = 12 * rows  # of D at every output, for the reactions
    return 8.0 * (5 * (2 * state + rows + reported + 16) + entries)  # tables, their copy, and the file


def check_saving(mechanism: Mechanism, s: Settings) -> None:
    """Refuse a run whose tables would not fit into memory when they are saved.

    Raises
    ------
    InputError
        If they would not.
    """
    until = mechanism.defaults.until if s.until is None else s.until
    every = s.output_step or mechanism.defaults.output_step
    if s.times is not None:
        count = float(len(s.times))
    elif every is not None:
        count = until / every
    elif _has_constant_steps(s, mechanism):
        count = until / (s.step or mechanism.defaults.step)
    else:
        count = DEFAULT_OUTPUTS
    require_memory("--save", f"{count:.3g} outputs of {mechanism.name}", count * output_size(mechanism, saved=True))


def _has_constant_steps(s: Settings, mechanism: Mechanism) -> bool:
    """Whether settings or a description name, or a method has by itself, an integrator with constant steps."""
    own = METHODS.get(s.method).default_integrator if s.method in METHODS else ""
    name = s.integrator or mechanism.defaults.integrator or own
    return name in INTEGRATORS and not chooses_steps(INTEGRATORS.get(name), s.options)


def multiples(every: float, until: float, size: float) -> Array:
    """Return the multiples of an output step, and the end; `size` is what an output takes [bytes]."""
    require_memory("output_step", f"{until / every:.3g} outputs", size * until / every)
    if until / every > 2e7:
        raise InputError("output_step", "at most 2e7 outputs", f"{until / every:.3g}")
    count = math.floor(until / every * (1.0 + 1e-12))
    times: Array = np.arange(count + 1, dtype=np.float64) * every
    if until - times[-1] > 1e-9 * every:
        times = np.append(times, until)
    times[-1] = min(times[-1], until)
    return times
