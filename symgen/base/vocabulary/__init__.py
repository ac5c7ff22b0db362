"""Words that all stages share: expressions, markers, measures, quantities and facts of emitted code.

In: names and numbers of a description.
Out: frozen records that later rooms read.
Imports: msgspec; nothing.
"""
