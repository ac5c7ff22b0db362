"""The last state of a run, read back from its files to go on from."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from symgen.describe.mechanism import ACCELERATIONS
from symgen.errors import InputError
from symgen.result.saved import Saved, read_saved
from symgen.runtime.last_state import LastState

_PLACES = ("x", "y", "z", "theta", "e0", "e1", "e2", "e3")


def read_last_state(option: str, path: Path) -> LastState:
    """Return the last state of a run from a file that its result was saved to.

    A NetCDF file holds all that the run kept; of other files, and of those that hold it no more, the last outputs are
    taken.

    Raises
    ------
    InputError
        If there is no such file, or it is none of a result.
    """

    def state(saved: Saved) -> LastState:
        if saved.last is None:
            return _of_columns(saved)
        found = LastState.of_header(*saved.last)
        if found is None:
            raise InputError(option, "the last state as it was written", f"'{path}', in which it was changed")
        return found

    return read_saved(option, path, state)


def _of_columns(saved: Saved) -> LastState:
    def row(labels: Iterable[str]) -> dict[str, float]:
        own = (name for name in saved.columns if name.count(".") == 1 and name.partition(".")[2] in labels)
        return {name: float(saved.columns[name][-1]) for name in own}

    work = 0.0 if saved.mechanism else float(saved.columns["energy.work"][-1])
    return LastState(saved.mechanism, "", float(saved.t[-1]), row(_PLACES), row(ACCELERATIONS), work)
