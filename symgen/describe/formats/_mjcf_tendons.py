"""Tendons of a compiled MJCF model: sums of coordinates, and straight ways through sites, with pulleys."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symgen.describe.formats._robot import GROUND, Connection, LeftOut, RobotActuator, RobotRange, RobotSpan

#: Names an object of the model: its sort, and its number.
Naming = Callable[[str, int], str]


class MjcfTendons:
    """Reads tendons.

    Parameters
    ----------
    mujoco, model
        The package, and a compiled model.
    name : callable
        Names objects.
    is_disabled : callable
        Whether a flag of the model switches something off.
    """

    def __init__(self, mujoco: Any, model: Any, name: Naming, is_disabled: Callable[[str], bool]) -> None:
        self.mujoco, self.model, self.name, self.is_disabled = mujoco, model, name, is_disabled
        self.spans = list[RobotSpan]()
        self.left_out = list[LeftOut]()
        self.weights = [self._read_way(i) for i in range(model.ntendon)]

    def _read_way(self, i: int) -> dict[str, float]:
        """Return coordinate or span -> its part of the length; empty where the way wraps geoms."""
        model, sorts = self.model, self.mujoco.mjtWrap
        weights, divisor, last = dict[str, float](), 1.0, -1
        first = int(model.tendon_adr[i])
        kinds = [int(model.wrap_type[w]) for w in range(first, first + int(model.tendon_num[i]))]
        if not {*kinds} <= {int(sorts.mjWRAP_JOINT), int(sorts.mjWRAP_SITE), int(sorts.mjWRAP_PULLEY)}:
            why = "its way wraps round geoms, where symgen has straight lines"
            self.left_out.append(LeftOut("a tendon", self.name("tendon", i), why, True))
            return {}
        for w, kind in enumerate(kinds, first):
            if kind == int(sorts.mjWRAP_JOINT):
                joint = self.name("joint", int(model.wrap_objid[w]))
                weights[joint] = weights.get(joint, 0.0) + float(model.wrap_prm[w])
            elif kind == int(sorts.mjWRAP_PULLEY):
                divisor, last = float(model.wrap_prm[w]), -1
            else:
                site = int(model.wrap_objid[w])
                if last >= 0:
                    span = RobotSpan(f"{self.name('tendon', i)}_{len(weights) + 1}", (self._end(last), self._end(site)))
                    self.spans.append(span)
                    weights[span.name] = 1.0 / divisor
                last = site
        return weights

    def _end(self, site: int) -> tuple[str, str]:
        """Return the link and the name of a site."""
        body = int(self.model.site_bodyid[site])
        return GROUND if body == 0 else self.name("body", body), self.name("site", site)

    def springs(self) -> list[RobotActuator]:
        """Return springs and dampers of tendons, as efforts without inputs."""
        model, springs = self.model, list[RobotActuator]()
        for i, weights in enumerate(self.weights):
            stiffness = 0.0 if self.is_disabled("SPRING") else float(model.tendon_stiffness[i])
            damping = 0.0 if self.is_disabled("DAMPER") else float(model.tendon_damping[i])
            if weights and (stiffness or damping):
                low, high = (float(x) for x in model.tendon_lengthspring[i])
                name, slack = f"{self.name('tendon', i)}_spring", (low, high) if low != high else None
                offset = 0.0 if slack else stiffness * low
                springs.append(RobotActuator(name, weights, 0.0, offset, -stiffness, -damping, slack=slack))
        return springs

    def ranges(self) -> list[RobotRange]:
        """Return the limits of lengths."""
        model = self.model
        return [
            RobotRange(self.name("tendon", i), weights, *(float(x) for x in model.tendon_range[i]))
            for i, weights in enumerate(self.weights)
            if weights and model.tendon_limited[i]
        ]

    def add_to_joints(self, connections: list[Connection]) -> None:
        """Give friction and armature of tendons along one coordinate to its joint; list the other tendons."""
        by_name, others = {c.name: c for c in connections}, list[str]()
        for i, weights in enumerate(self.weights):
            friction, armature = float(self.model.tendon_frictionloss[i]), float(self.model.tendon_armature[i])
            ((name, factor), *more) = weights.items() or [("", 0.0)]
            if not friction and not armature:
                continue
            if more or name not in by_name:
                others.append(self.name("tendon", i))
            else:
                by_name[name].friction += abs(factor) * friction
                by_name[name].rotor += factor**2 * armature
        if others:
            why = "a length that several coordinates make has neither here"
            self.left_out.append(LeftOut("friction and armature of tendons", ", ".join(others), why, True))
