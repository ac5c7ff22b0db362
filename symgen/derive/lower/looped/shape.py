"""A mechanism as instances of kernels: owners of bodies, rows and entries, and patterns of its matrices.

Everything here takes time linear in the size of the mechanism: instances are grouped by kernel, and no operation of a
single instance is ever built.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from symgen.base.ir.program import MODE_NUMBERS
from symgen.base.vocabulary.expressions import Expr
from symgen.base.vocabulary.measures import Measure
from symgen.derive.lower.factor import Elimination
from symgen.derive.lower.looped.instances import Instance
from symgen.derive.lower.looped.kernels import KernelInfo


@dataclass(frozen=True)
class RowBlock:
    """The entries of a row of D that belong to one body: `width` numbers from `offset` on, from velocity `first` on.

    `reach` are the velocities that M couples with those of its entries.
    """

    row: int
    first: int
    width: int
    offset: int
    entries: dict[int, float | None]  # velocities with structurally nonzero entries: the literal, or None
    reach: frozenset[int]


@dataclass(frozen=True)
class ProductTerms:
    """Products that make up D W D^T.

    Parameters
    ----------
    constant : tuple of (target, velocity, product)
        Products of two literals, summed once a run.
    runs : mapping of int to list of int
        By length of the runs of neighbouring entries: slot in D W, slot in D, target. Under 0 the products of two
        entries a, b of D W with two x, z of D: their slots, then the targets of ax, az, bx, bz.
    slots : mapping of int to int
        Slots of D W that are read, and their velocities.
    """

    constant: tuple[tuple[int, int, float], ...]
    runs: dict[int, list[int]]
    slots: dict[int, int]


@dataclass(frozen=True)
class KernelGroup:
    """All instances of one kernel."""

    stem: str
    info: KernelInfo
    members: tuple[int, ...]  # indices of instances


class LoopedShape:
    """A mechanism as instances of kernels: indices of everything.

    Parameters
    ----------
    instances : sequence of Instance
        Bodies, then joints, rows with bounds, rotors, forces and states.
    stems : sequence of str
        Module of each instance's kernel.
    infos : mapping of str to KernelInfo
        By module.
    parameters : int
        Number of the mechanism's parameters, which come first in ``p``.
    """

    def __init__(
        self, instances: Sequence[Instance], stems: Sequence[str], infos: Mapping[str, KernelInfo], parameters: int
    ) -> None:
        self.instances, self.stems, self.infos, self.parameters = instances, stems, infos, parameters
        members: dict[str, list[int]] = {}
        for k, stem in enumerate(stems):
            members.setdefault(stem, []).append(k)
        self.groups = tuple(KernelGroup(stem, infos[stem], tuple(indices)) for stem, indices in members.items())
        self.constant_index: dict[Expr, int] = {}
        self._place_bodies()
        self._place_elements()

    def _place_bodies(self) -> None:
        self.body: dict[str, tuple[int, int, int]] = {}  # name -> first coordinate, velocity, number of its record
        self.width: dict[int, int] = {}
        q = v = record = 0
        self.massless: list[int] = []
        self.spins: list[tuple[int, int]] = []
        for instance, stem in zip(self.instances, self.stems, strict=True):
            if instance.kind == "body":
                info = self.infos[stem]
                ((nq, nv, size),) = info.frames
                self.body[instance.name] = (q, v, record)
                self.width[v] = nv
                self.spins += [(q + i, v + j) for i, j in info.spins]
                self.massless += [v + j for j in info.massless]
                q, v, record = q + nq, v + nv, record + size
        self.nq, self.nv, self.records = q, v, record

    def _place_elements(self) -> None:
        self.row_of: list[int] = []  # instance -> its first row
        self.entry_of: list[int] = []  # instance -> its first entry of D
        self.coordinate_of: list[int] = []
        self.angle_index: dict[Measure, int] = {}  # measures whose turns are counted; equal ones are one angle
        self.computed_of: list[int] = []  # instance -> its first computed number, counted from 0
        self.blocks: list[RowBlock] = []
        self.holonomic: list[bool] = []
        self.angular: list[bool] = []  # rows that are angles or numbers, not lengths
        self.driven = 0
        entry = coordinate = computed = 0
        self.entries: list[tuple[int, int, int]] = []  # row, column, slot of structurally nonzero entries
        self.placed: list[tuple[int, int, int]] = []  # the same, of rows with bounds as they are, in force or off
        self.idle: list[tuple[int, int]] = []  # rows with bounds, and slots whose squares are on the diagonal
        self.rotors: list[int] = []  # their rows R, which are numbered after those of D; R^T R is their part of M
        self.rotor_blocks: list[RowBlock] = []
        rows_of: dict[str, int] = {}  # of joints, the first, and of rows with bounds
        for instance, stem in zip(self.instances, self.stems, strict=True):
            info = self.infos[stem]
            for constant in instance.constants:
                self.constant_index.setdefault(constant, len(self.constant_index))
            self.row_of.append(rows_of[instance.joint] if instance.joint else len(self.holonomic))
            if instance.kind in ("joint", "bound"):
                rows_of[instance.name] = self.row_of[-1]
            self.entry_of.append(entry)
            self.coordinate_of.append(coordinate)
            self.computed_of.append(computed)
            firsts = [self.body[name][1] for name in instance.frames]
            for r, shape in enumerate(info.rows):
                row, blocks = len(self.holonomic) + len(self.rotors), list[RowBlock]()
                for f in info.row_blocks(r):
                    width = info.frames[f][1]
                    literals = zip(shape.entries, shape.constant, strict=True)
                    used = {firsts[f] + j: literal for (g, j), literal in literals if g == f}
                    reach = frozenset(k for j in used for k in self.coupled.get(j, (j,)))
                    blocks.append(RowBlock(row, firsts[f], width, entry, used, reach))
                    entry += width
                if instance.kind == "rotor":
                    self.rotors.append(row)
                    self.rotor_blocks += blocks
                    continue
                self.blocks += blocks
                self.placed += [(row, j, b.offset + j - b.first) for b in blocks for j in b.entries]
                if instance.kind == "bound":
                    columns = [firsts[f] + j for f, j in shape.entries]
                    self.entries += [(row, j, entry + i) for i, j in enumerate(columns)]
                    entry += len(columns)
                    self.idle.append((row, entry))
                    entry += 1
                else:
                    self.entries += self.placed[len(self.placed) - len(shape.entries) :]
                self.holonomic.append(shape.holonomic)
                self.angular.append(shape.angular)
                self.driven += shape.driven
            coordinate += info.coordinates
            for angle in instance.angles:
                self.angle_index.setdefault(angle, len(self.angle_index))
            computed += info.computed
        self.m, self.jacobian, self.coordinates, self.computed = len(self.holonomic), entry, coordinate, computed
        self.windings = len(self.angle_index)
        bounds = [instance.name for instance in self.instances if instance.kind == "bound"]
        self.mode_index = {name: MODE_NUMBERS * i for i, name in enumerate(bounds)}
        drags = [instance for instance in self.instances if instance.kind == "drag"]
        # of rows with bounds that depend on reactions, and whether the sign of what they depend on counts
        self.drag_index = {drag.name: i for i, drag in enumerate(drags)}
        self.signed_drags = [drag.abstract.bounded[0].signed for drag in drags]
        states = [instance.name for instance in self.instances if instance.kind == "state"]
        self.state_index = {name: i for i, name in enumerate(states)}

    # -- p -------------------------------------------------------------------------------------------------------------

    @property
    def first_constant(self) -> int:
        """Index in ``p`` of the first constant."""
        return self.parameters

    @property
    def first_computed(self) -> int:
        """Index in ``p`` of the first number that kernels compute once a run."""
        return self.parameters + len(self.constant_index)

    @property
    def mass_diagonal(self) -> int:
        """Index in ``p`` of the diagonal of M; the diagonal of M^-1 and the mean mass follow."""
        return self.first_computed + self.computed

    @property
    def hoisted(self) -> int:
        """Number of numbers after the parameters in ``p``."""
        return self.gram_base + 2 * self.gram.size - self.parameters

    @property
    def gram_base(self) -> int:
        """Index in ``p`` of the constant part of D D^T; the constant part of D M^-1 D^T follows."""
        return self.mass_diagonal + 2 * self.nv

    @property
    def rotor_diagonal(self) -> list[tuple[int, int]]:
        """Velocities, and the places in ``p`` of what rotors add there to the diagonal of M."""
        diagonal: list[tuple[int, int]] = []
        for k, (instance, stem) in enumerate(zip(self.instances, self.stems, strict=True)):
            if instance.kind == "rotor":
                info = self.infos[stem]
                first = self.first_computed + self.computed_of[k] + info.hoisted
                columns = (self.body[instance.frames[f]][1] + j for f, j in info.rows[0].entries)
                diagonal += [(column, first + i) for i, column in enumerate(columns)]
        return diagonal

    # -- matrices ------------------------------------------------------------------------------------------------------

    @cached_property
    def coupled(self) -> dict[int, frozenset[int]]:
        """Velocities that M couples with a velocity, where there are others."""
        coupled: dict[int, frozenset[int]] = {}
        for instance, stem in zip(self.instances, self.stems, strict=True):
            for block in self.infos[stem].mass:
                if len(block) > 1:
                    first = self.body[instance.name][1]
                    columns = [first + j for j in block]
                    coupled |= dict.fromkeys(columns, frozenset(columns))
        return coupled

    @cached_property
    def turning(self) -> frozenset[int]:
        """Angular velocities; products of their constant entries are weighed by a number that a start computes."""
        of_spins = {first + k for _, first in self.spins for k in range(3)}
        plane = {v + 2 for v, width in self.width.items() if width == 3 and self.nq == self.nv}
        return frozenset(of_spins | plane)

    @cached_property
    def by_body(self) -> dict[int, list[RowBlock]]:
        """Row blocks by the first velocity of their body."""
        blocks: dict[int, list[RowBlock]] = {v: [] for _, v, _ in self.body.values()}
        for block in self.blocks:
            blocks[block.first].append(block)
        return blocks

    @cached_property
    def pairs(self) -> list[tuple[RowBlock, RowBlock]]:
        """Pairs of row blocks of one body that contribute to D M^-1 D^T, each once, rows with themselves too."""
        pairs = []
        for blocks in self.by_body.values():
            for i, a in enumerate(blocks):
                pairs += [(a, b) for b in blocks[: i + 1] if b is a or not a.reach.isdisjoint(b.entries)]
        return pairs

    @cached_property
    def products(self) -> ProductTerms:
        """Products of entries that make up D W D^T."""
        constant: list[tuple[int, int, float]] = []
        runs: dict[int, list[int]] = {}
        slots: dict[int, int] = {}
        for a, b in self.pairs:
            target = self.gram.place_of_entry(a.row, b.row)
            varying = []
            for j, literal in b.entries.items():
                if j in a.reach:
                    other = a.entries.get(j)
                    if literal is None or other is None or j in self.coupled or j in self.turning:
                        varying.append(j)
                    else:
                        constant.append((target, j, literal * other))
            for j in varying:
                slots[a.offset + j - a.first] = j
            start = 0
            for k in range(len(varying)):
                if k + 1 == len(varying) or varying[k + 1] != varying[k] + 1:
                    first = varying[start]
                    at = (a.offset + first - a.first, b.offset + first - b.first, target)
                    runs.setdefault(k + 1 - start, []).extend(at)
                    start = k + 1
        for row, slot in self.idle:
            runs.setdefault(1, []).extend((slot, slot, self.gram.place_of_entry(row, row)))
        single = runs.pop(1, [])
        outer, single = _pair_products([(single[k], single[k + 1], single[k + 2]) for k in range(0, len(single), 3)])
        runs |= {width: terms for width, terms in ((0, outer), (1, single)) if terms}
        return ProductTerms(tuple(constant), {width: runs[width] for width in sorted(runs)}, slots)

    @cached_property
    def gram(self) -> Elimination:
        """Elimination of D W D^T."""
        return _elimination_of_pairs(self.m + len(self.rotors), (*self.pairs, *self.rotor_pairs))

    @cached_property
    def rotor_pairs(self) -> list[tuple[RowBlock, RowBlock]]:
        """Pairs of a rotor's block, and another block of its body, that contribute to R M^-1 D^T or R M^-1 R^T."""
        pairs: list[tuple[RowBlock, RowBlock]] = []
        before: dict[int, list[RowBlock]] = {}
        for a in self.rotor_blocks:
            rotors = before.setdefault(a.first, [])
            rotors.append(a)
            others = (*self.by_body[a.first], *rotors)
            pairs += [(a, b) for b in others if b is a or not a.reach.isdisjoint(b.entries)]
        return pairs

    @cached_property
    def rotor_gram(self) -> Elimination:
        """Elimination of 1 + R M^-1 R^T, M being without rotors, whose rows are numbered from 0."""
        pairs = [(a, b) for a, b in self.rotor_pairs if b.row >= self.m]
        return _elimination_of_pairs(len(self.rotors), pairs, self.m)

    def rotor_products(self, among: bool) -> list[int]:
        """Return slots in R M^-1 and D or R, and each product's target, in the elimination of all or of R alone."""
        products: list[int] = []
        for a, b in self.rotor_pairs:
            if b.row < self.m and among:
                continue
            target = (
                self.rotor_gram.place_of_entry(a.row - self.m, b.row - self.m)
                if among
                else self.gram.place_of_entry(a.row, b.row)
            )
            for j in b.entries:
                if j in a.reach:
                    products += [a.offset + j - a.first, b.offset + j - b.first, target]
        return products

    @cached_property
    def rotor_rows(self) -> list[list[tuple[int, int]]]:
        """Entries (column, slot) of R, row by row."""
        rows: list[list[tuple[int, int]]] = [[] for _ in self.rotors]
        for block in self.rotor_blocks:
            rows[block.row - self.m] += [(j, block.offset + j - block.first) for j in block.entries]
        return rows

    @cached_property
    def rows(self) -> list[list[tuple[int, int]]]:
        """Entries (column, slot) of D, row by row."""
        rows: list[list[tuple[int, int]]] = [[] for _ in range(self.m)]
        for row, column, slot in self.placed:
            rows[row].append((column, slot))
        return rows

    @cached_property
    def augmented(self) -> Elimination:
        """Elimination of M + a D^T D."""
        near: list[set[int]] = [set(self.coupled.get(j, ())) for j in range(self.nv)]
        for row in (*self.rows, *self.rotor_rows):
            columns = [j for j, _ in row]
            for j in columns:
                near[j].update(columns)
        return Elimination.lay_out([frozenset(n - {j}) for j, n in enumerate(near)])

    def sizes(self, augmented: bool) -> dict[str, int]:
        """Return the sizes by which sections are defined."""
        eliminations = [self.gram, self.rotor_gram, *((self.augmented,) if augmented else ())]
        return {
            "one": 1,
            "nv": self.nv,
            "m": self.m,
            "longest": max(self.nv, self.m + len(self.rotors)),
            "jacobian": self.jacobian,
            "records": self.records,
            "gram": self.gram.size,
            "augmented": self.augmented.size if augmented else 0,
            "panel": max(e.largest for e in eliminations),
        }


def _elimination_of_pairs(size: int, pairs: Iterable[tuple[RowBlock, RowBlock]], first: int = 0) -> Elimination:
    """Return the elimination of a matrix in which pairs of rows, numbered from `first` on, have an entry."""
    near: list[set[int]] = [set() for _ in range(size)]
    for a, b in pairs:
        if a.row != b.row:
            near[a.row - first].add(b.row - first)
            near[b.row - first].add(a.row - first)
    return Elimination.lay_out([frozenset(n) for n in near])


def _pair_products(terms: Sequence[tuple[int, int, int]]) -> tuple[list[int], list[int]]:
    """Return products of single entries as products of two with two, where four belong together, and the others.

    The rows of a joint, x and y of a pin for instance, vary in the same column of a body: their entries meet those of
    another joint's rows in four products.
    """
    target = {(a, b): t for a, b, t in terms}
    partners: dict[int, list[int]] = {}
    for a, b, _ in terms:
        partners.setdefault(a, []).append(b)
    outer: list[int] = []
    used: set[tuple[int, int]] = set()
    slots = list(partners)
    for a, b in pairwise(slots):
        common = [x for x in partners[a] if (b, x) in target and (a, x) not in used and (b, x) not in used]
        for x, z in zip(common[::2], common[1::2], strict=False):
            four = ((a, x), (a, z), (b, x), (b, z))
            used |= set(four)
            outer += [a, b, x, z, *(target[pair] for pair in four)]
    return outer, [n for a, b, t in terms if (a, b) not in used for n in (a, b, t)]
