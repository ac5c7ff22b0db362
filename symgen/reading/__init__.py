"""Derived equations for readers: as SymPy objects, as LaTeX, as a page. Nothing is derived here."""
