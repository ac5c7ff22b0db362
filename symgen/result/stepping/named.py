"""A NumPy array whose elements have names, and which is a view: it shows what a run holds at present."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, quote, suggest

Array = NDArray[np.float64]


class Named(np.ndarray[Any, Any]):
    """A read-only view of one dimension whose elements have names.

    ``q["crank.theta"]`` is a number, ``q["crank"]`` the part that belongs to a body, a view where its elements stand
    together. Anything else is as with NumPy: ``q[0]``, ``q[2:5]``, ``k @ q``; results are plain arrays. ``q.copy()`` is
    a plain array that changes no more.

    Attributes
    ----------
    names, units : tuple of str
        Of the elements.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    _places: dict[str, int | slice | list[int]]

    @classmethod
    def of(cls, array: Array, names: tuple[str, ...], units: tuple[str, ...]) -> Named:
        """Return a view of `array`."""
        if not array.shape == (len(names),) == (len(units),):
            raise ValueError(f"{len(names)} names and {len(units)} units for an array {array.shape}")
        view = array.view(cls)
        view.flags.writeable = False
        groups: dict[str, list[int]] = {}
        for i, name in enumerate(names):
            groups.setdefault(name.rpartition(".")[0], []).append(i)
        view.names, view.units = names, units
        view._places = {body: _range_of_name(places) for body, places in groups.items()}
        view._places |= {name: i for i, name in enumerate(names)}
        return view

    def __array_finalize__(self, source: object) -> None:
        self.names, self.units, self._places = (), (), {}

    def __getitem__(self, key: Any) -> Any:
        """Return the element or the body's part called `key`; keys of other kinds are NumPy's.

        Raises
        ------
        InputError
            If there is no such name; says the nearest one.
        """
        plain = self.view(np.ndarray)
        if not isinstance(key, str):
            return plain[key]
        place = self._places.get(key)
        if place is None:
            hint = suggest(key, self.names) if len(self.names) <= 40 or "." in key else ""
            raise InputError("name", "that of an element or a body", quote(key), hint)
        return float(plain[place]) if isinstance(place, int) else plain[place]

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: object, **options: object) -> Any:
        """Compute with the numbers alone."""
        if "out" in options:
            options["out"] = _plain_array(options["out"])
        return getattr(ufunc, method)(*(_plain_array(x) for x in inputs), **options)

    def __array_function__(self, function: Any, kinds: Any, arguments: Any, options: Any) -> Any:
        """Compute with the numbers alone."""
        return function(*(_plain_array(x) for x in arguments), **{name: _plain_array(x) for name, x in options.items()})

    def copy(self, order: Any = "C") -> Array:  # type: ignore[override]  # a copy is no view and has no names
        """Return the present numbers as a plain array."""
        return np.array(self.view(np.ndarray), order=order)

    def to_dict(self) -> dict[str, float]:
        """Return the present numbers by name."""
        return dict(zip(self.names, self.view(np.ndarray).tolist(), strict=True))

    def __repr__(self) -> str:
        return "Named(" + ", ".join(f"{name}={x:.6g}" for name, x in self.to_dict().items()) + ")"

    def __reduce__(self) -> Any:
        return self.copy().__reduce__()  # what is sent away is no view any more


def _range_of_name(places: list[int]) -> slice | list[int]:
    """Return places as a slice where they follow each other."""
    together = places == [*range(places[0], places[-1] + 1)]
    return slice(places[0], places[-1] + 1) if together else places


def _plain_array(value: Any) -> Any:
    """Return a value without names, those inside of lists and tuples among them."""
    if isinstance(value, Named):
        return value.view(np.ndarray)
    return type(value)(_plain_array(x) for x in value) if type(value) in (list, tuple) else value
