"""What ``symgen generate`` writes beside emitted modules, so that they run by themselves: a package with its start."""

from __future__ import annotations

import json
import math
from collections.abc import Container, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symgen.describe.events import DOES
from symgen.emit.text import harmless

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.compiling.pipeline import MethodChoice
    from symgen.running.prepare import Prepared

#: Sections of ``w`` that a start settles; all others are written before they are read.
_SETTLED = ("status", "winding", "mask", "saved", "pivot", "gauge", "row_weight", "mass", "mass_entry")

#: What each file of a package has that symgen wrote; others of these names are somebody else's and stay as they are.
_OURS = {"start.json": '"step_at"', "simulate.py": "Written by symgen", "__init__.py": "Written by symgen"}
_OURS |= {"README.md": "Written by symgen"}

_PACKAGE = '''"""Emitted code of `MECHANISM`, and a consistent start; see README.md. Written by symgen."""

import json
import warnings
from importlib import import_module
from pathlib import Path

import numpy as np

_HERE = Path(__file__).resolve().parent
START = json.loads((_HERE / "start.json").read_text(encoding="utf-8"))


class Run:
    """A method of this mechanism at its start: `y` holds q, v and the work, `p` parameters, `w` and `iw` scratch."""

    def __init__(self, method=START["method"], step=START["step"]):
        if START["events"]:  # what follows after one of them is another motion than that of `symgen run`
            warnings.warn(f"nothing here looks for events, as a run does: {START['events']}", stacklevel=2)
        for told in START["warnings"]:
            warnings.warn(told, stacklevel=2)
        told = json.loads((_HERE / f"{method}.json").read_text(encoding="utf-8"))
        model, self.law = (import_module(f".{stem}", __name__) for stem in ("model", method))
        values, defaults = list(START["parameters"].values()), [default for _, default in told["parameters"]]
        first = told["parameter_offset"]
        self.p = np.zeros(first + len(defaults) + told["hoisted"])
        self.p[: len(values)], self.p[first : first + len(defaults)] = values, defaults
        model.prepare(self.p)
        self.law.prepare(self.p)
        self.w, self.iw = np.zeros(told["nw"]), np.zeros(START["counters"], np.int64)
        self.limits = {name: x[method] if name == "velocity" else x for name, x in START["limits"].items()}
        self.taken, self.energy, self.moved = 0, None, 0.0
        self.corrects, self.near, self.before = told["position_correction"], False, None
        for at, numbers in START["w"].values():
            self.w[at : at + len(numbers)] = [float(number) for number in numbers]
        self.y = self.corrected(0.0, np.array(START["y"]))
        self.w[START["step_at"]] = step
        self.passed(0.0)

    def rate(self, t, y):
        """Return the rate of a state."""
        y, ydot = np.array(y), np.zeros(len(y))
        if self.law.rhs(t, y, self.p, self.w, self.iw, ydot):  # a pivot is suspicious: rows are chosen anew
            self.law.confirm(t, y, self.p, self.w, self.iw, ydot)
        return ydot

    def corrected(self, t, y):
        """Return a state that is taken, corrected as the method does."""
        y = np.array(y)
        if self.law.accept(t, y, self.p, self.w, self.iw) & 1:
            raise ArithmeticError(f"the state at t = {t} cannot be corrected")
        return y

    def accepted(self, t, y, last=False):
        """Return the next state of a run, corrected; an ArithmeticError says why `symgen run` would end there.

        The energy of few steps is judged at the `last` one alone.
        """
        y = self.corrected(t, y)
        if why := self.wrong(y, last):
            raise ArithmeticError(f"{why} at t = {t}")
        entered = self.passed(t)
        if entered is not None and not self.near:
            where = f"passed near a singular position at t = {entered:.6g} s"
            if self.corrects:
                warnings.warn(f"{where}; the error there is not controlled by the step size", stacklevel=2)
            else:
                doubt = "and positions are not corrected: nothing tells whether the right branch was taken"
                warnings.warn(f"unverified: {where} {doubt}", stacklevel=2)
            self.near = True
        self.taken += 1
        return y

    def passed(self, t):
        """Return when the state that was taken last, or the step to it, has come near a singular position, or None."""
        pivots = self.w[START["status"].index("smallest_pivot")], self.limits["pivot"]
        sine, least = (max(pivot, 0.0) ** 0.5 for pivot in pivots)
        begun, last, fall = self.before or (t, sine, 0.0)
        gone = t - begun
        self.before = t, sine, (last - sine) / gone if gone > 0.0 else 0.0
        return t if sine < least else begun if fall > 0.0 and last - fall * gone < least else None

    def wrong(self, y, last=False):
        """Return why the corrected state that comes next in a run cannot be relied on, or an empty text."""
        now, limits, n = dict(zip(START["status"], self.w.tolist())), self.limits, START["coordinates"]
        sizes = np.abs(y[: len(START["metric"])]) * START["metric"]
        length, speed = max(now["length_scale"], *sizes[:n], 0.0), max(now["speed_scale"], *sizes[n:], 0.0)
        self.w[START["status"].index("speed_scale")] = speed
        whole = now["kinetic"] + now["potential"]
        if self.energy is None:
            self.energy = whole - y[-1], now["potential"]
        begun, level = self.energy
        self.moved = max(self.moved, now["kinetic"], abs(now["potential"] - level), abs(y[-1]))
        error = abs(whole - begun - y[-1])
        if not (np.isfinite(error) and np.isfinite(y).all()):
            return "the state is not finite"
        if now["shortest_row"] < limits["shortest_row"]:
            return "the gradient of a constraint has vanished"
        if not now["position_measure"] <= limits["position"] * length:
            return f"positions violate the constraints by {now['position_violation']:.3g}"
        if not now["velocity_measure"] <= limits["velocity"] * speed:
            return f"velocities violate the constraints by {now['velocity_violation']:.3g}"
        rounding = limits["rounding"] * (now["kinetic"] + abs(now["potential"]))
        if (last or self.taken >= limits["setting_out"]) and error > limits["energy"] * self.moved + rounding:
            return f"the energy is off by {error:.3g} J"
        if START["redundant"] and now["smallest_pivot"] < limits["pivot"]:
            return "the rows that stand for those left out hardly hold, and nothing here chooses others,"
        return ""
'''

_SIMULATE = '''"""Simulate this mechanism: python simulate.py [METHOD [UNTIL [STEP]]]. Written by symgen."""
import importlib.util as load, json, pathlib, sys  # the package needs numpy and numba, and nothing else
spec = load.spec_from_file_location("emitted", pathlib.Path(__file__).resolve().with_name("__init__.py"))
package = sys.modules["emitted"] = load.module_from_spec(spec)  # whatever its folder is called
spec.loader.exec_module(package)

def simulate(method=package.START["method"], until=package.START["until"], h=package.START["step"]):
    """Return times and states (q, v, work) of a run by the classical Runge-Kutta scheme with steps h."""
    run = package.Run(method, h)
    states = [(0.0, run.y)]
    for i in range(1, (end := round(until / h)) + 1):
        t, y = states[-1]
        k1 = run.rate(t, y)
        k2 = run.rate(t + h / 2, y + h / 2 * k1)
        k3 = run.rate(t + h / 2, y + h / 2 * k2)
        k4 = run.rate(t + h, y + h * k3)
        states.append((i * h, run.accepted(i * h, y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), i == end)))
    return states
t, y = simulate(*sys.argv[1:2], *map(float, sys.argv[2:4]))[-1]
print(json.dumps({"t": t, **dict(zip(package.START["names"], y.tolist()))}, indent=1))
'''


def may_write(path: Path) -> bool:
    """Whether a file of a package may be written: it is not there, or symgen wrote it."""
    try:
        return not path.exists() or _OURS[path.name] in path.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return False


def package(
    model: Model, choices: Sequence[MethodChoice], coordinates: str, free: Container[str] = ()
) -> tuple[tuple[MethodChoice, ...], dict[str, str]]:
    """Return methods as they are to be emitted, and the files that make them a package that runs, by name.

    Where bodies are so light at the start that a run takes another solver, so does the package. Where no method is for
    explicit integrators, or the mechanism does not close, there is no start and nothing to simulate, and the README
    says why.

    Parameters
    ----------
    model : Model
        What is to be generated, without outputs.
    choices : sequence of MethodChoice
        The methods, as they were asked for.
    coordinates : {"absolute", "joint"}
        Whose coordinates the state has.
    free : container of str
        Methods whose solver was not asked for.
    """
    from symgen.errors import AssemblyError, InputError
    from symgen.runtime.motions import refuse_jumps

    why, files = "no method here is for explicit integrators", dict[str, str]()
    explicit = [choice for choice in choices if not choice.implicit]
    usual = next((c for c in explicit if c.method.name == "direct-correction"), explicit[0] if explicit else None)
    if usual is not None:
        try:
            first = next((c for c in explicit if _may_change(c, free)), None)
            if first is not None and _finds_light(model, first, coordinates):
                choices = [c.given(solver="augmented") if _may_change(c, free) else c for c in choices]
                explicit = [choice for choice in choices if not choice.implicit]
                usual = next(choice for choice in explicit if choice.method is usual.method)
            settled = _settled(model, usual, explicit, coordinates)
            files = {"start.json": json.dumps(settled, allow_nan=False, indent=1) + "\n", "simulate.py": _SIMULATE}
            refuse_jumps(model.mechanism, {}, model.mechanism.defaults.until)
        except AssemblyError as error:
            why = harmless(error)
        except InputError as error:
            if not files:
                raise
            why, files = harmless(error), {}
    name = harmless(model.name)
    bare = f'"""Emitted code of `{name}`; see README.md. Written by symgen."""\n'
    files["__init__.py"] = _PACKAGE.replace("MECHANISM", name) if "start.json" in files else bare
    files["README.md"] = _readme(model, explicit, why if "start.json" not in files else "")
    return tuple(choices), files


def _may_change(choice: MethodChoice, free: Container[str]) -> bool:
    """Whether a method has a solver, and another one was not asked for."""
    return choice.method.name in free and "solver" in choice.options


def _finds_light(model: Model, choice: MethodChoice, coordinates: str) -> bool:
    """Whether a run by a method would take another solver than it has."""
    return bool(
        _begun(model, choice, coordinates, leave=("solver",)).compiled.law.options["solver"] != choice.options["solver"]
    )


def _begun(model: Model, choice: MethodChoice, coordinates: str, leave: Container[str] = ()) -> Prepared:
    """Return what a run by ``rk4`` begins with; options to `leave` are chosen by it."""
    from symgen.cli._reading import at_start
    from symgen.settings import Settings

    options = {f"method.{name}": str(value) for name, value in choice.options.items() if name not in leave}
    settings = Settings(choice.method.name, "rk4", options=options, shape="straight", coordinates=coordinates)
    return at_start(model, settings)[0]


def _settled(model: Model, choice: MethodChoice, choices: Sequence[MethodChoice], coordinates: str) -> dict[str, Any]:
    """Return parameters, a consistent start and the limits of runs, as the package takes them for some methods."""
    import numpy as np

    from symgen.ir.program import COUNTERS, STATUS
    from symgen.running.plan import limit_of_velocities
    from symgen.runtime import abi
    from symgen.runtime.frame import SETTING_OUT
    from symgen.runtime.simulation import Simulation
    from symgen.runtime.watch import NEGLIGIBLE, VANISHING

    begun = _begun(model, choice, coordinates)
    info, defaults, spec = begun.compiled.info, model.mechanism.defaults, begun.plan.spec
    run = Simulation(begun.compiled, begun.plan.integrator, begun.start, spec)
    run.enter(run.outputs(np.zeros(0)), until=0.0)
    state, most = run.state, spec.max_violation
    kept = {name: info.sections[name] for name in _SETTLED if name in info.sections}
    return {
        "mechanism": model.name,
        "method": choice.stem,
        "until": defaults.until,
        "step": defaults.step,
        "parameters": model.parameters(),
        "events": _events(model),
        "warnings": list(begun.plan.all_warnings),
        "names": [q.name for q in (*info.coordinates, *info.velocities)] + ["work"],
        "y": state.y[: info.work + 1].tolist(),
        "counters": len(COUNTERS),
        "status": list(STATUS),
        "coordinates": info.nq,
        "metric": state.metric[: info.work].tolist(),
        "redundant": int(state.control[abi.MASKED]),
        "limits": {
            "position": most,
            "velocity": {c.stem: limit_of_velocities(c.method, most) or most for c in choices},
            "energy": spec.max_energy_error,
            "rounding": NEGLIGIBLE,
            "setting_out": SETTING_OUT,
            "shortest_row": VANISHING**2,
            "pivot": float(state.gauges[abi.WARN_PIVOT]),
        },
        "step_at": info.sections["status"][0] + STATUS.index("step"),
        "w": {name: [at, [_json(x) for x in state.w[at : at + size]]] for name, (at, size) in kept.items()},
    }


def _json(x: float) -> float | str:
    """Return a number as JSON has it: the mask of a row that depends on others is ``inf``."""
    return float(x) if math.isfinite(x) else str(float(x))


def _readme(model: Model, choices: Sequence[MethodChoice], why: str) -> str:
    title, name = harmless(model.mechanism.title or model.name), harmless(model.name)
    lines = [
        f"# {name}",
        "",
        f"{title}. Written by symgen; the same mechanism gives the same bytes.",
        "",
        "`model.py` holds what all methods share, and one module a method its law; each begins with what its arrays"
        " mean. The JSON file beside a module says the same for programs.",
        "",
    ]
    if why:
        return "\n".join([*lines, f"There is no `simulate.py`: {why}.", ""])
    events = _events(model)
    methods = ", ".join(f"`{choice.stem}`" for choice in choices)
    return "\n".join(
        [
            *lines,
            "    python simulate.py [METHOD [UNTIL [STEP]]]",
            "",
            f"runs it with numpy and numba alone, from the start in `start.json`. METHOD is one of {methods}. `Run` in"
            " `__init__.py` has the start and the functions: `rate(t, y)`, and `corrected(t, y)` for accepted states;"
            " `accepted(t, y)` also ends a run where `symgen run` would end it, with the reason, and warns where it"
            " passes near a singular position, as a run does that is unverified. Errors are not estimated."
            " The start belongs to the parameters that stand there; with others the package has to be generated anew.",
            "",
            *([f"Nothing here looks for events, as `symgen run` does: {events}.", ""] if events else []),
        ]
    )


def _events(model: Model) -> str:
    """Return what events of the mechanism would do that nothing here looks for."""
    return ", ".join(f"`{e.name}` {DOES[e.action]}" for e in model.mechanism.events if e.action in DOES)
