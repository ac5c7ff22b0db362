"""Files named by users: written whole or not at all; errors are one sentence."""

from __future__ import annotations

import errno
import io
import os
import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from symgen.base.errors import InputError, quote, suggest

#: Content of a file, or a function that writes it to an open file.
Content = bytes | str | Callable[[io.BytesIO], object]


def check_writable(where: str, path: Path) -> None:
    """Refuse a file that could not be written, before anything is computed for it.

    Parameters
    ----------
    where : str
        Who asks, for the message.
    path : Path
        The file, which need not exist.

    Raises
    ------
    InputError
        If the path is a folder or a device, or its folder is missing or cannot be written.
    """
    check_file_name(where, path)
    try:
        real = Path(os.path.realpath(path))  # a link leads to where the file will be
        if real.is_dir():
            raise InputError(where, "the name of a file", f"the folder '{path}'")
        if not real.parent.is_dir():
            raise InputError(where, "a file in a folder that exists", f"'{path}'")
        if real.exists() and not real.is_file():
            raise InputError(where, "the name of a file", f"'{path}', which is a device or a pipe")
        if not os.access(real.parent, os.W_OK) or (real.exists() and not os.access(real, os.W_OK)):
            raise InputError(where, "a file that can be written", f"'{path}'")
    except (OSError, RuntimeError) as error:  # a link that leads to itself
        raise InputError(where, "a file that can be written", f"'{path}' ({system_message(error)})") from None


def file_beside(where: str, folder: str, name: str, endings: tuple[str, ...], expected: str) -> str:
    """Return the path of a file that a table of a mechanism names.

    Parameters
    ----------
    where : str
        File and key, for the message.
    folder : str
        Of the mechanism file; where a mechanism has none, any path is taken as it is.
    name : str
        As written.
    endings : tuple of str
        Its possible endings.
    expected : str
        What it is, for the message.

    Raises
    ------
    InputError
        If there is no such file in the folder or below it.
    """
    inside = f"{expected}, in the folder of the mechanism file or below it" if folder else expected
    plain = name.isprintable() and "\\" not in name and Path(name).suffix.lower() in endings
    outside = Path(name).is_absolute() or ".." in Path(name).parts
    if not plain or (folder and outside):
        raise InputError(where, inside, quote(name))
    try:
        path = (Path(folder or ".") / name).resolve()
        if (not folder or path.is_relative_to(Path(folder).resolve())) and path.is_file():
            return str(path)
        there = sorted(x.name for x in path.parent.iterdir() if x.suffix in endings) if path.parent.is_dir() else []
    except (OSError, RuntimeError, ValueError):  # a name too long, or links in a circle
        there = []
    raise InputError(where, inside, f"{quote(name)}, which is none", suggest(path.name, there) if there else "")


def need_library(where: str, *libraries: str, extra: str = "data") -> None:
    """Raise an error with installation advice if a library is missing.

    Raises
    ------
    InputError
        If one of `libraries` is not installed.
    """
    for library in libraries:
        if find_spec(library) is None:
            raise InputError(where, f"the library {library}", "none", f"pip install 'symgen[{extra}]' installs it")


#: Endings -> programs, of which one has to be there.
MEASURED: Mapping[str, tuple[str, ...]] = {".pgf": ("lualatex", "pdflatex", "xelatex")}


def check_path(where: str, path: Path, endings: Mapping[str, tuple[str, ...]], extra: str) -> Path:
    """Refuse a file that cannot be written, by its ending, its libraries or its folder, and return it otherwise.

    Parameters
    ----------
    where : str
        Option or argument, for the message.
    path : Path
        The file.
    endings : mapping
        Endings with the libraries that they need.
    extra : str
        The extra to install for the libraries.

    Raises
    ------
    InputError
        With the expected value.
    """
    ending = path.suffix.lower()
    if ending not in endings:
        expected = f"a file ending in {', '.join(endings)}"
        raise InputError(where, expected, f"'{path}'", _hint_on_ending(path, endings))
    need_library(where, *endings[ending], extra=extra)
    if ending in MEASURED and not any(map(shutil.which, MEASURED[ending])):
        programs = " or ".join(MEASURED[ending])
        raise InputError(where, f"{programs}, which measure the texts of a {ending} file", "none of them")
    check_writable(where, path)
    return path


#: Endings that other programs write -> those that take their place.
_ENDINGS_MEANT = {
    **dict.fromkeys((".xlsx", ".xls", ".ods", ".mat", ".txt", ".dat", ".tsv", ".json"), ".csv"),
    **dict.fromkeys((".h5", ".hdf5", ".hdf"), ".nc"),
    **dict.fromkeys((".doc", ".docx", ".odt", ".ps"), ".pdf"),
    **dict.fromkeys((".jpg", ".jpeg", ".bmp", ".gif", ".tif", ".tiff", ".webp"), ".png"),
    **dict.fromkeys((".dxf", ".dwg", ".eps"), ".svg"),
    **dict.fromkeys((".avi", ".mp4", ".mov", ".webm", ".gif", ".htm"), ".html"),
}


def _hint_on_ending(path: Path, endings: Mapping[str, tuple[str, ...]]) -> str:
    """Return the name with a likely ending; of one without an ending with the table's, else with the first one."""
    ending = path.suffix.lower()
    meant = _ENDINGS_MEANT.get(ending, "") if ending else next((e for e in (".csv", *endings) if e in endings), "")
    if meant not in endings and (hint := suggest(ending, endings)).startswith("did"):
        meant = hint.removeprefix("did you mean '").removesuffix("'?")
    return f"did you mean '{path.with_suffix(meant)}'?" if meant in endings and path.name else ""


def check_file_name(where: str, path: Path) -> None:
    """Refuse a name that the system cannot look up: one that is too long, or has a null character.

    Parameters
    ----------
    where : str
        Who asks, for the message.
    path : Path
        A file or folder, which need not exist.

    Raises
    ------
    InputError
        If the name is invalid.
    """
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError, PermissionError):
        return
    except (OSError, ValueError) as error:
        raise InputError(where, "a name that a file can have", f"'{path}' ({system_message(error)})") from None


def write_whole(path: Path, content: Content, *, replace: bool = True) -> Path:
    """Write one file; see `write_all`. One that exists is refused where it is not to be replaced."""
    if not replace and os.path.lexists(path):
        raise InputError(str(path), "the name of a file that does not exist yet", "one that does")
    write_all({path: content})
    return path


def write_all(files: Mapping[Path, Content]) -> None:
    """Write files that belong together: all appear, or, where one cannot be written, all stay as they were.

    Parameters
    ----------
    files : mapping
        Path -> content, or a function that writes it to an open binary file. That file is in memory: libraries do not
        expect that writing fails, and HDF5 then ends the process when it lets go of the file.

    Raises
    ------
    InputError
        If one cannot be written. No part of it remains.
    """
    siblings = dict[Path, Path]()
    current = Path()
    try:
        for current, content in files.items():
            target = _resolve_link(current)
            siblings[target] = target.with_name(f".{target.name[-80:]}-{os.urandom(6).hex()}")
            data = _content_as_bytes(content)
            with siblings[target].open("xb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())  # a full or missing disk may raise only now
        for current, sibling in siblings.items():
            os.replace(sibling, current)
    except OSError as error:
        raise InputError(str(current), "a file that can be written", system_message(error)) from error
    finally:
        for path in siblings.values():
            with suppress(OSError):
                path.unlink()


def write_csv(path: Path, heading: Sequence[str], rows: Iterable[Sequence[object]]) -> Path:
    """Write a table as CSV with the ends of lines of RFC 4180; None is empty."""
    import csv

    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(heading)
    writer.writerows(["" if x is None else x for x in row] for row in rows)
    return write_whole(path, text.getvalue())


def heading_with_unit(name: str, unit: str) -> str:
    """Return the heading of a column that carries its unit: ``crank.theta [rad]``."""
    return f"{name} [{unit}]" if unit else name


def system_message(error: Exception) -> str:
    """Return the system's message about a file, as a part of a sentence."""
    if isinstance(error, FileNotFoundError):
        return "no such file or folder"
    return getattr(error, "strerror", None) or str(error) or "an error"


def _resolve_link(path: Path) -> Path:
    """Return the target of a link."""
    try:
        return Path(os.path.realpath(path))
    except ValueError as error:
        raise OSError(errno.EINVAL, str(error)) from None


def _content_as_bytes(content: Content) -> bytes:
    if callable(content):
        stream = io.BytesIO()
        content(stream)
        return stream.getvalue()  # shared, not copied; a view of the stream would outlive it where errors are kept
    # arguments of the command line may hold bytes that are no text
    return content.encode(errors="replace") if isinstance(content, str) else content


def templates_folder() -> Path:
    """Return the folder of the templates: inside the installed package, else beside it in a checkout.

    Raises
    ------
    FileNotFoundError
        If neither exists.
    """
    package = Path(__file__).resolve().parents[1]
    inside, beside = package / "templates", package.parent / "templates"
    for folder in (inside, beside):
        if (folder / "parts").is_dir():
            return folder
    raise FileNotFoundError(f"templates found neither in {inside} nor in {beside}")
