"""Effects of events: velocities that the smallest impulse changes, and values written.

In: the state of a run at an event, and the formulas of the event.
Out: the state after it, with impulses and energy; whether events accumulate.
Imports: NumPy; `starts` and rooms below.
"""
