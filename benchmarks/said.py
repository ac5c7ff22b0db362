"""Examples of other systems as files that run, by the lines of `benchmarks.sayable`.

`benchmarks/examples` has a file of each, with the numbers of its source; the smallest of them are tables here, and some
are in the catalogue. `tests/verification/test_said.py` runs them in turns; `python -m benchmarks.sayable` counts them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from benchmarks.said_in_files import FILES, SAME
from benchmarks.said_touching import balls_on_a_table, balls_that_meet, cable_over_circles

Table = dict[str, Any]
DOWN, DOWN_IN_SPACE = [0.0, -9.81], [0.0, 0.0, -9.81]
ORIGIN, ORIGIN_IN_SPACE = [0.0, 0.0], [0.0, 0.0, 0.0]
INERTIA = [0.02, 0.03, 0.04]


def plane(bodies: Table, joints: Table | None = None, forces: Table | None = None, **more: Any) -> Table:
    """Return a file in the plane under gravity."""
    return {"mechanism": {"name": "said", "gravity": DOWN}, "bodies": bodies, **_parts(joints, forces), **more}


def space(bodies: Table, joints: Table | None = None, forces: Table | None = None, **more: Any) -> Table:
    """Return a file in space under gravity."""
    head = {"name": "said", "space": "spatial", "gravity": DOWN_IN_SPACE}
    return {"mechanism": head, "bodies": bodies, **_parts(joints, forces), **more}


def _parts(joints: Table | None, forces: Table | None) -> Table:
    return {key: table for key, table in (("joints", joints), ("forces", forces)) if table}


def point(*place: float, mass: float = 1.0, **more: Any) -> Table:
    """Return a point mass."""
    return {"type": "point", "mass": mass, "position": list(place), **more}


def bar(x: float = 0.5, y: float = 0.0, **more: Any) -> Table:
    """Return a bar of 1 m in the plane with a point at either end."""
    ends = {"a": [-0.5, 0.0], "b": [0.5, 0.0]}
    return {"mass": 1.0, "inertia": 1.0 / 12.0, "points": ends, "position": [x, y], **more}


def solid(*place: float, **more: Any) -> Table:
    """Return a body in space with a point at either end of its x axis."""
    ends = {"a": [-0.5, 0.0, 0.0], "b": [0.5, 0.0, 0.0]}
    return {"mass": 1.0, "inertia": INERTIA, "points": ends, "position": list(place), **more}


def between(kind: str, a: str, b: str, at: list[Any], **more: Any) -> Table:
    """Return a joint or force between two bodies."""
    return {"type": kind, "between": [a, b], "at": at, **more}


def spring(a: str, b: str, at: list[Any], stiffness: float = 200.0, **more: Any) -> Table:
    """Return a spring."""
    return between("spring-damper", a, b, at, stiffness=stiffness, **more)


def chain(count: int, **more: Any) -> Table:
    """Return a chain of bars on hinges from the origin."""
    names = ["ground", *(f"bar{k}" for k in range(count))]
    bodies = {name: bar(0.5 + k) for k, name in enumerate(names[1:])}
    joints = {f"pin{k}": between("revolute", names[k], names[k + 1], ["b" if k else ORIGIN, "a"]) for k in range(count)}
    return plane(bodies, joints, **more)


def chain_in_space(count: int, kind: str = "revolute", **more: Any) -> Table:
    """Return a chain of bodies on hinges or balls in space."""
    names = ["ground", *(f"bar{k}" for k in range(count))]
    bodies = {name: solid(0.5 + k, 0.0, 0.0) for k, name in enumerate(names[1:])}
    axis = {"axis": [0.0, 1.0, 0.0]} if kind == "revolute" else {}
    joints = {
        f"pin{k}": between(kind, names[k], names[k + 1], ["b" if k else ORIGIN_IN_SPACE, "a"], **axis)
        for k in range(count)
    }
    return space(bodies, joints, **more)


def cart(forces: Table, **keys: Any) -> Table:
    """Return a mass on a rail along x, with keys of its joint."""
    rail = between("translational", "ground", "mass", [ORIGIN, "centre"], axis=[1.0, 0.0], angle=0.0, **keys)
    return plane({"mass": {"mass": 1.0, "inertia": 0.1, "position": [0.1, 0.0]}}, {"rail": rail}, forces)


def on_rail(stiffness: float = 100.0, damping: float = 1.0, **more: Any) -> Table:
    """Return a spring along the rail of a cart."""
    return {"spring": {"type": "spring-damper", "joint": "rail", "stiffness": stiffness, "damping": damping, **more}}


def rotors(gears: Table, **forces: Any) -> Table:
    """Return two rotors on bearings, 0.3 m apart."""
    bodies = {name: {"mass": 1.0, "inertia": 0.02, "position": [x, 0.0]} for name, x in (("one", 0.0), ("two", 0.3))}
    joints = {
        f"bearing_{name}": between("revolute", "ground", name, [[x, 0.0], "centre"])
        for name, x in (("one", 0.0), ("two", 0.3))
    }
    return plane(bodies, joints | gears, dict(forces))


def beam(clamp: str = "ground", **more: Any) -> Table:
    """Return a beam along x with a force at its tip."""
    rod = {"start": ORIGIN, "end": [1.0, 0.0], "elements": 4, "axial": 1e4, "bending": 1.0, "mass": 1.0, "rotary": 1e-3}
    push = {"type": "force", "body": "rod", "at": "end", "force": [0.0, -0.5]}
    head = {"name": "said", "gravity": DOWN}
    return {"mechanism": head, "beams": {"rod": rod | {"clamp": clamp} | more}, "forces": {"push": push}}


def engine(**more: Any) -> Table:
    """Return a slider-crank with its piston on x."""
    bodies = {
        "crank": bar(0.0, 0.1, inertia=0.05, points={"tip": [0.0, 0.1]}),
        "rod": bar(0.3, 0.05, points={"a": [-0.3, 0.05], "b": [0.3, -0.05]}),
        "piston": {"mass": 0.5, "inertia": 0.01, "position": [0.6, 0.0]},
    }
    bodies["crank"]["position"] = ORIGIN
    joints = {
        "bearing": between("revolute", "ground", "crank", [ORIGIN, "centre"]),
        "pin": between("revolute", "crank", "rod", ["tip", "a"]),
        "bolt": between("revolute", "rod", "piston", ["b", "centre"]),
        "guide": between("translational", "ground", "piston", [ORIGIN, "centre"], axis=[1.0, 0.0], angle=0.0),
    }
    return plane(bodies, joints, **more)


def wheel(**more: Any) -> Table:
    """Return a disc in space that rolls on the ground, upright at the start."""
    disc = {"mass": 1.0, "inertia": [0.01, 0.02, 0.01], "position": [0.0, 0.0, 0.2]}
    disc |= {"velocity": [0.4, 0.0, 0.0], "angular_velocity": [0.0, 2.0, 0.1]}
    road = {"type": "rolling-disc", "body": "disc", "radius": 0.2, "axis": [0.0, 1.0, 0.0], "normal": [0.0, 0.0, 1.0]}
    return space({"disc": disc}, {"road": road | more})


def trolley(**more: Any) -> Table:
    """Return a mass that slides along a cable between two supports."""
    wheel = {"type": "slides-on", "body": "mass", "beam": "line"}
    return plane({"mass": point(0.9, -0.3, mass=2.0)}, {"wheel": wheel | more}, beams={"line": _LINE})


_LINE: Table = {
    **{"start": ORIGIN, "end": [4.0, 0.0], "arc": 0.77, "length": 4.05, "elements": 6},
    **{"cable": True, "axial": 500.0, "mass": 0.5, "clamp": ["ground", "ground"]},
}
_SPRUNG = {"mass": point(0.0, -1.0)}
_FROM_ABOVE = {"spring": spring("ground", "mass", [ORIGIN, "centre"], 50.0, free_length=0.9, damping=0.5)}
_OSCILLATOR = plane(_SPRUNG, forces=_FROM_ABOVE)
_DUFFING = cart(on_rail(actuator="-500*length**3"))
_ROD = plane({"mass": point(1.0, 0.0)}, {"rod": between("distance", "ground", "mass", [ORIGIN, "centre"], length=1.0)})
_HINGED = chain_in_space(1)
_PLANETS = {
    "mechanism": {"name": "said"},
    "bodies": {"one": point(0.0, 0.0, velocity=[0.0, -0.5]), "two": point(1.0, 0.0, velocity=[0.0, 0.5])},
    "forces": {"pull": between("spring-damper", "one", "two", ["centre", "centre"], actuator="-1/length**2")},
}
_BUSHED = space(
    {"mass": solid(0.0, 0.0, 0.0)},
    forces={
        "mount": between(
            "bushing", "ground", "mass", [ORIGIN_IN_SPACE, "centre"], stiffness=[300.0, 300.0, 300.0, 5.0, 5.0, 5.0]
        )
    },
)
_GEAR = {"gear": {"type": "gear", "between": ["one", "two"], "radii": [0.1, 0.2]}}
_TURN = {"type": "torque", "body": "one", "torque": "0.3*sin(3*t)"}
_BALL = {"mass": 1.0, "inertia": [4e-3] * 3, "position": [0.0, 0.0, 0.1], "angular_velocity": [0.0, 8.0, 3.0]}
_SPHERE = {"type": "rolling-sphere", "body": "ball", "radius": 0.1, "normal": [0.0, 0.0, 1.0]}
_GIVES = {"stiffness": 1e4, "damping": 50.0, "friction": {"coefficient": 0.4, "speed": 0.05}}

#: Set and name of an example -> its description, a name of the catalogue, or a path.
SAID: Mapping[str, Table | str] = {
    **FILES,
    **{name: FILES[same] for name, same in SAME.items()},
    # Exudyn's examples
    "exudyn/3SpringsDistance": plane(
        {"mass": point(0.5, 0.0)},
        {"rod": between("distance", "ground", "mass", [ORIGIN, "centre"], length=0.5)},
        {f"s{k}": spring("ground", "mass", [[x, 1.0], "centre"], 20.0) for k, x in enumerate((0.0, 0.5, 1.0))},
    ),
    "exudyn/ANCFcableCantilevered": beam(damping={"bending": 1e-3}),
    "exudyn/ANCFcantileverTest": beam(),
    "exudyn/ANCFslidingJoint": space(
        {"mass": point(0.9, 0.1, -0.3, mass=2.0)},
        {"wheel": {"type": "slides-on", "body": "mass", "beam": "line"}},
        beams={
            "line": _LINE | {"start": ORIGIN_IN_SPACE, "end": [4.0, 0.0, 0.0], "y_axis": [0.0, 0.0, -1.0], "arc": -0.77}
        },
    ),
    "exudyn/ANCFslidingJoint2D": trolley(stop={"lower": 0.5, "upper": 3.5, "restitution": 0.5}),
    "exudyn/ANCFslidingJoint2Drigid": plane(
        {"mass": {"mass": 2.0, "inertia": 0.1, "position": [0.5, -0.3], "points": {"eye": [0.0, 0.3]}}},
        {"wheel": {"type": "slides-on", "body": "mass", "at": "eye", "beam": "rod"}},
        beams={"rod": beam()["beams"]["rod"] | {"bending": 50.0, "clamp": ["ground", "ground"]}},
    ),
    "exudyn/ANCFtests2": beam(),
    "exudyn/ComputeSensitivitiesExample": _OSCILLATOR,
    "exudyn/SliderCrank": engine(forces={"gas": {"type": "torque", "body": "crank", "torque": 0.5}}),
    "exudyn/SpringDamperMassUserFunction": _DUFFING,
    "exudyn/SpringDamperMasspointSystem": space(
        {f"m{k}": point(0.5 * k, 0.0, 0.0) for k in (1, 2)},
        forces={
            "first": spring("ground", "m1", [ORIGIN_IN_SPACE, "centre"], free_length=0.45),
            "second": spring("m1", "m2", ["centre", "centre"], free_length=0.45),
        },
    ),
    "exudyn/SpringWithConstraints": plane(
        _SPRUNG, {"rail": {"type": "rows", "rows": [{"position": "mass.x"}]}}, _FROM_ABOVE
    ),
    "exudyn/addPrismaticJoint": space(
        {"one": solid(0.0, 0.0, 0.0), "two": solid(0.0, 1.0, 0.0)},
        {
            "first": between("prismatic", "ground", "one", [ORIGIN_IN_SPACE, "centre"], axis=[1.0, 0.0, 0.0]),
            "second": between("prismatic", "one", "two", ["centre", "centre"], axis=[0.0, 1.0, 0.0]),
        },
    ),
    "exudyn/addRevoluteJoint": chain_in_space(2),
    "exudyn/basicTutorial2024": _OSCILLATOR,
    "exudyn/beamTutorial": beam(damping={"bending": 0.02}),
    "exudyn/bicycleIftommBenchmark": "bicycle",
    "exudyn/bungeeJump": plane(
        {"jumper": point(0.5, 0.0, mass=5.0)},
        {"tied": between("revolute", "rope", "jumper", ["end", "centre"])},
        beams={
            "rope": {
                **{"start": ORIGIN, "end": [0.5, 0.0], "arc": 2.5, "elements": 6, "cable": True},
                **{"axial": 400.0, "mass": 0.2, "damping": 1e-3, "clamp": ["ground", ""]},
            }
        },
    ),
    "exudyn/cartesianSpringDamper": _BUSHED,
    "exudyn/cartesianSpringDamperUserFunction": plane(
        {"mass": point(0.1, 0.0)},
        forces={"mount": {"type": "force", "body": "mass", "force": ["-100*mass.x", "-100*mass.y - 20*mass.y**3"]}},
    ),
    "exudyn/chatGPTupdate2": _ROD,
    "exudyn/contactCurvePolynomial": plane(
        {"pin": point(0.3, 0.0)}, stops={"groove": {"gap": "0.5 - sqrt(pin.x**2 + pin.y**2)", "stiffness": 1e4}}
    ),
    "exudyn/coordinateSpringDamper": cart(on_rail(), friction={"sliding": 0.3}),
    "exudyn/doublePendulum2D": chain(2),
    "exudyn/finiteSegmentMethod": chain(
        3,
        forces={
            f"bend{k}": {"type": "torsional-spring-damper", "between": [f"bar{k}", f"bar{k + 1}"], "stiffness": 20.0}
            for k in range(2)
        },
    ),
    "exudyn/flexiblePendulumANCF": beam(clamp="")
    | {"joints": {"pin": between("revolute", "ground", "rod", [ORIGIN, "start"])}},
    "exudyn/gyroStability": {
        "mechanism": {"name": "said", "space": "spatial"},
        "bodies": {"gyro": solid(0.0, 0.0, 0.0, angular_velocity=[0.01, 8.0, 0.01])},
    },
    "exudyn/lavalRotor2Dtest": cart(
        on_rail() | {"unbalance": {"type": "force", "body": "mass", "force": ["0.2*sin(5*t)", 0.0]}}
    ),
    "exudyn/lugreFrictionODE1": cart({"brush": {"type": "force", "body": "mass", "force": ["2 - 1e3*z", 0.0]}})
    | {"states": {"z": {"start": 0.0, "rate": "mass.vx - abs(mass.vx)*z/1.5e-3"}}},
    "exudyn/myFirstExample": plane(
        {"mass": point(0.0, 0.0)}, forces={"push": {"type": "force", "body": "mass", "force": [1.0, 0.0]}}
    ),
    "exudyn/nMassOscillator": cart(on_rail(actuator="-50*length**3")),
    "exudyn/newtonsCradle": plane(
        {"one": point(-0.5, 0.0, velocity=[1.0, 0.0]), "two": point(0.0, 0.0)},
        {"rails": {"type": "rows", "rows": [{"position": "one.y"}, {"position": "two.y"}]}},
        stops={"hit": {"gap": "two.x - one.x - 0.1", "restitution": 1.0}},
    ),
    "exudyn/pendulum2Dconstraint": _ROD,
    "exudyn/pendulum": _ROD,
    "exudyn/pendulumGeomExactBeam2D": beam(clamp="")
    | {"joints": {"pin": between("revolute", "ground", "rod", [ORIGIN, "start"])}},
    "exudyn/pendulumIftommBenchmark": _ROD,
    "exudyn/rigid3Dexample": _BUSHED,
    "exudyn/rigidBodyTutorial": _HINGED,
    "exudyn/rigidBodyTutorial2": chain_in_space(2),
    "exudyn/rigidPendulum": chain(1),
    "exudyn/simple4linkPendulumBing": chain(4),
    "exudyn/solutionViewerTest": chain_in_space(6),
    "exudyn/slidercrankWithMassSpring": engine(
        forces={"hold": spring("ground", "piston", [[1.0, 0.0], "centre"], 30.0)}
    ),
    "exudyn/springDamperTutorial": _OSCILLATOR,
    "exudyn/springDamperUserFunctionNumbaJIT": _DUFFING,
    "exudyn/springMassFriction": cart(on_rail(), friction={"sliding": 0.2, "static": 0.4}),
    "exudyn/springsDeactivateConnectors": cart(on_rail(0.0, actuator="-whole*200*length"))
    | {
        "states": {"whole": {"start": 1.0, "rate": "0"}},
        "events": {"snap": {"when": "mass.vx + 1", "direction": "falling", "reset": {"whole": 0.0}}},
    },
    "exudyn/stiffFlyballGovernor2": "flyball-governor",
    "exudyn/stiffFlyballGovernorKT": "flyball-governor",
    "exudyn/FurtherExamples/bicycleIftommBenchmarkMarkerBasedJoints": "bicycle",
    "exudyn/switchingConstraintsPendulum": chain(1)
    | {"joints": {"pin0": between("revolute", "ground", "bar0", [ORIGIN, "a"], holds="t < 0.3")}},
    "exudyn/tippeTop": space({"ball": _BALL | {"centre_of_mass": [0.0, 0.0, -0.01]}}, {"road": _SPHERE | _GIVES}),
    "exudyn/universalJoint": space(
        {"one": solid(0.5, 0.0, 0.0), "two": solid(1.5, 0.0, 0.0)},
        {
            "bearing": between("revolute", "ground", "one", [ORIGIN_IN_SPACE, "a"], axis=[1.0, 0.0, 0.0]),
            "cross": between("universal", "one", "two", ["b", "a"], axes=[[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        },
    ),
    # Exudyn's test models
    "exudyn-tests/ANCFBeamTest": beam(),
    "exudyn-tests/ANCFcontactCircleTest": cable_over_circles(16, 2.07e5, 80.0, (1.5, 0.2)),
    "exudyn-tests/bricardMechanism": "bricard",
    "exudyn-tests/carRollingDiscTest": wheel(**_GIVES),
    "exudyn-tests/connectorGravityTest": _PLANETS,
    "exudyn-tests/contactCoordinateTest": cart(on_rail(), stop={"lower": 0.05, "stiffness": 1e4, "damping": 10.0}),
    "exudyn-tests/coordinateVectorConstraint": plane(
        {"one": point(1.0, 0.0)}, {"rod": {"type": "rows", "rows": [{"position": "sqrt(one.x**2 + one.y**2) - 1"}]}}
    ),
    "exudyn-tests/createSphereQuadContact": balls_that_meet(cue=False),
    "exudyn-tests/createSphereTriangleContact": balls_that_meet(cue=False),
    "exudyn-tests/sphereTriangleTest": balls_on_a_table(),
    "exudyn-tests/sphereTriangleTest2": balls_that_meet(cue=True),
    "exudyn-tests/fourBarMechanismIftomm": "n-four-bar",
    "exudyn-tests/heavyTop": "heavy-top",
    "exudyn-tests/createRollingDiscTest": wheel(),
    "exudyn-tests/createRollingDiscPenaltyTest": wheel(**_GIVES),
    "exudyn-tests/mecanumWheelRollingDiscTest": wheel(
        stiffness=1e4, damping=50.0, friction={"coefficient": 0.4, "speed": 0.05, "direction": 0.7}
    ),
    "exudyn-tests/pendulumFriction": chain(1)
    | {"joints": {"pin0": between("revolute", "ground", "bar0", [ORIGIN, "a"], friction={"sliding": 0.3})}},
    "exudyn-tests/perfRigidPendulum": chain(1),
    "exudyn-tests/perfSpringDamperUserFunction": _DUFFING,
    "exudyn-tests/perf3DRigidBodies": chain_in_space(3),
    "exudyn-tests/rigidBody2Dtest": chain(1),
    "exudyn-tests/rollingCoinTest": wheel(),
    "exudyn-tests/rollingCoinPenaltyTest": wheel(**_GIVES),
    "exudyn-tests/explicitLieGroupIntegratorTest": "heavy-top",
    "exudyn-tests/explicitLieGroupIntegratorPythonTest": "heavy-top",
    "exudyn-tests/sliderCrank3Dbenchmark": "spatial-slider-crank",
    "exudyn-tests/sliderCrank3Dtest": "spatial-slider-crank",
    "exudyn-tests/sphericalJointTest": chain_in_space(2, "spherical"),
    "exudyn-tests/springDamperUserFunctionTest": _DUFFING,
    "exudyn-tests/stiffFlyballGovernor": "flyball-governor",
    "exudyn-tests/MiniExamples/LoadMassProportional": plane({"mass": point(0.0, 0.0)}),
    "exudyn-tests/MiniExamples/ObjectANCFCable2D": beam(),
    "exudyn-tests/MiniExamples/ObjectConnectorCartesianSpringDamper": _BUSHED,
    "exudyn-tests/MiniExamples/ObjectConnectorDistance": _ROD,
    "exudyn-tests/MiniExamples/ObjectConnectorGravity": _PLANETS,
    "exudyn-tests/MiniExamples/ObjectConnectorSpringDamper": _OSCILLATOR,
    "exudyn-tests/MiniExamples/ObjectMass1D": cart(on_rail()),
    "exudyn-tests/MiniExamples/ObjectMassPoint2D": plane({"mass": point(0.0, 0.0)}),
    "exudyn-tests/MiniExamples/ObjectRigidBody2D": plane({"body": bar()}),
    "exudyn-tests/MiniExamples/ObjectRotationalMass1D": rotors({}, turn=_TURN),
    # Modelica's mechanics
    "modelica/MultiBody/Elementary/DoublePendulum": chain_in_space(2),
    "modelica/MultiBody/Elementary/Pendulum": _HINGED,
    "modelica/MultiBody/Elementary/PointGravity": space(
        {"body": solid(1.0, 0.0, 0.0, velocity=[0.0, 2.0, 0.0])},
        forces={
            "field": {
                "type": "force",
                "body": "body",
                "force": [f"-body.{c}*4/(body.x**2 + body.y**2 + body.z**2)**1.5" for c in "xyz"],
            }
        },
    )
    | {"mechanism": {"name": "said", "space": "spatial"}},
    "modelica/MultiBody/Elementary/RollingWheel": wheel(),
    "modelica/MultiBody/Constraints/SphericalConstraint": chain_in_space(1, "spherical"),
    "modelica/MultiBody/Loops/Engine1a": engine(),
    "modelica/Rotational/First": rotors(_GEAR, turn=_TURN),
    "modelica/Rotational/FirstGrounded": rotors(_GEAR, turn=_TURN),
    "modelica/Rotational/LossyGearDemo1": rotors({"gear": _GEAR["gear"] | {"efficiency": [0.5, 0.4]}}, turn=_TURN),
    "modelica/Rotational/CompareBrakingTorque": rotors(
        {}, brake={"type": "torque", "body": "one", "torque": "-0.1*one.omega"}
    ),
    "modelica/Translational/Accelerate": cart({})
    | {"joints": cart({})["joints"] | {"pull": {"type": "driver", "joint": "rail", "value": "0.1 + t**2"}}},
    "modelica/Translational/Damper": cart(on_rail(0.0, 5.0)),
    "modelica/Translational/Brake": cart({}, friction={"sliding": "2*t"}),
}
