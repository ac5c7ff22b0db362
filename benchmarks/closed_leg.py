"""The leg of docs/howto/predictive-control.md, a loop of four bars with two motors, for three programs.

symgen has the angles of bodies as coordinates; in the other files the shank turns against the thigh, and the rod
against the lever. There the end of the rod is closed to the shank.
"""

import symgen

#: Bodies whose joints in the other files turn against another body.
RELATIVE = {"shank": "thigh", "rod": "lever"}
#: Joints and places on their bodies that coincide.
LOOP = ("rod", (0.4, 0.0, 0.0)), ("shank", (-0.1, 0.0, 0.0))
#: Parent, place of the joint on it, place of the centre of mass, mass and inertia.
_LIMBS = {
    "thigh": ("base", 0.0, 0.2, 1.0, 0.02),
    "shank": ("thigh", 0.4, 0.2, 0.6, 0.01),
    "lever": ("base", 0.0, 0.05, 0.2, 0.001),
    "rod": ("lever", 0.1, 0.2, 0.2, 0.003),
}


def leg() -> symgen.Model:
    """Return the leg."""
    builder = (
        symgen.MechanismBuilder("leg", gravity=(0.0, -9.81))
        .input("hip", 0.0, unit="N m")
        .input("knee", 0.0, unit="N m")
        .body("thigh", mass=1.0, inertia=0.02, points={"hip": (-0.2, 0.0), "knee": (0.2, 0.0)}, angle=-0.9)
        .body(
            "shank",
            mass=0.6,
            inertia=0.01,
            points={"knee": (-0.2, 0.0), "rod": (-0.3, 0.0), "foot": (0.2, 0.0)},
            angle=-2.0,
        )
        .body("lever", mass=0.2, inertia=0.001, points={"hip": (-0.05, 0.0), "rod": (0.05, 0.0)}, angle=-2.0)
        .body("rod", mass=0.2, inertia=0.003, points={"lever": (-0.2, 0.0), "shank": (0.2, 0.0)}, angle=-0.9)
        .joint("hip_pin", "revolute", between=("ground", "thigh"), at=((0.0, 0.0), "hip"))
        .joint("knee_pin", "revolute", between=("thigh", "shank"), at=("knee", "knee"))
        .joint("lever_pin", "revolute", between=("ground", "lever"), at=((0.0, 0.0), "hip"))
        .joint("rod_top", "revolute", between=("lever", "rod"), at=("rod", "lever"))
        .joint("rod_end", "revolute", between=("rod", "shank"), at=("shank", "rod"), cut=True)
        .force("hip_motor", "torque", body="thigh", torque="hip")
        .force("knee_motor", "torque", body="lever", torque="knee")
    )
    return symgen.load(builder.build())


def _urdf() -> str:
    text = '<robot name="leg"><link name="base"/>'
    for name, (parent, at, centre, mass, inertia) in _LIMBS.items():
        turning = f'<inertia ixx="{inertia}" iyy="{inertia}" izz="{inertia}" ixy="0" ixz="0" iyz="0"/>'
        text += f'<link name="{name}_link"><inertial><origin xyz="{centre} 0 0"/><mass value="{mass}"/>{turning}'
        above = parent if parent == "base" else f"{parent}_link"
        text += f'</inertial></link><joint name="{name}" type="revolute"><parent link="{above}"/>'
        text += f'<child link="{name}_link"/><origin xyz="{at} 0 0"/><axis xyz="0 0 1"/>'
        text += '<limit lower="-9" upper="9" effort="99" velocity="99"/></joint>'
    return text + "</robot>"


def _mjcf(name: str) -> str:
    _, at, centre, mass, inertia = _LIMBS[name]
    text = f'<body name="{name}" pos="{at} 0 0"><joint name="{name}" type="hinge" axis="0 0 1"/>'
    text += f'<inertial pos="{centre} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>'
    return text + "".join(_mjcf(x) for x, limb in _LIMBS.items() if limb[0] == name) + "</body>"


URDF = _urdf()
MJCF = (
    '<mujoco><compiler angle="radian"/><option gravity="0 -9.81 0" solver="Newton"><flag contact="disable"/></option>'
    f"<worldbody>{_mjcf('thigh')}{_mjcf('lever')}"
    '<site name="unused"/></worldbody><equality><connect site1="end" site2="knob" solimp="0.9999 0.9999 1"/></equality>'
    "</mujoco>"
)
# the loop is open where all angles are zero, so places on both bodies close it
for _name, _place, _site in ((LOOP[0][0], LOOP[0][1], "end"), (LOOP[1][0], LOOP[1][1], "knob")):
    _joint = f'<joint name="{_name}" type="hinge" axis="0 0 1"/>'
    MJCF = MJCF.replace(_joint, f'{_joint}<site name="{_site}" pos="{_place[0]} 0 0"/>')
MJCF = MJCF.replace('<site name="unused"/>', "")
