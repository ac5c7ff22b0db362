"""Method `baumgarte` for model `four-bar` in lanes, for 8 runs at once. Emitted by symgen; do not edit.

violations decay like a damped oscillator with gains alpha, beta
Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1-16, doi 10.1016/0045-7825(72)90018-7
digest 46b2922f94755fcfcf37d7d2d33b09a20493d3c5c95f1eab876091ff3fa920d7, format 3, templates 774f5f3a0a6c3684
option solver = elimination
p[30] alpha (default 5.0)
p[31] beta (default 5.0)

All that a run has stands in one array z, since the compiler would otherwise have to make sure of too many pairs of
arrays that they do not overlap: element i of a lane is z[8*i + lane], with y from i = 0 on, y' from 20, p
from 40, w from 72, and counters of the lanes from 210. How many lanes there are is computed, since a loop of
known length would be unrolled before it could become vector instructions.
"""

import math

from numba import njit

from .model_lanes import cosine, sine

NUMBERS = 215  # places in z
SUSPECTS = 1680


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, z, lanes):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 217 operations a lane."""
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
        mask_1 = z[800 + lane]
        mask_2 = z[808 + lane]
        mask_3 = z[816 + lane]
        mask_4 = z[824 + lane]
        mask_5 = z[832 + lane]
        mask_7 = z[848 + lane]
        gauge_2 = z[1272 + lane]
        gauge_5 = z[1296 + lane]
        gauge_8 = z[1320 + lane]
        s0 = cosine(q2)
        s1 = sine(q2)
        s2 = -s0
        s3 = q0 - s0
        s4 = q1 - s1
        s5 = 4.0*cosine(q5)
        s6 = -s5
        s7 = q3 - q0 - s5 - s0
        s8 = 4.0*sine(q5)
        s9 = q4 - q1 - s8 - s1
        s10 = 2.5*cosine(q8)
        s11 = q6 - q3 + s10 - s5
        s12 = 2.5*sine(q8)
        s13 = q7 - q4 + s12 - s8
        s14 = q6 - 10.0 - s10
        s15 = q7 - s12
        s16 = s1*gauge_2
        s17 = s0*gauge_2
        s18 = s8*gauge_5
        s19 = s5*gauge_5
        s20 = s12*gauge_8
        s21 = s10*gauge_8
        s22 = s1*s16
        s23 = 1.0 + s22
        s24 = s0*s16
        s25 = -1.0 + s22
        s26 = s0*s17
        s27 = 1.0 + s26
        s28 = s8*s18
        s29 = 1.0 + s23 + s28
        s30 = s5*s18
        s31 = -1.0 + s28
        s32 = s5*s19
        s33 = 1.0 + s27 + s32
        s34 = s12*s20
        s35 = 1.0 + 1.0 + s28 + s34
        s36 = s10*s20
        s37 = 1.0 - s34
        s38 = s10*s21
        s39 = 1.0 + 1.0 + s32 + s38
        s40 = s12*s21
        s41 = 1.0 + s38
        s42 = 1.0/s23
        s43 = s24*s42
        s44 = -s43
        s45 = s25*s42
        s46 = s24*s43
        s47 = s27 - s46
        s48 = s25*s43 - s1*s17
        s49 = -1.0 + s26 - s46
        s50 = 1.0*(s47 > mask_1 + 1e-12*s27)
        s51 = s50/max(s47, 1e-300)
        s52 = s48*s51
        s53 = s49*s51
        s54 = s29 - s25*s45 - s48*s52
        s55 = s24*s45 - (s24 + s30) - s49*s52
        s56 = 1.0/(1.0 + s34)
        s57 = s36*s56
        s58 = s37*s56
        s59 = s40*s56
        s60 = s41 - s36*s57
        s61 = s36 + s37*s57
        s62 = 1.0 - s38 + s40*s57
        s63 = 1.0*(s60 > mask_7 + 1e-12*s41)
        s64 = s63/max(s60, 1e-300)
        s65 = s61*s64
        s66 = s62*s64
        s67 = 1.0*(s54 > mask_2 + 1e-12*s29)
        s68 = s67/max(s54, 1e-300)
        s69 = s55*s68
        s70 = s31*s68
        s71 = s30*s68
        s72 = s33 - s46 - s49*s53 - s55*s69
        s73 = s8*s19 + s31*s69
        s74 = -1.0 + s32 + s30*s69
        s75 = 1.0*(s72 > mask_3 + 1e-12*s33)
        s76 = s75/max(s72, 1e-300)
        s77 = s73*s76
        s78 = s74*s76
        s79 = s35 - s37*s58 - s61*s65 - s31*s70 - s73*s77
        s80 = s30*s70 - (s30 + s36 + s40*s58 + s62*s65) + s74*s77
        s81 = 1.0*(s79 > mask_4 + 1e-12*s35)
        s82 = s81/max(s79, 1e-300)
        s83 = s80*s82
        s84 = s39 - s40*s59 - s62*s66 - s30*s71 - s74*s78 - s80*s83
        s85 = 1.0*(s84 > mask_5 + 1e-12*s39)
        s86 = math.sqrt(s3*s3 + s4*s4 + s7*s7 + s9*s9 + s11*s11 + s13*s13 + s14*s14 + s15*s15)
        s87 = s47/s27
        s88 = s54/s29
        s89 = s72/s33
        s90 = s79/s35
        s91 = s84/s39
        s92 = min(min(min(min(min(1.0, mask_1 + s87), mask_2 + s88), mask_3 + s89), mask_4 + s90), mask_5 + s91)
        s93 = s60/s41
        z[920 + lane] = s3
        z[928 + lane] = s4
        z[936 + lane] = s7
        z[944 + lane] = s9
        z[952 + lane] = s11
        z[960 + lane] = s13
        z[968 + lane] = s14
        z[976 + lane] = s15
        z[576 + lane] = s86
        z[640 + lane] = s86
        z[1392 + lane] = s1
        z[1400 + lane] = s2
        z[1408 + lane] = s1
        z[1416 + lane] = s8
        z[1424 + lane] = s2
        z[1432 + lane] = s6
        z[1440 + lane] = s8
        z[1448 + lane] = -s12
        z[1456 + lane] = s6
        z[1464 + lane] = s10
        z[1472 + lane] = s12
        z[1480 + lane] = -s10
        z[1056 + lane] = s87
        z[1064 + lane] = s88
        z[1072 + lane] = s89
        z[1080 + lane] = s90
        z[1088 + lane] = s91
        z[1104 + lane] = s93
        z[616 + lane] = s63 + 1.0 + s85 + s81 + s75 + s67 + 1.0 + s50
        z[608 + lane] = min(s92, mask_7 + s93)
        z[656 + lane] = 1.0
        z[1488 + lane] = s44
        z[1496 + lane] = s45
        z[1504 + lane] = s44
        z[1512 + lane] = s52
        z[1520 + lane] = s53
        z[1528 + lane] = -s57
        z[1536 + lane] = s58
        z[1544 + lane] = s59
        z[1552 + lane] = s65
        z[1560 + lane] = s66
        z[1568 + lane] = s69
        z[1576 + lane] = s70
        z[1584 + lane] = -s71
        z[1592 + lane] = -s77
        z[1600 + lane] = s78
        z[1608 + lane] = s83
        z[1616 + lane] = s42
        z[1624 + lane] = s51
        z[1632 + lane] = s56
        z[1640 + lane] = s64
        z[1648 + lane] = s68
        z[1656 + lane] = s76
        z[1664 + lane] = s82
        z[1672 + lane] = s85/max(s84, 1e-300)
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
        jacobian_0 = z[1392 + lane]
        jacobian_1 = z[1400 + lane]
        jacobian_2 = z[1408 + lane]
        jacobian_3 = z[1416 + lane]
        jacobian_4 = z[1424 + lane]
        jacobian_5 = z[1432 + lane]
        jacobian_6 = z[1440 + lane]
        jacobian_7 = z[1448 + lane]
        jacobian_8 = z[1456 + lane]
        jacobian_9 = z[1464 + lane]
        jacobian_10 = z[1472 + lane]
        jacobian_11 = z[1480 + lane]
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
        z[920 + lane] = s1
        z[928 + lane] = s2
        z[936 + lane] = s3
        z[944 + lane] = s4
        z[952 + lane] = s5
        z[960 + lane] = s6
        z[968 + lane] = s7
        z[976 + lane] = s8
        z[584 + lane] = s9
        z[648 + lane] = s9
        z[592 + lane] = s0 + v8*v8*p11
        z[600 + lane] = q1*p4 + q4*p7 + q7*p10
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, z):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 359 operations a lane."""
    lanes = len(z) // NUMBERS
    for lane in range(lanes):
        q0 = z[0 + lane]
        q1 = z[8 + lane]
        q2 = z[16 + lane]
        v0 = z[72 + lane]
        v1 = z[80 + lane]
        v2 = z[88 + lane]
        q3 = z[24 + lane]
        q4 = z[32 + lane]
        q5 = z[40 + lane]
        v3 = z[96 + lane]
        v4 = z[104 + lane]
        v5 = z[112 + lane]
        q6 = z[48 + lane]
        q7 = z[56 + lane]
        q8 = z[64 + lane]
        v6 = z[120 + lane]
        v7 = z[128 + lane]
        v8 = z[136 + lane]
        p15 = z[440 + lane]
        p16 = z[448 + lane]
        p17 = z[456 + lane]
        mask_0 = z[792 + lane]
        mask_1 = z[800 + lane]
        mask_2 = z[808 + lane]
        mask_3 = z[816 + lane]
        mask_4 = z[824 + lane]
        mask_5 = z[832 + lane]
        mask_6 = z[840 + lane]
        mask_7 = z[848 + lane]
        p18 = z[464 + lane]
        p19 = z[472 + lane]
        p20 = z[480 + lane]
        p21 = z[488 + lane]
        p22 = z[496 + lane]
        p23 = z[504 + lane]
        p24 = z[512 + lane]
        p25 = z[520 + lane]
        p26 = z[528 + lane]
        p27 = z[536 + lane]
        p28 = z[544 + lane]
        p29 = z[552 + lane]
        s0 = cosine(q2)
        s1 = sine(q2)
        s2 = v2*v2
        s3 = s0*s2
        s4 = s1*s2
        s5 = cosine(q5)
        s6 = sine(q5)
        s7 = 4.0*s5
        s8 = 4.0*s6
        s9 = 4.0*(v5*v5)
        s10 = s5*s9
        s11 = s6*s9
        s12 = cosine(q8)
        s13 = sine(q8)
        s14 = 2.5*s12
        s15 = 2.5*s13
        s16 = 2.5*(v8*v8)
        s17 = s12*s16
        s18 = s13*s16
        s19 = v2*s1
        s20 = v2*s0
        s21 = v5*s8
        s22 = v5*s7
        s23 = v8*s15
        s24 = v8*s14
        s25 = s3 + (v0 + s19)*p18 + (q0 - s0)*p19
        s26 = s17 + (v6 + s23)*p18 + (q6 - 10.0 - s14)*p19
        s27 = s1*p21
        s28 = s0*p21
        s29 = s8*p23
        s30 = s7*p23
        s31 = s15*p25
        s32 = s14*p25
        s33 = s1*s27
        s34 = p20 + s33
        s35 = s0*s27
        s36 = s33 - p20
        s37 = s0*s28
        s38 = p20 + s37
        s39 = s8*s29
        s40 = p22 + s34 + s39
        s41 = s7*s29
        s42 = s39 - p22
        s43 = s7*s30
        s44 = p22 + s38 + s43
        s45 = s15*s31
        s46 = p24 + p22 + s39 + s45
        s47 = s14*s31
        s48 = p24 - s45
        s49 = s14*s32
        s50 = p24 + p22 + s43 + s49
        s51 = s15*s32
        s52 = p24 + s49
        s53 = 1.0/(mask_0 + s34)
        s54 = s35*s53
        s55 = s36*s53
        s56 = s35*s54
        s57 = s36*s54 - s1*s28
        s58 = s37 - p20 - s56
        s59 = mask_1 + s38 - s56
        s60 = 1.0/s59
        s61 = s57*s60
        s62 = s58*s60
        s63 = s35*s55 - (s35 + s41) - s58*s61
        s64 = 1.0/(mask_6 + p24 + s45)
        s65 = s47*s64
        s66 = s48*s64
        s67 = s51*s64
        s68 = s47 + s48*s65
        s69 = p24 - s49 + s51*s65
        s70 = mask_7 + s52 - s47*s65
        s71 = 1.0/s70
        s72 = s68*s71
        s73 = s69*s71
        s74 = mask_2 + s40 - s36*s55 - s57*s61
        s75 = 1.0/s74
        s76 = s63*s75
        s77 = s42*s75
        s78 = s41*s75
        s79 = s8*s30 + s42*s76
        s80 = s43 - p22 + s41*s76
        s81 = mask_3 + s44 - s56 - s58*s62 - s63*s76
        s82 = 1.0/s81
        s83 = s79*s82
        s84 = s80*s82
        s85 = s41*s77 - (s41 + s47 + s51*s66 + s69*s72) + s80*s83
        s86 = mask_4 + s46 - s48*s66 - s68*s72 - s42*s77 - s79*s83
        s87 = 1.0/s86
        s88 = s85*s87
        s89 = mask_5 + s50 - s51*s67 - s69*s73 - s41*s78 - s80*s84 - s85*s88
        s90 = s25*s54
        s91 = s4 + (v1 - s20)*p18 + (q1 - s1)*p19 - p26 + s90
        s92 = s3 + s10 + (v3 + s19 - v0 + s21)*p18 + (q3 - q0 - s7 - s0)*p19 - s25*s55 - s61*s91
        s93 = s18 + (v7 - s24)*p18 + (q7 - s15)*p19 - p27 + s26*s65
        s94 = p29 - (s18 - s11 - (v7 - (v4 + s22) + s24)*p18 - (q7 - q4 + s15 - s8)*p19) - s26*s67 - s73*s93
        s95 = s4 + s11 + (v4 - (v1 + s20) - s22)*p18 + (q4 - q1 - s8 - s1)*p19 + p28 + s90 - s62*s91 - s76*s92
        s96 = (q6 - q3 + s14 - s7)*p19 - (s17 - s10 - (v6 + s21 - v3 - s23)*p18) - s26*s66 - s72*s93 - s77*s92
        s97 = s96 + s83*s95
        s98 = 1.0/s89*(s94 + s78*s92 - s84*s95 - s88*s97)
        s99 = s87*s97
        s100 = s88*s98
        s101 = s99 - s100
        s102 = s82*s95 + s83*s101
        s103 = s84*s98
        s104 = s102 - s103
        s105 = s75*s92 - s76*s104 - s77*s101 + s78*s98
        s106 = s71*s93 - s72*s101 - s73*s98
        s107 = s26*s64 + s65*s106 - s66*s101 - s67*s98
        s108 = s60*s91 - s61*s105 - s62*s104
        s109 = s25*s53 + s54*s108 - s55*s105 + s54*s104
        s110 = (((((s59 < 1e-06*s38) | (s70 < 1e-06*s52)) | (s74 < 1e-06*s40)) | (s81 < 1e-06*s44)) | (s86 < 1e-06*s46))
        z[160 + lane] = v0
        z[168 + lane] = v1
        z[176 + lane] = v2
        z[184 + lane] = v3
        z[192 + lane] = v4
        z[200 + lane] = v5
        z[208 + lane] = v6
        z[216 + lane] = v7
        z[224 + lane] = v8
        z[232 + lane] = p20*(s105 - s109)
        z[240 + lane] = -p20*(p15 + s108 + s103 - s102)
        z[248 + lane] = p21*(s0*s104 - (s1*s109 - s0*s108 + s1*s105))
        z[256 + lane] = -p22*(s105 + s100 - s99)
        z[264 + lane] = -p22*(p16 + s104 - s98)
        z[272 + lane] = p23*(s7*s98 - (s8*s105 - s7*s104 + s8*s101))
        z[280 + lane] = -p24*(s101 + s107)
        z[288 + lane] = -p24*(p17 + s98 + s106)
        z[296 + lane] = p25*(s14*s106 - (s14*s98 - s15*s101 + s15*s107))
        z[304 + lane] = 0.0
        z[728 + lane] = s109
        z[736 + lane] = s108
        z[744 + lane] = s105
        z[752 + lane] = s104
        z[760 + lane] = s101
        z[768 + lane] = s98
        z[776 + lane] = s107
        z[784 + lane] = s106
        z[SUSPECTS + lane] += 1.0*(s110 | (s89 < 1e-06*s50))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, z):
    """Measure accepted states; lanes whose correction fails are counted."""
    lanes = len(z) // NUMBERS
    geometry(t, z, lanes)
    measure(t, z, lanes)
    return 0
