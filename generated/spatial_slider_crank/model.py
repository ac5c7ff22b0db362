"""Model `spatial-slider-crank`: what every method of it shares. Emitted by symgen; do not edit.

digest c2100cf33b5a79dfbf6312decf2b60a90e5d16c871d4de291fc3b6621fc4eecf, format 3, templates a1bfe8da2fcb1eac
21 coordinates, 18 velocities, 17 constraint rows, 0 parameters,
13 of 17 rows eliminated with 2 divisions, together with velocities that they fix

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     crank.x [m]
y[1]     crank.y [m]
y[2]     crank.z [m]
y[3]     crank.e0 [1]
y[4]     crank.e1 [1]
y[5]     crank.e2 [1]
y[6]     crank.e3 [1]
y[7]     rod.x [m]
y[8]     rod.y [m]
y[9]     rod.z [m]
y[10]    rod.e0 [1]
y[11]    rod.e1 [1]
y[12]    rod.e2 [1]
y[13]    rod.e3 [1]
y[14]    slider.x [m]
y[15]    slider.y [m]
y[16]    slider.z [m]
y[17]    slider.e0 [1]
y[18]    slider.e1 [1]
y[19]    slider.e2 [1]
y[20]    slider.e3 [1]
y[21]    crank.vx [m/s]
y[22]    crank.vy [m/s]
y[23]    crank.vz [m/s]
y[24]    crank.wx [rad/s]
y[25]    crank.wy [rad/s]
y[26]    crank.wz [rad/s]
y[27]    rod.vx [m/s]
y[28]    rod.vy [m/s]
y[29]    rod.vz [m/s]
y[30]    rod.wx [rad/s]
y[31]    rod.wy [rad/s]
y[32]    rod.wz [rad/s]
y[33]    slider.vx [m/s]
y[34]    slider.vy [m/s]
y[35]    slider.vz [m/s]
y[36]    slider.wx [rad/s]
y[37]    slider.wy [rad/s]
y[38]    slider.wz [rad/s]
y[39]    work of forces without potential and of drivers [J]
row 0    A.x [m]
row 1    A.y [m]
row 2    A.z [m]
row 3    A.first [rad]
row 4    A.second [rad]
row 5    B.x [m]
row 6    B.y [m]
row 7    B.z [m]
row 8    C.x [m]
row 9    C.y [m]
row 10   C.z [m]
row 11   C.cross [rad]
row 12   guide.across1 [m]
row 13   guide.across2 [m]
row 14   guide.first [rad]
row 15   guide.second [rad]
row 16   guide.angle [rad]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:22]    winding: turns of angles that are counted
w[22:39]    multipliers: Lagrange multipliers, one a row
w[39:56]    mask: inf at rows that depend on others, else 0
w[56:73]    saved: `mask` while `confirm` leaves out further rows
w[73:90]    residual: Phi after `geometry`, D v - nu after `measure`
w[90:107]   nu: right-hand side of D v = nu
w[107:124]  pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[124:142]  change: correction of velocities, or of positions, that `spread` leaves
w[142:160]  mass: diagonal of M
w[160:178]  gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[178:195]  row_weight: factors that make rows of different units comparable
w[195:233]  jacobian: entries of D that are not constant

Left out:
- columns of the ground: the ground does not move
- centre-of-mass offset of crank: its centre of mass is the frame's origin
- centre-of-mass offset of rod: its centre of mass is the frame's origin
- centre-of-mass offset of slider: its centre of mass is the frame's origin
"""

import math

from numba import njit

WINDING = 19  # sections of w
MASK = 39
RESIDUAL = 73
PIVOT = 107
CHANGE = 124
GAUGE = 160
ROW_WEIGHT = 178
JACOBIAN = 195
POSITION_VIOLATION = 0  # numbers in w
VELOCITY_VIOLATION = 1
KINETIC = 2
POTENTIAL = 3
SMALLEST_PIVOT = 4
RANK = 5
LENGTH_SCALE = 6
POSITION_MEASURE = 8
VELOCITY_MEASURE = 9
SHORTEST_ROW = 10


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 466 operations."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.z [m]
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    q7 = y[7]  # rod.x [m]
    q8 = y[8]  # rod.y [m]
    q9 = y[9]  # rod.z [m]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    q14 = y[14]  # slider.x [m]
    q15 = y[15]  # slider.y [m]
    q16 = y[16]  # slider.z [m]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    mask_6 = w[MASK + 6]  # B.y
    mask_7 = w[MASK + 7]  # B.z
    mask_11 = w[MASK + 11]  # C.cross
    mask_16 = w[MASK + 16]  # guide.angle
    gauge_3 = w[GAUGE + 3]  # crank.wx
    gauge_4 = w[GAUGE + 4]  # crank.wy
    gauge_5 = w[GAUGE + 5]  # crank.wz
    gauge_9 = w[GAUGE + 9]  # rod.wx
    gauge_10 = w[GAUGE + 10]  # rod.wy
    gauge_11 = w[GAUGE + 11]  # rod.wz
    gauge_15 = w[GAUGE + 15]  # slider.wx
    gauge_16 = w[GAUGE + 16]  # slider.wy
    gauge_17 = w[GAUGE + 17]  # slider.wz
    status_6 = w[LENGTH_SCALE]  # length_scale
    row_weight_3 = w[ROW_WEIGHT + 3]  # A.first
    row_weight_4 = w[ROW_WEIGHT + 4]  # A.second
    row_weight_11 = w[ROW_WEIGHT + 11]  # C.cross
    row_weight_14 = w[ROW_WEIGHT + 14]  # guide.first
    row_weight_15 = w[ROW_WEIGHT + 15]  # guide.second
    row_weight_16 = w[ROW_WEIGHT + 16]  # guide.angle
    # intermediate terms
    s0 = q3*q3
    s1 = q4*q4
    s2 = q5*q5
    s3 = q6*q6
    s4 = s0 - s1
    s5 = s2 - s3
    s6 = 2.0*(q4*q5)
    s7 = 2.0*(q3*q6)
    s8 = 2.0*(q4*q6)
    s9 = 2.0*(q3*q5)
    s10 = 2.0*(q5*q6)
    s11 = 2.0*(q3*q4)
    s12 = s6 + s7
    s13 = s4 + s5
    s14 = s10 + s11
    s15 = s4 - s5
    s16 = 0.04*(s8 + s9)
    s17 = q0 - s16
    s18 = 0.04*(s10 - s11)
    s19 = 0.04*s15
    s20 = q1 - s18 - 0.1
    s21 = q2 - s19 - 0.12
    s22 = 0.04*(s6 - s7)
    s23 = 0.04*s13
    s24 = 0.04*s14
    s25 = -0.04*(s0 + s1 - (s2 + s3))
    s26 = 0.04*s12
    s27 = -s26
    s28 = 0.04*(s8 - s9)
    s29 = -s28
    s30 = s11 - s10
    s31 = s9 - s8
    s32 = q10*q10
    s33 = q11*q11
    s34 = q12*q12
    s35 = q13*q13
    s36 = s32 + s33
    s37 = s32 - s33
    s38 = s34 + s35
    s39 = s34 - s35
    s40 = 2.0*(q11*q12)
    s41 = 2.0*(q10*q13)
    s42 = 2.0*(q11*q13)
    s43 = 2.0*(q10*q12)
    s44 = 2.0*(q12*q13)
    s45 = 2.0*(q10*q11)
    s46 = s40 - s41
    s47 = s42 + s43
    s48 = s40 + s41
    s49 = s37 + s39
    s50 = s44 - s45
    s51 = s44 + s45
    s52 = s37 - s39
    s53 = 0.15*(s36 - s38)
    s54 = 0.15*s48
    s55 = 0.15*(s42 - s43)
    s56 = q7 - s53 - (q0 + s16)
    s57 = q8 - s54 - (q1 + s18)
    s58 = q9 - s55 - (q2 + s19)
    s59 = 0.15*s47
    s60 = 0.15*s50
    s61 = 0.15*s52
    s62 = 0.15*s46
    s63 = -s62
    s64 = 0.15*s49
    s65 = -s64
    s66 = 0.15*s51
    s67 = -s66
    s68 = q17*q17
    s69 = q18*q18
    s70 = q19*q19
    s71 = q20*q20
    s72 = s68 - s69
    s73 = s70 - s71
    s74 = 2.0*(q18*q19)
    s75 = 2.0*(q17*q20)
    s76 = 2.0*(q18*q20)
    s77 = 2.0*(q17*q19)
    s78 = 2.0*(q19*q20)
    s79 = 2.0*(q17*q18)
    s80 = s68 + s69 - (s70 + s71)
    s81 = s74 + s75
    s82 = s72 + s73
    s83 = s76 - s77
    s84 = s78 + s79
    s85 = s72 - s73
    s86 = q14 - (q7 + s53)
    s87 = q15 - (q8 + s54)
    s88 = q16 - (q9 + s55)
    s89 = s46*s80 + s49*s81 + s51*s83
    s90 = s47*s80 + s50*s81 + s52*s83
    s91 = s80*(s38 - s36) - s48*s81 + s83*(s43 - s42)
    s92 = s79 - s78
    s93 = s49*s92 - s46*(s76 + s77) + s51*(s73 - s72)
    s94 = s46*(s74 - s75) + s49*s82 + s51*s84
    s95 = s77 - s76
    s96 = 1.0 + 1.0 + s23*(s23*gauge_3) + s26*(s26*gauge_4) + s60*(s60*gauge_10) + s64*(s64*gauge_11)
    s97 = 1.0 + 1.0 + s24*(s24*gauge_3) + s28*(s28*gauge_4) + s61*(s61*gauge_10) + s66*(s66*gauge_11)
    s98 = s90*(s90*gauge_9) + s91*(s91*gauge_11) + s93*(s93*gauge_16) + s94*(s94*gauge_17)
    s99 = s85*(s85*gauge_15) + s95*(s95*gauge_17)
    s100 = s22 + s22
    s101 = s23 + s23
    s102 = s24 + s24
    s103 = s59*s59
    s104 = s59*s62
    s105 = s62*s62
    s106 = 2.0*s100
    s107 = s59 + 0.3*s47
    s108 = s59*s106 + s59*s100
    s109 = s62*s106 + s62*s100
    s110 = s85*(s85*(1.0/(1.0/gauge_15)))
    s111 = 1.0/(1.0/gauge_3 + s22*s22 + s23*s23 + s24*s24 + s100*s106)
    s112 = s108*s111
    s113 = s109*s111
    s114 = s101*s111
    s115 = s109*s112 - (s104 + s60*s64 + s61*s66 + s104 + s62*s107)
    s116 = s60 + s60 - s101*s112
    s117 = s61 + s61 - s102*s112
    s118 = 1.0/(s103 + 1.0/gauge_10 + s60*s60 + s61*s61 + s103 + s59*s107 - s108*s112)
    s119 = s115*s118
    s120 = s116*s118
    s121 = s105 + 1.0/gauge_11 + s64*s64 + s66*s66 + s105 + s62*(s62 + 0.3*s46) - s109*s113 - s115*s119
    s122 = s101*s113 - (s64 + s64) - s116*s119
    s123 = s102*s113 - (s66 + s66) - s117*s119
    s124 = 1.0/s121
    s125 = s122*s124
    s126 = s123*s124
    s127 = s101*s114 + s116*s120 + s122*s125
    s128 = s102*s114 + s117*s120 + s123*s125
    s129 = s91*s125
    s130 = 1.0*(s127 > mask_6 + 1e-12*s96)
    s131 = s130/max(s127, 1e-300)
    s132 = s128*s131
    s133 = s129*s132 - s91*s126
    s134 = s102*(s102*s111) + s117*(s117*s118) + s123*s126 - s128*s132
    s135 = 1.0*(s134 > mask_7 + 1e-12*s97)
    s136 = s129*(s129*s131) - (s90*(s90*(1.0/(1.0/gauge_9))) + s91*(s91*s124)) + s133*(s133*(s135/max(s134, 1e-300)))
    s137 = s31*status_6
    s138 = s12*status_6
    s139 = s89*status_6
    s140 = s95*status_6
    s141 = s81*status_6
    s142 = s84*status_6
    s143 = s17*s17 + s20*s20 + s21*s21
    s144 = s56*s56
    s145 = s57*s57
    s146 = s58*s58
    s147 = s86*s86
    s148 = s87*s87
    s149 = s88*s88
    s150 = q15*q15
    s151 = q16*q16
    s152 = s143 + s31*s31 + s12*s12 + s144 + s145 + s146 + s147 + s148 + s149 + s89*s89 + s150 + s151 + s95*s95
    s153 = s151 + s150 + s149 + s148 + s147 + s146 + s145 + s144 + s143 + s137*s137 + s138*s138 + s139*s139
    s154 = s127/s96
    s155 = s134/s97
    s156 = s136/s98
    s157 = 1.0 + 1.0 + 1.0 + 1.0 + 1.0*(-s136 > mask_11 + 1e-12*s98) + 1.0 + 1.0 + 1.0 + s135 + s130 + 6.0
    s158 = s110/s99
    s159 = min(min(1.0, (s15*(s15*gauge_4) + s14*(s14*gauge_5))*row_weight_3), (s30*(s30*gauge_4) + s13*(s13*gauge_5))*row_weight_4)
    s160 = min(min(min(s159, s98*row_weight_11), (s85*(s85*gauge_16) + s84*(s84*gauge_17))*row_weight_14), (s92*(s92*gauge_16) + s82*(s82*gauge_17))*row_weight_15)
    # outputs
    w[RESIDUAL] = s17  # A.x
    w[RESIDUAL + 1] = s20  # A.y
    w[RESIDUAL + 2] = s21  # A.z
    w[RESIDUAL + 3] = s31  # A.first
    w[RESIDUAL + 4] = s12  # A.second
    w[RESIDUAL + 5] = s56  # B.x
    w[RESIDUAL + 6] = s57  # B.y
    w[RESIDUAL + 7] = s58  # B.z
    w[RESIDUAL + 8] = s86  # C.x
    w[RESIDUAL + 9] = s87  # C.y
    w[RESIDUAL + 10] = s88  # C.z
    w[RESIDUAL + 11] = s89  # C.cross
    w[RESIDUAL + 12] = q15  # guide.across1
    w[RESIDUAL + 13] = q16  # guide.across2
    w[RESIDUAL + 14] = s95  # guide.first
    w[RESIDUAL + 15] = s81  # guide.second
    w[RESIDUAL + 16] = s84  # guide.angle
    w[POSITION_VIOLATION] = math.sqrt(s152 + s81*s81 + s84*s84)  # position_violation
    w[POSITION_MEASURE] = math.sqrt(s153 + s140*s140 + s141*s141 + s142*s142)  # position_measure
    w[JACOBIAN] = s22  # D A.x, crank.wx
    w[JACOBIAN + 1] = s25  # D A.x, crank.wy
    w[JACOBIAN + 2] = s23  # D A.y, crank.wx
    w[JACOBIAN + 3] = s27  # D A.y, crank.wy
    w[JACOBIAN + 4] = s24  # D A.z, crank.wx
    w[JACOBIAN + 5] = s29  # D A.z, crank.wy
    w[JACOBIAN + 6] = s15  # D A.first, crank.wy
    w[JACOBIAN + 7] = -s14  # D A.first, crank.wz
    w[JACOBIAN + 8] = s30  # D A.second, crank.wy
    w[JACOBIAN + 9] = s13  # D A.second, crank.wz
    w[JACOBIAN + 10] = s22  # D B.x, crank.wx
    w[JACOBIAN + 11] = s25  # D B.x, crank.wy
    w[JACOBIAN + 12] = s59  # D B.x, rod.wy
    w[JACOBIAN + 13] = s63  # D B.x, rod.wz
    w[JACOBIAN + 14] = s23  # D B.y, crank.wx
    w[JACOBIAN + 15] = s27  # D B.y, crank.wy
    w[JACOBIAN + 16] = s60  # D B.y, rod.wy
    w[JACOBIAN + 17] = s65  # D B.y, rod.wz
    w[JACOBIAN + 18] = s24  # D B.z, crank.wx
    w[JACOBIAN + 19] = s29  # D B.z, crank.wy
    w[JACOBIAN + 20] = s61  # D B.z, rod.wy
    w[JACOBIAN + 21] = s67  # D B.z, rod.wz
    w[JACOBIAN + 22] = s59  # D C.x, rod.wy
    w[JACOBIAN + 23] = s63  # D C.x, rod.wz
    w[JACOBIAN + 24] = s60  # D C.y, rod.wy
    w[JACOBIAN + 25] = s65  # D C.y, rod.wz
    w[JACOBIAN + 26] = s61  # D C.z, rod.wy
    w[JACOBIAN + 27] = s67  # D C.z, rod.wz
    w[JACOBIAN + 28] = s90  # D C.cross, rod.wx
    w[JACOBIAN + 29] = s91  # D C.cross, rod.wz
    w[JACOBIAN + 30] = s93  # D C.cross, slider.wy
    w[JACOBIAN + 31] = s94  # D C.cross, slider.wz
    w[JACOBIAN + 32] = s85  # D guide.first, slider.wy
    w[JACOBIAN + 33] = -s84  # D guide.first, slider.wz
    w[JACOBIAN + 34] = s92  # D guide.second, slider.wy
    w[JACOBIAN + 35] = s82  # D guide.second, slider.wz
    w[JACOBIAN + 36] = s85  # D guide.angle, slider.wx
    w[JACOBIAN + 37] = s95  # D guide.angle, slider.wz
    w[PIVOT + 6] = s154  # B.y
    w[PIVOT + 7] = s155  # B.z
    w[PIVOT + 11] = -s156  # C.cross
    w[PIVOT + 16] = s158  # guide.angle
    w[RANK] = 1.0*(s110 > mask_16 + 1e-12*s99) + s157  # rank
    w[SMALLEST_PIVOT] = min(min(min(min(1.0, mask_6 + s154), mask_7 + s155), mask_11 - s156), mask_16 + s158)  # smallest_pivot
    w[SHORTEST_ROW] = min(s160, s99*row_weight_16)  # shortest_row
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 340 operations."""
    # inputs
    q2 = y[2]  # crank.z [m]
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    v0 = y[21]  # crank.vx [m/s]
    v1 = y[22]  # crank.vy [m/s]
    v2 = y[23]  # crank.vz [m/s]
    v3 = y[24]  # crank.wx [rad/s]
    v4 = y[25]  # crank.wy [rad/s]
    v5 = y[26]  # crank.wz [rad/s]
    q9 = y[9]  # rod.z [m]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    v6 = y[27]  # rod.vx [m/s]
    v7 = y[28]  # rod.vy [m/s]
    v8 = y[29]  # rod.vz [m/s]
    v9 = y[30]  # rod.wx [rad/s]
    v10 = y[31]  # rod.wy [rad/s]
    v11 = y[32]  # rod.wz [rad/s]
    q16 = y[16]  # slider.z [m]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    v12 = y[33]  # slider.vx [m/s]
    v13 = y[34]  # slider.vy [m/s]
    v14 = y[35]  # slider.vz [m/s]
    v15 = y[36]  # slider.wx [rad/s]
    v16 = y[37]  # slider.wy [rad/s]
    v17 = y[38]  # slider.wz [rad/s]
    winding_0 = w[WINDING]
    winding_1 = w[WINDING + 1]
    winding_2 = w[WINDING + 2]
    status_6 = w[LENGTH_SCALE]  # length_scale
    jacobian_0 = w[JACOBIAN]  # D A.x, crank.wx
    jacobian_1 = w[JACOBIAN + 1]  # D A.x, crank.wy
    jacobian_2 = w[JACOBIAN + 2]  # D A.y, crank.wx
    jacobian_3 = w[JACOBIAN + 3]  # D A.y, crank.wy
    jacobian_4 = w[JACOBIAN + 4]  # D A.z, crank.wx
    jacobian_5 = w[JACOBIAN + 5]  # D A.z, crank.wy
    jacobian_6 = w[JACOBIAN + 6]  # D A.first, crank.wy
    jacobian_7 = w[JACOBIAN + 7]  # D A.first, crank.wz
    jacobian_8 = w[JACOBIAN + 8]  # D A.second, crank.wy
    jacobian_9 = w[JACOBIAN + 9]  # D A.second, crank.wz
    jacobian_10 = w[JACOBIAN + 10]  # D B.x, crank.wx
    jacobian_11 = w[JACOBIAN + 11]  # D B.x, crank.wy
    jacobian_12 = w[JACOBIAN + 12]  # D B.x, rod.wy
    jacobian_13 = w[JACOBIAN + 13]  # D B.x, rod.wz
    jacobian_14 = w[JACOBIAN + 14]  # D B.y, crank.wx
    jacobian_15 = w[JACOBIAN + 15]  # D B.y, crank.wy
    jacobian_16 = w[JACOBIAN + 16]  # D B.y, rod.wy
    jacobian_17 = w[JACOBIAN + 17]  # D B.y, rod.wz
    jacobian_18 = w[JACOBIAN + 18]  # D B.z, crank.wx
    jacobian_19 = w[JACOBIAN + 19]  # D B.z, crank.wy
    jacobian_20 = w[JACOBIAN + 20]  # D B.z, rod.wy
    jacobian_21 = w[JACOBIAN + 21]  # D B.z, rod.wz
    jacobian_22 = w[JACOBIAN + 22]  # D C.x, rod.wy
    jacobian_23 = w[JACOBIAN + 23]  # D C.x, rod.wz
    jacobian_24 = w[JACOBIAN + 24]  # D C.y, rod.wy
    jacobian_25 = w[JACOBIAN + 25]  # D C.y, rod.wz
    jacobian_26 = w[JACOBIAN + 26]  # D C.z, rod.wy
    jacobian_27 = w[JACOBIAN + 27]  # D C.z, rod.wz
    jacobian_28 = w[JACOBIAN + 28]  # D C.cross, rod.wx
    jacobian_29 = w[JACOBIAN + 29]  # D C.cross, rod.wz
    jacobian_30 = w[JACOBIAN + 30]  # D C.cross, slider.wy
    jacobian_31 = w[JACOBIAN + 31]  # D C.cross, slider.wz
    jacobian_32 = w[JACOBIAN + 32]  # D guide.first, slider.wy
    jacobian_33 = w[JACOBIAN + 33]  # D guide.first, slider.wz
    jacobian_34 = w[JACOBIAN + 34]  # D guide.second, slider.wy
    jacobian_35 = w[JACOBIAN + 35]  # D guide.second, slider.wz
    jacobian_36 = w[JACOBIAN + 36]  # D guide.angle, slider.wx
    jacobian_37 = w[JACOBIAN + 37]  # D guide.angle, slider.wz
    # intermediate terms
    s0 = q10*q10
    s1 = q11*q11
    s2 = q12*q12
    s3 = q13*q13
    s4 = s0 - s1
    s5 = s2 - s3
    s6 = 2.0*(q11*q12)
    s7 = 2.0*(q10*q13)
    s8 = 2.0*(q11*q13)
    s9 = 2.0*(q10*q12)
    s10 = 2.0*(q12*q13)
    s11 = 2.0*(q10*q11)
    s12 = s0 + s1 - (s2 + s3)
    s13 = s6 - s7
    s14 = s8 + s9
    s15 = s6 + s7
    s16 = s4 + s5
    s17 = s10 - s11
    s18 = s8 - s9
    s19 = s10 + s11
    s20 = s4 - s5
    s21 = q17*q17
    s22 = q18*q18
    s23 = q19*q19
    s24 = q20*q20
    s25 = s21 - s22
    s26 = s23 - s24
    s27 = 2.0*(q18*q19)
    s28 = 2.0*(q17*q20)
    s29 = 2.0*(q18*q20)
    s30 = 2.0*(q17*q19)
    s31 = 2.0*(q19*q20)
    s32 = 2.0*(q17*q18)
    s33 = s21 + s22 - (s23 + s24)
    s34 = s27 - s28
    s35 = s29 + s30
    s36 = s27 + s28
    s37 = s25 + s26
    s38 = s31 - s32
    s39 = s29 - s30
    s40 = s31 + s32
    s41 = s25 - s26
    s42 = 0.5*(v3*(0.0001*v3) + v4*(0.0001*v4) + v5*(1e-05*v5)) + 0.06*(v0*v0) + 0.06*(v1*v1) + 0.06*(v2*v2)
    s43 = s42 + 0.5*(v9*(0.0004*v9) + v10*(0.004*v10) + v11*(0.004*v11)) + 0.25*(v6*v6) + 0.25*(v7*v7)
    s44 = s43 + 0.25*(v8*v8) + 0.5*(v15*(0.0001*v15) + v16*(0.0001*v16) + v17*(0.0001*v17)) + v12*v12
    s45 = v13*v13
    s46 = v14*v14
    s47 = math.atan2(2.0*(q5*q6) + 2.0*(q3*q4), q3*q3 - q4*q4 + q5*q5 - q6*q6)
    s48 = s33*(0.7453559924999299*s12 - 0.6666666666666666*s14) + s36*(0.7453559924999299*s15 - 0.6666666666666666*s17)
    s49 = s33*(0.6666666666666666*s12 + 0.7453559924999299*s14) + s36*(0.6666666666666666*s15 + 0.7453559924999299*s17)
    s50 = math.atan2(s48 + s39*(0.7453559924999299*s18 - 0.6666666666666666*s20), s49 + s39*(0.6666666666666666*s18 + 0.7453559924999299*s20))
    s51 = s13*(0.4472135954999579*s34 + 0.894427190999916*s35) + s16*(0.4472135954999579*s37 + 0.894427190999916*s38)
    s52 = s13*(0.894427190999916*s34 - 0.4472135954999579*s35) + s16*(0.894427190999916*s37 - 0.4472135954999579*s38)
    s53 = math.atan2(s51 + s19*(0.4472135954999579*s40 + 0.894427190999916*s41), s52 + s19*(0.894427190999916*s40 - 0.4472135954999579*s41))
    s54 = v0 + v3*jacobian_0 + v4*jacobian_1
    s55 = v1 + v3*jacobian_2 + v4*jacobian_3
    s56 = v2 + v3*jacobian_4 + v4*jacobian_5
    s57 = v4*jacobian_6 + v5*jacobian_7
    s58 = v4*jacobian_8 + v5*jacobian_9
    s59 = v6 + v3*jacobian_10 - v0 + v4*jacobian_11 + v10*jacobian_12 + v11*jacobian_13
    s60 = v7 + v3*jacobian_14 - v1 + v4*jacobian_15 + v10*jacobian_16 + v11*jacobian_17
    s61 = v8 + v3*jacobian_18 - v2 + v4*jacobian_19 + v10*jacobian_20 + v11*jacobian_21
    s62 = v12 + v10*jacobian_22 - v6 + v11*jacobian_23
    s63 = v13 + v10*jacobian_24 - v7 + v11*jacobian_25
    s64 = v14 + v10*jacobian_26 - v8 + v11*jacobian_27
    s65 = v9*jacobian_28 + v11*jacobian_29 + v16*jacobian_30 + v17*jacobian_31
    s66 = v16*jacobian_32 + v17*jacobian_33
    s67 = v16*jacobian_34 + v17*jacobian_35
    s68 = v15*jacobian_36 + v17*jacobian_37
    s69 = status_6*s57
    s70 = status_6*s58
    s71 = status_6*s65
    s72 = status_6*s66
    s73 = status_6*s67
    s74 = status_6*s68
    s75 = s54*s54 + s55*s55 + s56*s56
    s76 = s59*s59
    s77 = s60*s60
    s78 = s61*s61
    s79 = s62*s62
    s80 = s63*s63
    s81 = s64*s64
    s82 = s46 + s45 + s75 + s57*s57 + s58*s58 + s76 + s77 + s78 + s79 + s80 + s81 + s65*s65 + s66*s66
    s83 = s46 + s45 + s81 + s80 + s79 + s78 + s77 + s76 + s75 + s69*s69 + s70*s70 + s71*s71 + s72*s72
    # outputs
    w[RESIDUAL] = s54  # A.x
    w[RESIDUAL + 1] = s55  # A.y
    w[RESIDUAL + 2] = s56  # A.z
    w[RESIDUAL + 3] = s57  # A.first
    w[RESIDUAL + 4] = s58  # A.second
    w[RESIDUAL + 5] = s59  # B.x
    w[RESIDUAL + 6] = s60  # B.y
    w[RESIDUAL + 7] = s61  # B.z
    w[RESIDUAL + 8] = s62  # C.x
    w[RESIDUAL + 9] = s63  # C.y
    w[RESIDUAL + 10] = s64  # C.z
    w[RESIDUAL + 11] = s65  # C.cross
    w[RESIDUAL + 12] = v13  # guide.across1
    w[RESIDUAL + 13] = v14  # guide.across2
    w[RESIDUAL + 14] = s66  # guide.first
    w[RESIDUAL + 15] = s67  # guide.second
    w[RESIDUAL + 16] = s68  # guide.angle
    w[VELOCITY_VIOLATION] = math.sqrt(s82 + s67*s67 + s68*s68)  # velocity_violation
    w[VELOCITY_MEASURE] = math.sqrt(s83 + s73*s73 + s74*s74)  # velocity_measure
    w[KINETIC] = s44 + s45 + s46  # kinetic
    w[POTENTIAL] = 1.1772*q2 + 4.905*q9 + 19.62*q16  # potential
    w[WINDING] = s47 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s47))
    w[WINDING + 1] = s50 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_1 - s50))
    w[WINDING + 2] = s53 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_2 - s53))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def move(y, w):
    """q + N times `change`, Euler parameters of length 1: 129 operations."""
    # inputs
    q0 = y[0]  # crank.x [m]
    q1 = y[1]  # crank.y [m]
    q2 = y[2]  # crank.z [m]
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    q7 = y[7]  # rod.x [m]
    q8 = y[8]  # rod.y [m]
    q9 = y[9]  # rod.z [m]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    q14 = y[14]  # slider.x [m]
    q15 = y[15]  # slider.y [m]
    q16 = y[16]  # slider.z [m]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    change_0 = w[CHANGE]  # crank.vx
    change_1 = w[CHANGE + 1]  # crank.vy
    change_2 = w[CHANGE + 2]  # crank.vz
    change_3 = w[CHANGE + 3]  # crank.wx
    change_4 = w[CHANGE + 4]  # crank.wy
    change_5 = w[CHANGE + 5]  # crank.wz
    change_6 = w[CHANGE + 6]  # rod.vx
    change_7 = w[CHANGE + 7]  # rod.vy
    change_8 = w[CHANGE + 8]  # rod.vz
    change_9 = w[CHANGE + 9]  # rod.wx
    change_10 = w[CHANGE + 10]  # rod.wy
    change_11 = w[CHANGE + 11]  # rod.wz
    change_12 = w[CHANGE + 12]  # slider.vx
    change_13 = w[CHANGE + 13]  # slider.vy
    change_14 = w[CHANGE + 14]  # slider.vz
    change_15 = w[CHANGE + 15]  # slider.wx
    change_16 = w[CHANGE + 16]  # slider.wy
    change_17 = w[CHANGE + 17]  # slider.wz
    # intermediate terms
    s0 = 0.5*change_3
    s1 = 0.5*change_4
    s2 = 0.5*change_5
    s3 = q3 - (q4*s0 + q5*s1 + q6*s2)
    s4 = q4 + q3*s0 + q5*s2 - q6*s1
    s5 = q5 + q3*s1 + q6*s0 - q4*s2
    s6 = q6 + q3*s2 + q4*s1 - q5*s0
    s7 = 1.0/math.sqrt(s3*s3 + s4*s4 + s5*s5 + s6*s6)
    s8 = 0.5*change_9
    s9 = 0.5*change_10
    s10 = 0.5*change_11
    s11 = q10 - (q11*s8 + q12*s9 + q13*s10)
    s12 = q11 + q10*s8 + q12*s10 - q13*s9
    s13 = q12 + q10*s9 + q13*s8 - q11*s10
    s14 = q13 + q10*s10 + q11*s9 - q12*s8
    s15 = 1.0/math.sqrt(s11*s11 + s12*s12 + s13*s13 + s14*s14)
    s16 = 0.5*change_15
    s17 = 0.5*change_16
    s18 = 0.5*change_17
    s19 = q17 - (q18*s16 + q19*s17 + q20*s18)
    s20 = q18 + q17*s16 + q19*s18 - q20*s17
    s21 = q19 + q17*s17 + q20*s16 - q18*s18
    s22 = q20 + q17*s18 + q18*s17 - q19*s16
    s23 = 1.0/math.sqrt(s19*s19 + s20*s20 + s21*s21 + s22*s22)
    # outputs
    y[0] = q0 + change_0
    y[1] = q1 + change_1
    y[2] = q2 + change_2
    y[3] = s3*s7
    y[4] = s4*s7
    y[5] = s5*s7
    y[6] = s6*s7
    y[7] = q7 + change_6
    y[8] = q8 + change_7
    y[9] = q9 + change_8
    y[10] = s11*s15
    y[11] = s12*s15
    y[12] = s13*s15
    y[13] = s14*s15
    y[14] = q14 + change_12
    y[15] = q15 + change_13
    y[16] = q16 + change_14
    y[17] = s19*s23
    y[18] = s20*s23
    y[19] = s21*s23
    y[20] = s22*s23
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def normalise(y):
    """Euler parameters of length 1; 1 where they were not: 48 operations."""
    # inputs
    q3 = y[3]  # crank.e0 [1]
    q4 = y[4]  # crank.e1 [1]
    q5 = y[5]  # crank.e2 [1]
    q6 = y[6]  # crank.e3 [1]
    q10 = y[10]  # rod.e0 [1]
    q11 = y[11]  # rod.e1 [1]
    q12 = y[12]  # rod.e2 [1]
    q13 = y[13]  # rod.e3 [1]
    q17 = y[17]  # slider.e0 [1]
    q18 = y[18]  # slider.e1 [1]
    q19 = y[19]  # slider.e2 [1]
    q20 = y[20]  # slider.e3 [1]
    # intermediate terms
    s0 = q6*q6 + q5*q5 + q3*q3 + q4*q4
    s1 = 1.0/math.sqrt(s0)
    s2 = q13*q13 + q12*q12 + q10*q10 + q11*q11
    s3 = 1.0/math.sqrt(s2)
    s4 = q20*q20 + q19*q19 + q17*q17 + q18*q18
    s5 = 1.0/math.sqrt(s4)
    # outputs
    y[3] = q3*s1
    y[4] = q4*s1
    y[5] = q5*s1
    y[6] = q6*s1
    y[10] = q10*s3
    y[11] = q11*s3
    y[12] = q12*s3
    y[13] = q13*s3
    y[17] = q17*s5
    y[18] = q18*s5
    y[19] = q19*s5
    y[20] = q20*s5
    return int((1e-13 < max(max(abs(s0 - 1.0), abs(s2 - 1.0)), abs(s4 - 1.0))))
