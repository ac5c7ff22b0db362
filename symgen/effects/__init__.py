"""Effects: what an event does to a run: velocities with new values by the smallest impulse, and values written.

In: the state of a run at an event, and the formulas of the event.
Out: the state after it, with impulses and energy; whether events accumulate.
Imports: NumPy; `starts` and rooms below.
"""
