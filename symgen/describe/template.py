"""The commented file that ``symgen new`` writes: a mechanism that runs as it is, and every key a file may have."""

from __future__ import annotations

import textwrap

from symgen.describe.kinds import FORCES, JOINTS
from symgen.describe.names import check_mechanism_name


def template(name: str = "my-mechanism", space: str = "planar") -> str:
    """Return the text of a new mechanism file.

    Parameters
    ----------
    name : str
        Name of the mechanism: lower-case words joined by dashes.
    space : {"planar", "spatial"}
        Which of the two it describes.
    """
    check_mechanism_name(name, "name")
    joints = _listed([k for k, kind in JOINTS.items() if space in kind.SPACES and k != "revolute"])
    forces = _listed([k for k, kind in FORCES.items() if space in kind.SPACES and k != "torsional-spring-damper"])
    text = {"planar": _PLANAR, "spatial": _SPATIAL}[space]
    return text.replace("GIVEN\n", _GIVEN).replace("NAME", name, 1).replace("JOINTS", joints).replace("FORCES", forces)


def _listed(kinds: list[str]) -> str:
    """Return names with commas, in lines of comments where one line cannot hold them."""
    return "\n".join(textwrap.wrap(", ".join(kinds), 74, break_on_hyphens=False)).replace("\n", "\n" + " " * 42 + "# ")


#: Sections that are the same in the plane and in space.
_GIVEN = """\
[run]                                     # what a run uses where nothing else is asked for [s]
until = 10.0
step = 1e-3
# output_step = 0.01
# max_step = 1e-3                         # of adaptive integrators
# predictable_until = 5.0                 # for a chaotic motion

[parameters]                              # adjustable at run time; plain numbers elsewhere are compiled in
rod_mass = { value = 1.5, unit = "kg" }
rod_length = { value = 0.8, unit = "m" }
damping = { value = 0.02, unit = "N m s/rad", note = "in the pin" }
# rod_inertia = "rod_mass*rod_length**2/12"   # follows the others

# [inputs]                                # numbers from outside: symgen run FILE --input push="5*sin(t)"
# push = { default = 0.0, unit = "N" }    # may stand in forces, torques and actuators

# [tables.profile]                        # a function by interpolation, called as profile(t)
# x = [0.0, 1.0, 2.0, 3.0]
# y = [0.0, 0.5, 0.2, 0.0]
# interpolation = "linear"                # or cubic, which drivers may use, or pchip
# periodic = false                        # whether a smooth one repeats itself
"""

_PLANAR = """\
# A mechanism for symgen. SI units throughout: m, kg, s, N, rad. Angles count counter-clockwise.
# Wherever a number stands, a text may stand: an expression of parameters such as "2*rod_mass" or "pi/3".

[mechanism]
name = "NAME"
title = "A rod on a pin, with a damper and a motor"
space = "planar"
gravity = [0.0, -9.81]                    # none by default
# source = "where the data come from"

GIVEN

[bodies.rod]
mass = "rod_mass"
inertia = "rod_mass*rod_length**2/12"     # about the centre of mass
# centre_of_mass = [0.0, 0.0]             # in the body's frame; its origin by default
points = { top = ["-rod_length/2", 0.0], tip = ["rod_length/2", 0.0] }
position = ["rod_length/2", 0.0]          # where the frame's origin starts; approximately: assembly closes the joints
angle = 0.0                               # how far the frame is turned
angular_velocity = 0.0                    # left out: completed from the other velocities
# velocity = [0.0, 0.0]                   # of the centre of mass
# hold = "velocity"                       # kept while assembly moves the rest; or position, angle, a list, true

# [bodies.bob]                            # a point mass has no inertia, angle or points
# type = "point"
# mass = 0.2

[joints.pin]
type = "revolute"                         # or JOINTS
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]                  # a point of each body: a name, "centre" or coordinates in its frame
# start = { angle = 0.5 }                 # the joint's coordinate at the start, kept as well; rate = 1.0 is its rate
# cut = true                              # with joint coordinates: it closes a loop, and carries nothing

[forces.friction]
type = "torsional-spring-damper"          # or FORCES
between = ["ground", "rod"]
damping = "damping"

[forces.motor]
type = "torque"
body = "rod"
torque = "0.5*sin(2*pi*t) if t < 2 else -0.1*rod.omega"   # also rod.x, .y (of the centre of mass), .theta, .vx, .vy

# [outputs]                               # formulas that results report; also integrals over time
# height = { value = "rod.tip.y", unit = "m" }

# [events.turn]                           # watched during a run; also symgen run --stop-when "rod.theta > 2*pi"
# when = "rod.theta > 2*pi"               # happens when it becomes true; or an expression that passes through zero
# direction = "rising"                    # or "falling", "any"
# action = "stop"                         # or "record"; or "reset" with new velocities:
#                                         #   reset = { "rod.omega" = "-0.5*rod.omega" }
"""

_SPATIAL = """\
# A mechanism in space for symgen. SI units throughout: m, kg, s, N, rad.
# Wherever a number stands, a text may stand: an expression of parameters such as "2*rod_mass" or "pi/3".

[mechanism]
name = "NAME"
title = "An arm that a motor turns, with a rod on a pin"
space = "spatial"
gravity = [0.0, 0.0, -9.81]               # none by default
# source = "where the data come from"

GIVEN

[bodies.arm]
mass = 2.0
inertia = [0.02, 0.05, 0.06]              # tensor about the centre of mass; or six numbers, or three rows
# inertia_at = "centre"                   # another point that it refers to
# centre_of_mass = [0.0, 0.0, 0.0]        # in the body's frame; its origin by default
points = { end = [0.3, 0.0, 0.0] }
angular_velocity = [0.0, 0.0, 1.0]        # in body axes; left out: completed from the other velocities

[bodies.rod]
mass = "rod_mass"
inertia = [1e-4, "rod_mass*rod_length**2/12", "rod_mass*rod_length**2/12"]
points = { top = ["-rod_length/2", 0.0, 0.0], tip = ["rod_length/2", 0.0, 0.0] }
position = [0.3, 0.0, "-rod_length/2"]    # where the frame's origin starts; approximately: assembly closes the joints
orientation = { x_axis = [0.0, 0.0, -1.0], y_axis = [0.0, 1.0, 0.0] }   # or quaternion, rotation_vector, euler_angles
# velocity = [0.0, 0.0, 0.0]              # of the centre of mass
# hold = "position"                       # kept while assembly moves the rest; or angle, velocity, a list, true

# [bodies.bob]                            # a point mass has no inertia, orientation or points
# type = "point"
# mass = 0.2
# position = [0.0, 2.0, 0.0]

[joints.hub]
type = "revolute"                         # or JOINTS
between = ["ground", "arm"]
at = [[0.0, 0.0, 0.0], "centre"]          # a point of each body: a name, "centre" or coordinates in its frame
axis = [0.0, 0.0, 1.0]                    # in the first body's frame; or a pair, one in the frame of each body
# reference = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]   # directions that coincide at angle 0; as the bodies start

[joints.pin]
type = "revolute"
between = ["arm", "rod"]
at = ["end", "top"]
axis = [0.0, 1.0, 0.0]
# start = { angle = 0.5 }                 # the joint's coordinate at the start, kept as well; rate = 1.0 is its rate

[forces.friction]
type = "torsional-spring-damper"          # or FORCES
joint = "pin"
damping = "damping"

[forces.motor]
type = "torque"
joint = "hub"                             # or body = "arm" and three components
torque = "0.5*sin(2*pi*t) if t < 2 else -0.1*rate"   # also rod.x (centre of mass), .e0, .vx, .wx, ...

# [outputs]                               # formulas that results report; also integrals over time
# height = { value = "rod.tip.z", unit = "m" }

# [events.low]                            # watched during a run; also symgen run --stop-when "rod.z < -0.5"
# when = "rod.z < -0.5"                   # happens when it becomes true; or an expression that passes through zero
# direction = "rising"                    # or "falling", "any"
# action = "stop"                         # or "record"; or "reset" with new velocities:
#                                         #   reset = { "rod.vz" = "-0.5*rod.vz" }
"""
