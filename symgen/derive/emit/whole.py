"""A method as one readable module: the functions of its parts, with names in place of numbers of elements."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from symgen.base.ir.program import CARRYING, COUNTERS, JAMMING, STATUS
from symgen.derive.emit.module import ModulePiece, Origins, module_source
from symgen.describe.bounds.by_reaction import JAMMING_MEANS

#: Meaning of the sections of ``w``, for headers.
MEANINGS = {
    "status": "single numbers, named in this module where it uses them",
    "winding": "turns of angles that are counted",
    "multipliers": "Lagrange multipliers, one a row",
    "modes": "of each row that may be off: 1 in force or 0 off, where it is held, a sign, its bound, an effort at rest",
    "mask": "inf at rows that depend on others, else 0",
    "saved": "`mask` while `confirm` leaves out further rows",
    "residual": "Phi after `geometry`, D v - nu after `measure`",
    "nu": "right-hand side of D v = nu",
    "pivot": "pivots of D G D^T over its diagonal: near 0 a row depends on others",
    "change": "correction of velocities, or of positions, that `spread` leaves",
    "mass": "diagonal of M",
    "gauge": "diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l",
    "row_weight": "factors that make rows of different units comparable",
    "jacobian": "entries of D that are not constant",
    "lower": "L of the factorisation of D G D^T, below the diagonal",
    "reciprocal": "reciprocals of the pivots of D G D^T, 0 for rows left out",
    "law_lower": "L of the factorisation in the metric of this method",
    "law_reciprocal": "reciprocals of its pivots",
    "auxiliary": "rates of integrals beside the state",
    "dense": "a dense matrix, row by row",
    "dependent": "1 at dependent velocities, else 0",
    "basis": "directions of motion that constraints allow",
    "trial": "`basis` before its columns are orthogonal",
    "force": "forces, one a velocity",
    "weighed": "M times a direction or an acceleration",
    "small": "M in these directions",
    "reduced": "forces, then accelerations in these directions",
    "row_length": "lengths of the rows of D",
    "row_chosen": "rows in the order of the factorisation Q R",
    "row_corner": "diagonal of R",
    "row_factor": "factors of the reflections that make Q",
    JAMMING: JAMMING_MEANS,
    CARRYING: "what rows in force carry for others at rest",
    "mass_entry": "entries of M that depend on positions",
    "body_entry": "entries of the metric of bodies' own velocities",
    "moved": "sum of the corrections in this step",
    "force_of_constraints": "multipliers of the corrections",
    "kept": "what an iteration keeps from its beginning, or reaches",
}
_ELEMENT = re.compile(r"\b(w|iw|p)\[(\d+)\]")


@dataclass(frozen=True)
class Places:
    """Names of the elements of arrays that functions of one mechanism index by number.

    Attributes
    ----------
    sections : mapping of str to (int, int)
        Beginning and length of each section of ``w``.
    parameters : mapping of str to int
        Element of ``p`` of each parameter of the method.
    """

    sections: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    parameters: Mapping[str, int] = field(default_factory=dict)

    @property
    def header(self) -> list[str]:
        """Lines on the sections of ``w``."""
        lines = []
        for name, (first, size) in self.sections.items():
            meaning = MEANINGS.get(name) or MEANINGS.get(name.partition("_")[0], "of the method alone")
            lines += [f"{f'w[{first}:{first + size}]':<11} {name}: {meaning}"] if size else []
        return lines

    @property
    def constants(self) -> dict[str, tuple[int, str]]:
        """Number of each name, and its array."""
        constants = {name: (first, "sections of w") for name, (first, _) in self.sections.items()}
        if "status" in self.sections:
            first = self.sections["status"][0]
            constants |= {name: (first + i, "numbers in w") for i, name in enumerate(STATUS)}
        constants |= {name: (i, "counters in iw") for i, name in enumerate(COUNTERS)}
        return constants | {name: (at, "parameters of the method in p") for name, at in self.parameters.items()}

    def put_names(self, code: ModulePiece) -> ModulePiece:
        """Return a function with names in place of the numbers of elements of w and iw, and of the method in p."""
        used = set(code.sections)

        def name_of_match(match: re.Match[str]) -> str:
            array, index = match[1], int(match[2])
            place = self._name_and_distance(array, index)
            if place is None:
                return match[0]
            used.add(place[0])
            return f"{array}[{place[0].upper()}{f' + {place[1]}' if place[1] else ''}]"

        return replace(code, text=_ELEMENT.sub(name_of_match, code.text), sections=frozenset(used))

    def _name_and_distance(self, array: str, index: int) -> tuple[str, int] | None:
        """Return the name of an element, and its distance from the beginning of that name."""
        if array == "iw":
            return COUNTERS[index], 0
        if array == "p":
            return next(((name, 0) for name, at in self.parameters.items() if at == index), None)
        for name, (first, size) in self.sections.items():
            if first <= index < first + size:
                return (STATUS[index - first], 0) if name == "status" else (name, index - first)
        return None

    def module(
        self,
        title: str,
        header: Sequence[str],
        groups: Sequence[Sequence[ModulePiece]],
        origins: Origins,
        offsets: Mapping[str, tuple[int, str]] | None = None,
        **keys: Any,
    ) -> str:
        """Return the source of a module with all functions of a law, or of a model.

        Parameters
        ----------
        title, header, origins, offsets, **keys
            As for `symgen.derive.emit.module.module_source`; places by number need no offset.
        groups : sequence of sequence of Code
            The functions, those of each part of the law together, in the order of their text.
        """
        codes = [self.put_names(code) for code in rename_duplicates(groups, origins)]
        constants = {**(offsets or {}), **self.constants}
        origins = {**origins, **{name_in_model(name): origin for name, origin in origins.items()}}
        return import_siblings_by_name(module_source(title, header, codes, origins, constants, **keys))


def name_in_model(name: str) -> str:
    """Return the name of the model's function in a module that has its own function of that name."""
    return f"{name}_of_model"


def rename_duplicates(groups: Sequence[Sequence[ModulePiece]], origins: Origins) -> list[ModulePiece]:
    """Return functions of several modules as one module: of two with the same name, the earlier is renamed.

    A law has its own `geometry` and `spread` where its metric is not the model's, and its own `rhs` around the one for
    accelerations where dependent coordinates are closed first.

    Parameters
    ----------
    groups : sequence of sequence of Code
        Functions of each module, a module before those that import it.
    origins : mapping of str to (str, str)
        Names that the model defines.
    """
    last = {name: i for i, group in enumerate(groups) for code in group for name in code.names}
    before, codes = set[str](), list[ModulePiece]()
    for i, group in enumerate(groups):
        own = {name for code in group for name in code.names}
        replaced = {name: name_in_model(name) for name in origins.keys() & last.keys() - own - before}
        names = replaced | {name: "accelerate" for name in own if last[name] > i}
        codes += [_rename_function(code, names) for code in group]
        before |= own
    return codes


def _rename_function(code: ModulePiece, names: Mapping[str, str]) -> ModulePiece:
    """Return a function with other names for itself and its callees."""
    text = re.sub(r"\b(\w+)(?=\()", lambda match: names.get(match[0], match[0]), code.text)
    calls = frozenset(names.get(name, name) for name in code.calls)
    return replace(code, name=names.get(code.name, code.name), text=text, calls=calls)


def import_siblings_by_name(source: str) -> str:
    """Return a module that imports its siblings by their names alone, as in the folder of a script."""
    return re.sub(r"^from \.(?=\w)", "from ", source, flags=re.MULTILINE)


def names_from_model(laws: str) -> set[str]:
    """Return the names that the text of laws imports from the model."""
    found = re.findall(r"^from model import (\([^)]*\)|.*)$", laws, re.MULTILINE)
    return {name for names in found for name in re.findall(r"(?:^|[(,]\s*)(\w+)", names.strip())}
