"""Mechanism files read and solved a second time, in plain NumPy: the reference of the project's own verification.

Nothing here is shared with `symgen`: TOML is read by `tomllib`, formulas by a parser of their own, rows of joints and
generalised forces come from vector algebra on rotation matrices with derivatives carried forward beside the values,
accelerations from a singular value decomposition, motions from SciPy's DOP853 with a projection after every step.
Signs, names and units are those of docs/file-format and docs/results.md.
"""
