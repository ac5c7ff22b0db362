"""Scenes of bodies that touch in the plane, run by symgen and by an event-driven simulation of their own.

The simulation shares no code with `symgen`: bodies have their places and angles, joints are rows with multipliers,
modes and impacts come from enumeration, directional derivatives from complex steps, and motions from SciPy's DOP853,
of whose steps all events are looked for. The rules are those of docs/howto/contacts.md.
"""
