"""From an element's equations to its kernel: functions over all instances, and their facts for the tables."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import msgspec

from symgen.base.ir.graph import Graph
from symgen.base.ir.numerics import TINY
from symgen.base.ir.program import Block, ElementProgram, OutputSlot
from symgen.derive.lower.hoist import Hoister
from symgen.derive.lower.model import diagonal_at_origin
from symgen.derive.lower.position_changes import position_change_blocks
from symgen.derive.lower.scalar import ScalarNodes

if TYPE_CHECKING:
    from symgen.derive.formulate.elements import Element
    from symgen.derive.lower.looped.instances import Instance

Outputs = list[tuple[OutputSlot, int]]


class RowShape(msgspec.Struct, frozen=True):
    """A row of a joint: (frame, velocity of the frame) of D's nonzero entries, and whether it has Phi and nu.

    `angular` means that it is an angle or a number, not a length.

    `constant` holds for each entry its literal value, or None.
    """

    entries: tuple[tuple[int, int], ...]
    constant: tuple[float | None, ...]
    holonomic: bool
    driven: bool
    angular: bool


class KernelInfo(msgspec.Struct, frozen=True, omit_defaults=True):
    """Facts about a kernel for the tables.

    Parameters
    ----------
    kind : str
        ``body``, ``joint``, ``bound``, ``drag``, ``rotor``, ``force`` or ``state``.
    frames : tuple of (nq, nv, record)
        Coordinates, velocities and length of the record of each frame.
    constants, hoisted : int
        Number of constants of an instance, and of numbers computed from them once a run.
    rows : tuple of RowShape
        Of a joint, or of a row with bounds; of a rotor R, whose R^T R is its part of M.
    coordinates, windings : int
        Reported coordinates of a joint, and angles whose turns are counted.
    spins : tuple of (int, int)
        Of a body with Euler parameters: first of them in its coordinates, first angular velocity in its speeds.
    mass : tuple of tuple of int
        Of a body: the velocities of each block of M.
    massless : tuple of int
        Velocities whose mass is the literal 0.
    functions : dict
        Operations of each function that is not empty.
    states : int
        States of the file that an instance reads; a state is its own first.
    """

    kind: str
    frames: tuple[tuple[int, int, int], ...]
    constants: int
    hoisted: int
    rows: tuple[RowShape, ...]
    coordinates: int
    windings: int
    spins: tuple[tuple[int, int], ...]
    mass: tuple[tuple[int, ...], ...]
    massless: tuple[int, ...]
    functions: dict[str, int]
    states: int = 0

    @property
    def computed(self) -> int:
        """Size of an instance's numbers computed once a run: hoisted ones, then M and M^-1 of its larger blocks.

        Of a rotor the second ones are its part of the diagonal of M.
        """
        diagonal = len(self.rows[0].entries) if self.kind == "rotor" else 0
        return self.hoisted + diagonal + sum(2 * len(b) ** 2 for b in self.mass if len(b) > 1)

    def row_blocks(self, row: int) -> tuple[int, ...]:
        """Return the frames in which a row has entries, in their order."""
        return tuple(sorted({f for f, _ in self.rows[row].entries}))


#: A kernel.
KernelProgram = ElementProgram[KernelInfo]


def kernel_stem(instance: Instance) -> str:
    """Return the name of the module of an instance's kernel."""
    label = "".join(c if c.isalnum() else "_" for c in instance.label)
    return f"{instance.kind}_{label}_{hashlib.sha256(instance.key).hexdigest()[:16]}"[-60:]


def lower_kernel(element: Element, instance: Instance) -> KernelProgram:
    """Lower the kernel of an element.

    Parameters
    ----------
    element : Element
        The derived element.
    instance : Instance
        Any instance of it.
    """
    return _Kernel(element, instance).kernel_program()


#: Purpose of each function, for its docstring.
_PURPOSES = {
    "frame": "records of bodies: coordinates, velocities, entries of the rotation matrix",
    "speeds": "velocities in the records",
    "rates": {"body": "q' = N v", "state": "rates of states"},
    "move": "q += N change",
    "geometry": {"joint": "Phi, nu and D", "bound": "Phi, nu and D", "rotor": "R"},
    "motion": {
        "body": "weights and inertia forces",
        "joint": "nu, D and gamma",
        "bound": "nu, D, gamma, force and power",
        "rotor": "R and inertia forces",
        "force": "applied forces and power",
    },
    "full": "Phi, nu, D and gamma",
    "press": "bounds over a reaction, with signs, and its components",
    "energy": "energies",
    "wind": "angles whose turns are counted",
    "report": "joint coordinates and their rates",
}


class _Kernel:
    def __init__(self, element: Element, instance: Instance) -> None:
        self.element, self.instance, self.e = element, instance, element.equations
        self.graph = Graph()
        self.constants = len(instance.constants)
        self.hoister = Hoister(self.graph, self.constants)

    def copy_nodes(self, nodes: Sequence[int]) -> list[int]:
        return self.element.copy_over_records(nodes, self.graph)

    def kernel_program(self) -> KernelProgram:
        outputs: dict[str, Outputs] = getattr(self, self.instance.kind)()
        blocks = []
        for name, written in outputs.items():
            purpose: Any = _PURPOSES[name]
            purpose = purpose if isinstance(purpose, str) else purpose[self.instance.kind]
            if written:
                blocks.append(self.hoister.block_with_hoisted(name, purpose, written, ()))
        if self.instance.kind == "body":
            blocks += position_change_blocks(self.hoister, self.e)
        prepare = self.prepare_block()
        hoisted = len(self.hoister.slots)
        assert len(self.e.windings) == len(self.instance.angles), "angles are counted in the order of derivation"
        if prepare.outputs:
            blocks.append(prepare)
        e, info = self.e, self.element.frames
        kernel = KernelInfo(
            kind=self.instance.kind,
            frames=tuple((len(f.q), len(f.v), f.size) for f in info),
            constants=self.constants,
            hoisted=hoisted,
            rows=self.rows(),
            coordinates=len(e.joint_coordinates),
            windings=len(e.windings),
            spins=e.spins if self.instance.kind == "body" else (),
            mass=tuple(b.columns for b in e.mass) if self.instance.kind == "body" else (),
            massless=tuple(j for b in e.mass for k, j in enumerate(b.columns) if e.graph.value(b.entries[k][k]) == 0.0),
            functions={b.name: b.operations for b in blocks},
            states=len(self.instance.states),
        )
        return KernelProgram(kernel_stem(self.instance), self.instance.label, kernel, tuple(blocks), e.tables)

    def prepare_block(self) -> Block:
        """Return the block of numbers computed once a run: hoisted ones, and masses of a body or of a rotor."""
        block = self.hoister.prepare_block()
        if self.instance.kind not in ("body", "rotor"):
            return block
        outputs: Outputs = []
        system = ScalarNodes(self.e)
        inputs = {("p", i): block.graph.input("p", i) for i in range(self.constants)}

        def move_node(node: int) -> int:
            return block.graph.copy_from(system.graph, [node], inputs)[0]

        first = self.constants + len(self.hoister.slots)
        if self.instance.kind == "rotor":
            diagonal = {target.index: node for target, node in diagonal_at_origin(system)}
            entries = self.e.rows[0].entries
            outputs += [(OutputSlot("p", first + i), move_node(diagonal[j])) for i, (j, _) in enumerate(entries)]
            return Block("prepare", block.purpose, block.graph, (*block.outputs, *outputs), ())
        for b in self.e.mass:
            n = len(b.columns)
            for k, j in enumerate(b.columns):
                outputs.append((OutputSlot("mass_diagonal", j), move_node(b.entries[k][k])))
                # a massless body has no inverse: methods that use it are refused
                massless = system.graph.value(b.entries[k][k]) == 0.0
                inverse = system.graph.zero if massless else system.inverse_mass[j].get(j, system.graph.zero)
                outputs.append((OutputSlot("inverse_mass", j), move_node(inverse)))
                if n > 1:
                    for i, column in enumerate(b.columns):
                        entry = system.inverse_mass[j].get(column, system.graph.zero)
                        outputs.append((OutputSlot("p", first + n * k + i), move_node(b.entries[k][i])))
                        outputs.append((OutputSlot("p", first + n * n + n * k + i), move_node(entry)))
            first += 2 * n * n if n > 1 else 0
        return Block("prepare", block.purpose, block.graph, (*block.outputs, *outputs), ())

    # -- outputs by kind -----------------------------------------------------------------------------------------------

    def body(self) -> dict[str, Outputs]:
        """Return the outputs of a body's functions."""
        e, g, frame = self.e, self.graph, self.element.frames[0]
        nq, nv = len(frame.q), len(frame.v)
        plain = {("q", i): g.input("q", i) for i in range(nq)} | {("v", i): g.input("v", i) for i in range(nv)}
        slots = g.copy_from(e.graph, frame.slots, plain)
        speeds: Outputs = [(OutputSlot("record", nq + i), g.input("v", i)) for i in range(nv)]
        record: Outputs = [(OutputSlot("record", i), g.input("q", i)) for i in range(nq)] + speeds
        record += [(OutputSlot("record", nq + nv + i), n) for i, n in enumerate(slots)]
        steps = [g.add(g.input("q", i), g.input("change", i)) for i in range(nv)] if not e.spins else []
        kinetic, potential, *forces = self.copy_nodes([e.kinetic, e.potential, *e.forces])
        return {
            "frame": record,
            "speeds": speeds,
            "rates": [(OutputSlot("ydot", i), n) for i, n in enumerate(self.copy_nodes(e.q_rates))],
            "move": [(OutputSlot("y", i), n) for i, n in enumerate(steps)],
            "motion": [(OutputSlot("force=", i), n) for i, n in enumerate(forces)],
            "energy": [(OutputSlot("kinetic", 0), kinetic), (OutputSlot("potential", 0), potential)],
        }

    def joint(self) -> dict[str, Outputs]:
        """Return the outputs of a joint's functions."""
        e, g = self.e, self.graph
        rows = e.rows
        phi = self.copy_nodes([r.phi for r in rows if r.phi is not None])
        holonomic = [i for i, r in enumerate(rows) if r.phi is not None]
        nu, gamma = self.copy_nodes([r.nu for r in rows]), self.copy_nodes([r.gamma for r in rows])
        position: Outputs = [(OutputSlot("residual", i), n) for i, n in zip(holonomic, phi, strict=True)]
        other: Outputs = [(OutputSlot("phi", i), n) for i, n in zip(holonomic, phi, strict=True)]
        common: Outputs = [(OutputSlot("nu", i), n) for i, n in enumerate(nu) if n != g.zero]
        for slot, node in zip(
            self.slots_of_rows(), self.copy_nodes([n for r in rows for _, n in r.entries]), strict=True
        ):
            common.append((OutputSlot("jacobian", slot), node))
        quadratic: Outputs = [(OutputSlot("gamma", i), n) for i, n in enumerate(gamma) if n != g.zero]
        report: Outputs = []
        for i, c in enumerate(e.joint_coordinates):
            value, rate = self.copy_nodes([c.value, c.rate])
            report += [(OutputSlot("report", 2 * i), value), (OutputSlot("report", 2 * i + 1), rate)]
        return {
            "geometry": position + common,
            "motion": common + quadratic,
            "full": other + common + quadratic,
            "report": report,
            "wind": self.counted_angles(),
        }

    def bound(self) -> dict[str, Outputs]:
        """Return the outputs of the functions of a row with bounds.

        Where it is off the row of D is zero, so that it takes no part in anything. The entries that it has in force
        follow its blocks, for transitions and starts, which know which rows are off. The square of the
        last slot is added to the diagonal of D W D^T, whatever W is, and keeps the pivot of a row that is off above 0.
        """
        e, g = self.e, self.graph
        (row,) = e.rows
        assert row.held is not None, "a row with bounds has a mode"
        phi = [] if row.phi is None else self.copy_nodes([row.phi])  # none of a velocity
        held, nu, gamma, *entries = self.copy_nodes([row.held, row.nu, row.gamma, *(n for _, n in row.entries)])
        slots, first = self.slots_of_rows(), self.row_width
        common: Outputs = [] if nu == g.zero else [(OutputSlot("nu", 0), g.mul(held, nu))]
        common += [(OutputSlot("jacobian", slot), g.mul(held, n)) for slot, n in zip(slots, entries, strict=True)]
        common += [(OutputSlot("jacobian", first + i), n) for i, n in enumerate(entries)]
        # a pin in the middle of its hole has no direction, and no entries
        size = g.call("sqrt", g.call("max", g.sum_of(g.mul(n, n) for n in entries), g.constant(TINY)))
        idle = g.mul(g.sub(g.one, held), size)
        common += [(OutputSlot(section, first + len(entries)), idle) for section in ("jacobian", "left")]
        quadratic: Outputs = [] if gamma == g.zero else [(OutputSlot("gamma", 0), g.mul(held, gamma))]
        force = quadratic + self.force()["motion"]
        return {
            "geometry": [*((OutputSlot("residual", 0), n) for n in phi), *common],
            "motion": common + force,
            "full": [*((OutputSlot("phi", 0), n) for n in phi), *common, *force],
            "wind": self.counted_angles(),
        }

    @property
    def row_width(self) -> int:
        """Length of the blocks of the first row."""
        return sum(len(self.element.frames[f].v) for f in {f for f, _ in self.rows()[0].entries})

    def force(self) -> dict[str, Outputs]:
        """Return the outputs of a force's functions."""
        e, g = self.e, self.graph
        power, potential, *forces = self.copy_nodes([e.power, e.potential, *e.forces])
        motion: Outputs = [(OutputSlot("force+", i), n) for i, n in enumerate(forces) if n != g.zero]
        if power != g.zero:
            motion.append((OutputSlot("power", 0), power))
        energy: Outputs = [(OutputSlot("potential", 0), potential)] if potential != g.zero else []
        return {"motion": motion, "energy": energy, "wind": self.counted_angles()}

    def drag(self) -> dict[str, Outputs]:
        """Return the outputs of a drag's function: its bound over the reaction, with its sign, and the reaction."""
        e, g = self.e, self.e.graph
        (drag,) = e.drags
        parts = (g.sum_of(g.mul(n, g.input("multipliers", row)) for row, n in line) for line in drag.pressed)
        nodes = self.copy_nodes([g.mul(drag.sign, drag.coefficient), *parts])
        return {"press": [(OutputSlot("drag", i), n) for i, n in enumerate(nodes)]}

    def rotor(self) -> dict[str, Outputs]:
        """Return the outputs of a rotor's functions: R, which is written where D is, -J r b, and its energy."""
        e, g = self.e, self.graph
        kinetic, *forces = self.copy_nodes([e.kinetic, *e.forces])
        entries = self.copy_nodes([n for _, n in e.rows[0].entries])
        row: Outputs = [
            (OutputSlot("jacobian", slot), n) for slot, n in zip(self.slots_of_rows(), entries, strict=True)
        ]
        force: Outputs = [(OutputSlot("force+", i), n) for i, n in enumerate(forces) if n != g.zero]
        return {"geometry": row, "motion": row + force, "energy": [(OutputSlot("kinetic", 0), kinetic)]}

    def state(self) -> dict[str, Outputs]:
        """Return the outputs of a state's functions; joints count the turns of angles that it reads."""
        return {"rates": [(OutputSlot("own", 0), self.copy_nodes(self.e.state_rates[:1])[0])]}

    def counted_angles(self) -> Outputs:
        """Return the angles whose turns are counted."""
        return [(OutputSlot("winding", i), n) for i, n in enumerate(self.copy_nodes(self.e.windings))]

    # -- shapes --------------------------------------------------------------------------------------------------------

    def owner_of_velocity(self, velocity: int) -> tuple[int, int]:
        """Return frame and place in the frame of a velocity."""
        for f, frame in enumerate(self.element.frames):
            if velocity in frame.v:
                return f, velocity - frame.v[0]
        raise AssertionError("every velocity belongs to a frame")

    def rows(self) -> tuple[RowShape, ...]:
        """Return the shapes of a joint's rows; a drag has none of its own."""
        g, varies = self.e.graph, self.instance.kind == "bound"
        if self.instance.kind == "drag":
            return ()
        return tuple(
            RowShape(
                tuple(self.owner_of_velocity(j) for j, _ in row.entries),
                tuple(None if varies else g.value(n) for _, n in row.entries),
                row.phi is not None,
                row.nu != g.zero,
                row.unit == "rad",
            )
            for row in self.e.rows
        )

    def slots_of_rows(self) -> list[int]:
        """Return the offset of each entry of D from the joint's first: rows by blocks, blocks as wide as the frame."""
        slots, first = [], 0
        for shape in self.rows():
            base = {}
            for f in sorted({f for f, _ in shape.entries}):
                base[f] = first
                first += len(self.element.frames[f].v)
            slots += [base[f] + place for f, place in shape.entries]
        return slots
