"""The compiler: emitted functions and loops as machine code, C and JavaScript, kept in a cache.

In: functions in the checked language, as text.
Out: machine code that a process shares with those before it, and text of other languages.
Imports: none; rooms below.
"""
