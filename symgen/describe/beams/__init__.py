"""Beams: sections and lines of a flexible body in, its elements and nodes out.

In: tables of beams and sections.
Out: bodies and forces that represent a beam.
Imports: msgspec; `parts`, `formulas`.
"""
