"""Preparation of runs: settings in, runs that are ready out, for bodies and trees of joints alike.

In: a mechanism and `Settings`.
Out: a `Plan`, code with its start, and a `Prepared`.
Imports: msgspec, NumPy; `compiling` and rooms below.
"""
