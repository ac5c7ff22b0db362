"""Printed runs: whole runs kept between calls, for C, FMUs and pages.

In: loops, and a compiled model.
Out: loops that hold a whole run.
Imports: NumPy; `rows` and rooms below; no description.
"""
