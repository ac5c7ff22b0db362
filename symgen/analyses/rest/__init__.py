"""Rest: equilibria, and steady motions.

In: a mechanism, and a start.
Out: positions at rest, and whether they are stable.
Imports: msgspec, NumPy, SciPy; `state` and streets below.
"""
