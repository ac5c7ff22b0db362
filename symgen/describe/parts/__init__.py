"""Parts of a mechanism: bodies, parameters, inputs, events, outputs, columns and their units.

In: checked tables of a mechanism file.
Out: frozen parts of a `Mechanism`, and the columns of its results.
Imports: msgspec; `formulas`.
"""
