"""The graph of operations, blocks and programs: each operation is stored once.

In: operations in the order of their construction.
Out: nodes, blocks and programs with numbers that depend on that order alone.
Imports: no library; `vocabulary`.
"""
