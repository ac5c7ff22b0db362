"""Loops and starts: imports NumPy and Numba only."""
