"""Laws of rows with bounds: their forces at one state, and impulses at one impact, as one problem in numbers.

In: mobilities, accelerations without the forces, bounds and what they depend on.
Out: forces that obey all laws, how many motions do, shares of forces that are many.
Imports: NumPy; `layout` for larger numbers.
"""
