"""Descriptor forms of methods as formulas, before layout."""

from __future__ import annotations

from collections.abc import Mapping

from symgen.base.errors import InputError
from symgen.derive.lower.recorded_law import EQUATIONS, Part, RecordedLaw
from symgen.derive.methods._base import Descriptor, Method
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Scalar, Value, Vector


def record_form(method: Method, options: Mapping[str, str], kind: str = "whole", driven: bool = False) -> RecordedLaw:
    """Record a method's descriptor form F(t, y, k) = 0: one part ``residual`` with groups of equations.

    Unknowns of a stage are k = (q', v', lambda), and for stabilised index 2 also eta. The equations are ``q' - N (v -
    D^T eta)``, ``M v' + D^T lambda - f``, and the constraints at the level of the method: ``D v' - g - e lambda``
    (acceleration); ``Phi``, with ``D v - nu`` in nonholonomic rows (position); both (stabilised); or ``Phi`` with
    levels after the equations, both others for projections (projected), that of velocities (explicit).

    Parameters
    ----------
    method, options : Method, mapping
        The method with its structural options, complete.
    kind : {"whole", "body", "joint", "force"}
        All equations, or the contribution of an element of that kind.
    driven : bool
        Whether drivers prescribe coordinates of a tree.

    Raises
    ------
    InputError
        If the method has no such form.
    """
    s = System()
    form = method.descriptor(s, options)
    if form is None:
        what = f"'{method.name}', which has no form for implicit integrators"
        raise InputError(f"method '{method.name}'", "a method with a descriptor form", what)
    q_rates, accelerations = s.variable("k_q", "nq"), s.variable("k_v", "nv")
    multipliers, eta = s.variable("k_first", "m"), s.variable("k_second", "m")
    equations: list[tuple[str, Value]] = []
    if kind in ("whole", "body"):
        kinematic, dynamic = q_rates - s.q_rates, s.mass(accelerations)
        if kind == "whole":
            dynamic = dynamic + s.D.transposed(multipliers)
        dynamic = dynamic - s.f
        if kind == "whole" and form.level == "stabilised":  # N times a change of v: q' with that change in place of v
            kinematic = kinematic + s.at_velocity(s.q_rates, s.D.transposed(eta))
        equations += [("q", kinematic), ("v", dynamic)]
    if kind in ("whole", "joint"):
        equations += zip(EQUATIONS[2:], _constraint_groups(s, form, accelerations, multipliers), strict=False)
    drivers = multipliers.dot(s.nu)
    if kind == "joint":
        equations.append(("v", s.D.transposed(multipliers)))
        if form.level == "stabilised":
            equations.append(("q", s.at_velocity(s.q_rates, s.D.transposed(eta))))
    if kind == "force":
        equations.append(("v", -s.f))
    applied = s.power + s.driving(accelerations) if driven else s.power
    power: Scalar = {"whole": applied - drivers, "joint": -drivers}.get(kind, applied)
    if kind != "body":
        equations.append(("power", power))
    written = tuple((g, v.index) for g, v in equations)
    part = Part("residual", "F(t, y, k) of the descriptor form, and the power", written, role="form")
    return RecordedLaw(tuple(s.tape.operations), (part,), form=form.level)


def _constraint_groups(s: System, form: Descriptor, accelerations: Vector, multipliers: Vector) -> list[Vector]:
    """Return the equations of constraints in groups of m, and the rows after the equations for projections."""
    velocity = s.D @ s.v - s.nu
    if form.level == "position":
        return [s.holonomic_or(velocity)]
    if form.level == "explicit":
        return [s.holonomic_or(velocity), velocity]
    if form.level == "stabilised":
        return [velocity, s.holonomic_or(s.variable("k_second", "m"))]
    assert form.target is not None, "a descriptor at acceleration level has a target"
    rest = s.D @ accelerations - form.target
    if form.level == "projected":
        return [s.holonomic_or(velocity), velocity, rest]
    return [rest if form.compliance is None else rest - form.compliance.times(multipliers)]
