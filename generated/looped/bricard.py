"""Kernels of mechanism `bricard`, and how many instances each has; tables stand in the metadata.

body_body_f715eb486c2b480a: 5
joint_revolute_65e94ceb3a7d4c60: 1
joint_revolute_d7f92934ebcba418: 2
joint_revolute_8f2c71f8ac7b906d: 1
joint_revolute_0188572cec748091: 1
joint_revolute_63fa1630dd66dc96: 1
"""
