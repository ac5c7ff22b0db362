"""What an element adds to a method's descriptor form: kernels of its residual and of its Jacobian.

``F(t, y, k) = 0`` of a mechanism (`symgen.lower.descriptor`) is a sum over its elements. A body gives ``q' - N v`` and
``M v' - f``; a force gives ``-f``; a joint gives ``D^T lambda`` to its bodies, ``N D^T eta`` where the form is
stabilised, and its own rows at the level of the method, whose formula is asked for the joint alone. So kernels depend
on the element's kind and on that formula, and methods with the same formula share them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import msgspec

from symgen.errors import InputError
from symgen.formulate.equations import ConstraintRow, Equations, MassBlock, Quantity
from symgen.ir.derivative import jacobian
from symgen.ir.graph import Graph
from symgen.ir.program import Block, Target
from symgen.lower.algebra import System
from symgen.lower.descriptor import constraint_groups
from symgen.lower.vectors import Scalar, Vector

if TYPE_CHECKING:
    from symgen.formulate.elements import Element
    from symgen.lower.looped.instances import Instance
    from symgen.lower.looped.kernels import KernelInfo
    from symgen.methods._base import Descriptor, Method

#: Groups of equations: kinematic, dynamic, then up to three rows for each constraint.
EQUATIONS = ("q", "v", "first", "second", "third")
#: Groups of unknowns: parts of k, then the state.
UNKNOWNS = ("k_q", "k_v", "k_first", "k_second", "q", "v")


class FormInfo(msgspec.Struct, frozen=True):
    """What tables need to know of an element's part of a descriptor form.

    Parameters
    ----------
    level : str
        As in `symgen.methods._base.Descriptor`.
    entries : tuple of (str, int, str, int)
        Group and index, within the element, of the equation and of the unknown of each number that ``tangent`` writes.
    functions : dict
        Operations of each function that does something.
    """

    level: str
    entries: tuple[tuple[str, int, str, int], ...]
    functions: dict[str, int]


@dataclass(frozen=True)
class FormProgram:
    """The kernel of an element's part: what the emitter needs."""

    stem: str
    label: str
    info: FormInfo
    blocks: tuple[Block, ...]
    tables: tuple[tuple[str, tuple[float, ...], tuple[float, ...]], ...]


class _Joint:
    """A joint's equations as a method sees them: what needs the rest of the mechanism is not there."""

    def __init__(self, system: System, name: str) -> None:
        self._system, self._name = system, name
        self.D, self.v, self.nu, self.phi, self.gamma = system.D, system.v, system.nu, system.phi, system.gamma
        self.parameter, self.inverse, self.zeros = system.parameter, system.inverse, system.zeros

    @property
    def inverse_step(self) -> Scalar:
        return self._system.inverse_step

    def __getattr__(self, name: str) -> Any:
        asks = f"'{self._name}', whose constraints ask for '{name}'; the straight shape is for it"
        raise InputError("--shape looped", "constraints that each joint gives alone", asks)


def form_key(method: Method, options: Mapping[str, str]) -> str:
    """Return a short name of a method's formula for constraints: equal formulas have equal names.

    The formula is asked for one row over one velocity, with symbols for everything.

    Raises
    ------
    InputError
        If it asks for more than a joint knows.
    """
    g = Graph()
    phi, entry, nu, gamma = (g.input(name, 0) for name in ("phi", "D", "nu", "gamma"))
    velocity = g.input("v", 0)
    row = ConstraintRow("", "", "", phi, ((0, entry),), nu, gamma)
    one = (Quantity("", ""),)
    mass = (MassBlock((0,), ((g.one,),)),)
    equations = Equations(
        *("", g, (), one, one, (velocity,), mass, (row,), (g.zero,), g.zero, g.zero, g.zero, (), (), (), ()),
    )
    system = System(equations, [p.name for p in method.parameters], 0)
    descriptor = _descriptor(method, options, system)
    equals, more = constraint_groups(system, descriptor, *_unknowns(system, equations))
    ends = [n for group in (*equals, *more) for n in group]
    place: dict[int, int] = {}
    text = [descriptor.level]
    for node in system.graph.needed(ends):
        op, args, payload = system.graph.nodes[node]
        place[node] = len(place)
        text.append(f"{op} {[place[a] for a in args]} {payload}")
    text.append(str([place[n] for n in ends]))
    return hashlib.sha256("\n".join(text).encode()).hexdigest()[:8]


def form_stem(key: str, stem: str) -> str:
    """Return the name of the module of an element's part, from the formula's name and its kernel's."""
    return f"form_{key}_{stem[-45:]}"


def form_stride(kernel: KernelInfo) -> int:
    """Return the numbers of an instance: those of its frames, row, first entry, angles, constants."""
    return 3 * len(kernel.frames) + 2 + kernel.windings + kernel.constants


def lower_form(
    element: Element, instance: Instance, method: Method, options: Mapping[str, str], stem: str
) -> FormProgram:
    """Lower an element's part of a descriptor form.

    Parameters
    ----------
    element : Element
        The derived element.
    instance : Instance
        Any instance of it.
    method, options : Method, mapping
        The method with its structural options, complete.
    stem : str
        Name of the module.
    """
    e = element.equations
    system = System(e, [p.name for p in method.parameters], len(instance.constants))
    descriptor = _descriptor(method, options, system)
    g = system.graph
    outputs = {"body": _body, "joint": _joint, "force": _force}[instance.kind](system, descriptor)
    rows = [(group, i, n) for group, nodes in outputs.items() if group in EQUATIONS for i, n in enumerate(nodes)]
    rows = [(group, i, n) for group, i, n in rows if n != g.zero]
    counted = [(group, i, n) for group, i, n in rows if descriptor.level != "projected" or group in EQUATIONS[:3]]
    sizes = {"k_q": e.nq, "k_v": e.nv, "k_first": e.m, "k_second": e.m, "q": e.nq, "v": e.nv}
    keys = [(group, i) for group in UNKNOWNS for i in range(sizes[group])]
    entries: list[tuple[str, int, str, int]] = []
    slopes: list[int] = []
    for (group, i, _), derivatives in zip(counted, jacobian(g, [n for _, _, n in counted], keys), strict=True):
        for space, index in sorted(derivatives):
            entries.append((group, i, space, index))
            slopes.append(derivatives[space, index])
    power = outputs.get("power", [g.zero])[0]
    residual = [(Target(group, i), n) for group, i, n in rows]
    if power != g.zero:
        residual.append((Target("power", 0), power))
    blocks = []
    for name, purpose, found in (
        ("residual", "its part of F(t, y, k) of the descriptor form, and of the power", residual),
        ("tangent", "its entries of dF/dk and dF/dy", [(Target("entry", i), n) for i, n in enumerate(slopes)]),
    ):
        if found:
            graph = Graph()
            nodes = element.over_records([n for _, n in found], graph, g)
            copied = tuple((target, node) for (target, _), node in zip(found, nodes, strict=True))
            blocks.append(Block(name, purpose, graph, copied, ()))
    info = FormInfo(descriptor.level, tuple(entries), {b.name: b.operations for b in blocks})
    return FormProgram(stem, instance.label, info, tuple(blocks), e.tables)


def _descriptor(method: Method, options: Mapping[str, str], system: System) -> Descriptor:
    descriptor = method.descriptor(cast("System", _Joint(system, method.name)), options)
    if descriptor is None:
        what = f"'{method.name}', which has no form for implicit integrators"
        raise InputError("--shape looped", "a method with a descriptor form", what)
    return descriptor


def _unknowns(system: System, e: Equations) -> tuple[Vector, Vector, Vector]:
    """Return v', lambda and eta."""
    return (
        system.variable("k_v", e.nv),
        system.variable("k_first", e.m),
        system.variable("k_second", e.m),
    )


def _body(system: System, descriptor: Descriptor) -> dict[str, list[int]]:
    e = system.equations
    rates = system.variable("k_q", e.nq) - system.q_rates
    return {"q": list(rates), "v": list(system.mass(system.variable("k_v", e.nv)) - system.f)}


def _force(system: System, descriptor: Descriptor) -> dict[str, list[int]]:
    g = system.graph
    return {"v": [g.neg(n) for n in system.f], "power": [system.equations.power]}


def _joint(system: System, descriptor: Descriptor) -> dict[str, list[int]]:
    e, g = system.equations, system.graph
    accelerations, multipliers, eta = _unknowns(system, e)
    equals, more = constraint_groups(system, descriptor, accelerations, multipliers, eta)
    found = dict(zip(EQUATIONS[2:], (*equals, *more), strict=False))
    found["v"] = list(system.D.transposed(multipliers))
    found["power"] = [g.neg(multipliers.dot(system.nu).node)]
    if descriptor.level == "stabilised":
        found["q"] = list(system.at_velocity(system.q_rates, system.D.transposed(eta)))
    return found
