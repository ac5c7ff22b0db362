"""Formulation: a mechanism in, its equations of motion out; SymPy derives a kernel for each measure.

In: a `Mechanism`.
Out: `Equations`: Phi, D, nu, gamma, M, f and energies as nodes of one graph.
Imports: SymPy; `describe` and rooms below.
"""
