"""Forces of a robot: springs, dampers and actuators along joints, and along the lengths of tendons."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from symgen.describe.formats._names import DescriptionNames
from symgen.describe.formats._robot import GROUND, Connection, LeftOut, Robot, RobotActuator, RobotRange, RobotSpan

_ANGLE, _SLIDE = "angle", "displacement"
#: Share of the largest number of a vector or tensor below which a number is rounding.
ROUNDING = 1e-14


class Drives:
    """Forces along coordinates of joints and along spans, whose lengths are coordinates too.

    Parameters
    ----------
    robot : Robot
        The robot.
    names : DescriptionNames
        Names in the mechanism file.
    joints : mapping of str to Connection
        The joints that it has there.
    carriers : mapping of str to str
        Link -> the link whose body it belongs to.
    left_out : list of LeftOut
        What is left out; more is added.
    """

    def __init__(
        self,
        robot: Robot,
        names: DescriptionNames,
        joints: Mapping[str, Connection],
        carriers: Mapping[str, str],
        left_out: list[LeftOut],
    ) -> None:
        self.robot, self.names, self.joints, self.left_out = robot, names, joints, left_out
        self.carriers, self.spans = carriers, {span.name: span for span in robot.spans}

    @property
    def limited(self) -> list[RobotRange]:
        """The limits of sums of coordinates that the description has."""
        return [r for r in self.robot.ranges if self._is_known(r.weights)]

    def _is_known(self, weights: Mapping[str, float]) -> bool:
        return any(name in self.joints or name in self.spans for name in weights)

    def _is_stiff(self, name: str) -> bool:
        """Whether both ends of a span are on one body."""
        return name in self.spans and len({self.carriers[link] for link, _ in self.spans[name].ends}) == 1

    # -- coordinates

    def coordinate_text(self, name: str) -> str:
        """Return a coordinate of a joint, or the length of a span, as a formula."""
        if name in self.spans:
            return f"sqrt({' + '.join(f'{gap}**2' for gap in self._gaps(name, ''))})"
        label = _SLIDE if self.joints[name].kind == "translational" else _ANGLE
        return f"{self.names.name_for('joint', name)}.{label}"

    def rate_text(self, name: str) -> str:
        """Return the rate of a coordinate or of a length as a formula."""
        if name not in self.spans:
            return f"{self.coordinate_text(name)}.rate"
        pairs = zip(self._gaps(name, ""), self._gaps(name, "v"), strict=True)
        return "0.0" if self._is_stiff(name) else f"({' + '.join(map('*'.join, pairs))})/{self.coordinate_text(name)}"

    def _gaps(self, name: str, prefix: str) -> list[str]:
        """Return the differences of the ends of a span, or of their velocities, along the axes."""
        a, b = (self._end_texts(*end, prefix) for end in self.spans[name].ends)
        return [f"({y} - {x})" for x, y in zip(a, b, strict=True)]

    def _end_texts(self, link: str, point: str, prefix: str) -> list[str]:
        if self.carriers[link] != GROUND:
            owner = f"{self.body_name(link)}.{self.names.name_for('point', point)}"
            return [f"{owner}.{prefix}{axis}" for axis in "xyz"]
        return ["0.0"] * 3 if prefix else list(map(number_text, self._place(link, point)))

    def _place(self, link: str, point: str) -> list[float]:
        """Return a point of the ground in its frame."""
        own = self.robot.links[link] if link != GROUND else None
        at = self.robot.standing[point] if own is None else own.place.point_in_outer_frame(own.points[point])
        return tidy_numbers(at)

    def body_name(self, link: str) -> str:
        """Return the name of the body of a link."""
        top = self.carriers[link]
        return "ground" if top == GROUND else self.names.name_for("link", top)

    # -- tables

    def force_tables(self) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return the tables of forces, inputs and states."""
        efforts, inputs, states = dict[str, list[str]](), dict[str, Any](), dict[str, Any]()
        for actuator in self.robot.actuators:
            driven = {name: w for name, w in actuator.weights.items() if w and self._is_known({name: w})}
            if not driven:
                continue
            name = self.names.name_for("input", actuator.name)
            value = name
            if actuator.driven:
                inputs[name] = {"default": 0.0} | ({"unit": actuator.unit} if actuator.unit else {})
                value = self._bounded_text(name, actuator.bounds)
            if actuator.lag and actuator.driven:
                state = self.names.name_for("state", actuator.name)
                states[state] = {"rate": _rate_of_lag(actuator, state, value)}
                value = state
            for joint, text in self._actuator_formulas(actuator, driven, value).items():
                efforts.setdefault(joint, []).append(text)
        forces = dict[str, Any]()
        for name, c in self.joints.items():
            table: dict[str, Any] = {key: x for key, x in (("stiffness", c.stiffness), ("damping", c.damping)) if x}
            if c.kind not in ("revolute", "translational", "spherical"):
                if table:
                    what = "a spring or damper"
                    self.left_out.append(LeftOut(what, name, f"a {c.kind} joint has several coordinates", True))
                continue
            if name in efforts:
                table["actuator"] = " + ".join(efforts[name])
            if not table:
                continue
            straight = c.kind == "translational"
            if c.rest and c.stiffness and c.kind != "spherical":
                table["free_length" if straight else "free_angle"] = c.rest
            sort = "spring-damper" if straight else "torsional-spring-damper"
            forces[self.names.name_for("drive", name)] = {
                "type": sort,
                "joint": self.names.name_for("joint", name),
            } | table
        for name, span in self.spans.items():
            if name in efforts:
                forces[self.names.name_for("drive", name)] = self._span_table(span, " + ".join(efforts[name]))
        return forces, inputs, states

    @staticmethod
    def _bounded_text(value: str, bounds: tuple[float, float] | None) -> str:
        """Return a formula between bounds, if there are any."""
        return value if bounds is None else f"min(max({value}, {number_text(bounds[0])}), {number_text(bounds[1])})"

    def _actuator_formulas(self, actuator: RobotActuator, driven: dict[str, float], value: str) -> dict[str, str]:
        """Return joint -> formula of the effort of an actuator; `value` is the formula of its u."""
        terms = [value if actuator.gain == 1.0 else f"{number_text(actuator.gain)}*{value}"] if actuator.gain else []
        for factor, text in ((actuator.gain_along, self.coordinate_text), (actuator.gain_against, self.rate_text)):
            terms += [f"{number_text(factor * w)}*{text(n)}*{value}" for n, w in driven.items() if factor]
        if actuator.offset:
            terms.append(number_text(actuator.offset))
        if actuator.along and actuator.slack is not None:
            low, high = map(number_text, actuator.slack)
            length = self._sum_text(driven)
            terms.append(f"{number_text(actuator.along)}*(min({length} - {low}, 0) + max({length} - {high}, 0))")
        elif actuator.along:
            terms += [f"{number_text(actuator.along * w)}*{self.coordinate_text(n)}" for n, w in driven.items()]
        if actuator.against:
            terms += [f"{number_text(actuator.against * w)}*{self.rate_text(n)}" for n, w in driven.items()]
        whole = " + ".join(terms)
        if actuator.limits is not None:
            whole = self._bounded_text(whole, actuator.limits)
        elif len(terms) > 1:
            whole = f"({whole})"
        moved = {joint: w for joint, w in driven.items() if not self._is_stiff(joint)}
        return {joint: whole if w == 1.0 else f"{number_text(w)}*{whole}" for joint, w in moved.items()}

    def _sum_text(self, weights: Mapping[str, float]) -> str:
        """Return a weighted sum of coordinates as a formula."""
        return " + ".join(
            self.coordinate_text(n) if w == 1.0 else f"{number_text(w)}*{self.coordinate_text(n)}"
            for n, w in weights.items()
        )

    def _span_table(self, span: RobotSpan, effort: str) -> dict[str, Any]:
        """Return the table of an effort along a span."""
        at = [
            self._place(*end) if self.carriers[end[0]] == GROUND else self.names.name_for("point", end[1])
            for end in span.ends
        ]
        bodies = [self.body_name(link) for link, _ in span.ends]
        return {"type": "spring-damper", "between": bodies, "at": at, "actuator": effort}

    def stop_tables(self) -> dict[str, Any]:
        """Return stops that keep weighted sums of coordinates in their ranges."""
        stops = dict[str, Any]()
        for r in self.limited:
            own = {name: w for name, w in r.weights.items() if w and self._is_known({name: w})}
            gaps = {"lower": f"{self._sum_text(own)} - {number_text(r.lower)}"}
            gaps["upper"] = f"{number_text(r.upper)} - ({self._sum_text(own)})"
            for side, gap in gaps.items():
                stops[self.names.name_for("stop", f"{r.name}_{side}")] = {"gap": gap}
        return stops


def _rate_of_lag(actuator: RobotActuator, state: str, value: str) -> str:
    """Return the rate of the state between an input and what it drives."""
    if actuator.lag == "filter":
        return f"({value} - {state})/{number_text(actuator.time)}"
    if actuator.reach is None:
        return value
    low, high = map(number_text, actuator.reach)
    return f"0 if ({state} >= {high} and {value} > 0) or ({state} <= {low} and {value} < 0) else {value}"


def number_text(number: float) -> str:
    """Return a number as a factor or term of a formula."""
    return repr(number) if number >= 0.0 else f"({number!r})"


def tidy_numbers(vector: Iterable[float]) -> list[float]:
    """Return numbers in 15 digits; what is rounding beside the largest is 0."""
    numbers = [float(x) for x in vector]
    least = ROUNDING * max(map(abs, numbers))
    return [0.0 if abs(x) <= least else float(f"{x:.15g}") for x in numbers]


def names_with_count(names: list[str]) -> str:
    """Return some names and how many there are."""
    shown = ", ".join(names[:3])
    return shown if len(names) <= 3 else f"{shown} and {len(names) - 3} more"
