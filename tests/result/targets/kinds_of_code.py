"""A cart with a pole in all kinds that make functions of their own: what a target prints of each has to fit into it."""

from benchmarks.meeting import cart
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

_TABLE = '[tables.profile]\nx = [-2.0, -1.0, 0.0, 1.0, 2.0]\ny = [-60.0, -30.0, 0.0, 30.0, 65.0]\ninterpolation = "{}"'
_HOOK = """
[bodies.hook]
mass = 0.0
inertia = 0.0
position = ["0.1 + 2*size*sin(0.4)", "-2*size*cos(0.4)"]
points = { a = [0.0, 0.0] }
[joints.weld]
type = "rigid"
between = ["pole", "hook"]
at = ["tip", "a"]
"""
_TWIN = """
[joints.twin]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
"""
_EVENT = '[events.{0}]\nwhen = "cart.x - 0.0{1}"\n{2}\n'
_TOP = """
[mechanism]
name = "cart"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[bodies.rod]
mass = 1.0
inertia = [0.1, 0.1, 0.02]
position = [0.5, 0.0, 0.0]
points = { end = [-0.5, 0.0, 0.0] }
angular_velocity = [1.0, 2.0, 3.0]
[joints.ball]
type = "spherical"
between = ["ground", "rod"]
at = [[0.0, 0.0, 0.0], "end"]
"""


def _cart(inertia='"size**2/3"', force="-k*cart.x - cart.vx", more=""):
    units = 'size = { value = 0.5, unit = "m" }\nk = { value = 30.0, unit = "N/m" }'
    return cart(inertia=inertia, force=force, more=more).replace("size = 0.5\nk = 30.0", units)


#: Texts of files by what is special in them.
FILES = {
    "plain": _cart(),
    "light body": _cart(inertia="0.0"),
    "massless body": _cart(more=_HOOK),
    "redundant rows": _cart(more=_TWIN),
    "spatial": _TOP,
    "input": _cart(force="-k*cart.x + push", more='[inputs]\npush = { default = 0.1, unit = "N" }'),
    "own state": _cart(force="-k*cart.x + lag", more='[states.lag]\nstart = 0.3\nrate = "-lag + cart.x"'),
    "state of a reaction": _cart(
        force="-k*cart.x + lag", more='[states.lag]\nrate = "(pin.Fy + pole.alpha - lag)/0.1"'
    ),
    "state with a formula": _cart(force="lag", more='[states.lag]\nstart = "k*size**2"\nrate = "min(-lag, cart.x)"'),
    "linear table": _cart(force="-profile(cart.x)", more=_TABLE.format("linear")),
    "cubic table": _cart(force="-profile(cart.x)", more=_TABLE.format("cubic")),
    "functions": _cart(force="max(-k*cart.x, -9) + abs(cart.vx)**3 + atan2(cart.vx, 2) + (1 if cart.x > 9 else 0)"),
    "outputs": _cart(more='[outputs]\nw = { value = "integral(cart.vx**2)" }\nheight = { value = "pole.tip.y" }'),
    "reset": _cart(more=_EVENT.format("kick", 9, 'action = "reset"\nreset = { "cart.vx" = "0.5" }')),
    "impact": _cart(more=_EVENT.format("hit", 5, 'action = "reset"\nreset = { "cart.vx" = "-0.5*cart.vx" }')),
    "record and stop": _cart(
        more=_EVENT.format("turn", 9, 'action = "record"') + _EVENT.format("end", 1, 'action = "stop"')
    ),
    "driver": _cart(more='[joints.motor]\ntype = "driver"\njoint = "rail"\nvalue = "0.1 + 0.05*sin(3*t)"'),
    "rotor": _cart().replace(
        'at = ["centre", "pin"]', 'at = ["centre", "pin"]\nrotor_inertia = 1e-3\ngear_ratio = 10.0'
    ),
    "everything": _cart(
        inertia="0.0",
        force="-profile(cart.x) + lag + push",
        more='[inputs]\npush = { default = 0.1 }\n[states.lag]\nstart = 0.3\nrate = "-lag + cart.x"\n'
        '[outputs]\nheight = { value = "pole.tip.y" }\n'
        + _TABLE.format("cubic")
        + "\n"
        + _EVENT.format("kick", 9, 'action = "reset"\nreset = { "cart.vx" = "0.5" }'),
    ),
}


def mechanism_of(kind):
    """Return the mechanism of a kind."""
    return validate(parse_toml(FILES[kind], kind), kind)
