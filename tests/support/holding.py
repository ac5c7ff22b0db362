"""Machines whose joints hold for a while, as files."""

_HEAD = '[mechanism]\nname = "{}"\ngravity = [0.0, {}]\n'

#: A pendulum of 1 m that begins horizontally at rest, released at `t0`.
PENDULUM = (
    _HEAD.format("pendulum-released", -9.81)
    + """
[parameters]
t0 = 0.3

[bodies.bob]
type = "point"
mass = 1.0
position = [1.0, 0.0]

[joints.rod]
type = "distance"
between = ["ground", "bob"]
at = [[0.0, 0.0], "centre"]
length = 1.0
holds = "t < t0"

[run]
until = 1.0
"""
)

#: Two rotors, which a clutch of teeth connects twice, at angles as they are; a motor drives one between.
CLUTCH = (
    _HEAD.format("teeth-of-a-clutch", 0.0)
    + """
[parameters]
te = 0.1

[bodies.a]
mass = 1.0
inertia = 2.0
angular_velocity = 3.0

[bodies.b]
mass = 1.0
inertia = 1.0
angle = 0.4
angular_velocity = -1.0

[joints.A]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]

[joints.B]
type = "revolute"
between = ["ground", "b"]
at = [[0.0, 0.0], "centre"]

[joints.teeth]
type = "rigid"
between = ["a", "b"]
at = ["centre", "centre"]
holds = "t > te and t < 0.3 or t > 0.5"
holds_at = "present"

[forces.motor]
type = "torque"
body = "a"
torque = "4.0 if t > 0.3 and t < 0.5 else 0.0"

[run]
until = 1.0
"""
)

#: A carriage on a rail, from which a body swings until the carriage is at `place`.
CARRIAGE = (
    _HEAD.format("carriage-drops-body", -9.81)
    + """
[parameters]
place = 0.5

[bodies.carriage]
mass = 3.0
inertia = 0.1
position = [0.0, 2.0]
velocity = [1.5, 0.0]

[bodies.load]
mass = 1.0
inertia = 0.05
position = [0.3, 1.6]
angle = 0.6435

[joints.rail]
type = "translational"
between = ["ground", "carriage"]
at = [[0.0, 2.0], "centre"]
axis = [1.0, 0.0]

[joints.hook]
type = "revolute"
between = ["carriage", "load"]
at = ["centre", [0.0, 0.5]]
holds = "carriage.x < place"

[run]
until = 0.6
"""
)

#: A jumper leaves a platform at `t0` and falls; an elastic cord of 20 m slows the fall.
JUMPER = (
    _HEAD.format("bungee-jumper", -9.81)
    + """
[parameters]
t0 = 0.5

[bodies.jumper]
type = "point"
mass = 80.0
position = [0.0, 0.0]

[joints.platform]
type = "rows"
between = ["ground", "jumper"]
rows = [{ position = "jumper.x" }, { position = "jumper.y" }]
holds = "t < t0"

[forces.cord]
type = "force"
body = "jumper"
force = [0.0, "120.0*max(0.0, -jumper.y - 20.0)"]

[run]
until = 6.0
"""
)

#: A pin holds a block against a force that grows, and breaks by what it carries.
LINK = (
    _HEAD.format("breaking-link", 0.0)
    + """
[parameters]
strength = 50.0

[bodies.block]
mass = 2.0
inertia = 0.1

[joints.link]
type = "revolute"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
holds = "link.F < strength"

[forces.pull]
type = "force"
body = "block"
force = ["200.0*t", 0.0]

[run]
until = 0.6
"""
)

#: A ball that falls past a hook until its rope is taut, which takes the speed along the rope.
ROPE = (
    _HEAD.format("rope-becomes-taut", -9.81)
    + """
[parameters]
length = 1.0

[bodies.ball]
type = "point"
mass = 2.0
position = [0.4, 0.0]
velocity = [0.5, 0.0]

[joints.rope]
type = "distance"
between = ["ground", "ball"]
at = [[0.0, 0.0], "centre"]
length = "length"
holds = { catches = "t < 0.9 and sqrt(ball.x**2 + ball.y**2) > length", releases = "t > 0.9" }

[run]
until = 1.2
"""
)

#: Two bodies that float past each other are welded where they are, and part again.
DOCKING = (
    _HEAD.format("docking", 0.0)
    + """
[parameters]
offset = 0.5
spin = 0.8

[bodies.a]
mass = 2.0
inertia = 0.05
angular_velocity = "spin"

[bodies.b]
mass = 1.0
inertia = 0.02
position = ["offset", 0.0]
velocity = [0.3, 0.4]

[joints.weld]
type = "rigid"
between = ["a", "b"]
at = ["centre", "centre"]
holds = { catches = "t > 1.0", releases = "t > 2.0", at_start = false }
holds_at = "present"

[outputs]
L = "0.05*a.omega + 0.02*b.omega + 2.0*(a.x*a.vy - a.y*a.vx) + 1.0*(b.x*b.vy - b.y*b.vx)"

[run]
until = 2.4
"""
)
MACHINES = {
    "pendulum": PENDULUM,
    "clutch": CLUTCH,
    "carriage": CARRIAGE,
    "jumper": JUMPER,
    "link": LINK,
    "rope": ROPE,
    "docking": DOCKING,
}
