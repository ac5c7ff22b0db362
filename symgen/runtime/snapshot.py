"""All that a run keeps in one piece of memory, of which a copy costs less than a step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import abi
from symgen.runtime.padding import padded

if TYPE_CHECKING:
    from symgen.runtime.records import State

Array = NDArray[np.float64]

#: Arrays of a state that stand behind those which are always copied: passages are few, and working memory is not kept.
_BEHIND = ("events", "room")


class Snapshot:
    """A state whose arrays stand one behind the other, and a copy of what they held at some time.

    Parameters
    ----------
    state : State
        Its arrays are copied; all hold numbers of eight bytes.

    Attributes
    ----------
    state : State
        The same numbers in one piece of memory.
    front, copy : Array
        The part of it that is always copied, and its copy.
    rows : int
        Numbers of the table of passages that belong to the copy.
    """

    def __init__(self, state: State) -> None:
        arrays = state._asdict()
        names = [*(name for name in arrays if name not in _BEHIND), *_BEHIND]
        ends = np.cumsum([padded(len(arrays[name])) for name in names])
        block, views = np.zeros(ends[-1]), dict[str, Any]()
        for name, end in zip(names, ends, strict=True):
            first = end - padded(len(arrays[name]))
            views[name] = block[first : first + len(arrays[name])].view(arrays[name].dtype)
            views[name][:] = arrays[name]
        self.state = type(state)(**views)
        self.front = block[: ends[-len(_BEHIND) - 1]]
        self.copy, self._events = self.front.copy(), self.state.events.copy()
        self.rows, self._kept = 0, dict[str, NDArray[Any]]()
        self._names: tuple[str, ...] | None = None

    def take(self, scheme: Any) -> None:
        """Copy what the state holds, and what a scheme's record keeps."""
        self.copy[:] = self.front
        self.rows = min(int(self.state.control[abi.EVENTS]), abi.MAX_EVENTS) * abi.N_EVENT
        self._events[: self.rows] = self.state.events[: self.rows]
        if self._names is None:
            self._names = names_kept(scheme)
        for name in self._names:
            array, there = getattr(scheme, name), self._kept.get(name)
            if there is None or len(there) != len(array):
                self._kept[name] = array.copy()
            else:
                there[:] = array

    def put_back(self, scheme: Any) -> Any:
        """Give the state what was copied, and return the scheme's record with what it kept then."""
        self.front[:] = self.copy
        self.state.events[: self.rows] = self._events[: self.rows]
        self.state.events[self.rows :] = 0.0
        for name, array in self._kept.items():
            scheme = with_kept(scheme, name, array)
        return scheme


def names_kept(scheme: Any) -> tuple[str, ...]:
    """Return the fields of a scheme's record that belong to what a run keeps."""
    from symgen.runtime.records import KEPT

    return tuple(name for name in KEPT if hasattr(scheme, name))


def with_kept(scheme: Any, name: str, array: NDArray[Any]) -> Any:
    """Return a scheme's record with numbers that it kept, in the same memory where there is room for just these."""
    there = getattr(scheme, name)
    if there.shape != array.shape:
        return scheme._replace(**{name: array.copy()})
    there[:] = array
    return scheme
