"""What is asked of a mechanism beside its motion: equilibria, modes, state space, inverse dynamics, kinematics."""
