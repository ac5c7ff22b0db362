"""Compiling: the stages in their order, from a mechanism to compiled code in both shapes.

In: a mechanism, a method and choices of shape and target.
Out: a `CompiledModel` and functions beside it: outputs, events.
Imports: msgspec, NumPy; `emit`, `rows` and rooms below.
"""
