"""Studies: many runs against references, in the rooms `references`, `comparison` and `stress`.

In: mechanisms, methods, integrators and steps.
Out: rows of numbers, a journal, findings.
Imports: filelock, msgspec, NumPy, pandas, SciPy; Numba, SymPy in `references`; `api` and rooms below.
"""
