"""A store of the values that a process computed last."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar, cast

Key = TypeVar("Key")
Value = TypeVar("Value")
_MISSING = object()


def get_or_make(store: dict[Key, Value], key: Key, make: Callable[[], Value], most: int) -> Value:
    """Return the value of a key, made where there is none; of more keys than `most` the oldest leave.

    Threads may share a store: what another one has just taken out or removed is made, or left alone.

    Parameters
    ----------
    store : dict
        Values by key, the latest last.
    key, make : hashable, callable
        The key, and what computes its value.
    most : int
        Number of values that stay.
    """
    kept = store.pop(key, _MISSING)
    value = make() if kept is _MISSING else cast("Value", kept)
    store[key] = value
    for oldest in list(store)[:-most]:
        store.pop(oldest, None)
    return value
