"""Parts of compiled loops: bare arrays, vectors of eight, instances of plain Python, entries.

In: plain Python functions of arrays and numbers.
Out: their compiled forms, with other meanings of names, and calls of them.
Imports: llvmlite, NumPy; `store` and rooms below.
"""
