"""Mechanisms with dry friction, stops and ropes, run by symgen and by an event-driven simulation of their own.

The simulation shares no code with `symgen`: coordinates are those of a tree of joints, loops are closed by rows, forces
at rest come from bounded least squares, impacts from enumeration, and motions from SciPy's DOP853, of whose steps all
events are looked for. The rules are those of docs/howto/dry-friction.md and docs/howto/stops.md.
"""
