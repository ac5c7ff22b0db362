"""Kernels of mechanism `four-bar`, and how many instances each has; tables stand in the metadata.

body_body: 3
joint_revolute: 2
joint_revolute_2: 2
"""
