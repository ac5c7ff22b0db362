"""Formulation: a mechanism in, its equations of motion out; SymPy derives one kernel for each kind of measure.

In: a `Mechanism`.
Out: `Equations`: Phi, D, nu, gamma, M, f and energies as nodes of one graph.
Imports: SymPy; `describe` and rooms below.
"""
