"""Emission: programs in, source text out. The keys of a template are exactly the keys that it asks for.

In: programs.
Out: Python modules as text.
Imports: Jinja2; `lower` and rooms below.
"""
