"""Mechanisms whose events change velocities and write the time to a state, the same in all targets."""

from pathlib import Path

from symgen.describe import catalogue

#: A ball that bounces and loses energy; the state `last` is the time of the last impact.
BALL = """
[mechanism]
name = "bouncing-ball"
gravity = [0.0, -9.81]
[parameters]
e = 0.7
[bodies.ball]
type = "point"
mass = 1.0
position = [0.0, 1.0]
velocity = [1.0, 0.0]
[states.last]
start = 0.0
rate = 0.0
[events.floor]
when = "ball.y < 0"
reset = { "ball.vy" = "-e*ball.vy", last = "t" }
[outputs]
hit = "last"
[run]
until = 1.5
step = 1e-3
"""

#: A four-bar whose crank is struck each time it passes the horizontal.
FOUR_BAR = (
    (Path(catalogue.__file__).parent / "four-bar.toml")
    .read_text(encoding="utf-8")
    .replace('"four-bar"', '"struck-bar"')
    + """
[states.last]
start = 0.0
rate = 0.0
[events.blow]
when = "crank.y < 0"
direction = "any"
reset = { "crank.omega" = "0.8*crank.omega + 0.5", last = "t" }
[outputs]
hit = "last"
"""
)
#: The ball's run ends where it is far, at t = 1.2; the state `clock` is the time.
STOPPED = BALL.replace(
    "[events.floor]",
    """[states.clock]
start = 0.0
rate = 1.0
[events.far]
when = "ball.x > 1.2"
action = "stop"
[events.floor]""",
)
STRUCK = {"ball": BALL, "four-bar": FOUR_BAR}
