"""What formulas of the time do in the rows of an ensemble, where that depends on what varies."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.derived import derived
from symgen.runtime.motions import jump_of, names_of_motions

if TYPE_CHECKING:
    from collections.abc import Container, Sequence

    from numpy.typing import NDArray

    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.plan import Ensemble

#: Rows whose parameters are looked at together.
_TOGETHER = 65536
#: Combinations of parameters for which steps that may miss something are looked for: 10 s of formulas like sin(w*t).
MOST_LOOKS = 1000


def read_by_motions(mechanism: Mechanism, varied: Container[str]) -> tuple[str, ...]:
    """Return the parameters that motions which may jump read, if some of them differ from row to row; else none."""
    read, formulas = names_of_motions(mechanism), {name for name, _ in derived(mechanism.parameters)}
    known = tuple(p.name for p in mechanism.parameters if p.name in read)
    return known if any(name in varied or name in formulas for name in known) else ()


def rows_that_jump(ensemble: Ensemble, done: NDArray[np.bool_]) -> Iterator[tuple[NDArray[np.int64], str]]:
    """Yield rows in which the motion of a driver jumps, and what is said of each such group.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    done : Array of bool, shape (n,)
        Rows that are asked for.
    """
    mechanism, until = ensemble.model.mechanism, ensemble.recipe.spec.until
    read = read_by_motions(mechanism, ensemble.grid.names)
    if not read:
        return iter(())

    def jumping(values: dict[str, float], _: int) -> list[str]:
        told = jump_of(mechanism, values, until)
        return [] if told is None else [str(told)]

    return _told(ensemble, read, done, jumping)


def rows_whose_inputs_cannot_be(ensemble: Ensemble, failed: NDArray[np.bool_]) -> Iterator[tuple[int, str]]:
    """Yield rows whose inputs jump too often, and what single runs say of each.

    Parameters
    ----------
    ensemble : Ensemble
        What was run.
    failed : Array of bool, shape (n,)
        Rows without a start.
    """
    for row in np.flatnonzero(failed).tolist() if ensemble.driving.own else ():
        values = dict(zip(ensemble.parameters, ensemble.settled(row, row + 1).parameters[0].tolist(), strict=True))
        if all(map(math.isfinite, values.values())) and (told := ensemble.driving.refusal(values)):
            yield row, told


def rows_that_may_miss(ensemble: Ensemble, done: NDArray[np.bool_]) -> Iterator[tuple[NDArray[np.int64], str]]:
    """Yield rows whose steps may go across something short, and what single runs say of each such group.

    Parameters
    ----------
    ensemble, done
        As for `rows_that_jump`.
    """
    known, spec = ensemble.foreseen, ensemble.recipe.spec
    if not known:
        return iter(())
    often = f"times at which formulas change were looked for in {MOST_LOOKS} runs with other values alone"

    def missed(values: dict[str, float], looked: int) -> list[str]:
        if looked >= MOST_LOOKS:
            return [f"{often}: steps may miss what is short"]
        return known.missed(values, spec.until, None if spec.adaptive else spec.step)

    return _told(ensemble, [name for name in ensemble.parameters if name in known.reads], done, missed)


def _told(
    ensemble: Ensemble, read: Sequence[str], done: NDArray[np.bool_], say: Callable[[dict[str, float], int], list[str]]
) -> Iterator[tuple[NDArray[np.int64], str]]:
    """Yield rows and what is said of them, by the values they read and how many others were asked about before.

    Each combination is asked about once; what is not defined fails at its start, and nothing more is said of it.
    """
    said = dict[tuple[float, ...], list[str]]()
    for rows, values in _groups(ensemble, read, done):
        key = tuple(values.values())
        if key not in said and all(map(math.isfinite, key)):
            said[key] = say(values, len(said))
        for sentence in said.get(key, ()):
            yield rows, sentence


def _groups(
    ensemble: Ensemble, read: Sequence[str], done: NDArray[np.bool_]
) -> Iterator[tuple[NDArray[np.int64], dict[str, float]]]:
    """Yield rows that are done and alike in the parameters that are read, with the values of these."""
    places = [list(ensemble.parameters).index(name) for name in read]
    for first in range(0, len(ensemble), _TOGETHER):
        last = min(first + _TOGETHER, len(ensemble))
        asked, alike = np.flatnonzero(done[first:last]), dict[tuple[float, ...], list[int]]()
        for row, values in enumerate(ensemble.settled(first, last).parameters[asked][:, places].tolist()):
            alike.setdefault(tuple(values), []).append(row)
        for key, rows in alike.items():
            yield first + asked[rows], dict(zip(read, key, strict=True))
