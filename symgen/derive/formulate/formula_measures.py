"""Formulas of a file as measures and velocities: their rows and quadratic velocity terms by the chain rule."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.base.ir.derivative import jacobian
from symgen.base.vocabulary.expressions import ZERO, Name, Reading, moving_quantities, rename_quantities
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Carrying,
    Component,
    Driven,
    Exerted,
    Flexed,
    FormulaMeasure,
    FormulaSpeed,
    Integral,
    Marker,
    Spin,
    axes,
)
from symgen.derive.formulate.derived_measure import DerivedMeasure
from symgen.describe.coordinate_names import is_speed
from symgen.describe.modal_body import mode_number

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes


def formula_measure(nodes: ModelNodes, m: FormulaMeasure | FormulaSpeed) -> DerivedMeasure:
    """Return a formula of moving quantities x: s' = c x' + d with c = ds/dx, s'' = c x'' + (ds'/dx) x' + ds'/dt.

    A velocity u = c x' + d has the rate u' = c x'' + (du/dx) x' + du/dt.

    Parameters
    ----------
    nodes : ModelNodes
        Nodes of the model.
    m : FormulaMeasure or FormulaSpeed
        The formula.

    Returns
    -------
    DerivedMeasure
        Of the formula.
    """
    g, leaves = nodes.graph, moving_quantities(m.of)
    derived = [_moving_quantity(nodes, leaf) for leaf in leaves]
    orders = [int(leaf.order > 0 if isinstance(leaf, Reading) else is_speed(leaf.name)) for leaf in leaves]
    keys = [(("rate" if order else "value"), i) for i, order in enumerate(orders)]
    rates = [g.input("rate", i) for i in range(len(leaves))]
    names = {leaf: f"leaf {i}" for i, leaf in enumerate(leaves)}
    places = {names[leaf]: g.input(*key) for leaf, key in zip(leaves, keys, strict=True)}
    value = nodes.expression(rename_quantities(m.of, names), **places)

    def along(node: int) -> int:
        """Return the derivative along the motion, rates constant."""
        slopes = jacobian(g, [node], [key for key in keys if key[0] == "value"] + [("t", 0)])[0]
        return g.sum_of(
            slope if key == ("t", 0) else g.mul(slope, rates[key[1]]) for key, slope in sorted(slopes.items())
        )

    speed = value if isinstance(m, FormulaSpeed) else along(value)
    factors = jacobian(g, [speed], [("rate", i) for i in range(len(leaves))])[0]
    drift = g.replace_inputs([speed], {("rate", i): leaf.drift for i, leaf in enumerate(derived)})[0]
    at: dict[tuple[str, int], int] = {}
    for i, leaf in enumerate(derived):
        at |= {("value", i): leaf.value, ("rate", i): leaf.rate(g, nodes.velocities)}
    value, drift, bias = g.replace_inputs([value, drift, along(speed)], at)
    row = dict[int, int]()
    for (_, i), factor in sorted(factors.items()):
        (factor,) = g.replace_inputs([factor], at)
        bias = g.add(bias, g.mul(factor, derived[i].bias))
        for j, entry in derived[i].row.items():
            row[j] = g.add(row.get(j, g.zero), g.mul(factor, entry))
    return DerivedMeasure(value, {j: n for j, n in sorted(row.items()) if n != g.zero}, bias, drift)


def _moving_quantity(nodes: ModelNodes, leaf: Name | Reading) -> DerivedMeasure:
    """Return a moving quantity of a formula: a measure, or a coordinate or velocity of a body as a measure.

    Velocities of bodies on a tree are those of the joint's point, not of the centre of mass.
    """
    if isinstance(leaf, Reading):
        assert not isinstance(leaf.source, Exerted | Driven | Carrying | Integral | Flexed), "rows read measures"
        return nodes.measure_or_velocity(leaf.source)
    body, _, label = leaf.name.rpartition(".")
    if label in ("theta", "omega"):
        return nodes.measure(Angle(GROUND, body))
    if (number := mode_number(label)) > 0:
        m, _ = nodes.modes(body)
        place = nodes.first[body] + len(nodes.mechanism.body(body).speeds) - len(m) + number - 1
        return DerivedMeasure(m[number - 1], {place: nodes.graph.one}, nodes.graph.zero)
    dimension, i = len(nodes.mechanism.gravity), "xyz".index(label[-1])
    if label[0] == "w":
        return nodes.measure(Spin(GROUND, body, axes(body, dimension)[i]))
    origin, centre = Marker(GROUND, (ZERO,) * dimension), nodes.mechanism.body(body).centre_of_mass
    return nodes.measure(Component(origin, Marker(body, centre), axes(GROUND, dimension)[i]))
