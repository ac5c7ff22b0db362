"""Formulas: text in, trees of expressions with their values and derivatives out.

In: text of a file, and the names that it may use.
Out: expressions, their values, partial derivatives and names.
Imports: msgspec; `ir`, `vocabulary`.
"""
