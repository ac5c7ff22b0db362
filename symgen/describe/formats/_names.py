"""Names of another program's file as names of a description."""

from __future__ import annotations

import re

from symgen.describe.formulas.identifiers import LONGEST, RESERVED


class DescriptionNames:
    """Names of a file as names of a description: letters, digits and ``_``, each used once."""

    def __init__(self) -> None:
        self._used, self._names = {name.lower() for name in RESERVED}, dict[tuple[str, str], str]()

    def name_for(self, sort: str, name: str) -> str:
        """Return the name of a link, joint or input, always the same one."""
        import keyword

        if (sort, name) in self._names:
            return self._names[sort, name]
        stem = re.sub(r"[^A-Za-z0-9_]+", "_", name).strip("_")
        stem = (stem if stem[:1].isalpha() and stem.isascii() else f"{sort}_{stem}").rstrip("_")[: LONGEST - 12]
        cured, k = stem, 1
        if cured.lower() in self._used or keyword.iskeyword(cured):
            cured = f"{stem}_{sort}"
        while cured.lower() in self._used:
            k += 1
            cured = f"{stem}_{sort}{k}"
        self._used.add(cured.lower())
        self._names[sort, name] = cured
        return cured
