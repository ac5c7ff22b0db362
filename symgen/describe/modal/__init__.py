"""Modal bodies of a mechanism file: a table and its file of modes in, a body and its interfaces out.

In: tables of bodies, and files that `symgen.reduced` has written.
Out: a body with modes, bodies without coordinates for its interfaces, and the force of its springs.
Imports: msgspec, NumPy (for the file alone); `parts`, `formulas`.
"""
