"""Linear: modes, state space, and eigenvalues over a parameter.

In: a mechanism, and a place.
Out: eigenvalues, shapes, matrices of a linear system.
Imports: control, matplotlib, NumPy, SciPy; `rest` and rooms below.
"""
