"""Stress: which methods stay stable on stiff and extreme cases.

In: mechanisms, cases that make them hard, methods.
Out: a map of outcomes, and limits of stability.
Imports: msgspec, NumPy, pandas; `references` and streets below.
"""
