"""Breaks in time: times at which inputs and formulas jump or have kinks, and motions that no run can follow.

In: a description with its inputs, and the end of a run.
Out: the stops of the run, or a refusal.
Imports: NumPy; `loops` and rooms below.
"""
