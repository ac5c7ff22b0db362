"""MJCF: MuJoCo's format, read by MuJoCo's compiler, so that defaults, frames, includes and inertias are its own."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

from symgen.base.errors import InputError, quote
from symgen.describe.formats._mjcf_contacts import MjcfContacts
from symgen.describe.formats._mjcf_files import MjcfMeshes, check_files
from symgen.describe.formats._mjcf_tendons import MjcfTendons
from symgen.describe.formats._poses import Matrix, Pose, Vector, rotation_from_quaternion
from symgen.describe.formats._robot import (
    GROUND,
    Connection,
    CoupledCoordinate,
    Kind,
    LeftOut,
    Robot,
    RobotActuator,
    RobotLink,
    rotate_inertia,
)
from symgen.describe.formats._xml import read_tree

#: Last of the groups of shapes that MuJoCo shows; what collides is in later ones.
_LAST_SEEN = 2


class Mjcf:
    """Reads the compiled model: bodies, joints, equalities, tendons, actuators on joints and tendons, sites."""

    SUFFIXES: ClassVar[tuple[str, ...]] = (".mjcf", ".xml")
    ROOT: ClassVar[str] = "mujoco"

    @staticmethod
    def read(path: Path, floating: bool) -> Robot:
        """Return the robot of a file; a body without joints at the top is part of the ground, as in MuJoCo."""
        tree = read_tree(path, "mujoco")
        check_files(path, tree)
        try:
            import mujoco
        except ImportError:
            hint = "pip install symgen[import]"
            raise InputError(path.name, "MuJoCo's compiler, which reads MJCF", "no package 'mujoco'", hint) from None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # advice to the author of the file
                spec = mujoco.MjSpec.from_file(str(path.resolve()))  # as the files beside it were checked
                model = spec.compile()
        except (ValueError, RuntimeError) as error:
            slip = " ".join(str(error).replace(str(path.resolve().parent), ".").split())
            raise InputError(path.name, "a file that MuJoCo compiles", quote(slip)) from None
        name = tree.get("model", path.stem)
        return _Reader(mujoco, model, path.name, name, MjcfMeshes(spec, model, path.parent)).robot()


class _Reader:
    """The robot of a compiled model."""

    def __init__(self, mujoco: Any, model: Any, source: str, name: str, meshes: MjcfMeshes) -> None:
        self.mujoco, self.model, self.source, self.name = mujoco, model, source, name
        self.data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, self.data)
        self.left_out, self.meshes = list[LeftOut](), meshes
        self.connections, self.led = list[Connection](), dict[int, Connection]()
        self.touching = MjcfContacts(mujoco, model, self._is_disabled("CONTACT"))
        self.tendons = MjcfTendons(mujoco, model, self._name_of_object, self._is_disabled)

    def _name_of_object(self, sort: str, number: int) -> str:
        name = self.mujoco.mj_id2name(self.model, getattr(self.mujoco.mjtObj, f"mjOBJ_{sort.upper()}"), number)
        return name or f"{sort}{number}"

    def robot(self) -> Robot:
        model = self.model
        links = {self._name_of_object("body", i): self._read_link(i) for i in range(1, model.nbody)}
        for i in range(1, model.nbody):
            self._add_joints_of_body(i, links)
        followers = self._read_equalities()
        actuators = [a for i in range(model.nu) if (a := self._read_actuator(i)) is not None]
        actuators += self.tendons.springs()
        self.tendons.add_to_joints(self.connections)
        self._list_left_out()
        gravity = (0.0, 0.0, 0.0) if self._is_disabled("GRAVITY") else _as_vector(model.opt.gravity)
        return Robot(
            self.name,
            links,
            self.connections,
            followers,
            actuators,
            gravity,
            self.left_out,
            self.meshes.folder,
            self.tendons.spans,
            self.tendons.ranges(),
            self._sites_of_body(0),
            self.touching.of_ground(),
            self.touching.count(),
        )

    def _is_disabled(self, flag: str) -> bool:
        return bool(int(self.model.opt.disableflags) & int(getattr(self.mujoco.mjtDisableBit, f"mjDSBL_{flag}")))

    # -- bodies ------------------------------------------------------------------------------------------------------

    def _frame_of_body(self, body: int) -> Pose:
        return Pose(_as_vector(self.data.xpos[body]), rotation_from_quaternion(self.data.xquat[body].tolist()))

    def _read_link(self, i: int) -> RobotLink:
        model = self.model
        x, y, z = _as_vector(model.body_inertia[i])
        principal: Matrix = ((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z))
        link = RobotLink(
            self._name_of_object("body", i),
            self._frame_of_body(i),
            float(model.body_mass[i]),
            _as_vector(model.body_ipos[i]),
        )
        link.inertia = rotate_inertia(principal, rotation_from_quaternion(model.body_iquat[i].tolist()))
        link.points, link.touching = self._sites_of_body(i), self.touching.shapes(i)
        link.shapes = [s for k in self._read_looks(i) for s in self._read_geom(k)]
        return link

    def _sites_of_body(self, i: int) -> dict[str, Vector]:
        model = self.model
        sites = [k for k in range(model.nsite) if model.site_bodyid[k] == i]
        return {self._name_of_object("site", k): _as_vector(model.site_pos[k]) for k in sites}

    def _read_looks(self, i: int) -> list[int]:
        """Return the geoms of a body that MuJoCo shows; those that collide are hidden by meshes for the eye."""
        model = self.model
        geoms = [k for k in range(model.ngeom) if model.geom_bodyid[k] == i]
        seen = [k for k in geoms if model.geom_group[k] <= _LAST_SEEN] or geoms
        idle = [k for k in seen if not model.geom_contype[k] and not model.geom_conaffinity[k]]
        mesh = int(self.mujoco.mjtGeom.mjGEOM_MESH)
        return idle if any(int(model.geom_type[k]) == mesh for k in idle) else seen

    def _read_geom(self, k: int) -> list[dict[str, Any]]:
        model, sorts = self.model, self.mujoco.mjtGeom
        frame = Pose(_as_vector(model.geom_pos[k]), rotation_from_quaternion(model.geom_quat[k].tolist()))
        a, b, c = _as_vector(model.geom_size[k])
        red, green, blue = (f"{round(255 * min(max(x, 0.0), 1.0)):02x}" for x in model.geom_rgba[k].tolist()[:3])
        look: dict[str, Any] = {"frame": frame, "colour": f"#{red}{green}{blue}"}
        sort = int(model.geom_type[k])
        if sort == int(sorts.mjGEOM_BOX):
            return [look | {"type": "box", "size": (2.0 * a, 2.0 * b, 2.0 * c)}]
        if sort == int(sorts.mjGEOM_SPHERE):
            return [look | {"type": "sphere", "radius": a}]
        if sort in (int(sorts.mjGEOM_CYLINDER), int(sorts.mjGEOM_CAPSULE)):
            return [look | {"type": "cylinder", "radius": a, "length": 2.0 * b}]
        if sort == int(sorts.mjGEOM_MESH):
            mesh = self.meshes.shape(int(model.geom_dataid[k]), frame)
            return [] if mesh is None else [look | mesh]
        return []

    # -- joints ------------------------------------------------------------------------------------------------------

    def _add_joints_of_body(self, i: int, links: dict[str, RobotLink]) -> None:
        """Add the joints of a body, with links without mass between several of them."""
        model = self.model
        child, above = self._name_of_object("body", i), int(model.body_parentid[i])
        parent = GROUND if above == 0 else self._name_of_object("body", above)
        numbers = range(int(model.body_jntadr[i]), int(model.body_jntadr[i]) + int(model.body_jntnum[i]))
        if not numbers:
            if int(model.body_mocapid[i]) >= 0:
                self.left_out.append(LeftOut("a mocap body", child, "nothing moves it", True))
            self.connections.append(Connection(f"{child}_fixed", "fixed", parent, child))
            return
        for k in numbers:
            last = k == numbers[-1]
            below = child if last else f"{child}_{self._name_of_object('joint', k)}"
            if not last:
                links[below] = RobotLink(below, links[child].place)
            connection = self._read_joint(k, parent, below, links[child].place)
            if connection is not None:
                self.connections.append(connection)
                self.led[k] = connection
            parent = below

    def _read_joint(self, k: int, parent: str, child: str, place: Pose) -> Connection | None:
        model, sorts = self.model, self.mujoco.mjtJoint
        sort, dof, at = int(model.jnt_type[k]), int(model.jnt_dofadr[k]), int(model.jnt_qposadr[k])
        name = self._name_of_object("joint", k)
        damping, friction = float(model.dof_damping[dof]), float(model.dof_frictionloss[dof])
        if sort == int(sorts.mjJNT_FREE):
            if damping or friction or float(model.dof_armature[dof]):
                why = "a free body has no joint to act along"
                self.left_out.append(LeftOut("damping, friction or armature of a free body", name, why, True))
            return None
        kind: Kind = "revolute" if sort == int(sorts.mjJNT_HINGE) else "translational"
        if sort == int(sorts.mjJNT_BALL):
            kind = "spherical"
            for what, value in (("friction", friction), ("armature", float(model.dof_armature[dof]))):
                if value:
                    self.left_out.append(LeftOut(what, name, "a ball joint has three directions", True))
        frame = Pose(_as_vector(self.data.xanchor[k]), place.rotation)
        c = Connection(name, kind, parent, child, frame, axis=_as_vector(model.jnt_axis[k]))
        c.damping = 0.0 if self._is_disabled("DAMPER") else damping
        c.stiffness = 0.0 if self._is_disabled("SPRING") else float(model.jnt_stiffness[k])
        if kind != "spherical":
            c.value, c.rest = float(model.qpos0[at]), float(model.qpos_spring[at])
            c.friction, c.rotor = friction, float(model.dof_armature[dof])
        if model.jnt_limited[k]:
            c.lower, c.upper = (float(x) for x in model.jnt_range[k])
        return c

    # -- equalities --------------------------------------------------------------------------------------------------

    def _read_equalities(self) -> list[CoupledCoordinate]:
        followers, sorts = list[CoupledCoordinate](), self.mujoco.mjtEq
        for k in range(self.model.neq):
            sort, name = int(self.model.eq_type[k]), self._name_of_object("equality", k)
            if not self.model.eq_active0[k]:
                self.left_out.append(LeftOut("an equality", name, "it is not active", False))
            elif sort in (int(sorts.mjEQ_CONNECT), int(sorts.mjEQ_WELD)):
                self._add_tie(k, name, sort == int(sorts.mjEQ_WELD))
            elif sort == int(sorts.mjEQ_JOINT):
                followers.append(self._read_polynomial(k, name))
            else:
                self.left_out.append(LeftOut("an equality", name, "it is neither connect, weld nor joint", True))
        return followers

    def _add_tie(self, k: int, name: str, weld: bool) -> None:
        """Add a ball joint or a weld between two bodies, or between the bodies of two sites."""
        model, data = self.model, self.model.eq_data[k].tolist()
        ends = [int(model.eq_obj1id[k]), int(model.eq_obj2id[k])]
        if int(model.eq_objtype[k]) == int(self.mujoco.mjtObj.mjOBJ_SITE):
            local = [
                Pose(_as_vector(model.site_pos[s]), rotation_from_quaternion(model.site_quat[s].tolist())) for s in ends
            ]
            ends = [int(model.site_bodyid[s]) for s in ends]
        elif weld:
            relative = Pose((data[3], data[4], data[5]), rotation_from_quaternion(data[6:10]))
            anchor = Pose((data[0], data[1], data[2]))
            local = [relative @ anchor, anchor]
        else:
            local = [Pose((data[0], data[1], data[2])), Pose((data[3], data[4], data[5]))]
        frames = [self._frame_of_body(body) @ frame for body, frame in zip(ends, local, strict=True)]
        names = [GROUND if body == 0 else self._name_of_object("body", body) for body in ends]
        kind: Kind = "rigid" if weld else "spherical"
        self.connections.append(Connection(name, kind, names[0], names[1], frames[0], frames[1], closes=True))

    def _read_polynomial(self, k: int, name: str) -> CoupledCoordinate:
        """Return y - y0 = p(x - x0) as a polynomial of x."""
        model = self.model
        joint, other = int(model.eq_obj1id[k]), int(model.eq_obj2id[k])
        coefficients = model.eq_data[k].tolist()[:5]
        if other < 0:
            coefficients = coefficients[:1]
        start = 0.0 if other < 0 else float(model.qpos0[int(model.jnt_qposadr[other])])
        shifted: list[float] = []
        for a in reversed(coefficients):  # p(x - x0), from the highest power down (Horner)
            shifted = [a, *shifted] if not shifted else _shift_polynomial(shifted, start, a)
        shifted[0] += float(model.qpos0[int(model.jnt_qposadr[joint])])
        while len(shifted) > 1 and shifted[-1] == 0.0:
            shifted.pop()
        return CoupledCoordinate(
            name,
            self._name_of_object("joint", joint),
            None if other < 0 else self._name_of_object("joint", other),
            tuple(shifted),
        )

    # -- actuators ---------------------------------------------------------------------------------------------------

    def _read_actuator(self, i: int) -> RobotActuator | None:
        model, m = self.model, self.mujoco
        name = self._name_of_object("actuator", i)
        gear, at = float(model.actuator_gear[i][0]), int(model.actuator_trnid[i][0])
        sort = int(model.actuator_trntype[i])
        weights = dict[str, float]()
        if sort in (int(m.mjtTrn.mjTRN_JOINT), int(m.mjtTrn.mjTRN_JOINTINPARENT)):
            weights = {self._name_of_object("joint", at): gear} if self._is_hinge_or_slide(at) else {}
        elif sort == int(m.mjtTrn.mjTRN_TENDON):
            weights = {name: gear * w for name, w in self.tendons.weights[at].items()}
        lag = self._lags.get(int(model.actuator_dyntype[i]))
        gain_type, bias = int(model.actuator_gaintype[i]), int(model.actuator_biastype[i])
        fixed, by_state = int(m.mjtGain.mjGAIN_FIXED), int(m.mjtGain.mjGAIN_AFFINE)
        affine = bias == int(m.mjtBias.mjBIAS_AFFINE)
        early = bool(model.actuator_actearly[i])
        reach = _as_pair(model.actuator_actrange[i]) if model.actuator_actlimited[i] else None
        known = lag is not None and not early and not (reach and lag == "filter") and gain_type in (fixed, by_state)
        if not weights or not known or not (affine or bias == int(m.mjtBias.mjBIAS_NONE)):
            why = "it is no effort along joints that is affine in its input, or a lag of it, in coordinates and rates"
            self.left_out.append(LeftOut("an actuator", name, why, True))
            return None
        offset, along, against = model.actuator_biasprm[i].tolist()[:3] if affine else (0.0, 0.0, 0.0)
        bounds = _as_pair(model.actuator_ctrlrange[i]) if model.actuator_ctrllimited[i] else None
        limits = _as_pair(model.actuator_forcerange[i]) if model.actuator_forcelimited[i] else None
        gains = model.actuator_gainprm[i].tolist()[:3]
        by_gain = {"gain_along": gains[1], "gain_against": gains[2]} if gain_type == by_state else {}
        time = float(model.actuator_dynprm[i][0])
        plain = RobotActuator(name, weights, gains[0], offset, along, against, bounds, limits)
        return replace(plain, **by_gain, lag=lag or "", time=time, reach=reach)

    @property
    def _lags(self) -> dict[int, str]:
        """What stands between an input and what it drives, by MuJoCo's types."""
        kinds = self.mujoco.mjtDyn
        names = {"NONE": "", "INTEGRATOR": "integrator", "FILTER": "filter", "FILTEREXACT": "filter"}
        return {int(getattr(kinds, f"mjDYN_{kind}")): lag for kind, lag in names.items()}

    def _is_hinge_or_slide(self, joint: int) -> bool:
        sorts = self.mujoco.mjtJoint
        return int(self.model.jnt_type[joint]) in (int(sorts.mjJNT_HINGE), int(sorts.mjJNT_SLIDE))

    # -- the rest ----------------------------------------------------------------------------------------------------

    def _list_left_out(self) -> None:
        model, option = self.model, self.model.opt
        self.left_out += self.tendons.left_out
        for what in ("jnt_stiffness", "dof_damping", "tendon_stiffness", "tendon_damping"):
            if any(any(row) for row in getattr(model, f"{what}poly", ())):
                self.left_out.append(
                    LeftOut("higher powers of springs and dampers", what, "they are linear here", True)
                )
        if option.density or option.viscosity or any(option.wind):
            self.left_out.append(LeftOut("a fluid", "option", "bodies move in a vacuum", True))
        for why, count in self.meshes.reasons_of_lost():
            self.left_out.append(LeftOut("meshes", f"{count} in pictures", why, False))
        if model.nflex:
            self.left_out.append(LeftOut("flexible parts", f"{model.nflex}", "symgen has beams", True))
        if model.nplugin:
            self.left_out.append(LeftOut("plugins", f"{model.nplugin}", "their code is unknown", True))
        if any(model.body_gravcomp):
            self.left_out.append(LeftOut("gravity compensation", "bodies", "weight acts on every body", True))
        if model.nsensor:
            self.left_out.append(LeftOut("sensors", f"{model.nsensor}", "outputs are written by the user", False))
        if model.nkey:
            self.left_out.append(LeftOut("key frames", f"{model.nkey}", "the motion starts from the model", False))


def _shift_polynomial(higher: list[float], start: float, constant: float) -> list[float]:
    """Return (x - start) higher(x) + constant."""
    product = [0.0, *higher]
    for i, a in enumerate(higher):
        product[i] -= start * a
    product[0] += constant
    return product


def _as_vector(numbers: Any) -> Vector:
    x, y, z = (float(n) for n in numbers)
    return x, y, z


def _as_pair(numbers: Any) -> tuple[float, float]:
    low, high = (float(n) for n in numbers)
    return low, high


KIND = Mjcf
