"""The last state of a run with its saved arrays, from which another run continues."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.csv_tables import numbers_in_unit
from symgen.base.errors import plural

Array = NDArray[np.float64]

#: Settings of runs saved before these were recorded.
_BEFORE = {"coordinates": "absolute"}


@dataclass(frozen=True, repr=False)
class LastState:
    """The last state of a run.

    Attributes
    ----------
    mechanism, digest : str
        Name of the mechanism; digest of its equations, empty if unknown.
    t : float
        Time [s].
    q, v : mapping of str to float
        Coordinates and velocities by name.
    work : float
        Work since the motion began [J].
    work_before : float
        Part of the work from before the run of the arrays, not included in them.
    windings : tuple of float
        Angles that count turns; empty if unknown.
    rank : int
        Rank of D at the start of the run.
    made : mapping
        Settings of the run as JSON data: only a run with the same settings continues the arrays.
    failed : str
        Reason of a failure, if any: then only t, q, v and the work are continued.
    arrays : mapping of str to Array
        Arrays saved by `symgen.run.single.simulation.Simulation`; empty if none were saved.
    states : mapping of str to float
        States of the file's own by name; None without such states.
    state_units : mapping of str to str
        Their units where a file of columns gives others than the mechanism may.
    """

    mechanism: str
    digest: str
    t: float
    q: Mapping[str, float]
    v: Mapping[str, float]
    work: float = 0.0
    work_before: float = 0.0
    windings: tuple[float, ...] = ()
    rank: int = 0
    made: Mapping[str, Any] | None = None
    failed: str = ""
    arrays: Mapping[str, NDArray[Any]] | None = None
    states: Mapping[str, float] | None = None
    state_units: Mapping[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<LastState of {self.mechanism} at {self.t:g} s: {plural(len(self.q), 'coordinate')}>"

    def states_in(self, units: Mapping[str, str]) -> dict[str, float]:
        """Return the states of the file's own in units of a mechanism.

        Raises
        ------
        InputError
            If one has a unit of another quantity.
        """
        states, own = self.states or {}, self.state_units
        return {n: numbers_in_unit(f"start: {n}", [x], own.get(n, ""), units.get(n, ""))[0] for n, x in states.items()}

    @property
    def last_state(self) -> LastState:
        """The state itself: results have the same property, so a run can continue from either."""
        return self

    def other_than(self, made: Mapping[str, Any]) -> list[str]:
        """Return the differences of a run with settings `made`, in words; empty if it can continue the arrays."""
        if self.failed:
            return [f"that run failed ({self.failed})"]
        if self.made is None or not self.arrays:
            return ["nothing else was kept"]
        differences = list[str]()
        for key, value in made.items():
            before = self.made.get(key, _BEFORE.get(key))
            if before == value:
                continue
            if isinstance(value, Mapping) and isinstance(before, Mapping):
                names = [n for n in (*before, *(n for n in value if n not in before)) if before.get(n) != value.get(n)]
                differences += [f"{n} {_word(value.get(n))} instead of {_word(before.get(n))}" for n in names]
            else:
                differences.append(f"{key} {_word(value)} instead of {_word(before)}")
        return differences

    def header(self) -> dict[str, Any]:
        """Return all data but the arrays as JSON data, with a digest that includes the arrays."""
        names = ("mechanism", "digest", "t", "work", "work_before", "rank", "failed")
        header: dict[str, Any] = {name: getattr(self, name) for name in names}
        header |= {"q": dict(self.q), "v": dict(self.v), "windings": list(self.windings), "made": self.made}
        header |= {"states": dict(self.states)} if self.states else {}
        header["sizes"] = {name: [str(a.dtype), len(a)] for name, a in (self.arrays or {}).items()}
        return header | {"sha256": _digest(header, self.arrays or {})}

    @classmethod
    def of_header(cls, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> LastState | None:
        """Return the last state of `header` and its nonempty arrays, or None if the digest differs.

        Parameters
        ----------
        header : mapping
            From `header`.
        arrays : mapping of str to Array
            Arrays by name.
        """
        entries = {key: value for key, value in header.items() if key != "sha256"}
        whole = {
            name: np.ascontiguousarray(arrays.get(name, np.zeros(0)), dtype=np.dtype(kind))
            for name, (kind, _) in entries["sizes"].items()
        }
        if _digest(entries, whole) != header.get("sha256"):
            return None
        fields = {key: value for key, value in entries.items() if key not in ("sizes", "windings")}
        return cls(**fields, windings=tuple(entries["windings"]), arrays=whole)


def _word(value: object) -> str:
    return "none" if value is None else f"{value:g}" if isinstance(value, float) else str(value)


def _digest(header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> str:
    digest = hashlib.sha256(json.dumps(header, sort_keys=True).encode())
    for name in sorted(arrays):
        digest.update(name.encode() + b"\0" + np.ascontiguousarray(arrays[name]).tobytes())
    return digest.hexdigest()
