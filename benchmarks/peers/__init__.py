"""Measurements of other multibody tools on neutral models.

The modules here depend on NumPy, SciPy and the peers themselves only, so that
they run in an interpreter of their own; see ``README.md``.
"""
