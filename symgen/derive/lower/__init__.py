"""Lowering: equations and a method in, programs out, with elimination orders, factorisations and hoisting.

In: `Equations`, and a method with its options.
Out: programs of a model and of a law, straight or looped.
Imports: msgspec; `formulate`, `methods` and rooms below.
"""
