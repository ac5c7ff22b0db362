"""The commented file that ``symgen new`` writes: a mechanism that runs as it is, and every key a file may have."""

from __future__ import annotations

from symgen.describe.names import check_mechanism_name


def template(name: str = "my-mechanism") -> str:
    """Return the text of a new mechanism file.

    Parameters
    ----------
    name : str
        Name of the mechanism: lower-case words joined by dashes.
    """
    from symgen.forces import FORCES
    from symgen.joints import JOINTS

    check_mechanism_name(name, "name")
    joints = ", ".join(kind for kind in JOINTS.names if kind != "revolute")
    forces = ", ".join(kind for kind in FORCES.names if kind != "torsional-spring-damper")
    return _TEXT.replace("NAME", name, 1).replace("JOINTS", joints).replace("FORCES", forces)


_TEXT = """\
# A mechanism for symgen. SI units throughout: m, kg, s, N, rad. Angles count counter-clockwise.
# Wherever a number stands, a text may stand: an expression of parameters such as "2*rod_mass" or "pi/3".

[mechanism]
name = "NAME"
title = "A rod on a pin, with a damper and a motor"
space = "planar"
gravity = [0.0, -9.81]                    # none unless given
# source = "where the data come from"

[run]                                     # what a run uses where nothing else is asked for [s]
until = 10.0
step = 1e-3
# output_step = 0.01
# predictable_until = 5.0                 # for a chaotic motion

[parameters]                              # adjustable at run time; plain numbers elsewhere are compiled in
rod_mass = { value = 1.5, unit = "kg" }
rod_length = { value = 0.8, unit = "m" }
damping = { value = 0.02, unit = "N m s/rad", note = "in the pin" }

# [tables.profile]                        # a function by linear interpolation, called as profile(t)
# x = [0.0, 1.0, 2.0]
# y = [0.0, 0.5, 0.0]

[bodies.rod]
mass = "rod_mass"
inertia = "rod_mass*rod_length**2/12"     # about the centre of mass
# centre_of_mass = [0.0, 0.0]             # in the body's frame; its origin unless given
points = { top = ["-rod_length/2", 0.0], tip = ["rod_length/2", 0.0] }
position = ["rod_length/2", 0.0]          # where the frame's origin starts; approximately: assembly closes the joints
angle = 0.0                               # how far the frame is turned
angular_velocity = 0.0                    # left out: completed from the other velocities
# velocity = [0.0, 0.0]                   # of the centre of mass

# [bodies.bob]                            # a point mass has no inertia, angle or points
# type = "point"
# mass = 0.2

[joints.pin]
type = "revolute"                         # or JOINTS
between = ["ground", "rod"]
at = [[0.0, 0.0], "top"]                  # a point of each body: a name, "centre" or coordinates in its frame

[forces.friction]
type = "torsional-spring-damper"          # or FORCES
between = ["ground", "rod"]
damping = "damping"

[forces.motor]
type = "torque"
body = "rod"
torque = "0.5*sin(2*pi*t) if t < 2 else -0.1*rod.omega"   # also rod.x, .y (of the centre of mass), .theta, .vx, .vy
"""
