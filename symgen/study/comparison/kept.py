"""Rows and references of an interrupted study, found again by everything that they depend on."""

from __future__ import annotations

from dataclasses import asdict, fields
from typing import Any

from symgen.describe.mechanism import Mechanism
from symgen.result.contract import finite
from symgen.settings import Settings
from symgen.study.comparison.preparation import as_entry, from_entry
from symgen.study.comparison.rows import Row, Trace
from symgen.study.journal import Journal, cell_key, code_identity, mechanism_identity
from symgen.study.machine import machine_class, versions
from symgen.study.references.reference import Array, Reference


class Kept:
    """What a journal holds of the comparison on one mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    journal : Journal or None
        Where rows are kept; None keeps nothing.
    reference_by : str
        Where the reference comes from, as `symgen.study.references.reference.reference` takes it: errors are distances
        to it.
    """

    def __init__(self, mechanism: Mechanism, journal: Journal | None, reference_by: str = "auto") -> None:
        self.journal = journal
        self._base: dict[str, Any] = {}
        if journal is not None:
            self._base["mechanism"] = mechanism_identity(mechanism)
            self._base["code"] = code_identity()
            self._base["reference"] = reference_by
            # run times of another machine or with other libraries are other run times
            self._base["machine"], self._base["versions"] = machine_class(), versions()

    def _key(self, settings: Settings, what: str) -> str:
        times = [] if settings.times is None else list(settings.times)
        shared = {"until": settings.until, "times": times, "parameters": dict(settings.parameters)}
        shared["start"] = dict(settings.start)
        if what != "comparison":
            return cell_key(what=what, **self._base, **shared)
        own = {f.name: getattr(settings, f.name) for f in fields(settings) if f.name not in shared}
        if own["coordinates"] == "absolute":
            del own["coordinates"]  # rows were kept before there were others
        return cell_key(what=what, **self._base, **shared, **own)

    def _get(self, settings: Settings, what: str) -> dict[str, Any] | None:
        return None if self.journal is None else self.journal.get(self._key(settings, what))

    def _add(self, settings: Settings, what: str, entry: dict[str, Any]) -> None:
        if self.journal is not None and self._get(settings, what) is None:
            self.journal.add(self._key(settings, what), finite(entry))

    def row(self, settings: Settings) -> tuple[Row, Trace] | None:
        """Return a row that was kept, with its curves."""
        entry = self._get(settings, "comparison")
        if entry is None:
            return None
        optional = {f.name for f in fields(Row) if "None" in str(f.type)}
        # JSON has no nan; what is None but must not be was one
        values: dict[str, Any] = {k: _NAN if v is None and k not in optional else v for k, v in entry["row"].items()}
        values["warnings"] = tuple(values["warnings"])
        drawn = {k: tuple(_NAN if x is None else x for x in v) for k, v in entry["trace"].items()}
        return Row(**values), Trace(**drawn)

    def add_row(self, settings: Settings, row: Row, trace: Trace) -> None:
        """Keep a row with its curves."""
        self._add(settings, "comparison", {"row": asdict(row), "trace": asdict(trace)})

    def reference(self, settings: Settings, times: Array) -> Reference | None:
        """Return the reference that was kept."""
        entry = self._get(settings, "reference")
        return None if entry is None else from_entry(entry, times)

    def add_reference(self, settings: Settings, known: Reference) -> None:
        """Keep the reference."""
        self._add(settings, "reference", as_entry(known))

    def why_none(self, settings: Settings) -> str:
        """Return why no reference was found, an empty text where that is not known."""
        entry = self._get(settings, "no reference")
        return "" if entry is None else str(entry["note"])

    def add_why_none(self, settings: Settings, note: str) -> None:
        """Keep why there is no reference."""
        self._add(settings, "no reference", {"note": note})


_NAN = float("nan")
