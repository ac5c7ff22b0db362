"""Rows: many runs in one compiled loop, one after the other, in vector lanes or on a CUDA device.

In: arrays with a row for each run.
Out: summaries and outputs by rows.
Imports: Numba; `single` and rooms below; no description.
"""
