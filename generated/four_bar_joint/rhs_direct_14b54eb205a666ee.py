"""Right-hand side, for model `four-bar`. Emitted by symgen; do not edit.

digest 5a0879e70ad1e49683b99a216dbef576387e1c5c3a858c6fd5e65bf95f500c9d, format 3, templates 774f5f3a0a6c3684
"""

import math

from numba import njit


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 125 operations, 10337 before sharing."""
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
    p21 = p[21]
    p22 = p[22]
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
    s12 = 5.0*s2
    s13 = 8.0*s10
    s14 = 5.0*(v1*v1)
    s15 = 2.5*s1*p18
    s16 = s3*p19
    s17 = s4*p19
    s18 = s5*(s10*s17 - p17) - s6*(s10*s16) - s0*p16
    s19 = s6*s17 + s5*s16
    s20 = s19*p22
    s21 = 1.0/(p20 - s19*s20)
    s22 = 4.0*s3*p17 + s8*s17 - s9*s16 + s18*s20
    s23 = 8.0*s4 - s6*s20
    s24 = s5*s20 - 8.0*s3
    s25 = s6*p22
    s26 = s12*p21
    s27 = s21*s23
    s28 = s5*p22
    s29 = s11*p21
    s30 = s21*s24
    s31 = s8 + s3*s13 - s1*s14 + s18*s25 + s15*s26 - s22*s27
    s32 = s24*s27 - (s5*s25 + s11*s26)
    s33 = s5*s28 + s11*s29 + s24*s30
    s34 = 1.0/(mask_0 + s6*s25 + s12*s26 + s23*s27)
    s35 = s32*s34
    s36 = mask_1 + s33 - s32*s35
    s37 = 1.0/s36*(s9 + s4*s13 - s2*s14 - (s18*s28 + s15*s29 + s22*s30) - s31*s35)
    s38 = s31*s34 - s35*s37
    s39 = s21*(s22 + s23*s38 + s24*s37)
    # outputs
    ydot[0] = v0  # rate of crank.theta
    ydot[1] = v1  # rate of rocker.theta
    ydot[2] = v2  # rate of coupler.theta
    ydot[3] = p22*(s18 - (s6*s38 - s5*s37)) + s20*s39  # rate of crank.omega
    ydot[4] = -p21*(s15 + s11*s37 - s12*s38)  # rate of rocker.omega
    ydot[5] = -s39  # rate of coupler.omega
    ydot[6] = 0.0  # rate of work
    w[19] = s38  # C.x
    w[20] = s37  # C.y
    return int((s36 < 1e-06*s33))
