"""The file of a modal body: plain arrays of NumPy's format, read without running anything in them.

Descriptions hold no arrays of NumPy, so these become nested tuples of numbers; reading the first file imports NumPy.
"""

from __future__ import annotations

import functools
import io
import math
import os
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from symgen.base.errors import InputError, quote
from symgen.base.files import system_message
from symgen.describe.modal_body import (
    MOST_MODES,
    HeldStretch,
    InterfaceLoad,
    Matrix,
    ModalOutline,
    ModalRow,
    Numbers,
    PairedCouple,
)
from symgen.describe.parts.bodies import is_modal

#: End of the name, and version of the content.
SUFFIX, VERSION = ".npz", 1
#: Bytes of the file, and of all that is in it, at most.
LARGEST, LARGEST_CONTENT = 4_000_000, 40_000_000
#: What NumPy raises at bytes that are no array.
_DAMAGED = (
    *(ValueError, TypeError, KeyError, SyntaxError, OverflowError, MemoryError, RecursionError, EOFError),
    tokenize.TokenError,
)
#: Array -> its shape: d components of a place, r of a turn, k modes, n interfaces, and any number of others.
_SHAPES: dict[str, tuple[str, ...]] = {
    **{"version": (), "mass": (), "inner": (), "centre": ("d",), "inertia": ("r", "r"), "stiffness": ("k",)},
    **{"growth": ("k", "r", "r"), "second": ("k", "k", "r", "r"), "cross": ("k", "k", "r")},
    **{"interfaces": ("n",), "place": ("n", "d"), "shape": ("n", "k", "d"), "turn": ("n", "k", "r")},
    **{"elastic": ("n", "d", "k"), "shifted": ("n", "d", "d"), "spread": ("n", "d", "d", "d")},
    **{"modal": ("n", "d", "k"), "bearing_stiffness": ("n",), "bearing_length": ("n",)},
    **{"row_names": ("rows",), "row_units": ("rows",), "rows": ("rows", "k")},
    **{"points": ("points", "d"), "point_shapes": ("points", "k", "d"), "lines": ("lines", "two")},
}
#: The same of arrays that files of earlier releases do not have: those are read without.
_LATER: dict[str, tuple[str, ...]] = {
    **{"stretch_ends": ("stretches", "two"), "stretch_growth": ("stretches", "k", "k")},
    **{"stretch_stiffness": ("stretches",), "softening": ("d",)},
    **{"couple_ends": ("couples", "two"), "couple_share": ("couples", "d", "k")},
    **{"stiffened": (), "curve": ("curved", "k", "k", "d"), "twist": ("curved", "k", "k", "r")},
}
_TEXTS = ("interfaces", "row_names", "row_units")
_WHOLE = ("version", "inner", "lines", "stretch_ends", "couple_ends", "stiffened")


class InterfaceFile(NamedTuple):
    """An interface in a file: its place from the origin of the body's frame, and what modes move it by."""

    place: Numbers
    shape: tuple[Numbers, ...]
    turn: tuple[Numbers, ...]
    load: InterfaceLoad
    curve: tuple[tuple[Numbers, ...], ...]
    twist: tuple[tuple[Numbers, ...], ...]


class ModalFile(NamedTuple):
    """The content of a file; see `symgen.describe.modal_body`."""

    mass: float
    centre: Numbers
    inertia: Matrix
    stiffness: Numbers
    inner: int
    growth: tuple[Matrix, ...]
    second: tuple[tuple[Matrix, ...], ...]
    cross: tuple[tuple[Numbers, ...], ...]
    interfaces: dict[str, InterfaceFile]
    rows: tuple[ModalRow, ...]
    outline: ModalOutline
    stretches: tuple[HeldStretch, ...]
    couples: tuple[PairedCouple, ...]
    softening: Numbers
    stiffened: bool

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return len(self.centre)


def with_whole_paths(raw: Mapping[str, Any], source: str) -> dict[str, Any]:
    """Return a description with whole paths of its modal files and drawings, for reading it again without its folder.

    Parameters
    ----------
    raw : mapping
        The description.
    source : str
        Its origin; one without a folder leaves names as they are.
    """
    folder = getattr(source, "folder", "")
    if not folder:
        return dict(raw)
    whole = dict(raw)
    for section in ("bodies", "outlines"):
        tables = raw.get(section, {})
        named = {
            name: {**table, "file": str(Path(folder) / table["file"])}
            for name, table in (tables.items() if isinstance(tables, Mapping) else ())
            if isinstance(table, Mapping) and isinstance(table.get("file"), str)
            if section == "outlines" or is_modal(table)
        }
        if named:
            whole[section] = {**tables, **named}
    return whole


def read_modal_file(where: str, path: str) -> ModalFile:
    """Return the content of a file.

    Parameters
    ----------
    where : str
        File and key that name it, for messages.
    path : str
        Its path.

    Raises
    ------
    InputError
        If it is another file, or of another version.
    """
    try:
        status = os.stat(path)
        return _read(path, status.st_mtime_ns, status.st_size)
    except OSError as error:
        raise InputError(
            where, "a file that can be read", f"{quote(Path(path).name)} ({system_message(error)})"
        ) from None
    except _NotModal as error:
        name = quote(Path(path).name)
        hint = "symgen.reduced(...).save(...) writes it" if error.hint is None else error.hint
        raise InputError(where, error.expected, f"{name} {error.got}", hint) from None


class _NotModal(Exception):
    """A file is none of a modal body."""

    def __init__(self, got: str, expected: str = "a file of a modal body", hint: str | None = None) -> None:
        super().__init__(got)
        self.got, self.expected, self.hint = got, expected, hint


@functools.lru_cache(maxsize=64)
def _read(path: str, changed: int, size: int) -> ModalFile:
    if size > LARGEST:
        raise _NotModal(f"of {size} bytes, more than {LARGEST}")
    arrays = _arrays_of_file(path)
    if "version" not in arrays:
        raise _NotModal("without a version")
    if arrays["version"] != VERSION:
        got = f"of version {arrays['version']}"
        raise _NotModal(got, f"a file of version {VERSION}", "write it again by symgen.reduced")
    missing = [name for name in _SHAPES if name not in arrays]
    if missing:
        raise _NotModal(f"without the array '{missing[0]}'")
    centre = arrays.get("centre")
    no_softening = (0.0,) * len(centre) if isinstance(centre, tuple) else ()
    arrays = {**dict.fromkeys(_LATER, ()), "softening": no_softening, "stiffened": 0, **arrays}
    _check_shapes(arrays)
    names = arrays["row_names"]
    rows = tuple(
        ModalRow(name, 0 if names.count(name) == 1 else 1 + names[:i].count(name), unit, factors)
        for i, (name, unit, factors) in enumerate(zip(names, arrays["row_units"], arrays["rows"], strict=True))
    )
    loads = zip(
        *(arrays[name] for name in ("elastic", "shifted", "spread", "modal", "bearing_stiffness", "bearing_length")),
        strict=True,
    )
    curved = ((c, t) for c, t in zip(arrays["curve"], arrays["twist"], strict=True))
    frames = (
        InterfaceFile(place, shape, turn, InterfaceLoad(*load), *next(curved, ((), ())))
        for place, shape, turn, load in zip(arrays["place"], arrays["shape"], arrays["turn"], loads, strict=True)
    )
    return ModalFile(
        **{
            name: arrays[name]
            for name in ("mass", "centre", "inertia", "stiffness", "inner", "growth", "second", "cross")
        },
        interfaces=dict(zip(arrays["interfaces"], frames, strict=True)),
        rows=rows,
        outline=ModalOutline(arrays["points"], arrays["point_shapes"], arrays["lines"]),
        stretches=tuple(
            HeldStretch((arrays["interfaces"][i], arrays["interfaces"][j]), growth, stiffness)
            for (i, j), growth, stiffness in zip(
                *(arrays[name] for name in ("stretch_ends", "stretch_growth", "stretch_stiffness")), strict=True
            )
        ),
        couples=tuple(
            PairedCouple((arrays["interfaces"][i], arrays["interfaces"][j]), share)
            for (i, j), share in zip(arrays["couple_ends"], arrays["couple_share"], strict=True)
        ),
        softening=arrays["softening"],
        stiffened=bool(arrays["stiffened"]),
    )


def _check_shapes(arrays: dict[str, Any]) -> None:
    """Refuse arrays of sizes that do not fit each other, and numbers that are not finite."""
    sizes = {"d": len(arrays["centre"]) if isinstance(arrays["centre"], tuple) else 0, "two": 2}
    sizes["r"] = {2: 1, 3: 3}.get(sizes["d"], 0)
    if not sizes["r"]:
        raise _NotModal("that is neither of the plane nor of space")
    for name, symbols in (_SHAPES | _LATER).items():
        _check_size(name, arrays[name], symbols, sizes)
        if not _is_right(arrays[name], str if name in _TEXTS else int if name in _WHOLE else float):
            what = "a text" if name in _TEXTS else "a finite number"
            raise _NotModal(f"whose array '{name}' has an entry that is not {what}")
    if not 1 <= sizes["k"] <= MOST_MODES:
        raise _NotModal(f"with {sizes['k']} modes, not 1 to {MOST_MODES}")
    if any(not 0 <= end < sizes["points"] for line in arrays["lines"] for end in line):
        raise _NotModal("whose outline has lines between points that it does not have")
    if sizes["curved"] not in (0, sizes["n"]):
        raise _NotModal("whose array 'curve' has a size that does not fit the others")
    for what in ("stretch", "couple"):
        if any(not 0 <= end < sizes["n"] for pair in arrays[f"{what}_ends"] for end in pair):
            raise _NotModal(f"with a {what} between interfaces that it does not have")
    if not arrays["mass"] > 0.0 or not all(k > 0.0 for k in arrays["stiffness"]):
        raise _NotModal("with a mass or a stiffness that is not above 0")


def _check_size(name: str, array: object, symbols: tuple[str, ...], sizes: dict[str, int]) -> None:
    if not symbols:
        if isinstance(array, tuple):
            raise _NotModal(f"whose array '{name}' is not one number")
        return
    if not isinstance(array, tuple) or sizes.setdefault(symbols[0], len(array)) != len(array):
        raise _NotModal(f"whose array '{name}' has a size that does not fit the others")
    for part in array:
        _check_size(name, part, symbols[1:], sizes)


def _is_right(array: object, kind: type) -> bool:
    if isinstance(array, tuple):
        return all(_is_right(part, kind) for part in array)
    return isinstance(array, kind) and (not isinstance(array, float) or math.isfinite(array))


# -- arrays of NumPy's format ------------------------------------------------------------------------------------------


def _arrays_of_file(path: str) -> dict[str, Any]:
    """Return the arrays of a file as nested tuples."""
    try:
        with zipfile.ZipFile(path) as archive:
            if sum(info.file_size for info in archive.infolist()) > LARGEST_CONTENT:
                raise _NotModal("with too much in it")
            return {
                info.filename.removesuffix(".npy"): _array_of_bytes(info.filename, archive.read(info))
                for info in archive.infolist()
            }
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError):
        raise _NotModal("which is no archive of arrays") from None


def _array_of_bytes(name: str, content: bytes) -> Any:
    """Return an array: a number or a text, or nested tuples of these."""
    from numpy.lib.format import read_array

    try:
        with warnings.catch_warnings(action="ignore"):  # of headers that other programs wrote
            array = read_array(io.BytesIO(content), allow_pickle=False)
        if array.dtype.kind in "fiuU":
            return _nested(array.tolist())
    except _DAMAGED as error:
        if "allow_pickle" in str(error):
            got = f"whose array '{name.removesuffix('.npy')}' is a pickle, which nothing here runs"
            raise _NotModal(got) from None
    raise _NotModal(f"whose part {quote(name)} is no plain array")


def _nested(values: Any) -> Any:
    return tuple(map(_nested, values)) if isinstance(values, list) else values
