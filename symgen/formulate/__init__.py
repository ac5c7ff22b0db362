"""From a mechanism to its equations; the only package that imports SymPy (this file imports nothing)."""
