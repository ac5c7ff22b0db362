"""One state of a planar mechanism of the catalogue for schemes written with NumPy: all from `Plain`, dense."""

import numpy as np

from support import reference
from support.plain import Plain
from symgen.describe.files.load import read_raw


class Textbook:
    """M, f, D, nu and Phi of a mechanism as arrays, rows in the order of the file."""

    def __init__(self, name: str) -> None:
        self.plain = Plain(read_raw(name)[0])
        self.mass = np.diag(reference.masses(self.plain))

    def force(self, t, q, v) -> np.ndarray:
        return reference.applied(self.plain, t, list(q), list(v))[0]

    def rows(self, t, q, v) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Phi, D and nu."""
        phi, nu = self.plain.phi(t, list(q)), reference.nu(self.plain, t, list(q))
        d = reference.jacobian(self.plain, t, list(q), list(v))
        return np.array([phi[n] for n in d]), np.array([*d.values()]), np.array([nu[n] for n in d])

    def saddle(self, d, e, f, g) -> tuple[np.ndarray, np.ndarray]:
        """v' and lambda of M v' + D^T lambda = f, E v' = g."""
        n, m = len(f), len(g)
        solution = np.linalg.solve(np.block([[self.mass, d.T], [e, np.zeros((m, m))]]), np.concatenate([f, g]))
        return solution[:n], solution[n:]


def first_step(model, h, **keys):
    """q and v at the start of a run and behind its first step."""
    result = model.simulate(step=h, until=h, times=[0.0, h], max_violation=1.0, max_energy_error=1e3, **keys)
    assert result.steps == 1, result.reason
    return [(np.asarray(result.q)[i], np.asarray(result.v)[i]) for i in range(2)]
