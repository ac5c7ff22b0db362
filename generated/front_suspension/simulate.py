"""Simulate the mechanism of this folder with constant steps, by a method's own scheme or by rk4.

    python simulate.py [METHOD [UNTIL [STEP]]]

METHOD is a method of this folder, such as direct-correction; UNTIL and STEP are in seconds. Needs numpy and numba
alone. Written by symgen.
"""

import json
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
from numba import njit

FOLDER = Path(__file__).resolve().parent
MODEL = json.loads((FOLDER / "model.json").read_text(encoding="utf-8"))
RUN = MODEL["run"]
sys.path.insert(0, str(FOLDER))  # for the modules beside this one, however it is started


class System:
    """The equations of a method: parameters `p`, scratch `w`, counters `iw`, and a consistent start `y`."""

    def __init__(self, method=RUN["method"], step=RUN["step"]):
        name = method.replace("-", "_")  # as a module
        if name not in MODEL["methods"]:
            known = ", ".join(each.replace("_", "-") for each in MODEL["methods"])
            raise SystemExit(f"simulate.py: expected a method of this folder, one of {known}, got '{method}'")
        law, model, self.law = MODEL["methods"][name], import_module("model"), import_module(name)
        values, own = list(RUN["parameters"].values()), [default for _, default in law["parameters"]]
        first = law["parameter_offset"]
        self.p = np.zeros(first + len(own) + law["hoisted"])
        self.p[: len(values)] = values
        self.p[first : first + len(own)] = own
        model.prepare(self.p)
        self.law.prepare(self.p)
        self.w, self.iw = np.zeros(law["nw"]), np.zeros(RUN["counters"], dtype=np.int64)
        for section, numbers in RUN["w"].items():  # scales, and rows that depend on others
            begin, size = MODEL["sections"][section]
            self.w[begin : begin + size] = [float(number) for number in numbers]
        self.y = self.corrected(0.0, np.array(RUN["y"]))
        self.w[RUN["step_at"]] = step

    def rate(self, t, y):
        """Return the rate of a state, as integrators of other libraries call it."""
        ydot = np.zeros(len(y))
        if self.law.rhs(t, y, self.p, self.w, self.iw, ydot):  # a pivot is doubtful
            self.law.confirm(t, y, self.p, self.w, self.iw, ydot)
        return ydot

    def corrected(self, t, y):
        """Return a state at the end of a step as the method corrects it."""
        if self.law.accept(t, y, self.p, self.w, self.iw) & 1 or not np.isfinite(y).all():
            raise ArithmeticError(f"the state at t = {t} cannot be corrected")
        return y


def loop_of(law):
    """Return the loop over steps of a method, compiled with its functions."""
    rhs, confirm, accept = law.rhs, getattr(law, "confirm", law.rhs), law.accept

    @njit(error_model="numpy")
    def rate(t, y, p, w, iw, ydot):
        if rhs(t, y, p, w, iw, ydot) != 0:  # a pivot is doubtful
            confirm(t, y, p, w, iw, ydot)

    @njit(error_model="numpy")
    def run(states, h, p, w, iw):
        """Fill the rows of states behind the first one; return the number of whole steps."""
        n = states.shape[1]
        k1, k2, k3, k4 = np.zeros(n), np.zeros(n), np.zeros(n), np.zeros(n)
        for i in range(len(states) - 1):
            t, y = i * h, states[i]
            rate(t, y, p, w, iw, k1)
            rate(t + h / 2, y + h / 2 * k1, p, w, iw, k2)
            rate(t + h / 2, y + h / 2 * k2, p, w, iw, k3)
            rate(t + h, y + h * k3, p, w, iw, k4)
            states[i + 1] = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if accept((i + 1) * h, states[i + 1], p, w, iw) & 1 or not np.isfinite(states[i + 1]).all():
                return i
        return len(states) - 1

    return run


@njit
def nothing(*arguments):
    """Replace functions that a model or a law does not have and a scheme does not enter."""
    return 0


def own_steps(system, scheme, states, step):
    """Fill the rows of states behind the first one by the scheme of a method; return the number of whole steps."""
    model, module = import_module("model"), import_module(scheme["module"])
    sizes, law = module.Sizes(*scheme["sizes"]), system.law
    width = sizes.width
    functions = [getattr(law, name, law.rhs) for name in ("rhs", "confirm", "accept")]
    functions += [getattr(part, name, nothing) for part, name in ((model, "turn"), (law, "residual"), (law, "tangent"))]
    kinds = {"integers": np.int64, "numbers": np.float64}

    def read(value):
        if not isinstance(value, dict):
            return value
        ((kind, content),) = value.items()
        if isinstance(content, dict):
            return getattr(module, kind)(**{name: read(each) for name, each in content.items()})
        return getattr(model, content) if kind == "function" else np.array(content, dtype=kinds[kind])

    kept = {name: np.array(numbers) for name, numbers in scheme["arrays"].items()}
    own = {name: np.zeros(n, dtype=np.int64 if name == "control" else float) for name, n in scheme["lengths"].items()}
    y, trial = np.zeros(width), np.zeros(width)
    y[: len(system.y)] = system.y
    arrays = {"memory": np.zeros(scheme["memory"]), "room": np.zeros(scheme["room"])}
    arrays |= {"y": y, "trial": trial, "p": system.p, "w": system.w, "iw": system.iw}
    run = module.Run(**kept, **own, **arrays)
    span = module.Span(*map(float, scheme["span"]))._replace(step=step)
    return loop_of_scheme(module)(module.ModelSystem(sizes, *functions), read(scheme["record"]), span, run, states)


def loop_of_scheme(module):
    """Return the loop over steps of a scheme, compiled with its functions."""
    prepare, attempt, renew = module.prepare, module.attempt, module.renew
    correct, note = module.correct, module.note_step

    @njit(error_model="numpy")
    def loop(system, scheme, span, run, states):
        n, h = states.shape[1], span.step
        note(run, h)
        prepare(system, scheme, span, run)
        for i in range(len(states) - 1):
            note(run, h)
            following = (i + 1) * h
            if attempt(system, scheme, span, run, i * h, following, h, False) < 0.0:
                return i
            bits = correct(system, run, following, run.trial, False)
            if bits & 1 or not np.isfinite(run.trial).all():
                return i
            run.y[:] = run.trial
            run.clock[0] = following
            renew(system, scheme, span, run, following, bits & 2 != 0)
            states[i + 1] = run.y[:n]
        return len(states) - 1

    return loop


def simulate(method=RUN["method"], until=RUN["until"], step=RUN["step"]):
    """Return times and states: positions, velocities, and the work of forces without potential and of drivers."""
    system, count = System(method, step), round(until / step)
    states = np.zeros((count + 1, len(system.y)))
    states[0] = system.y
    scheme = MODEL["methods"][method.replace("-", "_")].get("scheme")
    if scheme is not None and "refused" in scheme:
        raise SystemExit(f"simulate.py: {method}: {scheme['refused']}")
    if scheme is not None:
        done = own_steps(system, scheme, states, step)
    else:
        done = loop_of(system.law)(states, step, system.p, system.w, system.iw)
    if done < count:
        raise ArithmeticError(f"the state at t = {(done + 1) * step} cannot be corrected")
    return step * np.arange(count + 1), states


if __name__ == "__main__":
    times, states = simulate(*sys.argv[1:2], *map(float, sys.argv[2:]))
    print(json.dumps({"t": times[-1], **dict(zip(RUN["names"], states[-1].tolist(), strict=True))}, indent=1))
