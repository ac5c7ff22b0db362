"""What meets what: each feature of a mechanism file in each command, target and coordinate, as a page of docs/tables.

python -m benchmarks.meeting [FEATURE ...]

computes the cells, of some features or of all, writes them to ``benchmarks/records/meeting.json`` and prints the page
from there. A cell is ``+``, or the sentence that refuses. `python -m benchmarks.meeting apart` computes the last table
alone, of two features in one file on bodies of their own: `benchmarks.bodies_apart`.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import tempfile
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

import symgen
from benchmarks import bodies_apart
from benchmarks.finite_elements import bar_frame, solid
from symgen.base.errors import InputError, SymgenError
from symgen.cli import main

ROOT = Path(__file__).resolve().parents[1]
RECORD, PAGE = ROOT / "benchmarks" / "records" / "meeting.json", ROOT / "docs" / "tables" / "meeting.md"

#: A cart on a rail with a pole; features change or add lines.
CART = """
[mechanism]
name = "cart"
gravity = [0.0, -9.81]
[run]
until = 0.4
[parameters]
size = 0.5
k = 30.0
[bodies.cart]
mass = 2.0
inertia = 0.1
position = [0.1, 0.0]
[bodies.pole]
mass = 1.0
inertia = {inertia}
points = {{ pin = ["-size", 0.0], tip = ["size", 0.0] }}
position = ["0.1 + size*sin(0.4)", "-size*cos(0.4)"]
angle = "0.4 - pi/2"
[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
[joints.pin]
type = "revolute"
between = ["cart", "pole"]
at = ["centre", "pin"]
{pin}
[forces.spring]
type = "force"
body = "cart"
force = ["{force}", 0.0]
{more}
"""


def cart(inertia: str = '"size**2/3"', pin: str = "", force: str = "-k*cart.x - cart.vx", more: str = "") -> str:
    """Return the text of a file."""
    return CART.format(inertia=inertia, pin=pin, force=force, more=more)


def lowered(play: float, text: str) -> str:
    """Return a file whose pole is lower by a play, which is closed then."""
    return text.replace('"-size*cos(0.4)"', f'"-size*cos(0.4) - {play!r}"')


def thrown(text: str) -> str:
    """Return a file whose cart moves at the start, so that its pole strikes a wall at the right."""
    return text.replace("position = [0.1, 0.0]", "position = [0.1, 0.0]\nvelocity = [1.0, 0.0]", 1)


_PIN = 'type = "revolute"\nbetween = ["cart", "pole"]\nat = ["centre", "pin"]'
_ROWS = 'type = "rows"\nrows = [{ position = "pole.pin.x - cart.x" }, { position = "pole.pin.y - cart.y" }]'
_RAIL = (
    'type = "translational"\nbetween = ["ground", "cart"]\nat = [[0.0, 0.0], "centre"]\naxis = [1.0, 0.0]\nangle = 0.0'
)
_PLAY = "clearance = { hole = 0.011, pin = 0.01, restitution = 0.3 }"
_GUIDE = "clearance = { length = 0.3, height = 0.1, gap = 0.002, restitution = 0.3, friction = 0.3 }"
_BLADE = 'type = "beam"\nbetween = ["cart", "end"]\nat = ["centre", "centre"]\nlength = 0.5\naxis = [1.0, 0.0]'
_HOOK = (
    'mass = 0.0\ninertia = 0.0\nposition = ["0.1 + 2*size*sin(0.4)", "-2*size*cos(0.4)"]\npoints = { a = [0.0, 0.0] }'
)
_ROPE = '[stops.rope]\ngap = "1.0 - sqrt(pole.tip.x**2 + (pole.tip.y + 0.1)**2)"'
_RAMP = '[stops.ramp]\ngap = "cart.x - 0.1 + 0.02*max(0.0, 0.3 - pole.tip.x)"'
#: A bar whose file stands beside the mechanism's.
MODAL_BAR = """[bodies.bar]
type = "modal"
file = "bar.npz"
damping = 1e-3
position = [0.1, 0.0]
[joints.clamp]
type = "rigid"
between = ["cart", "bar.root"]
at = ["centre", [0.0, 0.0]]
"""
_BEAM = "start = [0.1, 0.3]\nend = [0.6, 0.3]\nelements = 2\naxial = 1e3\nbending = 1.0\nmass = 0.2\nrotary = 1e-3"
_LINE = """[beams.line]
start = [0.0, 0.4]
end = [1.0, 0.4]
elements = 4
cable = true
length = 0.98
axial = 200.0
mass = 0.1
clamp = ["ground", "ground"]
[bodies.bead]
type = "point"
mass = 0.1
position = [0.3, 0.4]
[joints.on]
type = "slides-on"
body = "bead"
beam = "line"
"""
_TEETH = """[bodies.wheel]
mass = 0.5
inertia = 0.01
position = [0.1, 0.465]
angle = "1.5*pi + pi/29 - (0.4 - pi)*17/29"
[joints.axle]
type = "revolute"
between = ["cart", "wheel"]
at = [[0.0, 0.465], "centre"]
[outlines.pinion]
body = "pole"
at = ["-size", 0.0]
gear_profile = { module = 0.02, teeth = 17, thinner = 0.05 }
[outlines.wheel]
body = "wheel"
gear_profile = { module = 0.02, teeth = 29, thinner = 0.05 }
[contacts.mesh]
between = [{ outline = "pinion" }, { outline = "wheel" }]
restitution = 0.3
"""
_WALL = """[contacts.wall]
between = [
    { body = "pole", at = "tip" },
    { line = "ground", on = ["0.12 + 2*size*sin(0.4)", 0.0], normal = [-1.0, 0.0] },
]
friction = 0.2
restitution = 0.3"""
_SLOPES = """[outlines.slopes]
body = "ground"
points = [["0.2 + 2*size", -1.5], ["size + 0.03", "-2*size*cos(0.4) - 0.05"], ["size + 0.03", 1.0]]
[contacts.wall]
between = [{ body = "pole", at = "tip", disc = 0.02 }, { outline = "slopes" }]
friction = 0.2
restitution = 0.3"""
_SLED = """[bodies.sled]
mass = 1.0
inertia = 0.05
position = [0.8, -0.6]
velocity = [0.3, 0.0]
[contacts.left]
between = [{ body = "sled", at = [-0.2, -0.1] }, { line = "ground", on = [0.0, -0.7] }]
friction = { sliding = 0.2, static = 0.3 }
[contacts.right]
between = [{ body = "sled", at = [0.2, -0.1] }, { line = "ground", on = [0.0, -0.7] }]
friction = { sliding = 0.2, static = 0.3 }"""
_LATCH = """[joints.latch]
type = "rigid"
between = ["cart", "pole"]
at = ["centre", "pin"]
holds = "cart.x < 0.095 and t < 0.3"
holds_at = "present"
"""
_STOP = "stop = { lower = -2.2, upper = -1.0, restitution = 0.3 }"
_TABLE = 'x = [-2.0, -1.0, 0.0, 1.0, 2.0]\ny = [-60.0, -30.0, 0.0, 30.0, 65.0]\ninterpolation = "cubic"'

#: A cart on a rail in space, with a head that turns as functions of time say.
_HEAD = """[mechanism]
name = "cart"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[run]
until = 0.4
[parameters]
k = 30.0
[bodies.cart]
mass = 2.0
inertia = [0.1, 0.1, 0.1]
position = [0.1, 0.0, 0.0]
[bodies.head]
mass = 1.0
inertia = [0.02, 0.03, 0.04]
position = [0.1, 0.0, 0.2]
[joints.rail]
type = "translational"
between = ["ground", "cart"]
at = [[0.0, 0.0, 0.0], "centre"]
axis = [1.0, 0.0, 0.0]
[joints.neck]
type = "spherical"
between = ["cart", "head"]
at = ["centre", [0.0, 0.0, -0.2]]
[joints.look]
type = "orientation"
between = ["cart", "head"]
euler_angles = ["0.5*sin(3*t)", "0.2*t", "0.0"]
convention = "zyx"
[forces.spring]
type = "force"
body = "cart"
force = ["-k*cart.x - cart.vx", 0.0, 0.0]
"""
#: Files with one feature each.
FEATURES: Mapping[str, str] = {
    "bodies, joints, forces": cart(),
    "input": cart(force="-k*cart.x - cart.vx + push", more='[inputs]\npush = { default = 0.1, unit = "N" }'),
    "output, integral": cart(more='[outputs]\nw = { value = "integral(cart.vx**2)" }'),
    "ray": cart(
        more='[outputs]\nfree = { ray = { body = "pole", at = "tip", direction = [1.0, 0.2], reach = 9.0, '
        'shapes = [{ line = "ground", on = [3.0, 0.0], normal = [-1.0, 0.0] }, { body = "cart", disc = 0.1 }] } }'
    ),
    "state of the file": cart(
        force="-k*cart.x - cart.vx + lag", more='[states.lag]\nstart = 0.3\nrate = "cart.x - lag"'
    ),
    "rows of the file": cart().replace(_PIN, _ROWS),
    "table": cart(force="-profile(cart.x) - cart.vx", more=f"[tables.profile]\n{_TABLE}"),
    "jump in time": cart(force="-k*cart.x + (3.0 if t < 0.2 else 0.0)"),
    "state that reads a reaction": cart(
        force="-k*cart.x - cart.vx + 0.01*shown",
        more='[states.shown]\nrate = "(pin.Fy + pole.alpha - shown)/0.1"',
    ),
    "jump with the state": cart(force="-k*cart.x - (1.0 if cart.x > 0.05 else -1.0)"),
    "event, recorded": cart(more='[events.turn]\nwhen = "cart.x - 0.09"\naction = "record"'),
    "event with a reset": cart(more='[events.kick]\nwhen = "cart.x - 0.09"\nreset = { "cart.vx" = "0.5" }'),
    "driver": cart(more='[joints.motor]\ntype = "driver"\njoint = "rail"\nvalue = "0.1 + 0.05*sin(3*t)"'),
    "orientation of time": _HEAD,
    "redundant rows": cart(more=f"[joints.twin]\n{_RAIL}"),
    "light body": cart(inertia="0.0"),
    "massless body": cart(
        more=f'[bodies.hook]\n{_HOOK}\n[joints.weld]\ntype = "rigid"\nbetween = ["pole", "hook"]\nat = ["tip", "a"]'
    ),
    "rotor": cart(pin="rotor_inertia = 1e-3\ngear_ratio = 10.0"),
    "friction": cart(pin="friction = { sliding = 0.3, static = 0.4 }"),
    "friction, two directions": cart(
        pin="friction = { sliding = { forwards = 0.3, backwards = 0.2 }, static = { forwards = 0.5, backwards = 0.3 } }"
    ),
    "friction by a reaction": cart(pin="friction = { coefficient = 0.2, radius = 0.05 }"),
    "friction of the state": cart(pin='friction = { sliding = "0.2 + cart.x**2" }'),
    "efficiency of a gear": cart(
        more="[bodies.wheel]\nmass = 0.5\ninertia = 0.01\nposition = [0.1, 0.3]\n"
        '[joints.axle]\ntype = "revolute"\nbetween = ["cart", "wheel"]\nat = [[0.0, 0.3], "centre"]\n'
        '[joints.mesh]\ntype = "gear"\nbetween = ["pole", "wheel"]\ncarrier = "cart"\nratio = 0.5\n'
        "efficiency = [0.9, 0.8]"
    ),
    "friction, smooth": cart(pin='friction = { sliding = 0.3, law = "tanh", speed = 1e-3 }'),
    "friction, light body": cart(inertia="0.0", pin="friction = { sliding = 0.3 }"),
    "stop": cart(pin=_STOP),
    "stop, elastic": cart(pin="stop = { lower = -2.2, upper = -1.0, stiffness = 50.0 }"),
    "stop, moving": cart(more='[stops.wall]\ngap = "0.2 - 0.02*t - cart.x"'),
    "friction and stop": cart(pin=f"friction = {{ sliding = 0.3 }}\n{_STOP}"),
    "friction by a reaction and stop": cart(pin=f"friction = {{ coefficient = 0.2, radius = 0.05 }}\n{_STOP}"),
    "rope": cart(more=_ROPE),
    "corner in a gap": cart(more=_RAMP),
    "rotor and stop": cart(pin=f"rotor_inertia = 1e-3\ngear_ratio = 10.0\n{_STOP}"),
    "rotor, event with a reset": cart(
        pin="rotor_inertia = 1e-3\ngear_ratio = 10.0",
        more='[events.kick]\nwhen = "cart.x - 0.09"\nreset = { "cart.vx" = "0.5" }',
    ),
    "contact": thrown(cart(more=_WALL)),
    "contact, two feet": cart(more=_SLED),
    "contacts of a set": thrown(
        cart(
            more="[contacts.all]\namong = [\n"
            '    { body = "pole", at = "tip", disc = 0.02 },\n    { body = "cart", at = [0.0, -0.9], disc = 0.05 },\n'
            '    { line = "ground", on = ["0.14 + 2*size*sin(0.4)", 0.0], normal = [-1.0, 0.0] },\n]\n'
            "friction = 0.2\nrestitution = 0.3"
        )
    ),
    "contact with an outline": thrown(cart(more=_SLOPES)),
    "contact by Poisson's law": thrown(cart(more=_WALL)).replace(
        "[mechanism]", '[mechanism]\nrestitution_law = "poisson"'
    ),
    "contact in space": _HEAD
    + """[contacts.ball]
between = [{ body = "head", sphere = 0.1 }, { plane = "ground", on = [-0.01, 0.0, 0.0], normal = [1.0, 0.0, 0.2] }]
restitution = 0.3
""",
    "contact in space with friction": _HEAD
    + """[contacts.ball]
between = [{ body = "head", sphere = 0.1 }, { plane = "ground", on = [-0.01, 0.0, 0.0], normal = [1.0, 0.0, 0.2] }]
restitution = 0.3
friction = 0.2
""",
    "contact that resists rolling": thrown(cart(more=f"{_WALL}\nrolling = 0.01\n")),
    "contact in space that resists rolling and spin": _HEAD
    + """[contacts.ball]
between = [{ body = "head", sphere = 0.1 }, { plane = "ground", on = [-0.01, 0.0, 0.0], normal = [1.0, 0.0, 0.2] }]
friction = 0.2
rolling = 0.01
torsion = 0.005
""",
    "contact whose surface moves": thrown(
        cart(more=_WALL).replace("[-1.0, 0.0] }", '[-1.0, 0.0], surface_speed = "0.2*cos(3*t)" }')
    ),
    "contact in space whose surface moves": _HEAD
    + """[contacts.ball]
between = [
    { body = "head", sphere = 0.1 },
    { plane = "ground", on = [-0.01, 0.0, 0.0], normal = [1.0, 0.0, 0.2], surface_velocity = [0.0, "0.1*k*t", 0.0] },
]
friction = 0.2
""",
    "contact of gears": cart(more=_TEETH),
    "clearance": lowered(0.001, cart(pin=_PLAY)),
    "clearance of a slide": lowered(0.002, cart())
    .replace(_RAIL, f"{_RAIL}\n{_GUIDE}")
    .replace("[0.1, 0.0]", "[0.1, -0.002]\nvelocity = [0.3, 0.0]"),
    "joint that lets go": cart(pin='holds = "t < 0.2503"'),
    "joint that catches": cart(more=_LATCH),
    "joint that catches, friction and stop": cart(pin=f"friction = {{ sliding = 0.3 }}\n{_STOP}", more=_LATCH),
    "point that slides on a cable": cart(more=_LINE),
    "point that slides and rubs": cart(more=f"{_LINE}friction = {{ coefficient = 0.2 }}\n"),
    "rope over a sheave": cart(
        more="[bodies.weight]\nmass = 0.5\ninertia = 0.01\nposition = [0.5, -0.6]\n"
        '[joints.rope]\ntype = "rope"\nbetween = ["pole", "weight"]\nat = ["tip", "centre"]\n'
        'over = [{ at = [0.4, 0.2], radius = 0.1, turn = "right" }]'
    ),
    "rope in space": _HEAD
    + """[bodies.weight]
type = "point"
mass = 0.5
position = [0.6, 0.0, 0.3]
[joints.rope]
type = "rope"
between = ["head", "weight"]
at = ["centre", "centre"]
over = [{ at = [0.2, 0.0, 0.5] }, { at = [0.4, 0.0, 0.6], radius = 0.1, turn = "left", axis = [0.0, 1.0, 0.0] }]
""",
    "wheel that gives way": cart(
        more="[bodies.wheel]\nmass = 0.5\ninertia = 0.01\nposition = [0.1, 0.3]\nvelocity = [0.2, 0.0]\n"
        '[joints.road]\ntype = "rolling"\nbetween = ["wheel", "cart"]\nradius = 0.2\naxis = [1.0, 0.0]\n'
        "on = [0.0, 0.1]\nstiffness = 1e4\ndamping = 10.0\nfriction = { coefficient = 0.5, speed = 0.05 }"
    ),
    "beam element": cart(
        more="[bodies.end]\nmass = 0.5\ninertia = 0.01\nposition = [0.6, 0.0]\n"
        f"[forces.blade]\n{_BLADE}\naxial = 1e4\nbending = 10.0"
    ),
    "beam": cart(more=f'[beams.bar]\n{_BEAM}\nclamp = "ground"'),
    "modal body": cart(more=MODAL_BAR),
    "modal body that loads stiffen": cart(more=MODAL_BAR.replace("bar.npz", "strip.npz")),
}

#: Takes a file and a folder; returns "" where it is done, and else the sentence.
Place = Callable[[Path, Path], str]


class _TracebackError(Exception):
    """An error that is no sentence."""


def invoked(*arguments: object) -> str:
    """Run a command in this process; return nothing where it succeeds, else its sentence."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            code = main([str(a) for a in arguments])
        except SystemExit as end:
            code = int(end.code or 0)
    if code == 0:
        return ""
    lines = err.getvalue().strip().splitlines()
    if not lines or code != 2:
        raise _TracebackError(err.getvalue())
    return lines[-1].removeprefix("symgen: ")


def guarded(call: Callable[[], object]) -> str:
    """Call something from Python; return nothing where it succeeds, else its sentence."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            call()
    except SymgenError as error:
        return str(error)
    return ""


def _run(*options: str) -> Place:
    return lambda file, folder: invoked("run", file, *options)


def _generated(target: str, name: str, *further: str) -> Place:
    return lambda file, folder: invoked("generate", file, "--target", target, "-o", folder / name, *further)


def _inverse(file: Path, folder: Path) -> str:
    refusal = invoked("run", file, "--save", folder / "motion.nc")
    return refusal or invoked("inverse", file, "--from", folder / "motion.nc", "--actuators", "spring")


def _identified(file: Path, folder: Path) -> str:
    refusal = invoked("run", file, "--save", folder / "motion.csv", "--output-step", "0.05")
    free = ("--free", "k", "--quantity", "cart.x")
    return refusal or invoked("identify", file, "--data", folder / "motion.csv", *free)


def _live(file: Path, folder: Path) -> str:
    refusal, mark = invoked("view", file, "-o", folder / "page.html"), "has no live part: "
    if refusal:
        return refusal
    _, found, rest = (folder / "page.html").read_text(encoding="utf-8").partition(mark)
    why = rest.partition('"')[0]
    return f"a page {mark}{why}" if found else ""


def _exchanged(file: Path, folder: Path) -> str:
    from fmpy import read_model_description, simulate_fmu

    refusal = invoked("generate", file, "--target", "fmu", "-o", folder / "cart.fmu")
    if not refusal and read_model_description(str(folder / "cart.fmu")).modelExchange is None:
        return str(symgen.load(file).generate(folder / "again.fmu", target="fmu").notes[-1])
    if not refusal:
        rows = simulate_fmu(str(folder / "cart.fmu"), fmi_type="ModelExchange", stop_time=0.1, relative_tolerance=1e-6)
        assert abs(rows["time"][-1] - 0.1) < 1e-9, "it has been integrated"
    return refusal


def _stepped(file: Path, folder: Path) -> str:
    def go() -> None:
        simulation = symgen.load(file).start()
        simulation.step(0.05)
        simulation.reset()

    return guarded(go)


def _stressed(file: Path, folder: Path) -> str:
    def go() -> None:
        from symgen.study.stress.study import stress

        study = stress([file], ["gravity"], ["lagrange"], quick=True, jobs=1)
        if study.unusable:
            raise InputError("stress", "cells with references", study.unusable[0][-1])
        assert study.rows, "it has cells"

    return guarded(go)


def _adjoint(file: Path, folder: Path) -> str:
    return guarded(lambda: symgen.load(file).gradient("cart.x", by=("k",), way="adjoint"))


_DESIGNED = ("--vary", "k=25:40", "--aim", "peak(cart.x)", "--keep", "cart.x <= 5 m", "--until", "0.1")
_COMPARED = ("--methods", "lagrange,direct-correction", "--integrators", "dop853", "--until", "0.2")

#: Places by groups, each a table of the page.
GROUPS: Mapping[str, Mapping[str, Place]] = {
    "Runs": {
        "run": _run(),
        "joint coordinates": _run("--coordinates", "joint"),
        "looped code": _run("--shape", "looped"),
        "picard": _run("--integrator", "picard"),
        "radau5": _run("--integrator", "radau5"),
        "ggl, bdf": _run("--method", "ggl", "--integrator", "bdf"),
        "generalized-alpha": _run("--method", "generalized-alpha", "--step", "1e-3"),
        "null-space": _run("--method", "null-space"),
        "augmented-lagrangian": _run("--method", "augmented-lagrangian"),
        "step by step": _stepped,
    },
    "Studies and derivatives": {
        "sweep": lambda file, folder: invoked("sweep", file, "--vary", "k=lin(20,40,3)"),
        "compare": lambda file, folder: invoked("compare", file, *_COMPARED),
        "stress": _stressed,
        "report": lambda file, folder: invoked("report", file, "-o", folder / "report.html"),
        "forward": _run("--sensitivity", "k"),
        "adjoint": _adjoint,
        "identify": _identified,
        "design": lambda file, folder: invoked("design", file, *_DESIGNED),
    },
    "Analyses": {
        "equilibrium": lambda file, folder: invoked("equilibrium", file),
        "modes": lambda file, folder: invoked("modes", file),
        "linearise": lambda file, folder: invoked("linearise", file, "--at", "start", "--instantaneous"),
        "inverse": _inverse,
        "inspect": lambda file, folder: invoked("inspect", file, "-o", folder / "equations.html"),
    },
    "Code and pages": {
        "modules": _generated("cpu", "cpu"),
        "lanes": _generated("lanes", "lanes"),
        "C": _generated("c", "c"),
        "C, dop853": _generated("c", "c", "--integrator", "dop853"),
        "FMU": _generated("fmu", "cart.fmu"),
        "FMU, model exchange": _exchanged,
        "FMU, derivatives": _generated("fmu", "cart.fmu", "--derivatives"),
        "JavaScript": _generated("javascript", "js"),
        "live page": _live,
    },
}
PLACES: Mapping[str, Place] = {name: place for group in GROUPS.values() for name, place in group.items()}

Table = dict[str, dict[str, str]]


def cell(feature: str, place: str) -> str:
    """Return ``+``, or the sentence that refuses a feature in a place."""
    with tempfile.TemporaryDirectory() as folder:
        (file := Path(folder) / "cart.toml").write_text(FEATURES[feature], encoding="utf-8")
        write_modal_files(FEATURES[feature], Path(folder))
        return PLACES[place](file, Path(folder)).replace(f"{folder}/", "") or "+"


def write_modal_files(text: str, folder: Path) -> None:
    """Write the modal bodies that a file reads beside it."""
    for name in ("bar.npz", "strip.npz"):
        if name in text:
            _reduce_bar(folder / name)


def _reduce_bar(file: Path) -> None:
    """Write a bar of solids, or a strip of bars that loads stiffen, as a modal body."""
    if file.stem == "bar":
        bar = solid((0.4, 0.02), (4, 1), young=1e8, thick=0.02)
        symgen.reduced(bar.x, bar.mass, bar.stiffness, bar.ends).save(file)
    else:
        strip = bar_frame(np.column_stack([np.linspace(0.0, 0.4, 9), np.zeros(9)]), 1e8, 4e-4, 1.3e-8, 1000.0)
        symgen.reduced(strip.x, strip.mass, strip.stiffness, strip.ends, stiffening="interfaces").save(file)


def stored() -> Table:
    """Return the cells as they are stored."""
    table: Table = json.loads(RECORD.read_text(encoding="utf-8"))
    return table


def page(table: Table) -> str:
    """Return the text of the page."""
    lines = [
        "# What meets what",
        "",
        "Written by `python -m benchmarks.meeting`. Each row is a mechanism file with one feature, each column what is",
        "asked of it: `+` where it is done, else the number of the sentence below that says what is taken instead.",
        "Methods and integrators that fit together are on [a page of their own](pairs.md).",
        "",
        f"Features: {'; '.join(FEATURES)}.",
    ]
    for group, places in GROUPS.items():
        refusals = list(dict.fromkeys(table[f][p] for f in FEATURES for p in places if table[f][p] != "+"))
        lines += ["", f"## {group}", "", f"| | {' | '.join(places)} |", "| --- |" + " --- |" * len(places)]
        for cells, features in _equal(table, places).items():
            name = "all others" if set(cells) == {"+"} else "; ".join(features)
            shown = (c if c == "+" else str(1 + refusals.index(c)) for c in cells)
            lines.append(f"| {name} | {' | '.join(shown)} |")
        lines += ["", *(f"{i}. {_shown(sentence)}" for i, sentence in enumerate(refusals, 1))] if refusals else []
    done = sum(c == "+" for row in table.values() for c in row.values())
    lines += ["", f"{done} of {len(FEATURES) * len(PLACES)} cells are done.", ""]
    return "\n".join([*lines, *bodies_apart.table(bodies_apart.stored()), ""])


def _equal(table: Table, places: Mapping[str, Place]) -> dict[tuple[str, ...], list[str]]:
    """Return the features that have the same cells, by these; those that are done everywhere come last."""
    rows: dict[tuple[str, ...], list[str]] = {}
    for feature in FEATURES:
        rows.setdefault(tuple(table[feature][place] for place in places), []).append(feature)
    return dict(sorted(rows.items(), key=lambda row: set(row[0]) == {"+"}))


def _shown(sentence: str) -> str:
    """Return a sentence as code, which needs no escapes."""
    return f"`{sentence.replace('`', chr(39))}`"


def record(features: list[str]) -> None:
    """Compute the cells of some features, and write record and page."""
    table = stored() if RECORD.exists() else {}
    for feature in features:
        table[feature] = {place: cell(feature, place) for place in PLACES}
        print(
            f"{feature}: {sum(c == '+' for c in table[feature].values())} of {len(PLACES)}", file=sys.stderr, flush=True
        )
        whole = {feature: table[feature] for feature in FEATURES if feature in table}
        RECORD.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")
    if len(whole) == len(FEATURES):
        PAGE.write_text(page(whole), encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:] != ["apart"]:
        record(sys.argv[1:] or list(FEATURES))
    if sys.argv[1:] in ([], ["apart"]):
        bodies_apart.record()
        PAGE.write_text(page(stored()), encoding="utf-8")
