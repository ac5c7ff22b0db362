"""Runs: everything between settings and the outcome of an integration.

In: a mechanism, compiled blocks and settings.
Out: an `Outcome`: states, events, counts and a status.
Imports: none; rooms below.
"""
