"""Text for people on its way into emitted code, and names that are made of names of a file."""

from __future__ import annotations

#: Longest text that is emitted in one piece.
LONGEST = 200


def harmless(text: object) -> str:
    """Return a text that cannot end the comment or docstring it stands in, nor be read as an escape.

    Line ends and all that is not printable become spaces, double quotes single ones, and backslashes slashes.

    Parameters
    ----------
    text : object
        What a file, a method or an option says of itself.
    """
    kept = str(text)[: LONGEST + 1].translate(_SIGNS)
    if not kept.isprintable():
        kept = "".join(c if c.isprintable() else " " for c in kept)
    return kept if len(kept) <= LONGEST else kept[: LONGEST - 3] + "..."


_SIGNS = str.maketrans('"\\', "'/")

#: What precedes the name of a table in each of the names that are made of it: no other emitted name begins so.
_OF_TABLE = {"value": "table_", "slope": "slope_", "second": "second_", "x": "points_", "y": "values_"}


def table_name(name: str, what: str = "value") -> str:
    """Return the emitted name of a table's function, of its derivatives', or of the array of its points or values.

    The table's name follows unchanged, so that names differ wherever those of tables do.

    Parameters
    ----------
    name : str
        A checked identifier.
    what : {"value", "slope", "second", "x", "y"}
        Which one.
    """
    return _OF_TABLE[what] + name
