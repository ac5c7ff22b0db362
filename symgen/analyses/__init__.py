"""Analyses besides motion: equilibria, modes, state space, inverse dynamics, kinematics, fits; rooms by question.

In: a mechanism, and a state or a motion.
Out: a result with its tables.
Imports: NumPy; rooms and streets below.
"""
