"""From programs to source text; the only package that imports Jinja2 (this file imports nothing)."""
