"""Rows whose force has bounds: dry friction, stops, and the smooth friction that stands in for it.

In: tables `friction` and `stop` of joints.
Out: frozen bounds of the mechanism's coordinates.
Imports: msgspec; `parts`, `formulas`.
"""
