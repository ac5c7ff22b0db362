"""Simulate the mechanism of this folder by the classical Runge-Kutta scheme with constant steps.

    python simulate.py [METHOD [UNTIL [STEP]]]

METHOD is a module of this folder; UNTIL and STEP are in seconds. Needs numpy and numba alone. Written by symgen.
"""

import json
import sys
from importlib import import_module
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parent
MODEL = json.loads((FOLDER / "model.json").read_text(encoding="utf-8"))
RUN = MODEL["run"]
sys.path.insert(0, str(FOLDER))  # for the modules beside this one, however it is started


class System:
    """The equations of a method: parameters `p`, scratch `w`, counters `iw`, and a consistent start `y`."""

    def __init__(self, method=RUN["method"], step=RUN["step"]):
        law, model, self.law = MODEL["methods"][method], import_module("model"), import_module(method)
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
        """Return the rate of a state."""
        ydot = np.zeros(len(y))
        if self.law.rhs(t, y, self.p, self.w, self.iw, ydot):  # a pivot is doubtful
            self.law.confirm(t, y, self.p, self.w, self.iw, ydot)
        return ydot

    def corrected(self, t, y):
        """Return a state at the end of a step as the method corrects it."""
        if self.law.accept(t, y, self.p, self.w, self.iw) & 1 or not np.isfinite(y).all():
            raise ArithmeticError(f"the state at t = {t} cannot be corrected")
        return y


def simulate(method=RUN["method"], until=RUN["until"], step=RUN["step"]):
    """Return times and states: positions, velocities, and the work of forces without potential and of drivers."""
    system, h = System(method, step), step
    times, states = [0.0], [system.y]
    for i in range(round(until / h)):
        t, y = i * h, states[-1]
        k1 = system.rate(t, y)
        k2 = system.rate(t + h / 2, y + h / 2 * k1)
        k3 = system.rate(t + h / 2, y + h / 2 * k2)
        k4 = system.rate(t + h, y + h * k3)
        times.append((i + 1) * h)
        states.append(system.corrected(times[-1], y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)))
    return np.array(times), np.array(states)


if __name__ == "__main__":
    times, states = simulate(*sys.argv[1:2], *map(float, sys.argv[2:]))
    print(json.dumps({"t": times[-1], **dict(zip(RUN["names"], states[-1].tolist(), strict=True))}, indent=1))
