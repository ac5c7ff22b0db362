"""Lie-group integrators beside the numbers of Exudyn's test models, by two authors of a comparison of such schemes.

The test models ``explicitLieGroupIntegratorTest``, ``explicitLieGroupMBSTest`` and ``heavyTop`` list what their runs
reached: omega_y in ground axes at the end, by number of steps. Bodies are turned there by exponentials of rotation
vectors, or described by Euler angles or Euler parameters. Here the same motions are integrated by `rkmk4` and others,
and by the closed form of the first of their schemes on compiled accelerations. Errors are those of omega_y beside a
tight run of `dop853`.

    python -m benchmarks.lie_groups [TABLE ...]
    python -m benchmarks.lie_groups figure
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.page_tables import PageTable, Row, list_of, number, print_tables
from symgen.api import Model, load
from symgen.base.settings import Settings
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.result.points import rotation_matrices

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
#: Their numbers by steps, bodies, and settings of what stands beside them here.
Series = tuple[Mapping[int, float], str, Mapping[str, Any]]

FILE = Path(__file__).with_name("two-tops.toml")
PAGE = "docs/tables/lie-groups.md"
TIGHT = 1e-13
TOP, TOPS, ANGLES = "`heavy-top`", "two bodies", "two bodies by Euler angles"
#: What is read of each: the body, and the end of the run [s].
ENDS = {TOP: ("top", 2.0), TOPS: ("first", 0.5), ANGLES: ("first", 0.5)}

# -- numbers of the test models: omega_y [rad/s] by number of steps ----------------------------------------------------

#: Runge-Kutta of order 4 on rotation vectors.
EXPLICIT: Mapping[str, Mapping[int, float]] = {
    TOP: {
        1000: -105.89196163228372,
        2000: -106.16651966442174,
        4000: -106.16459373617013,
        8000: -106.16387282138162,
        16000: -106.16380903826868,
        20000: -106.16380619750855,
        32000: -106.163804467377,
        200000: -106.163804141195,
    },
    TOPS: {
        6: 2.702587408085803,
        12: 3.500994026725583,
        25: 3.494254676339284,
        50: 3.4934962239098266,
        100: 3.4934396559233964,
        200: 3.493435944205257,
        400: 3.4934357084409986,
        1000: 3.4934356930303623,
        2000: 3.4934356926497165,
        4000: 3.493435692625912,
        8000: 3.4934357574192836,
        16000: 3.4934358339144076,
    },
}
BY_ANGLES = {
    1000: 3.49438947822092,
    2000: 3.493676264726853,
    4000: 3.4934947182154583,
    8000: 3.4934437605569335,
    16000: 3.49343936041691,
    32000: 3.49343670618681,
    64000: 3.49343610818212,
}
INDEX_2 = {10000: 3.4934359503518673, 20000: 3.4934357159579665, 40000: 3.493435698477724, 80000: 3.49343569408307}
INDEX_3 = {20000: 3.493390210631171, 40000: 3.493412945808683, 80000: 3.493424317747051, 160000: 3.4934300048200115}
#: Implicit schemes by what their file calls them.
IMPLICIT: Mapping[str, Series] = {
    "Euler angles": (BY_ANGLES, ANGLES, {"integrator": "newmark", "coordinates": "joint"}),
    "index 2": (INDEX_2, TOPS, {"integrator": "newmark", "coordinates": "absolute"}),
    "index 3": (INDEX_3, TOPS, {"method": "generalized-alpha", "integrator": "generalized-alpha"}),
}
#: What stands beside their explicit schemes.
LIE: Mapping[str, Any] = {"integrator": "rkmk4", "coordinates": "joint"}
#: The heavy top at 2 s by DOPRI5 within 1e-14 and by RK67 with 1e-4 s, at 0.01 s by 400 steps.
DOPRI5, RK67, EARLY = -106.16380414306643, -106.1638041430917, 149.8473939540758
#: Its Euler parameters at 0.2 s, by RK4 of a program in Matlab, and with index 2 and 1e-4 s.
MATLAB = (-0.70828, 0.43878, 0.54573, 0.0894)
PARAMETERS = (-0.70824157, 0.43878143, 0.54578152, 0.08937154)


# -- the same motions here ---------------------------------------------------------------------------------------------


def by_angles() -> dict[str, Any]:
    """Return the file of the two bodies on hinges and guides between massless bodies: coordinates are Euler angles."""
    raw = parse_toml(FILE.read_text(encoding="utf-8"), FILE.name)
    raw["mechanism"]["name"], raw["joints"] = "two-tops-by-angles", {}
    for last, kinds in (("first", ["revolute"] * 3), ("second", ["translational"] * 3 + ["revolute"] * 3)):
        place, before = raw["bodies"][last].get("position", [0.0, 0.0, 0.0]), "ground"
        for k, kind in enumerate(kinds):
            body = last if k == len(kinds) - 1 else f"{last}{k + 1}"
            raw["bodies"].setdefault(body, {"mass": 0, "inertia": [0, 0, 0], "position": place})
            at = [place if before == "ground" else [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
            raw["joints"][f"J{body}"] = {
                "type": kind, "between": [before, body], "at": at, "axis": np.eye(3)[k % 3].tolist()
            }  # fmt: skip
            before = body
    return raw


@cache
def model(name: str) -> Model:
    """Return a mechanism by its name in the tables."""
    if name == ANGLES:
        return Model(validate(by_angles(), ANGLES))
    return load(str(FILE) if name == TOPS else "heavy-top")


def end_of_run(name: str, steps: int | None, until: float | None = None, **keys: Any) -> tuple[Array, float]:
    """Return Euler parameters and omega_y in ground axes at the end of a run by a number of steps, or a tight one."""
    body, end = ENDS[name]
    end = until or end
    own: dict[str, Any] = {"step": end / steps} if steps else {"rtol": TIGHT, "atol": TIGHT}
    own = {"method": "lagrange", "until": end, "times": [end], "verify": False, "max_violation": 1.0, **own, **keys}
    run = model(name).simulate(Settings(**own))
    assert run.ok, run.reason
    turned = np.array([run[f"{body}.e{k}"][-1] for k in range(4)], dtype=float)
    spin = np.array([run[f"{body}.w{axis}"][-1] for axis in "xyz"], dtype=float)
    return turned, float((rotation_matrices(turned[None])[0] @ spin)[1])


@cache
def exact(name: str) -> float:
    """Return omega_y of a tight run."""
    return end_of_run(name, None, integrator="dop853", coordinates="joint")[1]


# -- the closed form of their scheme -----------------------------------------------------------------------------------


def cross(a: Array, b: Array) -> Array:
    """Return the vector product, without the room that NumPy's takes."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def rate_of_rotation_vector(u: Array, omega: Array) -> Array:
    """Return u', with exp(u) the rotation since the start of the step and omega in body axes."""
    angle = float(np.linalg.norm(u))
    share = (1.0 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2 if angle else 1.0 / 12.0
    once = cross(u, omega)
    return omega + 0.5 * once + share * cross(u, once)


def turned_by(e: Array, u: Array) -> Array:
    """Return Euler parameters after a further rotation by the exponential of a vector in body axes."""
    half = 0.5 * float(np.linalg.norm(u))
    c, s = np.cos(half), 0.5 * np.sinc(half / np.pi) * u
    return np.array([e[0] * c - e[1:] @ s, *(e[0] * s + c * e[1:] + cross(e[1:], s))])


def by_closed_form(name: str, steps: int, until: float | None = None) -> float:
    """Return omega_y at the end by the classical scheme on rotation vectors, in coordinates of joints."""
    body, end = ENDS[name]
    dynamics = model(name).functions(coordinates="joint")
    h = (until or end) / steps
    coordinates, velocities = ([x.name for x in names] for names in (dynamics.coordinates, dynamics.velocities))
    spins = [(coordinates.index(f"{x[:-3]}.e0"), i) for i, x in enumerate(velocities) if x.endswith(".wx")]
    plain = [(coordinates.index(x.replace(".v", ".")), i) for i, x in enumerate(velocities) if ".v" in x]
    places, speeds = (np.array(indices, dtype=int) for indices in ([a for a, _ in plain], [b for _, b in plain]))
    q, v = (np.array(x, dtype=float) for x in dynamics.start)
    none = np.zeros_like(v)

    def moved(u: Array) -> Array:
        new = q.copy()
        new[places] += u[speeds]
        for e, i in spins:
            new[e : e + 4] = turned_by(q[e : e + 4], u[i : i + 3])
        return new

    def rates(u: Array, w: Array) -> tuple[Array, Array]:
        rate = w.copy()
        for _, i in spins:
            rate[i : i + 3] = rate_of_rotation_vector(u[i : i + 3], w[i : i + 3])
        return rate, dynamics.forward_dynamics(moved(u), w, none)

    for _ in range(steps):
        stages = [rates(none, v)]
        for share in (0.5, 0.5, 1.0):
            du, dv = stages[-1]
            stages.append(rates(share * h * du, v + share * h * dv))
        du, dv = (h / 6.0 * (a + 2.0 * b + 2.0 * c + d) for a, b, c, d in zip(*stages, strict=True))
        q, v = moved(du), v + dv
    e, i = coordinates.index(f"{body}.e0"), velocities.index(f"{body}.wx")
    return float((rotation_matrices(q[None, e : e + 4])[0] @ v[i : i + 3])[1])


# -- tables ------------------------------------------------------------------------------------------------------------

#: The closed form takes longer than a second beyond.
LONGEST = 4000
SCHEMES = ("rkmk4", "rkmk4-screws", "rk4")


def explicit_cells(name: str, steps: int) -> Iterator[str]:
    """Yield the error of their run, that of `rkmk4`, its difference and the closed form's, and errors of others."""
    theirs, right = EXPLICIT[name][steps], exact(name)
    omegas = [end_of_run(name, steps, integrator=scheme, coordinates="joint")[1] for scheme in SCHEMES]
    closed = number(abs(by_closed_form(name, steps) - theirs)) if steps <= LONGEST else ""
    yield from (number(abs(theirs - right)), number(abs(omegas[0] - right)), number(abs(omegas[0] - theirs)), closed)
    yield from (number(abs(x - right)) for x in omegas[1:])


def implicit_cells(label: str, steps: int) -> Iterator[str]:
    """Yield the errors of their run and of that here."""
    theirs, name, keys = IMPLICIT[label]
    yield from (number(abs(x - exact(TOPS))) for x in (theirs[steps], end_of_run(name, steps, **keys)[1]))


def tables() -> dict[str, PageTable]:
    """Return the tables of the page."""
    explicit: list[Row] = [
        ((name, str(steps)), partial(list_of, explicit_cells, name, steps))
        for name, theirs in EXPLICIT.items()
        for steps in theirs
    ]
    implicit: list[Row] = [
        ((label, f"`{keys['integrator']}`", str(steps)), partial(list_of, implicit_cells, label, steps))
        for label, (theirs, _, keys) in IMPLICIT.items()
        for steps in theirs
    ]
    at: Mapping[str, Any] = {"integrator": "dop853", "coordinates": "joint"}
    values: list[Row] = [
        ((f"{TOP}, 2 s: DOPRI5", repr(DOPRI5)), lambda: [f"{exact(TOP):.9f}"]),
        ((f"{TOP}, 2 s: RK67, 1e-4 s", repr(RK67)), lambda: [f"{exact(TOP):.9f}"]),
        ((f"{TOP}, 0.01 s: RK4, 400 steps", repr(EARLY)), lambda: [f"{end_of_run(TOP, None, 0.01, **at)[1]:.11f}"]),
        (
            (f"{TOP}, 0.2 s: Euler parameters, RK4", ", ".join(map(str, MATLAB))),
            lambda: [euler_parameters(5, None, **at)],
        ),
        (
            (f"{TOP}, 0.2 s: the same, index 2, 1e-4 s; here `newmark`", ", ".join(map(str, PARAMETERS))),
            lambda: [euler_parameters(8, 2000, integrator="newmark")],
        ),
        (("two bodies, 0.5 s: RK4, 4000 steps", repr(EXPLICIT[TOPS][LONGEST])), lambda: [f"{exact(TOPS):.12f}"]),
    ]
    schemes = ("`rkmk4`", "less theirs", "closed form less theirs", "`rkmk4-screws`", "`rk4`")
    return {
        "values": PageTable("lie_groups values", PAGE, ("value", "theirs", "here"), tuple(values)),
        "explicit": PageTable(
            *("lie_groups explicit", PAGE, ("bodies", "steps", "theirs", *schemes), tuple(explicit)),
            loose=(3, 4, 5, 6, 7),
        ),
        "implicit": PageTable(
            "lie_groups implicit", PAGE, ("theirs", "here", "steps", "their error", "error here"), tuple(implicit)
        ),
    }


def euler_parameters(digits: int, steps: int | None, **keys: Any) -> str:
    """Return the heavy top's Euler parameters at 0.2 s with the sign of theirs, to so many digits."""
    e = end_of_run(TOP, steps, 0.2, **keys)[0]
    return ", ".join(f"{x:.{digits}f}" for x in np.copysign(1.0, MATLAB[0] * e[0]) * e)


# -- the figure --------------------------------------------------------------------------------------------------------


#: What each of the two pictures shows.
DRAWN: Mapping[str, Mapping[str, Series]] = {
    TOP: {"rotation vectors, RK4": (EXPLICIT[TOP], TOP, LIE)},
    TOPS: {"rotation vectors, RK4": (EXPLICIT[TOPS], TOPS, LIE), **IMPLICIT},
}
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")


def draw() -> Figure:
    """Draw errors over step sizes: points are theirs, lines are runs here."""
    from matplotlib.figure import Figure

    drawing = Figure(figsize=(7.2, 3.8), layout="constrained")
    for axes, (title, series) in zip(drawing.subplots(1, 2), DRAWN.items(), strict=True):
        right, end, shown = exact(title), ENDS[title][1], list[Any]()
        for colour, (label, (theirs, name, keys)) in zip(COLOURS, series.items(), strict=False):
            sizes, dashed = [end / steps for steps in theirs], "--" if "method" in keys else "-"
            errors = [abs(end_of_run(name, steps, **keys)[1] - right) for steps in theirs]
            own = {"color": colour, "fillstyle": "none", "markersize": 5}
            shown += axes.loglog(sizes, errors, dashed, label=f"here: {keys['integrator']}", **own)
            shown += axes.loglog(sizes, [abs(x - right) for x in theirs.values()], "o", label=f"theirs: {label}", **own)
        axes.set(xlabel="step [s]", title=title.strip("`"))
    drawing.legend(handles=shown, ncols=len(COLOURS), loc="outside lower center", fontsize=7.5, handlelength=1.6)
    drawing.axes[0].set_ylabel("error of the angular velocity [rad/s]")
    return drawing


def write_figure() -> Path:
    """Write the figure of the page."""
    from benchmarks.kept_pictures import PICTURES, put
    from symgen.study.report.picture import picture_of_figure

    return put(picture_of_figure("lie-groups", "", "", draw), PICTURES)


if __name__ == "__main__":
    if sys.argv[1:] == ["figure"]:
        sys.stdout.write(f"{write_figure()}\n")
        sys.exit(0)
    sys.exit(print_tables(tables(), sys.argv[1:]))
