"""Numbers of a machine by an aim: the best values within bounds and limits, by exact derivatives of its motion.

In: a model, the numbers that vary, an aim and limits.
Out: a `Design`: values, limits with their prices, the file with the new numbers, reports before and after.
Imports: msgspec, NumPy; rooms beside and streets below.
"""
