"""Efforts: inverse dynamics, what drivers and actuators need for a motion.

In: a mechanism and its motion.
Out: forces and torques over time.
Imports: msgspec, NumPy, SciPy; `prescribed` and rooms below.
"""
