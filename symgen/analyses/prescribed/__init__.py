"""Prescribed motion: kinematics of driven mechanisms.

In: a mechanism whose drivers move all of it.
Out: positions, velocities and accelerations over time.
Imports: msgspec, NumPy, SciPy; `state` and streets below.
"""
