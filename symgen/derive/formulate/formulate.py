"""From a mechanism to its equations: the only stage that uses SymPy.

Equations are derived joint by joint and force by force; no expression of the whole system is expanded, simplified or
inverted.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from symgen.base.errors import refuse_overflow
from symgen.base.ir.interpolation import Interpolation
from symgen.base.ir.program import MODE_NUMBERS, MODES, table_of_payload
from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import Dot, Holonomic, Row, StiffHolonomic, Sum
from symgen.base.vocabulary.quantities import Quantity
from symgen.derive.formulate.equations import (
    ConstraintRow,
    Drag,
    Equations,
    JointCoordinate,
    MassBlock,
    Omission,
)
from symgen.derive.formulate.exertion import exertion_of_effort
from symgen.derive.formulate.flexure import exertions_of_force
from symgen.derive.formulate.joint_tree import energies_on_tree
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.formulate.modal_inertia import add_modal_inertia
from symgen.derive.formulate.of_time import time_function
from symgen.derive.formulate.rotors import with_rotors
from symgen.describe.bounded import BoundedRow
from symgen.describe.bounds.bounded_modes import name_of_number, places_of_first_modes
from symgen.describe.bounds.by_reaction import pressed_rows, refuse_shared_reactions
from symgen.describe.facts.repeats import without_repeats
from symgen.describe.formulas.results_read import reads_results
from symgen.describe.mechanism import Holding, Mechanism, SpatialBody
from symgen.describe.parts.held_places import name_of_place
from symgen.describe.parts.holding_joints import CHANGED
from symgen.describe.parts.topology import UNITS, state_quantities


def formulate(mechanism: Mechanism) -> Equations:
    """Derive the equations of motion of `mechanism`.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.

    Returns
    -------
    Equations
        Phi, D, nu, gamma, M, f, energies and power as nodes of one graph.

    Raises
    ------
    InputError
        If products or sums of a mechanism's numbers overflow; it names the body, joint or force.
    """
    mechanism, repeats = without_repeats(mechanism)
    with refuse_overflow("mechanism"):
        model = ModelNodes(mechanism)
    modes, holding = dict(places_of_first_modes(mechanism)), {x.joint: x for x in mechanism.holding}
    rows = tuple(
        row
        if joint.name not in modes
        else _row_of_holding(model, row, holding[joint.name])
        if joint.name in holding
        else _switchable_row(model, row, modes[joint.name] + MODE_NUMBERS * i)
        for joint in mechanism.joints
        for i, row in enumerate(_equations_of_row(model, joint.name, row) for row in joint.rows)
    )
    rows += tuple(_equations_of_bounded_row(model, bounded, modes[bounded.row]) for bounded in mechanism.bounded)
    forces, power, potential = _forces_and_potential(model)
    driving = None
    if model.tree is None:
        mass, kinetic, gravity_potential = _mass_and_energies(model, forces)
    else:
        kinetic, gravity_potential = energies_on_tree(model, forces)
        mass, forces, driving = model.tree.dynamics(forces)
    mass, rotating = with_rotors(model, mass, forces)
    joint_coordinates = _joint_coordinates(model)
    rates = _rates_of_states(model, rows)
    coordinates, velocities = state_quantities(mechanism)
    return Equations(
        name=mechanism.name,
        graph=model.graph,
        parameters=tuple(Quantity(p.name, p.unit) for p in mechanism.parameters),
        inputs=mechanism.inputs,
        coordinates=coordinates,
        velocities=velocities,
        q_rates=model.q_rates(),
        mass=mass,
        rows=rows,
        forces=tuple(forces),
        power=power,
        kinetic=model.graph.add(kinetic, rotating),
        potential=model.graph.add(potential, gravity_potential),
        joint_coordinates=tuple(joint_coordinates),
        windings=tuple(model.windings),
        spins=_first_indices_of_spins(model),
        omissions=(
            *(Omission(f"row {row}", f"it repeats row {other} for all q") for row, other in repeats),
            *_omitted_terms(mechanism),
        ),
        dropped_rows=tuple(f"{row} = {other}" for row, other in repeats),
        bodies=_coordinates_of_bodies(model),
        driving=driving,
        metric=() if model.tree is None else model.tree.metric_of_bodies(),
        states=tuple(Quantity(x.name, x.unit) for x in mechanism.states),
        state_rates=rates,
        renewed=tuple(
            (modes[row.row] + MODES.index("sign"), model.expression(row.renewed))
            for row in mechanism.bounded
            if row.renewed is not None
        ),
        drags=tuple(_drag_of_reaction(model, row, rows, repeats) for row in pressed_rows(mechanism)),
        tables=_tables_read(model),  # the last one: drags may read tables
    )


def _tables_read(model: ModelNodes) -> tuple[Interpolation, ...]:
    read = {table_of_payload(o.payload)[0] for o in model.graph.nodes if o.op == "table"}
    return tuple(t.interpolated for t in model.mechanism.tables if t.name in read)


def _rates_of_states(model: ModelNodes, rows: Sequence[ConstraintRow]) -> tuple[int, ...]:
    """Return the rates of the file's states; those that read results have v' and multipliers among their inputs."""
    states = model.mechanism.states
    if any(reads_results(x.rate) for x in states):
        model.places_of_rows = {row.name: i for i, row in enumerate(rows)}
        model.name_accelerations()
    return tuple(model.expression(x.rate) for x in states)


def _coordinates_of_bodies(model: ModelNodes) -> tuple[int, ...]:
    """Return coordinates, velocities and accelerations of the bodies on a tree of joints."""
    if model.tree is None:
        return ()
    bodies, rates = model.mechanism.bodies, model.tree.accelerations(model.state_rates)
    names = [f"{b.name}.{c}" for b in bodies for c in b.coordinates]
    speeds = [f"{b.name}.{c}" for b in bodies for c in b.speeds]
    return (*(model.names[n] for n in (*names, *speeds)), *(rates[n] for n in speeds))


def _first_indices_of_spins(model: ModelNodes) -> tuple[tuple[int, int], ...]:
    """Return the first indices of Euler parameters in q and of their angular velocities in v."""
    if model.tree is not None:
        return tuple(model.tree.spins)
    return tuple(
        (model.first_q[b.name] + 3, model.first[b.name] + 3)
        for b in model.mechanism.bodies
        if isinstance(b, SpatialBody) and not b.is_point and b.carried is None
    )


def _joint_coordinates(model: ModelNodes) -> list[JointCoordinate]:
    coordinates = list[JointCoordinate]()
    for joint in model.mechanism.joints:
        with refuse_overflow(f"joints.{joint.name}"):
            for label, measure in joint.coordinates:
                derived = model.measure(measure)
                rate = derived.rate(model.graph, model.velocities)
                coordinates.append(JointCoordinate(f"{joint.name}.{label}", joint.unit(label), derived.value, rate))
    return coordinates


# -- constraints -----------------------------------------------------------------------------------------------------


def _equations_of_row(model: ModelNodes, joint: str, row: Row) -> ConstraintRow:
    g = model.graph
    with refuse_overflow(f"joints.{joint}"):
        value, slope, curvature = time_function(model, row.value)
        stiffness = time_function(model, row.stiffness)[0] if isinstance(row, StiffHolonomic) else None
        if isinstance(row, Holonomic):
            measure = model.measure(row.measure)
            phi, nu = g.sub(measure.value, value), slope
        else:
            measure = model.speed(row.speed)
            phi, nu, curvature = None, value, slope
        entries, bias, drift = model.row_over_state(measure.row, measure.bias)
        gamma, nu = g.sub(curvature, bias), g.sub(g.sub(nu, drift), measure.drift)
        ordered, size = tuple(sorted(entries.items())), _size_of_row(model, row, measure.row)
    axes = model.tree is None and isinstance(row, Holonomic) and holds_parallel_axes(row)
    name = f"{joint}.{row.label}"
    return ConstraintRow(name, joint, row.unit, phi, ordered, nu, gamma, size, stiffness, axes=axes)


def _equations_of_bounded_row(model: ModelNodes, bounded: BoundedRow, first: int) -> ConstraintRow:
    """Return a row whose force has bounds, in force at times."""
    row = _equations_of_row(model, bounded.owner, bounded.held)
    return replace(_switchable_row(model, row, first), name=bounded.row, bounded=True)


def _drag_of_reaction(
    model: ModelNodes, bounded: BoundedRow, rows: Sequence[ConstraintRow], repeats: Iterable[tuple[str, str]]
) -> Drag:
    """Return the effort by the reaction of a joint, or by the force of a gap.

    Its power is over the velocities of the state: what drivers of a tree give to it, they take from it again.
    """
    g, places = model.graph, {row.name: i for i, row in enumerate(rows)}
    refuse_shared_reactions(bounded, repeats)
    rate = model.measure_or_velocity(bounded.measure).rate(g, model.velocities)
    with refuse_overflow(bounded.where):
        sign, coefficient = (
            model.expression(bounded.way or name_of_number(bounded, "sign")),
            model.expression(bounded.coefficient, rate=rate),
        )
    rows_of = tuple(places[name] for name in bounded.pressed)
    pressed: tuple[tuple[tuple[int, int], ...], ...] = tuple(((row, g.one),) for row in rows_of)
    if bounded.across:
        cosines = [[model.measure(cosine).value for cosine in line] for line in bounded.across]
        pressed = tuple(tuple(zip(rows_of, line, strict=True)) for line in cosines)
    if bounded.signed:  # a force that pushes is minus the multiplier of its row
        coefficient = g.neg(coefficient)
    along = g.sum_of(g.mul(node, g.input("v", j)) for j, node in rows[places[bounded.row]].entries)
    return Drag(places[bounded.row], sign, coefficient, along, pressed, bounded.family.one, bounded.signed)


def _switchable_row(model: ModelNodes, row: ConstraintRow, first: int) -> ConstraintRow:
    """Return a row as one that may be off: ``Phi = held (s - value - constant)``; D stays as it is."""
    g, held = model.graph, model.graph.input("modes", first)
    phi = row.phi if row.phi is None else g.mul(held, g.sub(row.phi, g.input("modes", first + 1)))
    return replace(row, phi=phi, held=held)


def _row_of_holding(model: ModelNodes, row: ConstraintRow, holding: Holding) -> ConstraintRow:
    """Return a row as one that its joint's states put into force: ``Phi = held (s - value - place)``."""
    g, changed = model.graph, model.names[f"{holding.joint}.{CHANGED}"]
    held = g.call("abs", g.sub(model.expression(holding.first), changed))
    held = g.call("where", g.call("gt", held, g.constant(0.5)), g.one, g.zero)  # whatever integration rounds
    place = model.names.get(name_of_place(holding.joint, row.name.removeprefix(f"{holding.joint}.")), g.zero)
    assert row.phi is not None, "rows of joints that hold for a while are of positions"
    return replace(row, phi=g.mul(held, g.sub(row.phi, place)), held=held, place=place)


def _size_of_row(model: ModelNodes, row: Row, entries: Mapping[int, int]) -> int | None:
    """Return the square of a row over the translational velocities of bodies, or the angular ones for an angle."""
    if model.tree is None or any(i >= model.size for i in entries):
        return None
    speeds = [speed for body in model.mechanism.bodies for speed in body.speeds]
    turning = [node for i, node in sorted(entries.items()) if UNITS[speeds[i]] == "rad/s"]
    moving = [node for i, node in sorted(entries.items()) if UNITS[speeds[i]] == "m/s"]
    if row.unit in ("rad", "rad/s"):
        return None if moving else model.graph.dot(turning, turning)
    return model.graph.dot(moving, moving) if moving else None


# -- forces, inertia and energies ------------------------------------------------------------------------------------


def _forces_and_potential(model: ModelNodes) -> tuple[list[int], int, int]:
    """Return f without gravity, the power of its part without potential, and its potential."""
    g = model.graph
    forces, power, potential = [g.zero] * len(model.velocities), g.zero, g.zero
    for force in model.mechanism.forces:
        with refuse_overflow(f"forces.{force.name}"):
            for exerted in exertions_of_force(model, force):
                for i, entry in sorted(exerted.row.items()):
                    forces[i] = g.add(forces[i], g.mul(entry, exerted.total))
                power = g.add(power, exerted.power)
                potential = g.add(potential, exerted.energy)
    for bounded in model.mechanism.bounded:
        with refuse_overflow(bounded.where):
            exerted = exertion_of_effort(model, bounded.effort)
            for i, entry in sorted(exerted.row.items()):
                forces[i] = g.add(forces[i], g.mul(entry, exerted.total))
            power = g.add(power, exerted.power)
    return forces, power, potential


def _mass_and_energies(model: ModelNodes, forces: list[int]) -> tuple[tuple[MassBlock, ...], int, int]:
    """Return M, the kinetic energy and gravity's potential; add weights and gyroscopic terms to `forces`."""
    g = model.graph
    gravity = tuple(model.expression(e) for e in model.mechanism.gravity)
    blocks: list[MassBlock] = []
    kinetic = potential = g.zero
    half = g.constant(0.5)
    for body in model.mechanism.bodies:
        if body.carried is not None:
            continue
        with refuse_overflow(f"bodies.{body.name}", "its weight is its mass times gravity"):
            first, first_q = model.first[body.name], model.first_q[body.name]
            mass = model.expression(body.mass)
            masses = [mass] * len(gravity)
            if body.modal is not None:
                kinetic = g.add(kinetic, add_modal_inertia(model, body, blocks, forces))
            elif isinstance(body, SpatialBody):
                if body.inertia is not None:
                    tensor = tuple(model.expression(e) for e in body.inertia)
                    kinetic = g.add(kinetic, _add_rotational_inertia(model, first + 3, tensor, blocks, forces))
            elif body.inertia is not None:
                masses.append(model.expression(body.inertia))
            for offset, entry in enumerate(masses):
                i = first + offset
                blocks.append(MassBlock((i,), ((entry,),)))
                v = model.velocities[i]
                kinetic = g.add(kinetic, g.mul(g.mul(half, entry), g.mul(v, v)))
                if offset < len(gravity):
                    weight = g.mul(mass, gravity[offset])
                    forces[i] = g.add(forces[i], weight)
                    potential = g.sub(potential, g.mul(weight, g.input("q", first_q + offset)))
    return tuple(sorted(blocks, key=lambda block: block.columns)), kinetic, potential


def _add_rotational_inertia(
    model: ModelNodes, first: int, tensor: tuple[int, ...], blocks: list[MassBlock], forces: list[int]
) -> int:
    """Add the rotational inertia to M and -omega x (I omega) to f; return the rotational energy.

    Differences of the diagonal entries make the gyroscopic term vanish for an isotropic body.
    """
    g = model.graph
    xx, yy, zz, xy, xz, yz = tensor
    x, y, z = model.velocities[first : first + 3]
    for i, (a, b, cross, ab, ac, (u, v, w)) in enumerate(
        ((yy, zz, yz, xz, xy, (x, y, z)), (zz, xx, xz, xy, yz, (y, z, x)), (xx, yy, xy, yz, xz, (z, x, y)))
    ):
        # about axis u: (b - a) v w + I_vw (v^2 - w^2) + u (I_uw v - I_uv w)
        moment = g.mul(g.sub(b, a), g.mul(v, w))
        moment = g.add(moment, g.mul(cross, g.sub(g.mul(v, v), g.mul(w, w))))
        moment = g.add(moment, g.mul(u, g.sub(g.mul(ab, v), g.mul(ac, w))))
        forces[first + i] = g.sub(forces[first + i], moment)
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    if (xy, xz, yz) == (g.zero,) * 3:
        blocks += [MassBlock((first + i,), ((rows[i][i],),)) for i in range(3)]
    else:
        blocks.append(MassBlock((first, first + 1, first + 2), rows))
    momentum = [g.dot(row, (x, y, z)) for row in rows]
    return g.mul(g.constant(0.5), g.dot(momentum, (x, y, z)))


def _omitted_terms(mechanism: Mechanism) -> list[Omission]:
    omissions = [Omission("columns of the ground", "the ground does not move")]
    if mechanism.space == "planar":
        omissions = [
            Omission("z coordinates, Euler parameters and 3x3 inertia tensors", "the mechanism is planar"),
            Omission("the kinematic map N", "planar velocities are the rates of the coordinates"),
            Omission("gyroscopic terms", "they vanish in the plane"),
            *omissions,
        ]
    if all(e == ZERO for e in mechanism.gravity):
        omissions.append(Omission("weights and gravity's potential", "gravity is zero"))
    for body in mechanism.bodies:
        if body.is_point:
            what = "angle" if mechanism.space == "planar" else "orientation"
            omissions.append(Omission(f"{what} of {body.name}", "a point mass has none"))
        elif body.carried is not None:
            continue
        elif all(e == ZERO for e in body.centre_of_mass) and len(mechanism.bodies) <= 12:
            omissions.append(
                Omission(f"centre-of-mass offset of {body.name}", "its centre of mass is the frame's origin")
            )
    return omissions


def holds_parallel_axes(row: Holonomic) -> bool:
    """Whether a row holds two axes parallel: `parallel` of joints in space makes pairs of them."""
    measure = row.measure
    if row.label == "first" and isinstance(measure, Sum) and len(measure.terms) == 1:
        measure = measure.terms[0][1]
    return row.label in ("first", "second") and isinstance(measure, Dot)
