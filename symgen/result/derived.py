"""Tables that follow from a motion, whatever it was found by, worked out when they are first asked for."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from symgen.result.labelled import Labelled

if TYPE_CHECKING:
    from symgen.result.measured import Measured
    from symgen.result.reactions import Forces


class OfForces:
    """Multipliers and reactions by `forces`."""

    forces: Forces

    @cached_property
    def lam(self) -> Labelled:
        """Multipliers; where constraints are redundant, those of minimum norm."""
        return self.forces.multipliers()

    @cached_property
    def reactions(self) -> Labelled:
        """Reaction of each joint on its first body: ``JOINT.Fx``, ``JOINT.Fy`` [N], ``JOINT.M`` [N m].

        In space ``JOINT.Fx`` ... ``.Fz`` and ``JOINT.Mx`` ... ``.Mz``, all in ground axes. ``-D^T lambda`` of the
        joint's rows; moments are about the joint's own point on that body, and where a kind of joint has none about
        the body's centre of mass, on the ground about the origin.
        """
        return self.forces.reactions(self.lam)

    @cached_property
    def magnitudes(self) -> Labelled:
        """Magnitudes of the reactions: ``JOINT.F`` [N] and, in space, ``JOINT.T`` [N m] of their moments."""
        return self.forces.magnitudes(self.reactions)

    @cached_property
    def non_unique_reactions(self) -> tuple[str, ...]:
        """Joints whose reactions the motion does not determine, because constraints are redundant."""
        return self.forces.non_unique


class Derived(OfForces):
    """What joints report, and by `measured` the quantities that a file names."""

    measured: Measured

    @cached_property
    def joint_coordinates(self) -> Labelled:
        """What joints report, each followed by its rate: ``JOINT.angle``, ``JOINT.angle.rate``."""
        motion = self.measured.outcome
        quantities = motion.compiled.info.joint_coordinates
        names = tuple(name for q in quantities for name in (q.name, f"{q.name}.rate"))
        units = tuple(unit for q in quantities for unit in (q.unit, f"{q.unit}/s"))
        return Labelled(motion.joint_coordinates, names, units)

    @cached_property
    def points(self) -> Labelled:
        """Named points of bodies in the ground frame: ``arm.tip.x``, ``.vx``, ``.ax``, ..."""
        return self.measured.table("points")

    @cached_property
    def elements(self) -> Labelled:
        """Force elements and drivers: ``spring.length``, ``.rate``, ``.force``, ``.power``; ``motor.effort``, ..."""
        return self.measured.table("elements")

    @cached_property
    def outputs(self) -> Labelled:
        """The formulas of the file's ``[outputs]``; integrals are left out where nothing is integrated."""
        return self.measured.table("outputs")
