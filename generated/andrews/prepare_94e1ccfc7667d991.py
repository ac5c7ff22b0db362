"""Numbers that depend on parameters alone, for model `andrews`. Emitted by symgen; do not edit.

digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 5 operations, 5 before sharing."""
    # inputs
    p0 = p[0]  # drive_torque [N m]
    p1 = p[1]  # spring_stiffness [N/m]
    p2 = p[2]  # spring_length [m]
    p9 = p[9]  # alpha
    p10 = p[10]  # beta
    # outputs
    p[4] = 0.5*p1  # 0.5*spring_stiffness
    p[5] = 2.0*p2  # 2.0*spring_length
    p[6] = 2.0*p9  # 2.0*alpha
    p[7] = p10*p10  # beta*beta
    p[8] = 455788.5141294439*p0  # 455788.5141294439*drive_torque
    return 0
