"""The descriptor form of a mechanism with its exact derivatives, as one function in a module of its own.

Equilibria, linear systems and modes use it. Everything is differentiated on the graph, operation by operation, so
nothing is expanded and nothing is approximated; multipliers are inputs, so that the stiffness includes their part.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symgen.base.ir.derivative import Key, jacobian
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import Block, OutputSlot
from symgen.base.vocabulary.infos import BY, LinearisedInfo
from symgen.base.vocabulary.measures import Holonomic
from symgen.derive.formulate.equations import Equations
from symgen.derive.formulate.flexure import exertions_of_force
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.side_program import SideModel, SideProgram, copy_to_own_graph, side_program
from symgen.derive.lower.windings import Beside, winding_order
from symgen.describe.formulas.evaluate import dependent_parameters
from symgen.describe.mechanism import Mechanism

#: Differentiated groups, in this order: ``motion``, q' = N v, ``balance``, M v' + D^T lambda - f, ``accelerations``,
#: D v' - gamma, ``velocities``, D v - nu, ``positions``, Phi, and ``states``, rates of the states of the file.
#: Contributions of single forces to the balance follow as ``elements``.
#: Groups that are differentiated by time as well; the third derivative of a cubic table does not exist.
TIMED = ("motion", "balance", "velocities", "positions", "states")
#: Name of the emitted function.
NAME = "linearised"


def lower_descriptor(
    mechanism: Mechanism, by: Sequence[str], beside: Beside, groups: Sequence[str] = ()
) -> tuple[SideProgram, LinearisedInfo]:
    """Lower the descriptor form with its derivatives; return one function, and the meaning of its numbers.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism, with or without a tree.
    by : sequence of str
        Parameters of differentiation besides t, q, v, v' and lambda; parameters that follow from them by formulas of
        the description follow them here too.
    beside : Beside
        Readable parts of the compiled model.
    groups : sequence of str
        Selected groups, with derivatives by state, v' and multipliers alone; by default everything.

    Raises
    ------
    OverflowError
        If numbers that meet in a formula overflow.
    """
    equations = formulate(mechanism)
    model = SideModel(mechanism, beside=beside)
    g = model.graph
    values = {
        name: nodes for name, nodes in _groups_of_descriptor(model, equations).items() if not groups or name in groups
    }
    elements, parts = ((), []) if groups else _forces_by_element(model)
    values |= {"elements": parts}
    sizes = {name: len(nodes) for name, nodes in values.items()}
    functions, nodes = ([], []) if groups else _values_and_rates(model)
    count = sum(sizes.values())
    outputs = [node for group in sizes for node in values[group]] + nodes
    names = [p.name for p in mechanism.parameters]
    places = {"ydot": BY.index("a"), "multipliers": BY.index("lam")} | {name: k for k, name in enumerate(BY)}
    nq, nv = equations.nq, equations.nv
    keys: list[Key] = [("q", i) for i in range(nq)] + [("v", i) for i in range(nv)]
    keys += [("ydot", nq + i) for i in range(nv)] + [("multipliers", i) for i in range(equations.m)]
    keys += [("z", i) for i in range(1, len(mechanism.states) + 1)]
    following = _dependent_parameters(model, by)
    keys += [("p", names.index(name)) for name in (*by, *following)]
    timed = [] if groups else [node for group in TIMED for node in values[group]]
    by_time = dict(zip(timed, jacobian(g, timed, [("t", 0)]), strict=True))
    pattern, derivatives = [], []
    for i, slopes in enumerate(jacobian(g, outputs, keys)):
        slopes = _chain_dependent_parameters(g, slopes, following, names, by)
        slopes = {**slopes, **(by_time.get(outputs[i], {}) if i < count else {})}
        for space, index in sorted(slopes):
            pattern.append((i, places[space], index - {"ydot": nq, "z": 1}.get(space, 0)))
            derivatives.append(slopes[space, index])
    graph, images = copy_to_own_graph(g, [*outputs, *derivatives])
    targets = tuple((OutputSlot("out", i), image) for i, image in enumerate(images))
    purpose = "The descriptor form with its derivatives"
    block = Block(NAME, purpose, graph, targets, ("t", "y", "p", "w", "ydot", "out"))
    labels = [f"{group} {i}" for group, size in sizes.items() for i in range(size)]
    labels += [name + "'" * order for name, _, orders in functions for order in range(orders)]
    info = LinearisedInfo(tuple(sizes.items()), tuple(functions), tuple(pattern), elements)
    return side_program(mechanism, (block,), beside, labels), info


def _dependent_parameters(model: SideModel, by: Sequence[str]) -> dict[str, dict[str, int]]:
    """Return the parameters that follow from others by formulas, with their derivatives by each of `by`."""
    g, names = model.graph, [p.name for p in model.mechanism.parameters]
    derivatives: dict[str, dict[str, int]] = {}
    for name, formula in dependent_parameters(model.mechanism.parameters) if by else ():
        node = model.expression(formula)
        slopes = jacobian(g, [node], [("p", i) for i in range(len(names))])[0]
        total: dict[str, int] = {}
        for (_, i), slope in sorted(slopes.items()):
            for base, more in (
                *([(names[i], g.one)] if names[i] in by else []),
                *derivatives.get(names[i], {}).items(),
            ):
                total[base] = g.add(total.get(base, g.zero), g.mul(slope, more))
        if total:
            derivatives[name] = total
    return derivatives


def _chain_dependent_parameters(
    g: Graph,
    slopes: Mapping[Key, int],
    following: Mapping[str, Mapping[str, int]],
    names: Sequence[str],
    by: Sequence[str],
) -> dict[Key, int]:
    """Return derivatives by `by`, with the chain rule for parameters that follow from others."""
    places: dict[Key, Mapping[str, int]] = {("p", names.index(name)): bases for name, bases in following.items()}
    followed = {key: slope for key, slope in slopes.items() if key[0] != "p" or names[key[1]] in by}
    for key, bases in places.items():
        for base, more in bases.items() if key in slopes else ():
            at = ("p", names.index(base))
            followed[at] = g.add(followed.get(at, g.zero), g.mul(slopes[key], more))
    return followed


def can_decay(mechanism: Mechanism, beside: Beside) -> bool:
    """Whether a force depends on velocities, a joint is a condition on them, or a file has states."""
    if mechanism.states or any(not isinstance(row, Holonomic) for joint in mechanism.joints for row in joint.rows):
        return True
    model = SideModel(mechanism, beside=beside)
    for force in mechanism.forces:
        totals = [exerted.total for exerted in exertions_of_force(model, force)]
        if any(space == "v" for space, _ in model.graph.inputs_of(totals)):
            return True
    return False


def _groups_of_descriptor(model: SideModel, e: Equations) -> dict[str, list[int]]:
    """Return the nodes of each group in the graph of formulas."""
    g = model.graph
    roots = [*e.q_rates, *e.forces, *(n for block in e.mass for row in block.entries for n in row)]
    roots += [n for row in e.rows for n in (row.nu, row.gamma, *([] if row.phi is None else [row.phi]))]
    roots += [n for row in e.rows for _, n in row.entries]
    # equations count turns in the order of straight code, the compiled model maybe in another one
    turning = winding_order(model.mechanism, "straight")
    keys = {key: g.input(*key) for key in e.graph.inputs_of(roots)}
    keys |= {key: g.input("winding", model.place_of_turn(turning[key[1]])) for key in keys if key[0] == "winding"}
    image = dict(zip(roots, g.copy_from(e.graph, roots, keys), strict=True))
    velocities = [g.input("v", i) for i in range(e.nv)]
    rates = [g.input("ydot", e.nq + i) for i in range(e.nv)]
    balance = [g.neg(image[n]) for n in e.forces]
    for block in e.mass:
        for i, entries in zip(block.columns, block.entries, strict=True):
            for j, n in zip(block.columns, entries, strict=True):
                balance[i] = g.add(balance[i], g.mul(image[n], rates[j]))
    groups: dict[str, list[int]] = {"motion": [image[n] for n in e.q_rates], "balance": balance}
    groups |= {"accelerations": [], "velocities": [], "positions": []}
    groups |= {"states": [model.expression(x.rate) for x in model.mechanism.states]}
    for k, row in enumerate(e.rows):
        own = [(j, image[n]) for j, n in row.entries]
        for j, n in own:
            balance[j] = g.add(balance[j], g.mul(n, g.input("multipliers", k)))
        groups["accelerations"].append(g.sub(g.sum_of(g.mul(n, rates[j]) for j, n in own), image[row.gamma]))
        groups["velocities"].append(g.sub(g.sum_of(g.mul(n, velocities[j]) for j, n in own), image[row.nu]))
        groups["positions"].append(g.zero if row.phi is None else image[row.phi])
    return groups


def _forces_by_element(model: SideModel) -> tuple[tuple[tuple[str, int], ...], list[int]]:
    """Return the contribution of each force element to the balance, velocity by velocity."""
    if model.tree is not None:
        return (), []
    g, entries = model.graph, dict[tuple[str, int], int]()
    for force in model.mechanism.forces:
        for exerted in exertions_of_force(model, force):
            for i, entry in sorted(exerted.row.items()):
                key = force.name, i
                entries[key] = g.sub(entries.get(key, g.zero), g.mul(entry, exerted.total))
    return tuple(entries), list(entries.values())


def _values_and_rates(model: SideModel) -> tuple[list[tuple[str, str, int]], list[int]]:
    """Return coordinates of joints and outputs, and the nodes of their values and rates."""
    functions, nodes = list[tuple[str, str, int]](), list[int]()
    named = [
        (f"{joint.name}.{label}", joint.unit(label), model.measure(measure).value)
        for joint in model.mechanism.joints
        for label, measure in joint.coordinates
    ]
    if model.tree is not None:  # coordinates of carried bodies are quantities of the state as well
        named += [
            (f"{b.name}.{c}", "", model.names[f"{b.name}.{c}"])
            for b in model.mechanism.bodies
            for c in (*b.coordinates, *b.speeds)
        ]
    named += [(x.name, x.unit, model.names[x.name]) for x in model.mechanism.states]
    named += [(o.name, o.unit, model.expression(o.value)) for o in model.mechanism.outputs]
    own = len(model.mechanism.states)
    for name, unit, value in named:
        keys = model.graph.inputs_of([value])
        spaces = {space for space, _ in keys}
        if "status" in spaces or any(space == "z" and i > own for space, i in keys):
            continue  # an integral has a history, not a value of the state
        chain = [value]
        for last in ("v", "ydot")[len(spaces & {"v"}) :] if not spaces & {"ydot", "multipliers"} else ():
            chain += model.rates(chain[-1:])
            if last == "ydot":
                break
        functions.append((name, unit, len(chain)))
        nodes += chain
    return functions, nodes
