"""Modes: which rows with bounds are in force, their forces, and impacts, in one source for all targets.

In: rows with bounds, and a state.
Out: modes, forces within bounds, velocities after impacts.
Imports: NumPy; `effects` and rooms below.
"""
