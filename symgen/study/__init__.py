"""Comparisons of methods and integrators."""
