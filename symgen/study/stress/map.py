"""The map of a stress study: for each method and family, how many cases went well and what became of the others."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.study.stress.cell_outcome import GOOD, OUTCOMES, REFUSED, UNJUDGED, counts

if TYPE_CHECKING:
    from symgen.study.stress.stress_rows import Stress, StressRow

#: Letters of outcomes in a map.
LETTERS = {
    "inaccurate": "i",
    "wrong branch": "b",
    "singular": "s",
    "diverged": "d",
    "too slow": "t",
    "refused": "r",
    "unjudged": "u",
}
#: What the letters mean, one line.
LEGEND = ", ".join(f"{letter} {outcome}" for outcome, letter in LETTERS.items())


@dataclass(frozen=True)
class Entry:
    """One field of the map.

    Attributes
    ----------
    rows : tuple of StressRow
        The cells that it sums up.
    """

    rows: tuple[StressRow, ...]

    @property
    def judged(self) -> int:
        """Cells that were run against a reference."""
        return sum(row.outcome not in (REFUSED, UNJUDGED) for row in self.rows)

    @property
    def good(self) -> int:
        """Cells that were accurate."""
        return sum(row.outcome == GOOD for row in self.rows)

    @property
    def text(self) -> str:
        """Accurate cells of all that were judged, with the letters of the other outcomes: ``3/5 di``."""
        if not self.rows:
            return ""
        found = counts([row.outcome for row in self.rows])
        letters = "".join(LETTERS[name] for name in OUTCOMES if name in LETTERS and found[name])
        return f"{self.good}/{self.judged} {letters}".strip()


@dataclass(frozen=True)
class Map:
    """Fields by method and family.

    Attributes
    ----------
    lines : tuple of (str, str)
        Methods with their integrators, in the order of the rows.
    families : tuple of str
        Columns.
    """

    lines: tuple[tuple[str, str], ...]
    families: tuple[str, ...]
    rows: tuple[StressRow, ...]

    @classmethod
    def of(cls, study: Stress) -> Map:
        """Return the map of all families in which one quantity is varied."""
        rows = map_rows(study.rows)
        lines = tuple(dict.fromkeys((row.method, row.integrator) for row in rows))
        order = {name: i for i, name in enumerate(dict.fromkeys(method for method, _ in lines))}
        families = tuple(dict.fromkeys(row.family for row in rows))
        return cls(tuple(sorted(lines, key=lambda line: order[line[0]])), families, rows)

    def entry(self, line: tuple[str, str], family: str | None = None) -> Entry:
        """Return a field; of all families together unless one is named."""
        return Entry(
            tuple(
                row
                for row in self.rows
                if (row.method, row.integrator) == line and (family is None or row.family == family)
            )
        )


def map_rows(rows: Iterable[StressRow]) -> tuple[StressRow, ...]:
    """Return the rows of the map, without those of planes."""
    return tuple(row for row in rows if len(row.values) == 1)


def plane_rows(rows: Iterable[StressRow], family: str) -> tuple[StressRow, ...]:
    """Return the rows of one plane."""
    return tuple(row for row in rows if row.family == family)


def plane_lines(rows: Sequence[StressRow]) -> tuple[tuple[str, str, str], ...]:
    """Return (model, method, integrator) of the planes among rows, in order."""
    return tuple(dict.fromkeys((row.model, row.method, row.integrator) for row in rows))


def outcomes_of_models(rows: Sequence[StressRow]) -> tuple[tuple[str, dict[str, int]], ...]:
    """Return how often each outcome occurs on each model, planes included; ``-`` are mechanisms of families."""
    models = dict.fromkeys(row.model for row in rows)
    return tuple((model, counts([row.outcome for row in rows if row.model == model])) for model in models)


def shares_of_models(rows: Sequence[StressRow]) -> tuple[tuple[str, int, int], ...]:
    """Return model, accurate cells and judged cells of the map."""
    found = outcomes_of_models(map_rows(rows))
    return tuple((m, n[GOOD], sum(n.values()) - n[REFUSED] - n[UNJUDGED]) for m, n in found if m != "-")
