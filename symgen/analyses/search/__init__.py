"""Searches: numbers within bounds with which an aim is least, from derivatives of motions.

In: ranges of numbers, motions as functions of them, an aim and limits or measured columns.
Out: the best numbers, how far they are determined, and what limits cost.
Imports: NumPy, SciPy; streets below.
"""
