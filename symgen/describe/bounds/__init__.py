"""Rows whose force has bounds: dry friction, stops, and the smooth friction that stands in for it.

In: keys of joints and sections of files, one file a kind in `kinds`.
Out: frozen rows with their bounds, events, outputs and words (`symgen.describe.bounded`).
Imports: msgspec; `parts`, `formulas`.
"""
