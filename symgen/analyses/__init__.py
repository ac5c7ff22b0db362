"""Analyses besides motion: equilibria, modes, state space, inverse dynamics, kinematics.

In `kinds` one file declares an analysis with its command.

In: a mechanism, and a state or a motion.
Out: a result with its tables.
Imports: msgspec, NumPy, SciPy; control, matplotlib when needed; `reading`, `reruns` and rooms below.
"""
