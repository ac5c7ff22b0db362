"""References: motions computed without any of the emitted code.

In: a mechanism and settings.
Out: states of a second derivation at times of a run, with their own error.
Imports: msgspec, Numba, NumPy, SciPy, SymPy; `result` and streets below.
"""
