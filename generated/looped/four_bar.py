"""Kernels of mechanism `four-bar`, and how many instances each has; tables stand in the metadata.

body_body_d9162fada94ee10a: 3
joint_revolute_f5113b1fe3bcba04: 2
joint_revolute_ce857deb8a0cb9a0: 2
"""
