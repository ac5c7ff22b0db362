"""Ensembles: sweeps of one model over its parameters, on threads, a CUDA device or a cluster.

In: a mechanism, settings and axes.
Out: a `Sweep` with a row of numbers for each run.
Imports: filelock, msgspec, Numba, NumPy; distributed, pandas, xarray when needed; `study` and rooms below.
"""
