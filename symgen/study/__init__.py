"""Studies: many runs against references, in the rooms `references`, `comparison` and `stress`.

In: mechanisms, methods, integrators and steps.
Out: rows of numbers, a journal, findings.
Imports: filelock; `api` and streets below.
"""
