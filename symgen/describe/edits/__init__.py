"""Edits of mechanism files by hand: points that move, typed lengths, names, new parts; all other text stays as it is.

In: the text of a file and what a hand, a name or a number asks of it.
Out: changes of this text, or a new text.
Imports: `files` for places and validation; `bounds`, `formulas`, `parts`.
"""
