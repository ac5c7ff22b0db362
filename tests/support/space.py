"""Textbook kinematics and statics of a raw spatial description, written with rotation matrices of Euler parameters.

Nothing of symgen's markers, measures or derivation is used: each joint and force is evaluated from the keys of its
table as its documentation defines it, with NumPy arrays of real or complex numbers. Derivatives are complex steps along
q' = N v and, for second ones, central differences of sixth order along the exact motion of constant v.
"""

import math

import numpy as np

from support.plain import ALIASES, numbered
from support.space_bodies import GROUND, STEP, Bodies, angle_of, rotation, skew, triad, unit

__all__ = ["GROUND", "STEP", "Space", "angle_of", "rotation", "skew", "triad", "unit"]


class Space(Bodies):
    """A raw spatial description with numbers for its parameters: joints, forces, energies."""

    # -- joints --------------------------------------------------------------------------------------------------------

    def phi(self, t, q) -> dict:
        return {
            f"{name}.{label}": value
            for name, keys in self.raw.get("joints", {}).items()
            for label, value in self.joint(keys, t, q)[0]
        }

    def coordinates(self, q) -> dict:
        return {
            f"{name}.{label}": value
            for name, keys in self.raw.get("joints", {}).items()
            for label, value in self.joint(keys, 0.0, q)[1]
        }

    def joint(self, keys, t, q):
        """(rows, coordinates), each as (label, value), of one joint."""
        kind = ALIASES.get(keys["type"], keys["type"])
        rows = getattr(self, f"_{kind.replace('-', '_')}", None)
        if rows is not None:
            return rows(keys, t, q), []
        a, b = keys["between"]
        if kind == "perpendicular":
            one, other = (self.direction(*pair, q) for pair in zip((a, b), keys["axes"], strict=True))
            return [("cross", one @ other)], []
        if kind in ("orientation", "parallel-axes"):
            keys = keys | {"at": [(0.0,) * 3 if body == GROUND else "centre" for body in (a, b)]}  # of no meaning
        ends = self.point(a, keys["at"][0], q), self.point(b, keys["at"][1], q)
        gap = ends[1] - ends[0]
        if kind == "place":
            return [], [*zip("xyz", self.matrix(a, q).T @ gap, strict=True)]
        axes = keys.get("axis", keys.get("normal", keys.get("axes")))
        if kind in ("spherical", "distance"):
            length = self.number(keys.get("length", 1.0))
            stretch = [("distance", (gap @ gap - length**2) / (2 * length))]
            return (stretch if kind == "distance" else [*zip("xyz", gap, strict=True)]), []
        if kind in ("pin-in-slot", "point-on-plane"):
            one, two, three = (self.matrix(b, q) @ triad(axes)).T
            if kind == "pin-in-slot":
                return [("across1", one @ gap), ("across2", two @ gap)], [("displacement", -three @ gap)]
            return [("normal", three @ gap)], [("displacement1", -one @ gap), ("displacement2", -two @ gap)]
        if kind == "revolute-spherical":
            one, two, three = (self.matrix(a, q) @ triad(axes, keys.get("reference"))).T
            length = self.number(keys["length"])
            rows = [("along", three @ gap), ("distance", (gap @ gap - length**2) / (2 * length))]
            return rows, [("angle", angle_of(two @ gap, one @ gap))]
        u, w = (self.matrix(x, q) @ triad(axes[i], keys["reference"][i]) for i, x in enumerate((a, b)))
        r, local = u.T @ w, u.T @ gap
        tilt = [("first", -r[1, 2]), ("second", r[0, 2])]
        turn = ("angle", angle_of(r[1, 0], r[0, 0]))
        along, across = ("displacement", local[2]), [("across1", local[0]), ("across2", local[1])]
        together = [*zip("xyz", gap, strict=True)]
        if kind == "screw":
            advance = self.number(keys["pitch"]) * turn[1] / (2 * math.pi) + self.number(keys.get("offset", 0.0))
            return [*across, *tilt, ("screw", local[2] - advance)], [along, turn]
        if kind == "planar":
            return [("normal", local[2]), *tilt], [("displacement1", local[0]), ("displacement2", local[1]), turn]
        if kind == "universal":
            angles = angle_of(r[1, 2], r[0, 2]), -angle_of(r[2, 1], r[2, 0])
            return [*together, ("cross", r[2, 2])], [("angle1", angles[0]), ("angle2", angles[1])]
        return {
            "revolute": ([*together, *tilt], [turn]),
            "cylindrical": ([*across, *tilt], [along, turn]),
            "translational": ([*across, *tilt, ("angle", r[1, 0])], [along]),
            "rigid": ([*together, *tilt, ("angle", r[1, 0])], []),
            "orientation": ([*tilt, ("angle", r[1, 0])], []),
            "parallel-axes": (tilt, [turn]),
            "constant-velocity": ([*together, ("twist", (r[1, 0] - r[0, 1]) / 2)], []),
        }[kind]

    def _reported(self, name, label, q):
        return dict(self.joint(self.raw["joints"][name], 0.0, q)[1])[label]

    def _rows(self, keys, t, q):
        rest = np.zeros(self.nv)
        return [(n, self.of_state(row["position"], t, q, rest)) for n, row in numbered(keys) if "position" in row]

    def _coupling(self, keys, t, q):
        def coordinate(name):
            return self._reported(*name.split("."), q)

        total = sum(self.number(factor) * coordinate(name) for name, factor in keys["terms"].items())
        powers = enumerate(keys.get("polynomial", ()))
        total -= sum(self.number(c) * coordinate(keys["of"]) ** k for k, c in powers)
        return [("coupling", total - self.number(keys["value"], t=t))]

    def _driver(self, keys, t, q):
        if "joint" in keys:
            value = self._reported(keys["joint"], keys["coordinate"], q)
        else:
            value = self.point(keys["body"], keys.get("point", "centre"), q)["xyz".index(keys["coordinate"])]
        return [("driver", value - self.number(keys["value"], t=t))]

    def _gear(self, keys, t, q):
        first, second = self.vector(keys["radii"]) if "radii" in keys else (1.0, self.number(keys["ratio"]))
        sense = -1.0 if keys.get("mesh") == "internal" else 1.0
        a, b = (self._reported(*pair, q) for pair in zip(keys["joints"], keys["coordinates"], strict=True))
        return [("mesh", first * a + sense * second * b - self.number(keys.get("offset", 0.0)))]

    def _rack_and_pinion(self, keys, t, q):
        turn = self._reported(keys["pinion"], keys["coordinates"][0], q)
        way = self._reported(keys["rack"], keys["coordinates"][1], q)
        return [("mesh", way - self.number(keys["radius"]) * turn - self.number(keys.get("offset", 0.0)))]

    def _contact(self, keys, q):
        """From the centre of a rolling body to its lowest point."""
        up = unit(keys["normal"])
        if keys["type"] == "rolling-sphere":
            return -self.number(keys["radius"]) * up
        axis = self.direction(keys["body"], keys["axis"], q)
        uphill = up - (up @ axis) * axis
        return -self.number(keys["radius"]) * uphill / np.sqrt(uphill @ uphill)

    def _rolling_disc(self, keys, t, q):
        lowest = self.point(keys["body"], keys.get("centre", "centre"), q) + self._contact(keys, q)
        return [("normal", -(unit(keys["normal"]) @ (lowest - self.vector(keys.get("on", (0.0, 0.0, 0.0))))))]

    _rolling_sphere = _rolling_disc

    def _knife_edge(self, keys, t, q):
        height = self.point(keys["body"], keys.get("at", "centre"), q) - self.vector(keys.get("on", (0.0, 0.0, 0.0)))
        return [("normal", -(unit(keys["normal"]) @ height))]

    def slips(self, t, q, v) -> dict:
        """Residuals of nonholonomic conditions by row name."""
        result = {}
        for name, keys in self.raw.get("joints", {}).items():
            if keys["type"] in ("rolling-disc", "rolling-sphere"):
                centre = self.velocity(keys["body"], keys.get("centre", "centre"), q, v)
                slip = centre + np.cross(self.spin(keys["body"], q, v), self._contact(keys, q))
                one, two, _ = triad(keys["normal"], keys.get("reference")).T
                result |= {f"{name}.slip1": -one @ slip, f"{name}.slip2": -two @ slip}
            elif keys["type"] == "knife-edge":
                heading = self.direction(keys["body"], keys["axis"], q)
                left = np.cross(unit(keys["normal"]), heading)
                speed = self.velocity(keys["body"], keys.get("at", "centre"), q, v)
                result[f"{name}.side"] = -(left @ speed) / np.sqrt(left @ left)
            elif keys["type"] == "rows":
                rows = {n: row["velocity"] for n, row in numbered(keys) if "velocity" in row}
                result |= {f"{name}.{n}": self.of_state(row, t, q, v) for n, row in rows.items()}
        return result

    # -- derivatives ---------------------------------------------------------------------------------------------------

    def rate(self, t, q, v) -> dict:
        """Phi_q N v + Phi_t by a complex step, and the nonholonomic residuals."""
        step = 1j * STEP
        moved = self.phi(t + step, np.asarray(q) + step * self.rates(q, v))
        return {n: np.imag(x) / STEP for n, x in moved.items()} | self.slips(t, q, v)

    def jacobian(self, t, q, v) -> dict:
        """Rows of D; velocities enter linearly."""
        still = self.rate(t, q, np.zeros(self.nv))
        columns = [self.rate(t, q, column) for column in np.eye(self.nv)]
        return {n: np.array([c[n] - still[n] for c in columns]) for n in still}

    def nu(self, t, q) -> dict:
        return {n: -x for n, x in self.rate(t, q, np.zeros(self.nv)).items()}

    def gamma(self, t, q, v) -> dict:
        """-(rate)' along the motion of constant velocities: (value, bound of its error) by row name."""
        coarse, fine = (self._gamma(t, q, v, h) for h in (4e-3, 2e-3))
        return {n: (x, abs(x - coarse[n])) for n, x in fine.items()}

    def _gamma(self, t, q, v, h) -> dict:
        """By differences of sixth order."""
        weights = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
        ends = {
            k: (self.rate(t + k * h, self.moved(q, v, k * h), v), self.rate(t - k * h, self.moved(q, v, -k * h), v))
            for k in weights
        }
        names = ends[1][0]
        return {n: -sum(w * (ends[k][0][n] - ends[k][1][n]) for k, w in weights.items()) / h for n in names}

    # -- forces and energies -------------------------------------------------------------------------------------------

    def slope(self, text, **names):
        (name, value) = next(iter(names.items()))
        return np.imag(self.number(text, **{name: value + 1j * STEP})) / STEP

    def loads(self, t, q, v):
        """(body, force, torque, point, conservative), in ground axes, of every applied load but gravity."""
        for keys in self.raw.get("forces", {}).values():
            yield from getattr(self, f"_{keys['type'].replace('-', '_')}_loads")(keys, t, q, v)

    def _force_loads(self, keys, t, q, v):
        body, at = keys["body"], keys.get("at", "centre")
        if "potential" in keys:
            where = zip("xyz", self.point(body, at, q), keys["potential"], strict=True)
            yield body, np.array([-self.slope(text, **{n: x}) for n, x, text in where]), np.zeros(3), at, True
            return
        pull = np.array([self.of_state(e, t, q, v) for e in keys["force"]])
        if keys.get("frame") == "body":
            pull = self.matrix(body, q) @ pull
        yield body, pull, np.zeros(3), at, False

    def _torque_loads(self, keys, t, q, v):
        if "joint" in keys:
            yield from self._turning(keys, "torque", t, q, v)
            return
        torque = np.array([self.of_state(e, t, q, v) for e in keys["torque"]])
        if keys.get("frame") == "body":
            torque = self.matrix(keys["body"], q) @ torque
        yield keys["body"], np.zeros(3), torque, "centre", False
        yield keys.get("reaction", GROUND), np.zeros(3), -torque, "centre", False

    def _turning(self, keys, word, t, q, v):
        """Torques of a revolute or cylindrical joint's angle: along its axis, as its rows hold the axes parallel.

        Off the constraints the work along the angle decides: the gradient of the angle by body rotations.
        """
        joint = self.raw["joints"][keys["joint"]]
        turn = self._reported(keys["joint"], keys["coordinate"], q)
        gradient = self._angle_gradient(keys, q)
        rate = gradient @ np.asarray(v)
        kept = -self.number(keys.get("stiffness", 0.0)) * (turn - self.number(keys.get("free_angle", 0.0)))
        kept -= self.slope(keys["potential"], angle=turn) if "potential" in keys else 0.0
        lost = self.of_state(keys.get(word, 0.0), t, q, v, angle=turn, rate=rate)
        lost -= self.number(keys.get("damping", 0.0)) * rate
        for body in joint["between"]:
            if body != GROUND:
                j = self.first_v[body]
                # the generalised torque in body axes, turned to ground axes; the length of e cancels
                back = np.linalg.inv(self.matrix(body, q)).T
                assert not np.any(gradient[j : j + 3]), "the angles tried do not depend on positions"
                for size, conservative in ((kept, True), (lost, False)):
                    yield body, np.zeros(3), back @ (size * gradient[j + 3 : j + 6]), "centre", conservative

    def _angle_gradient(self, keys, q):
        columns = [np.asarray(q) + 1j * STEP * self.rates(q, column) for column in np.eye(self.nv)]
        turns = [self._reported(keys["joint"], keys["coordinate"], moved) for moved in columns]
        return np.imag(turns) / STEP

    def _torsional_spring_damper_loads(self, keys, t, q, v):
        return self._turning(keys, "actuator", t, q, v)

    def _spring_damper_loads(self, keys, t, q, v):
        (a, b), (end_a, end_b) = keys["between"], keys["at"]
        gap = self.point(b, end_b, q) - self.point(a, end_a, q)
        length = np.sqrt(gap @ gap)
        rate = gap @ (self.velocity(b, end_b, q, v) - self.velocity(a, end_a, q, v)) / length
        kept = -self.number(keys.get("stiffness", 0.0)) * (length - self.number(keys.get("free_length", 0.0)))
        kept -= self.slope(keys["potential"], length=length) if "potential" in keys else 0.0
        lost = self.of_state(keys.get("actuator", 0.0), t, q, v, length=length, rate=rate)
        lost -= self.number(keys.get("damping", 0.0)) * rate
        for size, conservative in ((kept, True), (lost, False)):
            yield b, size * gap / length, np.zeros(3), end_b, conservative
            yield a, -size * gap / length, np.zeros(3), end_a, conservative

    def _strain(self, keys, q):
        """The six displacements of a bushing."""
        (a, b), (end_a, end_b) = keys["between"], keys["at"]
        u, w = (self.matrix(x, q) @ triad(keys["axis"][i], keys["reference"][i]) for i, x in enumerate((a, b)))
        r = u.T @ w
        turns = (r[2, 1] - r[1, 2]) / 2, (r[0, 2] - r[2, 0]) / 2, (r[1, 0] - r[0, 1]) / 2
        return np.array([*(u.T @ (self.point(b, end_b, q) - self.point(a, end_a, q))), *turns])

    def six(self, keys, key):
        given = keys.get(key, (0.0,) * 6)
        whole = isinstance(given[0], list | tuple)
        return np.array([self.vector(row) for row in given]) if whole else np.diag(self.vector(given))

    def _bushing_loads(self, keys, t, q, v):
        """Nothing: its generalised force is a gradient, see `applied`."""
        return iter(())

    def _bushing_force(self, keys, q, v):
        """-(du/dv)^T (K u, C u') with du/dv by complex steps."""
        columns = [np.asarray(q) + 1j * STEP * self.rates(q, column) for column in np.eye(self.nv)]
        gradient = np.array([np.imag(self._strain(keys, moved)) / STEP for moved in columns])  # nv x 6
        rate = gradient.T @ np.asarray(v)
        lost = -self.six(keys, "damping") @ rate
        return -gradient @ (self.six(keys, "stiffness") @ self._strain(keys, q)), gradient @ lost, lost @ rate

    def inertia(self, body):
        keys = self.bodies[body]["inertia"]
        xx, yy, zz, xy, xz, yz = [self.number(e) for e in keys] + [0.0] * (6 - len(keys))
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def mass(self):
        """M, dense."""
        m = np.zeros((self.nv, self.nv))
        for body, j in self.first_v.items():
            m[j : j + 3, j : j + 3] = self.number(self.bodies[body]["mass"]) * np.eye(3)
            if self.turns(body):
                m[j + 3 : j + 6, j + 3 : j + 6] = self.inertia(body)
        return m

    def applied(self, t, q, v):
        """f by virtual power with gravity and gyroscopic terms; and the power of what has no potential."""
        f, power = np.zeros(self.nv), 0.0
        gravity = self.vector(self.raw["mechanism"].get("gravity", (0.0, 0.0, 0.0)))
        for body, j in self.first_v.items():
            f[j : j + 3] += self.number(self.bodies[body]["mass"]) * gravity
            if self.turns(body):
                omega = np.asarray(v[j + 3 : j + 6])
                f[j + 3 : j + 6] -= np.cross(omega, self.inertia(body) @ omega)
        for body, force, torque, at, conservative in self.loads(t, q, v):
            if body == GROUND:
                continue
            j = self.first_v[body]
            f[j : j + 3] += force
            if self.turns(body):
                f[j + 3 : j + 6] += self.matrix(body, q).T @ (torque + np.cross(self.arm(body, at, q), force))
            if not conservative:
                power += force @ self.velocity(body, at, q, v) + torque @ self.spin(body, q, v)
        for keys in self.raw.get("forces", {}).values():
            if keys["type"] == "bushing":
                kept, lost, drawn = self._bushing_force(keys, q, v)
                f, power = f + kept + lost, power + drawn
        return f, power

    def potential(self, q):
        """Potential energy of springs, of given potentials and of gravity."""
        gravity = self.vector(self.raw["mechanism"].get("gravity", (0.0, 0.0, 0.0)))
        total = 0.0
        for body in self.bodies:
            total -= self.number(self.bodies[body]["mass"]) * (gravity @ self.centre(body, q))
        for keys in self.raw.get("forces", {}).values():
            if keys["type"] == "bushing":
                u = self._strain(keys, q)
                total += u @ self.six(keys, "stiffness") @ u / 2
            elif keys["type"] == "force":
                if "potential" in keys:
                    where = zip(
                        "xyz", self.point(keys["body"], keys.get("at", "centre"), q), keys["potential"], strict=True
                    )
                    total += sum(self.number(text, **{n: x}) for n, x, text in where)
            elif "joint" in keys or keys["type"] == "spring-damper":
                word, free = ("angle", "free_angle") if "joint" in keys else ("length", "free_length")
                if "joint" in keys:
                    s = self._reported(keys["joint"], keys["coordinate"], q)
                else:
                    (a, b), (end_a, end_b) = keys["between"], keys["at"]
                    gap = self.point(b, end_b, q) - self.point(a, end_a, q)
                    s = np.sqrt(gap @ gap)
                total += self.number(keys.get("stiffness", 0.0)) * (s - self.number(keys.get(free, 0.0))) ** 2 / 2
                total += self.number(keys["potential"], **{word: s}) if "potential" in keys else 0.0
        return total

    def potential_rate(self, q, v):
        """dV/dt along the motion by a complex step."""
        return np.imag(self.potential(np.asarray(q) + 1j * STEP * self.rates(q, v))) / STEP
