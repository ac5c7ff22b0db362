"""Emitted code against a derivation of the whole system at once, the slow textbook way, with SymPy and lambdify.

q, v and t are symbols; Phi is written out for all joints with cos(theta) and sin(theta); D is its Jacobian,
gamma = -((D v)_q v + 2 Phi_qt v + Phi_tt); f comes from the potential's gradient and from virtual power.
"""

import numpy as np
import pytest
import sympy as sp
from support.checks import close
from support.emitted import Emitted, mechanism_of
from support.models import EVERYTHING
from support.plain import Plain, dot
from support.reference import masses, saddle_point

from symgen.describe.catalogue import raw


class Symbolic(Plain):
    """`Plain` with symbols; forces with a potential are left to the potential."""

    def slope(self, text, **names):
        return sp.S.Zero


def derive(description):
    """Return numeric functions of (t, q, v): Phi, D, gamma, nu, f."""
    plain = Symbolic(description, sp)
    t, q, v = sp.Symbol("t"), sp.symbols(f"q:{plain.size}"), sp.symbols(f"v:{plain.size}")
    phi, slips = plain.phi(t, q), plain.slips(t, q, v)
    residual = sp.Matrix([sp.sympify(x) for x in phi.values()])
    d = residual.jacobian(q)
    gamma = -((d * sp.Matrix(v)).jacobian(q) * sp.Matrix(v) + 2 * d.diff(t) * sp.Matrix(v) + residual.diff(t, 2))
    nu = -residual.diff(t)
    if slips:
        conditions = sp.Matrix(list(slips.values()))
        d = d.col_join(conditions.jacobian(v))
        gamma = gamma.col_join(-conditions.jacobian(q) * sp.Matrix(v))
        residual, nu = (m.col_join(sp.zeros(len(slips), 1)) for m in (residual, nu))
    force = -sp.Matrix([plain.potential(q)]).jacobian(q).T
    for body, pull, torque, at, conservative in plain.loads(t, q, v):
        if body != "ground" and not conservative:
            power = dot(pull, plain.velocity(body, at, q, (w := sp.symbols(f"w:{plain.size}")))) + torque * plain.spin(
                body, w
            )
            force += sp.Matrix([power]).jacobian(w).T
    parts = sp.lambdify((t, q, v), [residual, d, gamma, nu, force], "numpy")
    return [*phi, *slips], lambda *at: [np.array(x, dtype=float) for x in parts(*at)]


@pytest.mark.fast("four-bar", "slider-crank")
@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "everything"])
def test_against_the_whole_system_at_once(name):
    description = EVERYTHING if name == "everything" else raw(name)
    plain, emitted = Plain(description), Emitted(mechanism_of(description))
    names, textbook = derive(description)
    order = [names.index(row.name) for row in emitted.info.rows]
    p, rng = emitted.parameters(plain.values), np.random.default_rng(11)
    for _ in range(5):
        t, q, v = rng.uniform(0, 2), rng.uniform(-2, 2, plain.size), rng.uniform(-2, 2, plain.size)
        phi, d, gamma, nu, f = textbook(t, q, v)
        found = emitted.at(float(t), q.tolist(), v.tolist(), p)
        close(found.phi, phi[order, 0], "Phi")
        close(found.d, d[order], "D")
        close(found.gamma, gamma[order, 0], "gamma")
        close(found.nu, nu[order, 0], "nu")
        acceleration, multipliers = saddle_point(masses(plain), d[order], f[:, 0], gamma[order, 0])
        close(found.acceleration, acceleration, "v'", 1e-9)
        close(found.multipliers, multipliers, "lambda", 1e-9)
