"""Mechanisms whose lengths are parameters, with derivatives from closed forms and from models without symgen."""

from pathlib import Path

#: The catalogue's four-bar; the crank is held at 60 degrees, at rest.
FOUR_BAR = """
[mechanism]
name = "four-bar-of-lengths"
gravity = [0.0, "-g"]

[parameters]
a = { value = 2.0, unit = "m" }
b = { value = 8.0, unit = "m" }
c = { value = 5.0, unit = "m" }
d = { value = 10.0, unit = "m" }
m1 = { value = 2.0, unit = "kg" }
m2 = { value = 8.0, unit = "kg" }
m3 = { value = 5.0, unit = "kg" }
g = { value = 9.81, unit = "m/s^2" }

[bodies.crank]
mass = "m1"
inertia = "m1*a**2/12"
points = { A = ["-a/2", 0.0], B = ["a/2", 0.0] }
position = [0.5, 0.8660254037844386]
angle = "pi/3"
hold = "angle"

[bodies.coupler]
mass = "m2"
inertia = "m2*b**2/12"
points = { B = ["-b/2", 0.0], C = ["b/2", 0.0] }
position = [4.706229663272004, 3.236664273905892]
angle = 0.38564124740737094

[bodies.rocker]
mass = "m3"
inertia = "m3*c**2/12"
points = { D = ["-c/2", 0.0], C = ["c/2", 0.0] }
position = [9.206229663272005, 2.3706388701214536]
angle = 1.8938968124057762

[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "A"]
[joints.B]
type = "revolute"
between = ["crank", "coupler"]
at = ["B", "B"]
[joints.C]
type = "revolute"
between = ["coupler", "rocker"]
at = ["C", "C"]
[joints.D]
type = "revolute"
between = ["ground", "rocker"]
at = [["d", 0.0], "D"]
"""
#: Its crank's angle and speed at t = 2 s, and their derivatives: a model in one coordinate by mpmath in 30 digits,
#: extrapolated differences and a complex step, which agree in 12 digits.
STATE = -3.89197850462554669, -2.26048163611827722
BY_NAME = {
    "a": (0.983355206404607, -1.54342915819839),
    "b": (-0.218174112582779, 0.673468941054567),
    "c": (-0.174838838974221, 0.434666525528715),
    "d": (0.291335831884241, -0.839144090173804),
    "m1": (-0.110828448010165, 0.264398031306828),
    "m2": (-0.00976953694893677, 0.0397271484985635),
    "m3": (0.0599626383223649, -0.169322650120433),
    "g": (-0.230426262601252, 0.399308365143193),
}
LENGTHS, MASSES = {"a": 2.0, "b": 8.0, "c": 5.0, "d": 10.0}, {"m1": 2.0, "m2": 8.0, "m3": 5.0}

#: A uniform rod on a pin, from rest.
ROD = """
[mechanism]
name = "rod-on-a-pin"
gravity = [0.0, "-g"]

[parameters]
length = { value = 1.0, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }
angle = { value = 1.0, unit = "rad" }

[bodies.rod]
mass = 1.0
inertia = "length**2/12"
points = { pin = ["-length/2", 0.0] }
position = ["length/2*sin(angle)", "-length/2*cos(angle)"]
angle = "angle - pi/2"
hold = "angle"

[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "pin"]
"""
#: Its angle and speed at t = 3 s by Jacobi's sn, with derivatives by length, g and angle.
ROD_STATE = -0.2063670748029877, 3.592276558181479
ROD_BY = {
    "length": (-5.38841483727222, -6.3189131370493),
    "g": (0.549277761189829, 0.644129779515728),
    "angle": (-1.63956547944265, 2.07073566544866),
}
#: Its period by the elliptic integral, with derivatives by length, g and angle.
ROD_PERIOD = 1.746598536990109, {"length": 0.8732992684950546, "g": -0.08902133216055602, "angle": 0.230762206713677}

#: The slider-crank of IDAS's example ``idasSlCrank_FSA_dns``; G is the integral of the kinetic energy over 10 s.
SLIDER_CRANK = (Path(__file__).parents[3] / "benchmarks" / "idas-slider-crank.toml").read_text(encoding="utf-8")
#: G and its derivatives, by a model in one coordinate in 30 digits; the example prints 5 of them.
G, G_BY = 3.3366067994828, {"k": 0.33344810612844, "c": -0.36375403397095}


def model(folder, text: str):
    """Return the model of a text."""
    import symgen

    path = folder / "mechanism.toml"
    path.write_text(text, encoding="utf-8")
    return symgen.load(path)
