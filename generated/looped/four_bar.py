"""Kernels of mechanism `four-bar`, and how many instances each has; tables stand in the metadata.

body_body_91fa7493f7d11b24: 3
joint_revolute_a8cf2fddbec79b2b: 2
joint_revolute_aaa22c7ae073045f: 2
"""
