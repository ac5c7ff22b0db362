"""The layout of a compiled model: slots of arrays, records for loops, scales, dependent rows.

In: emitted functions and their metadata.
Out: a `CompiledModel`, records and places that loops and starts share.
Imports: msgspec, NumPy; `loopcode` and rooms below; no description.
"""
