"""Laws and corrections of a planar mechanism at any state, beside M, D, f and gamma of the plain description."""

from pathlib import Path

import numpy as np

import symgen.describe.catalogue
from support import reference
from support.plain import Plain
from symgen.api import Model
from symgen.base.ir.program import COUNTERS, STATUS
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate


def described(name: str) -> dict:
    """The raw description of a mechanism of the catalogue."""
    file = Path(symgen.describe.catalogue.__file__).parent / f"{name}.toml"
    return parse_toml(file.read_text(encoding="utf-8"), name)


def on_rails() -> dict:
    """A block that drivers hold at x = 0 and at an angle of 0, beside nothing else: D is constant, Phi linear."""
    return {
        "mechanism": {"name": "on-rails", "gravity": [0.0, 0.0]},
        "bodies": {"block": {"mass": 2.0, "inertia": 0.5}},
        "joints": {
            "x": {"type": "driver", "body": "block", "coordinate": "x", "value": 0.0},
            "turn": {"type": "driver", "body": "block", "coordinate": "theta", "value": 0.0},
        },
    }


class StateEquations:
    """M, D, f, gamma, nu, Phi and w = D v - nu at one state, from `Plain` alone."""

    def __init__(self, plain: Plain, rows, t, q, v) -> None:
        q, v = list(map(float, q)), list(map(float, v))
        phi, drift, nu = plain.phi(t, q), reference.velocity_residual(plain, t, q, v), reference.nu(plain, t, q)
        d, gamma = reference.jacobian(plain, t, q, v), reference.gamma(plain, t, q, v)
        self.phi = np.array([phi.get(n, 0.0) for n in rows])
        self.d = np.array([d[n] for n in rows]).reshape(len(rows), plain.size)
        self.gamma = np.array([gamma[n] for n in rows])
        self.drift = np.array([drift[n] for n in rows])
        self.nu = np.array([nu.get(n, 0.0) for n in rows])
        self.f, self.power = reference.applied(plain, t, q, v)
        self.mass = np.diag(reference.masses(plain))

    def schur(self) -> np.ndarray:
        """S = D M^-1 D^T."""
        return self.d @ np.linalg.solve(self.mass, self.d.T)


class LawAt:
    """A compiled law of a raw planar description, to be called at any state."""

    def __init__(self, raw: dict, method: str, options=None, parameters=None) -> None:
        self.model, self.plain = Model(validate(raw, "test")), Plain(raw)
        self.compiled = self.model.compile(method, options)
        self.start = self.model.assemble(self.compiled, None, parameters)
        info = self.compiled.info
        self.nq, self.nv, self.rows = info.nq, info.nv, [row.name for row in info.rows]
        self.q, self.v = self.start.y[: info.nq].copy(), self.start.y[info.nq : info.nq + info.nv].copy()
        self.w, self.iw = self.start.w, np.zeros(len(COUNTERS), dtype=np.int64)

    def equations(self, q, v, t=0.0) -> StateEquations:
        """The plain description's equations."""
        return StateEquations(self.plain, self.rows, t, q, v)

    def state(self, q, v) -> np.ndarray:
        """The state vector, without work."""
        y = np.zeros_like(self.start.y)
        y[: self.nq], y[self.nq : self.nq + self.nv] = q, v
        return y

    def section(self, name: str) -> np.ndarray:
        """A section of w."""
        return self.compiled.section(self.w, name)

    def status(self, name: str) -> float:
        """A number of the status."""
        return float(self.w[STATUS.index(name)])

    def row_masses(self) -> np.ndarray:
        """The mean mass times the weights of rows: the unit of penalties."""
        return self.status("mean_mass") * self.section("row_weight")

    def rates(self, q, v, t=0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """q', v' and lambda; the second opinion on rank where the law asks for it."""
        y, rate, law = self.state(q, v), np.zeros_like(self.start.y), self.compiled.law_module
        if law.rhs(t, y, self.start.p, self.w, self.iw, rate) != 0:
            law.confirm(t, y, self.start.p, self.w, self.iw, rate)
        return rate[: self.nq], rate[self.nq : self.nq + self.nv], self.section("multipliers").copy()

    def accepted(self, q, v, t=0.0) -> tuple[np.ndarray, np.ndarray]:
        """q and v after the correction of an accepted state."""
        y = self.state(q, v)
        bits = self.compiled.law_module.accept(t, y, self.start.p, self.w, self.iw)
        assert bits & 1 == 0
        return y[: self.nq].copy(), y[self.nq : self.nq + self.nv].copy()

    def moved(self, q, v, h, steps, correct=False) -> tuple[np.ndarray, np.ndarray]:
        """q and v after steps of the classical Runge-Kutta scheme, with the correction or without."""
        self.w[STATUS.index("step")] = h
        q, v = np.array(q, dtype=float), np.array(v, dtype=float)
        for k in range(steps):
            rates = [np.zeros(len(q) + len(v))]
            for part in (0.0, 0.5, 0.5, 1.0):
                y = np.concatenate([q, v]) + part * h * rates[-1]
                rates.append(np.concatenate(self.rates(y[: len(q)], y[len(q) :], (k + part) * h)[:2]))
            change = h / 6.0 * (rates[1] + 2.0 * rates[2] + 2.0 * rates[3] + rates[4])
            q, v = q + change[: len(q)], v + change[len(q) :]
            if correct:
                q, v = self.accepted(q, v, (k + 1) * h)
        return q, v
