"""Comparisons: error against run time of methods, integrators, steps and tolerances."""
