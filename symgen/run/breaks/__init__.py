"""Breaks in time: jumps and kinks of inputs and formulas, and motions that no run can follow.

In: a description with its inputs, and the end of a run.
Out: the seams of the run, or a refusal.
Imports: NumPy; `loops` and rooms below.
"""
