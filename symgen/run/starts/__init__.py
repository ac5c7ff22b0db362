"""Starts: positions closed, velocities completed, dependent rows left out, in one source for all targets.

In: described coordinates, held quantities and a compiled model.
Out: a consistent `Start`, or the reason why there is none.
Imports: NumPy; `loops` and rooms below; no description.
"""
