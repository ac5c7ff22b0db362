"""Reruns: a second run with finer steps, which estimates the error of the first.

In: a prepared run and its outcome.
Out: an estimate of its error, or a run with smaller steps.
Imports: NumPy; `result`, `stepping` and rooms below.
"""
