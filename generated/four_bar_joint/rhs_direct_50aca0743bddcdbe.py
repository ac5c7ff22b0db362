"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 148 operations, 10927 before sharing."""
    # inputs
    q0 = y[0]  # crank.theta [rad]
    q1 = y[1]  # rocker.theta [rad]
    q2 = y[2]  # coupler.theta [rad]
    v0 = y[3]  # crank.omega [rad/s]
    v1 = y[4]  # rocker.omega [rad/s]
    v2 = y[5]  # coupler.omega [rad/s]
    p16 = p[16]  # 9.81*crank_mass
    p17 = p[17]  # 9.81*coupler_mass
    p18 = p[18]  # 9.81*rocker_mass
    p19 = p[19]  # 4.0*coupler_mass
    p20 = p[20]
    mask_0 = w[21]  # C.x
    mask_1 = w[22]  # C.y
    p21 = p[21]  # 2.0*alpha
    p22 = p[22]  # beta*beta
    p23 = p[23]
    p24 = p[24]
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.cos(q1)
    s2 = math.sin(q1)
    s3 = math.cos(q2)
    s4 = math.sin(q2)
    s5 = 2.0*s0
    s6 = 2.0*math.sin(q0)
    s7 = v0*v0
    s8 = s5*s7
    s9 = s6*s7
    s10 = v2*v2
    s11 = 5.0*s1
    s12 = 8.0*s3
    s13 = 5.0*s2
    s14 = 8.0*s4
    s15 = 8.0*s10
    s16 = 5.0*(v1*v1)
    s17 = 2.5*s1*p18
    s18 = s3*p19
    s19 = s4*p19
    s20 = s5*(s10*s19 - p17) - s6*(s10*s18) - s0*p16
    s21 = s6*s19 + s5*s18
    s22 = s21*p24
    s23 = 1.0/(p20 - s21*s22)
    s24 = 4.0*s3*p17 + s8*s19 - s9*s18 + s20*s22
    s25 = s14 - s6*s22
    s26 = s5*s22 - s12
    s27 = s6*p24
    s28 = s13*p23
    s29 = s23*s25
    s30 = s5*p24
    s31 = s11*p23
    s32 = s23*s26
    s33 = s8 + s3*s15 - s1*s16 + (v0*s6 - v1*s13 + v2*s14)*p21 + (10.0 - s5 + s11 - s12)*p22 + s20*s27 + s17*s28 - s24*s29
    s34 = s9 + s4*s15 - s2*s16 + (v1*s11 - v0*s5 - v2*s12)*p21 + (s13 - s6 - s14)*p22 - (s20*s30 + s17*s31 + s24*s32)
    s35 = s26*s29 - (s5*s27 + s11*s28)
    s36 = s5*s30 + s11*s31 + s26*s32
    s37 = 1.0/(mask_0 + s6*s27 + s13*s28 + s25*s29)
    s38 = s35*s37
    s39 = mask_1 + s36 - s35*s38
    s40 = 1.0/s39*(s34 - s33*s38)
    s41 = s33*s37 - s38*s40
    s42 = s23*(s24 + s25*s41 + s26*s40)
    # outputs
    ydot[0] = v0  # rate of crank.theta
    ydot[1] = v1  # rate of rocker.theta
    ydot[2] = v2  # rate of coupler.theta
    ydot[3] = p24*(s20 - (s6*s41 - s5*s40)) + s22*s42  # rate of crank.omega
    ydot[4] = -p23*(s17 + s11*s40 - s13*s41)  # rate of rocker.omega
    ydot[5] = -s42  # rate of coupler.omega
    ydot[6] = 0.0  # rate of work
    w[19] = s41  # C.x
    w[20] = s40  # C.y
    return int((s39 < 1e-06*s36))
