"""The program: everything that the emitter needs, independent of printing.

A block is a named piece of computation with declared outputs. Symbolic targets name the place of its elements (``y``,
``ydot``, ``p`` or a section of the scratch array ``w``); the emitter's layout turns them into element access.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Generic, TypeVar

from symgen.base.ir.graph import Graph
from symgen.base.ir.interpolation import Interpolation
from symgen.base.vocabulary.expressions import SMOOTH
from symgen.base.vocabulary.infos import LawInfo

Info = TypeVar("Info")

#: The right-hand side that `confirm` evaluates where loops in closed form are suspicious.
BY_PIVOTS = "rhs_by_pivots"
#: The right-hand sides of motions with rows with bounds in force and without: ``rhs`` enters one of them.
HELD_RHS, FREE_RHS = "rhs_held", "rhs_free"

#: End of the names of functions for derivatives, which are those of the residual; the right-hand side among them.
SLOPES = "_by_residual"
BY_RESIDUAL = f"rhs{SLOPES}"

#: Format of the emitted modules: changes when their functions, signatures or sections do.
FORMAT = 3

#: Targets of emitted code, and the ends of their modules' names.
SUFFIXES = {"cpu": "", "lanes": "_lanes", "cuda": "_cuda"}
TARGETS = tuple(SUFFIXES)
#: Simultaneous runs of code for ``lanes``: a vector of the widest registers, or two of the next.
LANES = 8
#: Counters of code for ``lanes`` after ``w``, in this order: evaluations with suspicious pivots, corrections that
#: failed, their iterations; and auxiliary numbers for these.
LANE_COUNTERS = ("suspects", "failures", "iterations", "last", "open")


def lane_bases(ny: int, n_p: int, nw: int) -> dict[str, int]:
    """Return the beginnings of the arrays of a run in the one array of lanes, in elements of a lane.

    Parameters
    ----------
    ny, n_p, nw : int
        Lengths of y, p and w.

    Returns
    -------
    dict
        By the names of the arrays; ``spare`` for `LANE_COUNTERS`, ``numbers`` for the length of all.
    """
    room = -(-ny // 4) * 4  # so that loops over all elements of a state leave no remainder after unrolled vectors
    spare = 2 * room + n_p + nw
    places = {"y": 0, "ydot": room, "p": 2 * room, "w": 2 * room + n_p}
    return {**places, "spare": spare, "numbers": spare + len(LANE_COUNTERS)}


#: Scalars that `accept` leaves at the beginning of ``w`` for the runtime, in this order.
STATUS = (
    "position_violation",  # |Phi|
    "velocity_violation",  # |D v - nu|
    "kinetic",  # T
    "potential",  # V
    "smallest_pivot",  # of D D^T with scaled rows, over the rows that are not permanently redundant
    "rank",  # rows kept by the factorisation of D D^T
    "length_scale",  # set by the runtime: the mechanism's length [m]
    "speed_scale",  # set by the runtime: largest speed so far [m/s]
    "position_measure",  # |Phi| with rows that are angles or numbers times the scale of lengths [m]
    "velocity_measure",  # the same for |D v - nu| [m/s]
    "shortest_row",  # of the rows that are angles: least square of a gradient, over that at the start
    "mean_mass",  # set by the runtime: mean of M's diagonal, that of rotations being I / l^2 [kg]
    "step",  # set by the loop: the step being taken
    "increment",  # |change| of the last iteration of an iterated law
    "partition_quality",  # det(D P D^T) / det(D D^T), P keeping the dependent columns
    "partition_best",  # largest one since the partition was chosen; 0 where all coordinates are dependent
    "partition_last",  # the quality at the accepted state before
    "partition_sine",  # root of the smallest pivot at the accepted state before
    "power",  # of forces without potential and of drivers, by `residual`
)

#: Sections of ``w`` that functions of every model and law share, and their lengths.
SECTIONS = (
    *((name, "m") for name in ("multipliers", "mask", "saved", "residual", "nu", "pivot")),
    *((name, "nv") for name in ("change", "mass", "gauge")),
    *(("row_weight", "m"), ("jacobian", "jacobian")),
)

#: Numbers in the section ``modes`` of each row that may be off: 1 where it is in force and 0 where it is off; the value
#: that its measure is held at, beyond the described one; the sign of its rate or effort where it is off; its largest
#: effort where it is in force; the effort of a row with bounds that rests though it is off.
MODES = ("held", "constant", "sign", "limit", "effort")
MODE_NUMBERS = len(MODES)
#: Where bounds depend on a reaction, the square of its jamming number is in the section ``jamming``.
JAMMING = "jamming"
#: Where the forces of gaps press rows, what rows in force carry for these is in the section ``carrying``. It has three
#: parts, each of a spare number and one for each row with bounds: the sum of the bounds at rest that the row carries,
#: what it exerts over its own bound with this sum, and that number of the row which carries it.
CARRYING = "carrying"


def size_of_carrying(rows: int, pressed: bool) -> int:
    """Return the length of the section ``carrying`` of a model with some rows with bounds; 0 unless gaps press some."""
    return 3 * (rows + 1) if pressed else 0


#: Sections of ``w`` that a start settles; all others are written before they are read.
SETTLED = ("status", "winding", "modes", "mask", "saved", "pivot", "gauge", "row_weight", "mass", "mass_entry")

#: Numbers of the status that a start computes, and that are 1 before.
SCALES = ("length_scale", "speed_scale", "mean_mass")

#: Integers in ``iw``, in this order.
COUNTERS = (
    "confirmed",  # 1 while an evaluation runs with rows decided by D D^T
    "suspects",  # evaluations in which a pivot of S was suspiciously small
    "light",  # of these, those where D D^T found full rank: light bodies, not redundant rows
    "iterations",  # iterations of corrections
    "failures",  # corrections that did not converge
    "probing",  # 1 while a state between steps is measured: nothing is kept
    "law_iterations",  # iterations of an iterated law
    "partitions",  # choices of a partition
    "degrees",  # columns of a tangent basis
    "dense_solves",  # evaluations by a dense factorisation
    "dense_rank",  # their smallest rank
    "balanced",  # 1 once the target energy of velocity scaling is set
)


@dataclass(frozen=True)
class OutputSlot:
    """Place of an output: element `index` of array or scratch section `space`."""

    space: str
    index: int


#: A table's function and its derivatives: gamma of a row has the second one, and derivatives of gamma the third one.
DERIVATIVES = ("value", "slope", "second", "third")


def table_of_payload(payload: object) -> tuple[str, str]:
    """Return the name in the payload of a table's operation, and its item of `DERIVATIVES`."""
    name = str(payload).rstrip("'")
    return name.removeprefix(SMOOTH), DERIVATIVES[len(str(payload)) - len(name)]


def derived_table(payload: object) -> str | None:
    """Return the payload of the derivative of a table's operation, None where it is zero.

    The slope of straight lines is constant between points, and so is the third derivative of cubic pieces.
    """
    last = DERIVATIVES[-1] if str(payload).startswith(SMOOTH) else "slope"
    return None if table_of_payload(payload)[1] == last else f"{payload}'"


@dataclass(frozen=True)
class Block:
    """Straight-line computation.

    Parameters
    ----------
    name : str
        Name of the emitted function.
    purpose : str
        Purpose of the function, in one line.
    graph : Graph
        Holds the nodes.
    outputs : tuple of (Target, int)
        Outputs, in order.
    flag : int or None
        Node whose truth the function returns; None: it returns 0.
    arguments : tuple of str
        Arrays passed to the function.
    role : {"", "preparation", "acceleration", "iteration", "metric", "form", "derivation"}
        The part of a law that the function belongs to; none for functions of the model.
    """

    name: str
    purpose: str
    graph: Graph
    outputs: tuple[tuple[OutputSlot, int], ...]
    arguments: tuple[str, ...]
    flag: int | None = None
    role: str = ""

    @property
    def nodes(self) -> tuple[int, ...]:
        """All end nodes of the block."""
        return tuple(n for _, n in self.outputs) + (() if self.flag is None else (self.flag,))

    @cached_property
    def needed(self) -> list[int]:
        """All nodes that these depend on, in evaluation order."""
        return self.graph.required_nodes(self.nodes)

    @property
    def tables(self) -> tuple[tuple[str, str], ...]:
        """Tables that are read, by name, with their items of `DERIVATIVES`."""
        operations = (self.graph.nodes[n] for n in self.needed)
        return tuple(dict.fromkeys(table_of_payload(o.payload) for o in operations if o.op == "table"))

    @cached_property
    def operations(self) -> int:
        """Operations with common subexpressions computed once."""
        return self.graph.count_operations(self.nodes)

    @property
    def tree_operations(self) -> int:
        """Operations without sharing."""
        return self.graph.count_tree_operations(self.nodes)


@dataclass(frozen=True)
class ModelLayout:
    """Sizes of the model and the sections of the scratch array ``w`` and of ``p``."""

    nq: int
    nv: int
    m: int
    parameters: int
    sections: Mapping[str, tuple[int, int]]  # name -> (offset in w, size)
    states: int = 0
    switchable: int = 0  # rows that may be off
    bounded: int = 0  # of these, the last ones, whose forces have bounds

    @property
    def ny(self) -> int:
        """Length of the state: q, v, the work of forces without potential and of drivers, and states of a file."""
        return self.nq + self.nv + 1 + self.states

    @property
    def nw(self) -> int:
        """Length of ``w``."""
        return max((offset + size for offset, size in self.sections.values()), default=0)

    def offset(self, section: str) -> int:
        """Return the beginning of a section of ``w``."""
        return self.sections[section][0]


@dataclass(frozen=True)
class JacobianEntry:
    """A stored entry of D: a constant of the scene, or element `slot` of the section ``jacobian``."""

    row: int
    column: int
    constant: float | None
    slot: int | None


@dataclass(frozen=True)
class FixedVelocities:
    """Velocities that rows of D fix by the others: they are eliminated together, without a decision on rank."""

    columns: tuple[int, ...]
    rows: tuple[int, ...]


@dataclass(frozen=True)
class EliminationPlan:
    """How M v' + D^T lambda = f, D v' = gamma is solved.

    Parameters
    ----------
    fixed : tuple of FixedVelocities
        Velocities eliminated with their rows, before all others, in order.
    loops : tuple of FixedVelocities
        Two velocities and the two rows of a joint that leave no others free, eliminated next, in order. Their
        determinant vanishes in some positions, so that only functions with a flag take them.
    schur : bool
        Whether S = D M^-1 D^T is formed from all rows, which takes no velocities with their rows.
    normal : bool
        Whether entries are brought to normal form before a division.
    """

    fixed: tuple[FixedVelocities, ...] = ()
    schur: bool = True
    normal: bool = False
    loops: tuple[FixedVelocities, ...] = ()

    @cached_property
    def rows(self) -> frozenset[int]:
        """Rows that fix velocities."""
        return frozenset(r for each in self.fixed for r in each.rows)


@dataclass(frozen=True)
class ModelProgram:
    """Program that every method of a model shares: module ``model`` of the emitted folder."""

    name: str
    digest: str
    layout: ModelLayout
    blocks: tuple[Block, ...]
    jacobian: tuple[JacobianEntry, ...]
    hoisted: int  # numbers after the parameters in p
    order: tuple[int, ...]  # elimination order of the rows
    fill: int  # entries of L that are zero in D D^T
    tables: tuple[Interpolation, ...] = ()
    plan: EliminationPlan = field(default_factory=EliminationPlan)


@dataclass(frozen=True)
class ElementProgram(Generic[Info]):
    """Shared program of elements of one kind in looped code: the module `stem`, and its facts for the tables."""

    stem: str
    label: str
    info: Info
    blocks: tuple[Block, ...]
    tables: tuple[Interpolation, ...]


@dataclass(frozen=True)
class Correction:
    """Correction of the state after each accepted step.

    Parameters
    ----------
    position : {"none", "once", "newton"}
        Whether positions are corrected, by one step or until the constraints hold.
    velocity : bool
        Whether velocities are corrected.
    metric : {"identity", "scaled", "mass", "independent", "augmented"}
        Norm in which the correction is smallest; ``scaled`` is that in which rank is decided, where 1 rad weighs as
        much as the body's length; ``independent`` keeps the independent coordinates, ``augmented`` is the metric of M
        reached by iterations with M + a D^T D.
    share : str
        Parameter of the method that multiplies the correction; none by default.
    energy : bool
        Whether the velocities that the constraints leave free are then scaled to the balance of energy. The energy of
        such a run is no measure of its error.
    stages : bool
        Whether states are closed in the same way before every evaluation.
    """

    position: str = "none"
    velocity: bool = False
    metric: str = "identity"
    share: str = ""
    energy: bool = False
    stages: bool = False

    @property
    def rounds(self) -> int:
        """Largest number of position corrections in a step."""
        return {"none": 0, "once": 1, "newton": 14}[self.position]

    @property
    def any(self) -> bool:
        """Whether anything is corrected."""
        return self.position != "none" or self.velocity


@dataclass(frozen=True)
class LawCode:
    """Facts of a method besides its functions.

    Parameters
    ----------
    info : LawInfo
        Metadata of the source.
    form : {"direct", "iterated", "dense", "tangent"}
        Computation of v'.
    closed : bool
        Whether dependent coordinates are closed before every evaluation.
    correction : Correction
        Correction of accepted states.
    """

    info: LawInfo
    form: str
    closed: bool
    correction: Correction


@dataclass(frozen=True)
class LawProgram(LawCode):
    """Program that one method adds in straight code: modules of the emitted folder next to ``model``."""

    layout: ModelLayout
    blocks: tuple[Block, ...]
    degrees: int = 0  # room for columns of a tangent basis
