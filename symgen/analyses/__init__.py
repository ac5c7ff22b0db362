"""Analyses besides motion: equilibria, modes, state space, inverse dynamics, kinematics."""
