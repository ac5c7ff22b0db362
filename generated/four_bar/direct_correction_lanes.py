"""Method `direct-correction` for model `four-bar` in lanes, for 8 runs at once. Emitted by symgen; do not edit.

Positions and velocities are projected after each step with the pseudoinverse of D.
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076; Yoon, Howe, Greenwood, J. Mech. D...
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates a1bfe8da2fcb1eac
option solver = elimination
option weight = identity
option when = step
p[27] tolerance (default 1e-13)

All that a run has stands in one array z, since the compiler would otherwise have to make sure of too many pairs of
arrays that they do not overlap: element i of a lane is z[8*i + lane], with y from i = 0 on, y' from 20, p
from 40, w from 70, and counters of the lanes from 184. How many lanes there are is computed, since a loop of
known length would be unrolled before it could become vector instructions.
"""

import math

from numba import njit

from .model_lanes import cosine, sine

NUMBERS = 189  # places in z
SUSPECTS = 1472
FAILURES = 1480
ITERATIONS = 1488
LAST = 1496
OPEN = 1504


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, z, lanes):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 129 operations a lane."""
    for lane in range(lanes):
        q0 = z[0 + lane]
        q1 = z[8 + lane]
        q2 = z[16 + lane]
        q3 = z[24 + lane]
        q4 = z[32 + lane]
        q5 = z[40 + lane]
        q6 = z[48 + lane]
        q7 = z[56 + lane]
        q8 = z[64 + lane]
        mask_4 = z[808 + lane]
        mask_5 = z[816 + lane]
        gauge_2 = z[1256 + lane]
        gauge_5 = z[1280 + lane]
        gauge_8 = z[1304 + lane]
        s0 = cosine(q2)
        s1 = sine(q2)
        s2 = -s0
        s3 = q0 - s0
        s4 = q1 - s1
        s5 = cosine(q5)
        s6 = sine(q5)
        s7 = 4.0*s5
        s8 = -s7
        s9 = q3 - q0 - s7 - s0
        s10 = 4.0*s6
        s11 = q4 - q1 - s10 - s1
        s12 = cosine(q8)
        s13 = sine(q8)
        s14 = 2.5*s12
        s15 = q6 - q3 + s14 - s7
        s16 = 2.5*s13
        s17 = q7 - q4 + s16 - s10
        s18 = q6 - 10.0 - s14
        s19 = q7 - s16
        s20 = 1.0 + 1.0 + s10*(s10*gauge_5) + s16*(s16*gauge_8)
        s21 = 1.0 + 1.0 + s7*(s7*gauge_5) + s14*(s14*gauge_8)
        s22 = s1 + s1
        s23 = s0 + s0
        s24 = 5.0*s13
        s25 = 5.0*s12
        s26 = 8.0*(s1*s6 + s0*s5)
        s27 = 1.0/(1.0/gauge_8 + 6.25)
        s28 = s24*s27
        s29 = 1.0/(1.0/gauge_2 + 5.0)
        s30 = s26*s29
        s31 = s22*s29
        s32 = 8.0*s6 - s22*s30
        s33 = s23*s30 - 8.0*s5
        s34 = 1.0/(1.0/gauge_5 + 16.0 - s26*s30)
        s35 = s32*s34
        s36 = s24*s28 + s22*s31 + s32*s35
        s37 = s25*s28 + s23*s31 - s33*s35
        s38 = 1.0*(s36 > mask_4 + 1e-12*s20)
        s39 = s25*(s25*s27) + s23*(s23*s29) + s33*(s33*s34) - s37*(s37*(s38/max(s36, 1e-300)))
        s40 = math.sqrt(s3*s3 + s4*s4 + s9*s9 + s11*s11 + s15*s15 + s17*s17 + s18*s18 + s19*s19)
        s41 = s36/s20
        s42 = s39/s21
        z[904 + lane] = s3
        z[912 + lane] = s4
        z[920 + lane] = s9
        z[928 + lane] = s11
        z[936 + lane] = s15
        z[944 + lane] = s17
        z[952 + lane] = s18
        z[960 + lane] = s19
        z[560 + lane] = s40
        z[624 + lane] = s40
        z[1376 + lane] = s1
        z[1384 + lane] = s2
        z[1392 + lane] = s1
        z[1400 + lane] = s10
        z[1408 + lane] = s2
        z[1416 + lane] = s8
        z[1424 + lane] = s10
        z[1432 + lane] = -s16
        z[1440 + lane] = s8
        z[1448 + lane] = s14
        z[1456 + lane] = s16
        z[1464 + lane] = -s14
        z[1064 + lane] = s41
        z[1072 + lane] = s42
        z[600 + lane] = 1.0 + 1.0 + 1.0*(s39 > mask_5 + 1e-12*s21) + 4.0 + s38
        z[592 + lane] = min(min(1.0, mask_4 + s41), mask_5 + s42)
        z[640 + lane] = 1.0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(t, z, lanes):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 147 operations a lane."""
    for lane in range(lanes):
        mask_4 = z[808 + lane]
        mask_5 = z[816 + lane]
        residual_0 = z[904 + lane]
        residual_1 = z[912 + lane]
        residual_2 = z[920 + lane]
        residual_3 = z[928 + lane]
        residual_4 = z[936 + lane]
        residual_5 = z[944 + lane]
        residual_6 = z[952 + lane]
        residual_7 = z[960 + lane]
        jacobian_0 = z[1376 + lane]
        jacobian_1 = z[1384 + lane]
        jacobian_2 = z[1392 + lane]
        jacobian_3 = z[1400 + lane]
        jacobian_4 = z[1408 + lane]
        jacobian_5 = z[1416 + lane]
        jacobian_6 = z[1424 + lane]
        jacobian_7 = z[1432 + lane]
        jacobian_8 = z[1440 + lane]
        jacobian_9 = z[1448 + lane]
        jacobian_10 = z[1456 + lane]
        jacobian_11 = z[1464 + lane]
        pivot_4 = z[1064 + lane]
        pivot_5 = z[1072 + lane]
        s0 = jacobian_0 + jacobian_2
        s1 = jacobian_1 + jacobian_4
        s2 = jacobian_7 - jacobian_10
        s3 = jacobian_9 - jacobian_11
        s4 = jacobian_3*s0 + jacobian_5*s1
        s5 = 1.0/(1.0 + jacobian_10*jacobian_10 + jacobian_11*jacobian_11)
        s6 = s2*s5
        s7 = s3*s5
        s8 = 1.0/(1.0 + jacobian_0*jacobian_0 + jacobian_1*jacobian_1 + s0*s0 + s1*s1)
        s9 = s4*s8
        s10 = s0*s8
        s11 = s1*s8
        s12 = jacobian_3 + jacobian_6 - s0*s9
        s13 = jacobian_5 + jacobian_8 - s1*s9
        s14 = 1.0/(1.0 + jacobian_3*jacobian_3 + jacobian_5*jacobian_5 - s4*s9)
        s15 = s12*s14
        s16 = s13*s14
        s17 = s3*s6 + s1*s10 + s13*s15
        s18 = 1.0*(pivot_4 > mask_4 + 1e-12)/max(s2*s6 + s0*s10 + s12*s15, 1e-300)
        s19 = s17*s18
        s20 = residual_0 + residual_2
        s21 = residual_1 + residual_3
        s22 = residual_6*jacobian_10 + residual_7*jacobian_11
        s23 = residual_0*jacobian_0 + residual_1*jacobian_1 + s0*s20 + s1*s21
        s24 = s9*s23 - (jacobian_3*s20 + jacobian_5*s21)
        s25 = residual_6 - residual_4 - s20 + s6*s22 + s10*s23 - s15*s24
        s26 = 1.0*(pivot_5 > mask_5 + 1e-12)/max(s3*s7 + s1*s11 + s13*s16 - s17*s19, 1e-300)*(residual_7 - residual_5 - s21 + s7*s22 + s11*s23 - s16*s24 - s19*s25)
        s27 = s19*s26 - s18*s25
        s28 = s14*s24 - s15*s27 + s16*s26
        s29 = s11*s26 - (s8*s23 + s9*s28 + s10*s27)
        s30 = s7*s26 - (s5*s22 + s6*s27)
        s31 = residual_0 + jacobian_0*s29
        s32 = residual_1 + jacobian_1*s29
        z[1096 + lane] = -s31
        z[1104 + lane] = -s32
        z[1112 + lane] = s29
        z[1120 + lane] = -(residual_2 + s31 + jacobian_2*s29 + jacobian_3*s28)
        z[1128 + lane] = -(residual_3 + s32 + jacobian_4*s29 + jacobian_5*s28)
        z[1136 + lane] = s28
        z[1144 + lane] = -(residual_6 + jacobian_10*s30)
        z[1152 + lane] = -(residual_7 + jacobian_11*s30)
        z[1160 + lane] = s30
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, z, lanes):
    """D v - nu with the D and nu that `geometry` left: 28 operations a lane."""
    for lane in range(lanes):
        v0 = z[72 + lane]
        v1 = z[80 + lane]
        v2 = z[88 + lane]
        v3 = z[96 + lane]
        v4 = z[104 + lane]
        v5 = z[112 + lane]
        v6 = z[120 + lane]
        v7 = z[128 + lane]
        v8 = z[136 + lane]
        jacobian_0 = z[1376 + lane]
        jacobian_1 = z[1384 + lane]
        jacobian_2 = z[1392 + lane]
        jacobian_3 = z[1400 + lane]
        jacobian_4 = z[1408 + lane]
        jacobian_5 = z[1416 + lane]
        jacobian_6 = z[1424 + lane]
        jacobian_7 = z[1432 + lane]
        jacobian_8 = z[1440 + lane]
        jacobian_9 = z[1448 + lane]
        jacobian_10 = z[1456 + lane]
        jacobian_11 = z[1464 + lane]
        z[904 + lane] = v0 + v2*jacobian_0
        z[912 + lane] = v1 + v2*jacobian_1
        z[920 + lane] = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
        z[928 + lane] = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
        z[936 + lane] = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
        z[944 + lane] = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
        z[952 + lane] = v6 + v8*jacobian_10
        z[960 + lane] = v7 + v8*jacobian_11
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, z, lanes):
    """D v - nu with the D and nu that `geometry` left, and the energies: 75 operations a lane."""
    for lane in range(lanes):
        q1 = z[8 + lane]
        v0 = z[72 + lane]
        v1 = z[80 + lane]
        v2 = z[88 + lane]
        q4 = z[32 + lane]
        v3 = z[96 + lane]
        v4 = z[104 + lane]
        v5 = z[112 + lane]
        q7 = z[56 + lane]
        v6 = z[120 + lane]
        v7 = z[128 + lane]
        v8 = z[136 + lane]
        p3 = z[344 + lane]
        p4 = z[352 + lane]
        p5 = z[360 + lane]
        p6 = z[368 + lane]
        p7 = z[376 + lane]
        p8 = z[384 + lane]
        p9 = z[392 + lane]
        p10 = z[400 + lane]
        p11 = z[408 + lane]
        jacobian_0 = z[1376 + lane]
        jacobian_1 = z[1384 + lane]
        jacobian_2 = z[1392 + lane]
        jacobian_3 = z[1400 + lane]
        jacobian_4 = z[1408 + lane]
        jacobian_5 = z[1416 + lane]
        jacobian_6 = z[1424 + lane]
        jacobian_7 = z[1432 + lane]
        jacobian_8 = z[1440 + lane]
        jacobian_9 = z[1448 + lane]
        jacobian_10 = z[1456 + lane]
        jacobian_11 = z[1464 + lane]
        s0 = p3*(v0*v0) + p3*(v1*v1) + v2*v2*p5 + p6*(v3*v3) + p6*(v4*v4) + v5*v5*p8 + p9*(v6*v6) + p9*(v7*v7)
        s1 = v0 + v2*jacobian_0
        s2 = v1 + v2*jacobian_1
        s3 = v3 + v2*jacobian_2 - v0 + v5*jacobian_3
        s4 = v4 + v2*jacobian_4 - v1 + v5*jacobian_5
        s5 = v6 + v5*jacobian_6 - v3 + v8*jacobian_7
        s6 = v7 + v5*jacobian_8 - v4 + v8*jacobian_9
        s7 = v6 + v8*jacobian_10
        s8 = v7 + v8*jacobian_11
        s9 = math.sqrt(s1*s1 + s2*s2 + s3*s3 + s4*s4 + s5*s5 + s6*s6 + s7*s7 + s8*s8)
        z[904 + lane] = s1
        z[912 + lane] = s2
        z[920 + lane] = s3
        z[928 + lane] = s4
        z[936 + lane] = s5
        z[944 + lane] = s6
        z[952 + lane] = s7
        z[960 + lane] = s8
        z[568 + lane] = s9
        z[632 + lane] = s9
        z[576 + lane] = s0 + v8*v8*p11
        z[584 + lane] = q1*p4 + q4*p7 + q7*p10
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, z):
    """q', v', power and multipliers; 1 where a loop or a pivot of S is suspicious: 155 operations a lane."""
    lanes = len(z) // NUMBERS
    for lane in range(lanes):
        p0 = z[320 + lane]
        p1 = z[328 + lane]
        p2 = z[336 + lane]
        q2 = z[16 + lane]
        v0 = z[72 + lane]
        v1 = z[80 + lane]
        v2 = z[88 + lane]
        q5 = z[40 + lane]
        v3 = z[96 + lane]
        v4 = z[104 + lane]
        v5 = z[112 + lane]
        q8 = z[64 + lane]
        v6 = z[120 + lane]
        v7 = z[128 + lane]
        v8 = z[136 + lane]
        p15 = z[440 + lane]
        p16 = z[448 + lane]
        p17 = z[456 + lane]
        mask_4 = z[808 + lane]
        mask_5 = z[816 + lane]
        p28 = z[544 + lane]
        p29 = z[552 + lane]
        p18 = z[464 + lane]
        p19 = z[472 + lane]
        p24 = z[512 + lane]
        p25 = z[520 + lane]
        p26 = z[528 + lane]
        s0 = cosine(q2)
        s1 = sine(q2)
        s2 = v2*v2
        s3 = s0*s2
        s4 = s1*s2
        s5 = cosine(q5)
        s6 = sine(q5)
        s7 = 4.0*s5
        s8 = 4.0*s6
        s9 = v5*v5
        s10 = cosine(q8)
        s11 = sine(q8)
        s12 = 2.5*s10
        s13 = 2.5*s11
        s14 = v8*v8
        s15 = s1 + s1
        s16 = s0 + s0
        s17 = 5.0*s11
        s18 = 5.0*s10
        s19 = 8.0*s6
        s20 = p18*(s1*s6 + s0*s5)
        s21 = 8.0*s5
        s22 = s10*p24
        s23 = s14*s18 - s9*s21 - s2*(2.0*s0)
        s24 = p18*(s0*s6 - s1*s5)
        s25 = s2*s24 + s5*p26
        s26 = s14*s17 - s9*s19 - s2*(2.0*s1)
        s27 = s18*s19 - s17*s21
        s28 = 1.0/s27
        s29 = s18*s28
        s30 = s17*s28
        s31 = s21*s28
        s32 = s19*s28
        s33 = s15*s29 - s16*s30
        s34 = s15*s31 - s16*s32
        s35 = p28*s34
        s36 = p19*s33 - s20
        s37 = s23*s29 + s26*s30
        s38 = s23*s31 + s26*s32
        s39 = 1.0/(p29 + s33*s36 + s34*s35 - s20*s33)*(s9*s24 - s0*p25 + s25*s33 + s22*s34 + s36*s37 + s35*s38)
        s40 = s37 - s33*s39
        s41 = s38 - s34*s39
        s42 = s25 + p19*s40 + s20*s39
        s43 = s22 + p28*s41
        s44 = s29*s42 + s31*s43
        s45 = s30*s42 + s32*s43
        s46 = s1*s39
        s47 = s3 + s46
        s48 = s0*s39
        s49 = s48 - s4
        s50 = s12*s14 + s13*s41
        s51 = s12*s41 - s13*s14
        s52 = s3 + s7*s9 + s46 + s47 + s8*s40
        s53 = s4 + s8*s9 + s4 - s48 - s48 - s7*s40
        s54 = p1*s52
        s55 = p16 + s45 - p1*s53
        z[160 + lane] = v0
        z[168 + lane] = v1
        z[176 + lane] = v2
        z[184 + lane] = v3
        z[192 + lane] = v4
        z[200 + lane] = v5
        z[208 + lane] = v6
        z[216 + lane] = v7
        z[224 + lane] = v8
        z[232 + lane] = -s47
        z[240 + lane] = s49
        z[248 + lane] = s39
        z[256 + lane] = -s52
        z[264 + lane] = -s53
        z[272 + lane] = s40
        z[280 + lane] = -s50
        z[288 + lane] = s51
        z[296 + lane] = s41
        z[304 + lane] = 0.0
        z[712 + lane] = p0*s47 - (s44 - s54)
        z[720 + lane] = -(p15 + s55 + p0*s49)
        z[728 + lane] = s54 - s44
        z[736 + lane] = -s55
        z[744 + lane] = -s44
        z[752 + lane] = -s45
        z[760 + lane] = s44 + p2*s50
        z[768 + lane] = -(p17 + p2*s51 - s45)
        z[SUSPECTS + lane] += 1.0*(s27*s27 <= 0.16 + mask_4 + mask_5)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, z):
    """Correct and measure accepted states; lanes whose correction fails are counted."""
    lanes = len(z) // NUMBERS
    for lane in range(lanes):
        z[LAST + lane] = math.inf
        z[OPEN + lane] = 1.0
    for round in range(15):
        geometry(t, z, lanes)
        left = 0.0
        for lane in range(lanes):
            tolerance = z[536 + lane] * z[608 + lane]
            violation = z[624 + lane]
            # at the floor of rounding another iteration gains nothing
            stalled = (violation > 0.5 * z[LAST + lane]) & (violation <= 1e4 * tolerance)
            closed = (violation <= tolerance) | stalled | (round == 14)
            z[OPEN + lane] = 0.0 if closed else z[OPEN + lane]
            z[LAST + lane] = violation
            left += z[OPEN + lane]
        if left == 0.0:
            drift(t, z, lanes)  # leaves D v - nu in the section that `spread` corrects
        spread(t, z, lanes)
        if left == 0.0:
            for i in range(9 * lanes):
                z[72 + i] += z[1096 + i]
            break
        for j in range(9):
            for lane in range(lanes):
                z[1096 + lanes * j + lane] *= z[OPEN + lane]
        for lane in range(lanes):
            z[ITERATIONS + lane] += z[OPEN + lane]
        for i in range(9 * lanes):
            z[i] += z[1096 + i]
    for lane in range(lanes):
        z[FAILURES + lane] += 0.0 if z[624 + lane] <= 1e4 * z[536 + lane] * z[608 + lane] else 1.0
    measure(t, z, lanes)
    return 0
