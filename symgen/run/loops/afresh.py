"""Schemes that begin afresh: they forget past steps, when called from compiled loops or from Python."""

from __future__ import annotations

from symgen.run.layout import abi
from symgen.run.loops.event_loop import EventState


def forget_steps(state: EventState) -> None:
    """Forget what a scheme keeps of past steps: rates, points, refusals and the length that is allowed."""
    control = state.control
    control[abi.KNOWN] = control[abi.POINTS] = control[abi.REFUSED] = 0
    state.clock[abi.ALLOWED] = 0.0


def begin_afresh(state: EventState) -> None:
    """Have a scheme begin afresh at its next step, as velocities or inputs have jumped."""
    state.control[abi.BEGUN] = abi.AFRESH
    forget_steps(state)
