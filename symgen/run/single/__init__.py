"""Runs: one run from its start to its outcome, with its events, resets, changes and observers.

In: a compiled model, an integrator, a start and a `RunSpec`.
Out: an `Outcome`, or a `Simulation` to go on with.
Imports: NumPy; `integrators`, `starts` and rooms below.
"""
