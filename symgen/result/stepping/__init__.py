"""Runs step by step from Python, with controllers on a clock.

In: a prepared run and changes between steps.
Out: the state after each step, a history, a saved state.
Imports: NumPy; `result` and rooms below.
"""
