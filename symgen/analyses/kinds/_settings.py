"""Which settings count for an analysis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.errors import InputError
from symgen.settings import Settings, changed

#: Settings that count for analyses about a state, and for motions that drivers prescribe.
OF_STATES = ("parameters", "inputs", "start", "coordinates", "shape")
OF_MOTIONS = ("parameters", "inputs", "start", "strict", "shape")
#: Those of them that count where drivers say the motion, not where it was recorded.
OF_DRIVEN = ("start", "strict")
#: And beside those of states for a run that leads to one.
OF_RUNS = (*OF_STATES, "options", "events", "strict", "max_violation", "max_energy_error", "max_step", "max_attempts")


def settings_of(
    where: str, settings: Settings | None, changes: Mapping[str, object], counting: Sequence[str] = OF_STATES
) -> Settings:
    """Return settings with single ones replaced.

    Raises
    ------
    InputError
        If a single one would count for nothing; of settings that are given all at once, those are of no account.
    """
    whole = changed(settings, changes)
    for name in changes:
        if name not in counting:
            raise InputError(f"{where}: {name}", f"one of {', '.join(counting)}", "a setting of runs")
    return whole


def settings_at(where: str, settings: Settings | None, changes: Mapping[str, object], at: str | float) -> Settings:
    """Return settings of an analysis about a place; those of a run count where one leads there."""
    return settings_of(where, settings, changes, OF_STATES if isinstance(at, str) else OF_RUNS)
