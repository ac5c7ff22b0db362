"""Kernels of mechanism `bricard`, and how many instances each has; tables stand in the metadata.

body_body_ee54a870bc60d9ef: 5
joint_revolute_7e6e081c3e08c9d7: 1
joint_revolute_cee0e665349d55cb: 2
joint_revolute_43da9c9f3d0a6473: 1
joint_revolute_d6a421250eeb96ac: 1
joint_revolute_a4dc1f6279ee1b73: 1
"""
