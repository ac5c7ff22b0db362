"""From a mechanism to source text: equations of motion, a method's law, operations in order, emission.

In: a `Mechanism` and a method with its options.
Out: source text of the model's and the method's modules.
Imports: none; rooms below.
"""
