"""Comparisons: error against run time of methods, integrators, steps and tolerances.

In: a mechanism, methods, integrators and steps or tolerances.
Out: a `Study` with a row for each run.
Imports: msgspec, NumPy, pandas; `references` and streets below.
"""
