"""The derived equations of one mechanism: the frozen value between `formulate` and `lower`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from symgen.base.ir.graph import Graph
from symgen.base.ir.interpolation import Interpolation
from symgen.base.vocabulary.quantities import Counted, Quantity


@dataclass(frozen=True)
class ConstraintRow:
    """One constraint: ``D v = nu`` and ``D v' = gamma``; `phi` is None for a nonholonomic row.

    `entries` holds (velocity index, node) of the structurally nonzero entries of D, in increasing order of index.
    With bodies on a tree of joints a whole row may vanish, at a dead centre for instance: its square is compared with
    `size`, the square of the row over the velocities of bodies; None for a row that cannot vanish.
    `stiffness` is the node of a stiffness specified in the file [N/m]. `held` is the node of 1 where a row that may be
    off is in force, and of 0 where it is off; None for a row that is always in force. Where states of the file say so,
    `place` is the node of what the row holds beyond its value: ``geometry`` writes both to the modes. `axes` marks the
    two rows of a joint that keep an axis of one body parallel to one of another, over the velocities of bodies.
    The forces of `bounded` rows have bounds.
    """

    name: str
    joint: str
    unit: str
    phi: int | None
    entries: tuple[tuple[int, int], ...]
    nu: int
    gamma: int
    size: int | None = None
    stiffness: int | None = None
    held: int | None = None
    axes: bool = False
    bounded: bool = False
    place: int | None = None


@dataclass(frozen=True)
class MassBlock:
    """A symmetric diagonal block of M over the velocity indices `columns`; `entries` are nodes, row by row."""

    columns: tuple[int, ...]
    entries: tuple[tuple[int, ...], ...]


def mass_blocks(entries: Mapping[tuple[int, int], int], size: int, zero: int) -> tuple[MassBlock, ...]:
    """Return a symmetric matrix as blocks of coupled velocities."""
    label = list(range(size))
    for (i, j), node in entries.items():
        if node != zero and label[i] != label[j]:
            old, new = max(label[i], label[j]), min(label[i], label[j])
            label = [new if x == old else x for x in label]
    blocks = list[MassBlock]()
    for root in sorted(set(label)):
        columns = tuple(i for i in range(size) if label[i] == root)
        blocks.append(MassBlock(columns, tuple(tuple(entries.get((i, j), zero) for j in columns) for i in columns)))
    return tuple(blocks)


@dataclass(frozen=True)
class JointCoordinate:
    """Nodes of the value and rate of a reported joint coordinate."""

    name: str
    unit: str
    value: int
    rate: int


@dataclass(frozen=True)
class Omission:
    """A part left out of the model because the scene does not need it, and the reason."""

    what: str
    why: str


@dataclass(frozen=True)
class DriverPower:
    """Power of the drivers of prescribed coordinates.

    It excludes the power against the efforts of rows, which is part of the power of rows: their nu contains the motion
    of drivers.

    Attributes
    ----------
    entries : tuple of (int, int)
        Velocities of the state, and the factors of their rates.
    rest : int
        The power at v' = 0.
    """

    entries: tuple[tuple[int, int], ...]
    rest: int


@dataclass(frozen=True)
class Drag:
    """An effort that a reaction bounds, in motion: a force ``sign coefficient |N|`` against the rate of a coordinate.

    Attributes
    ----------
    row : int
        The row of the coordinate.
    sign, coefficient, rate : int
        Nodes of the sign, 0 at rest, of the force over |N| [1 or m], and of the part of the rate that the velocities
        of the state make: a driver of a tree pays for the rest.
    pressed : tuple of tuple of (int, int)
        Of each component of N the rows in it, and nodes by which their multipliers count.
    noun : str
        What it is.
    signed : bool
        Whether N has one component, whose sign counts: it is the force of a one-sided row.
    """

    row: int
    sign: int
    coefficient: int
    rate: int
    pressed: tuple[tuple[tuple[int, int], ...], ...]
    noun: str
    signed: bool = False


@dataclass(frozen=True)
class Equations(Counted):
    """Equations of motion ``M v' + D^T lambda = f``, ``D v' = gamma``, ``q' = N v`` as nodes of one graph.

    Parameters
    ----------
    graph : Graph
        Inputs ``t``, ``q``, ``v`` and ``p`` (the parameters in the order of the file).
    coordinates, velocities : tuple of Quantity
        Names and units of q and v.
    q_rates : tuple of int
        Nodes of q' = N v; the planar ones are the velocities themselves.
    mass : tuple of MassBlock
        M, block diagonal and independent of q.
    rows : tuple of ConstraintRow
        Phi, D, nu and gamma, row by row.
    forces : tuple of int
        f, one node for each velocity.
    power : int
        Power of the applied forces that have no potential, f_nc^T v [W].
    kinetic, potential : int
        Energies [J].
    joint_coordinates : tuple of JointCoordinate
        Coordinates that results report in addition to q and v.
    tables : tuple of Interpolation
        Interpolated functions.
    omissions : tuple of Omission
        Parts left out and the reasons.
    dropped_rows : tuple of str
        Rows equal to another row for all q, named ``ROW = ROW``.
    windings : tuple of int
        Angles with counted turns: each on the branch nearest to its value in the section ``winding``.
    spins : tuple of (int, int)
        For each body with Euler parameters, their first index in q and that of its angular velocity in v.
    inputs : tuple of str
        Parameters that may change during a run.
    bodies : tuple of int
        With bodies on a tree of joints: coordinates, velocities and accelerations of the bodies.
    driving : DriverPower, optional
        Power of the drivers of prescribed coordinates of a tree; no part of `power`.
    metric : tuple of MassBlock
        With bodies on a tree of joints: the identity in the velocities of the bodies, pulled back.
    states : tuple of Quantity
        States that the file defines.
    state_rates : tuple of int
        Nodes of their rates; as inputs of the graph the states are ``z``, numbered from 1.
    drags : tuple of Drag
        Efforts by reactions, in motion; no part of `forces` and `power`.
    renewed : tuple of (int, int)
        Places in the section ``modes`` of numbers that each step renews, and their nodes.
    """

    name: str
    graph: Graph
    parameters: tuple[Quantity, ...]
    coordinates: tuple[Quantity, ...]
    velocities: tuple[Quantity, ...]
    q_rates: tuple[int, ...]
    mass: tuple[MassBlock, ...]
    rows: tuple[ConstraintRow, ...]
    forces: tuple[int, ...]
    power: int
    kinetic: int
    potential: int
    joint_coordinates: tuple[JointCoordinate, ...]
    tables: tuple[Interpolation, ...]
    omissions: tuple[Omission, ...]
    dropped_rows: tuple[str, ...]
    windings: tuple[int, ...] = ()
    spins: tuple[tuple[int, int], ...] = ()
    inputs: tuple[str, ...] = ()
    bodies: tuple[int, ...] = ()
    driving: DriverPower | None = None
    metric: tuple[MassBlock, ...] = ()
    states: tuple[Quantity, ...] = ()
    state_rates: tuple[int, ...] = ()
    drags: tuple[Drag, ...] = ()
    renewed: tuple[tuple[int, int], ...] = ()

    @property
    def reads_results(self) -> bool:
        """Whether the rates of states have v' or multipliers among their inputs."""
        return not {space for space, _ in self.graph.inputs_of(self.state_rates)}.isdisjoint(("ydot", "multipliers"))

    def nodes(self, rows: Iterable[ConstraintRow] | None = None) -> dict[str, list[int]]:
        """Return the nodes of each quantity by its name, for `rows` or else for all rows."""
        rows = self.rows if rows is None else tuple(rows)
        return {
            "phi": [row.phi for row in rows if row.phi is not None],
            "jacobian": [node for row in rows for _, node in row.entries],
            "nu": [row.nu for row in rows],
            "gamma": [row.gamma for row in rows],
            "mass": [node for block in self.mass for line in block.entries for node in line],
            "forces": list(self.forces),
        }


def without_bounded_rows(equations: Equations) -> Equations:
    """Return equations in which no row with bounds is in force; it keeps its number, and its entries are left out."""
    rows = (replace(row, entries=(), held=equations.graph.zero) if row.bounded else row for row in equations.rows)
    return replace(equations, rows=tuple(rows))
