"""Functions: the dynamics as compiled functions of the state, and frames of bodies.

In: a mechanism.
Out: functions of arrays.
Imports: NumPy, SciPy; `run` and streets below.
"""
