"""Linkages for a task: four-bar linkages that pass three positions of a body or the points of a path.

In: a table of positions or of points.
Out: a `Synthesis`: linkages, the best first, each with its file, its transmission angle and its deviation.
Imports: NumPy; rooms beside and streets below.
"""
