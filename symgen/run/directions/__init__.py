"""Directions: derivatives of runs and of steps, forward and by the adjoint.

In: a run, and the numbers to differentiate by.
Out: derivatives of its states.
Imports: NumPy; `single` and rooms below.
"""
