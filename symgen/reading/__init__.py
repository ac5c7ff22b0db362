"""What was derived, for people to read: as SymPy objects, as LaTeX, as a page. Nothing is derived here."""
