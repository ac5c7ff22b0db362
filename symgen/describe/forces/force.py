"""Force at a point of a body."""

from __future__ import annotations

from typing import ClassVar, Literal

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr, Name, call, product, sum_of_terms
from symgen.base.vocabulary.measures import GROUND, Component, Effort, Marker, PointSpeed, axes
from symgen.describe.mechanism import Force as Resolved
from symgen.describe.parts.fields import BodyName, Point, PotentialVector, StateVector, value_in_words
from symgen.describe.parts.scope import CENTRE, Scope


class Force(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A force that acts at a point of `body` and comes from the ground.

    Parameters
    ----------
    body : body name
        The body.
    at : point
        Where it acts; the centre of mass by default.
    force : vector of functions of state
        Components [N], in space three; expressions of t, parameters and body coordinates.
    frame : str
        Axes of the components: ``"ground"``, or ``"body"`` for a force that turns with the body.
    potential : vector of expressions
        Potential energy [J] in place of `force`: the first as an expression of ``x``, the second of ``y``, in space the
        third of ``z``, the point's coordinates in the ground frame [m]; the force is minus its derivative and counts as
        conservative.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    body: BodyName
    at: Point = CENTRE
    force: StateVector | None = None
    frame: Literal["ground", "body"] = "ground"
    potential: PotentialVector | None = None

    def build(self, scope: Scope) -> Resolved:
        """Resolve to efforts along the point's coordinates, for body axes in space along its velocity."""
        body = scope.body("body", self.body, turns=self.frame == "body", ground=False)
        if (self.force is None) == (self.potential is None):
            raise scope.error(
                "", "either the key force or the key potential", "neither" if self.force is None else "both"
            )
        if self.potential is not None and self.frame == "body":
            raise scope.error("frame", "'ground', as a potential is given", "'body'")
        point = scope.marker("at", body, self.at)
        for key, vector in (("force", self.force), ("potential", self.potential)):
            if vector is not None and len(vector) != scope.dimension:
                raise scope.error(key, f"{scope.dimension} components", value_in_words(vector))
        magnitudes = self._component_magnitudes(scope, body)
        turning = axes(body, 3) if scope.spatial and self.frame == "body" else None
        efforts = []
        for i, (label, axis) in enumerate(zip("xyz", axes(GROUND, scope.dimension), strict=False)):
            energy = ZERO if self.potential is None else scope.potential("potential", self.potential[i], {label: "s"})
            if magnitudes[i] != ZERO or energy != ZERO:
                origin = Marker(GROUND, (ZERO,) * scope.dimension)
                measure = Component(origin, point, axis) if turning is None else PointSpeed(point, turning[i])
                efforts.append(Effort(label, measure, magnitude=magnitudes[i], potential=energy))
        return Resolved(scope.name, scope.kind, (body,), tuple(efforts))

    def _component_magnitudes(self, scope: Scope, body: str) -> tuple[Expr, ...]:
        """Return the components in ground axes, in space in the selected axes."""
        if self.force is None:
            return (ZERO,) * scope.dimension
        components = tuple(scope.of_state("force", component) for component in self.force)
        if self.frame == "ground" or scope.spatial:
            return components
        x, y = components
        cosine, sine = call("cos", Name(f"{body}.theta")), call("sin", Name(f"{body}.theta"))
        return (
            sum_of_terms(product(x, cosine), product(call("neg", y), sine)),
            sum_of_terms(product(x, sine), product(y, cosine)),
        )


KIND = Force
