"""Loops: the frame around the step of a scheme, error control, Newton iterations, the search for events.

In: a model, a `RunSpec` and the arrays of a `State`.
Out: the state at the end, outputs, a code for the reason of the end.
Imports: NumPy; `layout` and rooms below; no description.
"""
