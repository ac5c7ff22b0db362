"""Derived equations for readers: SymPy objects, text, LaTeX, a page. Nothing is derived here.

In: equations, laws and tapes.
Out: views of them, for models and for pages.
Imports: msgspec, NumPy, SymPy; `result`, `stepping` and rooms below.
"""
