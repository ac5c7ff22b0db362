"""Numbers that depend on parameters alone, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 9 operations, 9 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    # outputs
    p[15] = -9.81*p0  # -9.81*crank_mass
    p[16] = -9.81*p1  # -9.81*coupler_mass
    p[17] = -9.81*p2  # -9.81*rocker_mass
    p[18] = 0.3333333333333333*p0  # 0.3333333333333333*crank_mass
    p[19] = 5.333333333333333*p1  # 5.333333333333333*coupler_mass
    p[20] = 2.083333333333333*p2  # 2.083333333333333*rocker_mass
    return 0
