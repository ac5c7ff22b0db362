"""Reduction of finite elements to modal bodies: nodes, M and K in, modes with their integrals out.

In: arrays of any program for finite elements.
Out: the file that a modal body of a mechanism names.
Imports: NumPy, SciPy; `modal` for the file.
"""
