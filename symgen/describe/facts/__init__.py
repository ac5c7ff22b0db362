"""Facts of a mechanism that follow from its description: kinks, repeats, lengths, sides, its digest.

In: a validated `Mechanism`.
Out: numbers, names and digests that later stages ask for.
Imports: msgspec; `parts`, `formulas`, `files`.
"""
