"""State: a mechanism at one position, with its matrices, rows in force and free directions.

In: a mechanism, and a place.
Out: matrices, null spaces and subspaces there.
Imports: msgspec, NumPy, SciPy; `run` and streets below.
"""
