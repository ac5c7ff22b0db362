"""The derived equations as SymPy objects: check one by hand, print LaTeX, evaluate them with NumPy."""

import numpy as np
import sympy

import symgen

equations = symgen.load("slider-crank").equations

# the Jacobian is the derivative of the constraints
coordinates = sympy.Matrix(list(equations.q.values()))
jacobian = sympy.simplify(equations.Phi.jacobian(coordinates) * equations.N - equations.D)

# the mass matrix is the second derivative of the kinetic energy
velocities = list(equations.v.values())
masses = sympy.simplify(sympy.hessian(equations.T, velocities) - equations.M)
print(f"{jacobian.is_zero_matrix + masses.is_zero_matrix} of 2 checks by SymPy hold")

print(equations.latex("Phi"))

evaluate = equations.lambdify("M", "D", "gamma", "f")
M, D, gamma, f = evaluate(0.0, np.linspace(0.1, 0.9, 9), np.zeros(9))
print("accelerations at rest by NumPy:")
system = np.block([[M, D.T], [D, np.zeros((len(D), len(D)))]])
print(np.linalg.lstsq(system, np.vstack([f, gamma]), rcond=None)[0][:3].ravel())
