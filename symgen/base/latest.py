"""A store of the values that a process computed last."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


def get_or_make(store: dict[Key, Value], key: Key, make: Callable[[], Value], most: int) -> Value:
    """Return the value of a key, made where there is none; of more keys than `most` the oldest leave.

    Parameters
    ----------
    store : dict
        Values by key, the latest last.
    key, make : hashable, callable
        The key, and what computes its value.
    most : int
        Number of values that stay.
    """
    value = store.pop(key) if key in store else make()
    store[key] = value
    for oldest in list(store)[:-most]:
        del store[oldest]
    return value
