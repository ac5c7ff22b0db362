"""Fits: numbers of a model from measured data.

In: a model, data, and which numbers are free.
Out: values with intervals, and what the data do not determine.
Imports: msgspec, NumPy; `search` and streets below.
"""
