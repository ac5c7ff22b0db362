"""Descriptor form, for model `four-bar`. Emitted by symgen; do not edit.

digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def residual(t, y, k, p, w, r):
    """F(t, y, k) of the descriptor form, and the power: 84 operations, 114 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.theta [rad]
    v0 = y[9]  # crank.vx [m/s]
    v1 = y[10]  # crank.vy [m/s]
    v2 = y[11]  # crank.omega [rad/s]
    q3 = y[3]  # coupler.x [m]
    q4 = y[4]  # coupler.y [m]
    q5 = y[5]  # coupler.theta [rad]
    v3 = y[12]  # coupler.vx [m/s]
    v4 = y[13]  # coupler.vy [m/s]
    v5 = y[14]  # coupler.omega [rad/s]
    q6 = y[6]  # rocker.x [m]
    q7 = y[7]  # rocker.y [m]
    q8 = y[8]  # rocker.theta [rad]
    v6 = y[15]  # rocker.vx [m/s]
    v7 = y[16]  # rocker.vy [m/s]
    v8 = y[17]  # rocker.omega [rad/s]
    p28 = p[28]  # 0.3333333333333333*crank_mass
    p15 = p[15]  # 9.81*crank_mass
    p29 = p[29]  # 5.333333333333333*coupler_mass
    p16 = p[16]  # 9.81*coupler_mass
    p30 = p[30]  # 2.083333333333333*rocker_mass
    p17 = p[17]  # 9.81*rocker_mass
    k0 = k[0]
    k1 = k[1]
    k2 = k[2]
    k3 = k[3]
    k4 = k[4]
    k5 = k[5]
    k6 = k[6]
    k7 = k[7]
    k8 = k[8]
    k9 = k[9]
    k10 = k[10]
    k11 = k[11]
    k12 = k[12]
    k13 = k[13]
    k14 = k[14]
    k15 = k[15]
    k16 = k[16]
    k17 = k[17]
    k18 = k[18]
    k19 = k[19]
    k20 = k[20]
    k21 = k[21]
    k22 = k[22]
    k23 = k[23]
    k24 = k[24]
    k25 = k[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = 4.0*math.cos(q5)
    s3 = 4.0*math.sin(q5)
    s4 = 2.5*math.cos(q8)
    s5 = 2.5*math.sin(q8)
    # outputs
    r[0] = k0 - v0
    r[1] = k1 - v1
    r[2] = k2 - v2
    r[3] = k3 - v3
    r[4] = k4 - v4
    r[5] = k5 - v5
    r[6] = k6 - v6
    r[7] = k7 - v7
    r[8] = k8 - v8
    r[9] = p0*k9 + k18 - k20
    r[10] = p15 + p0*k10 + k19 - k21
    r[11] = p28*k11 + s1*k18 - s0*k19 + s1*k20 - s0*k21
    r[12] = p1*k12 + k20 - k22
    r[13] = p16 + p1*k13 + k21 - k23
    r[14] = p29*k14 + s3*k20 - s2*k21 + s3*k22 - s2*k23
    r[15] = p2*k15 + k22 + k24
    r[16] = p17 + p2*k16 + k23 + k25
    r[17] = p30*k17 + s4*k23 - s5*k22 + s5*k24 - s4*k25
    r[18] = q0 - s0
    r[19] = q1 - s1
    r[20] = q3 - q0 - s2 - s0
    r[21] = q4 - q1 - s3 - s1
    r[22] = q6 - q3 + s4 - s2
    r[23] = q7 - q4 + s5 - s3
    r[24] = q6 - 10.0 - s4
    r[25] = q7 - s5
    w[18] = 0.0  # power
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def tangent(t, y, k, p, w, j):
    """entries of dF/dk and dF/dy of the descriptor form: 35 operations, 93 before sharing."""
    # inputs
    p0 = p[0]  # crank_mass [kg]
    p1 = p[1]  # coupler_mass [kg]
    p2 = p[2]  # rocker_mass [kg]
    q2 = y[2]  # crank.theta [rad]
    q5 = y[5]  # coupler.theta [rad]
    q8 = y[8]  # rocker.theta [rad]
    p28 = p[28]  # 0.3333333333333333*crank_mass
    p29 = p[29]  # 5.333333333333333*coupler_mass
    p30 = p[30]  # 2.083333333333333*rocker_mass
    k18 = k[18]
    k19 = k[19]
    k20 = k[20]
    k21 = k[21]
    k22 = k[22]
    k23 = k[23]
    k24 = k[24]
    k25 = k[25]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = -s0
    s3 = 4.0*math.cos(q5)
    s4 = -s3
    s5 = 4.0*math.sin(q5)
    s6 = 2.5*math.cos(q8)
    s7 = 2.5*math.sin(q8)
    s8 = -s7
    s9 = -s6
    # outputs
    j[0] = 1.0
    j[1] = -1.0
    j[2] = 1.0
    j[3] = -1.0
    j[4] = 1.0
    j[5] = -1.0
    j[6] = 1.0
    j[7] = -1.0
    j[8] = 1.0
    j[9] = -1.0
    j[10] = 1.0
    j[11] = -1.0
    j[12] = 1.0
    j[13] = -1.0
    j[14] = 1.0
    j[15] = -1.0
    j[16] = 1.0
    j[17] = -1.0
    j[18] = p0
    j[19] = 1.0
    j[20] = -1.0
    j[21] = p0
    j[22] = 1.0
    j[23] = -1.0
    j[24] = p28
    j[25] = s1
    j[26] = s2
    j[27] = s1
    j[28] = s2
    j[29] = s0*k18 + s1*k19 + s0*k20 + s1*k21
    j[30] = p1
    j[31] = 1.0
    j[32] = -1.0
    j[33] = p1
    j[34] = 1.0
    j[35] = -1.0
    j[36] = p29
    j[37] = s5
    j[38] = s4
    j[39] = s5
    j[40] = s4
    j[41] = s3*k20 + s5*k21 + s3*k22 + s5*k23
    j[42] = p2
    j[43] = 1.0
    j[44] = 1.0
    j[45] = p2
    j[46] = 1.0
    j[47] = 1.0
    j[48] = p30
    j[49] = s8
    j[50] = s6
    j[51] = s7
    j[52] = s9
    j[53] = s6*k24 - (s6*k22 + s7*k23) + s7*k25
    j[54] = 1.0
    j[55] = s1
    j[56] = 1.0
    j[57] = s2
    j[58] = -1.0
    j[59] = s1
    j[60] = 1.0
    j[61] = s5
    j[62] = -1.0
    j[63] = s2
    j[64] = 1.0
    j[65] = s4
    j[66] = -1.0
    j[67] = s5
    j[68] = 1.0
    j[69] = s8
    j[70] = -1.0
    j[71] = s4
    j[72] = 1.0
    j[73] = s6
    j[74] = 1.0
    j[75] = s7
    j[76] = 1.0
    j[77] = s9
    return 0
