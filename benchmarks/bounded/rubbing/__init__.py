"""Machines whose joints rub by their reactions beside stops and contacts, by symgen and by a simulation of their own.

The simulation shares no code with `symgen`: bodies have their places and angles, joints are rows with multipliers,
modes are sought by signs and verified, impacts are the same laws in rates, and motions are SciPy's DOP853, of whose
steps all events are looked for. The rules are those of docs/howto/dry-friction.md and docs/howto/contacts.md.
"""
