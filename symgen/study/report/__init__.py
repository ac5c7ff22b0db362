"""Reports: studies as documents of sections, tables and pictures, in HTML or Markdown.

In: a study.
Out: a document and its files.
Imports: Jinja2, matplotlib, NumPy; `study` and rooms below.
"""
