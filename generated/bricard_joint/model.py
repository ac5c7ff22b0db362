"""Model `bricard`: what every method of it shares. Emitted by symgen; do not edit.

digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates a1bfe8da2fcb1eac
5 coordinates, 5 velocities, 5 constraint rows, 0 parameters,
0 fill-ins in the factor of D D^T

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and integers iw.

y[0]     P0.angle [rad]
y[1]     P5.angle [rad]
y[2]     P1.angle [rad]
y[3]     P4.angle [rad]
y[4]     P2.angle [rad]
y[5]     P0.angle.rate [rad/s]
y[6]     P5.angle.rate [rad/s]
y[7]     P1.angle.rate [rad/s]
y[8]     P4.angle.rate [rad/s]
y[9]     P2.angle.rate [rad/s]
y[10]    work of forces without potential and of drivers [J]
row 0    P3.x [m]
row 1    P3.y [m]
row 2    P3.z [m]
row 3    P3.first [rad]
row 4    P3.second [rad]

w[0:19]     status: single numbers, named in this module where it uses them
w[19:20]    winding: turns of angles that are counted
w[20:25]    multipliers: Lagrange multipliers, one a row
w[25:30]    mask: inf at rows that depend on others, else 0
w[30:35]    saved: `mask` while `confirm` leaves out further rows
w[35:40]    residual: Phi after `geometry`, D v - nu after `measure`
w[40:45]    nu: right-hand side of D v = nu
w[45:50]    pivot: pivots of D G D^T over its diagonal: near 0 a row depends on others
w[50:55]    change: correction of velocities, or of positions, that `spread` leaves
w[55:60]    mass: diagonal of M
w[60:65]    gauge: diagonal of G, the metric in which rank is decided: 1, or 1/l^2 for a rotation of a body of length l
w[65:70]    row_weight: factors that make rows of different units comparable
w[70:93]    jacobian: entries of D that are not constant
w[93:103]   lower: L of the factorisation of D G D^T, below the diagonal
w[103:108]  reciprocal: reciprocals of the pivots of D G D^T, 0 for rows left out
w[108:113]  mass_entry: entries of M that depend on positions

Left out:
- columns of the ground: the ground does not move
- centre-of-mass offset of rod1: its centre of mass is the frame's origin
- centre-of-mass offset of rod2: its centre of mass is the frame's origin
- centre-of-mass offset of rod3: its centre of mass is the frame's origin
- centre-of-mass offset of rod4: its centre of mass is the frame's origin
- centre-of-mass offset of rod5: its centre of mass is the frame's origin
"""

import math

from numba import njit

WINDING = 19  # sections of w
MASK = 25
RESIDUAL = 35
PIVOT = 45
CHANGE = 50
MASS = 55
GAUGE = 60
JACOBIAN = 70
LOWER = 93
RECIPROCAL = 103
MASS_ENTRY = 108
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
    """Numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """Phi, nu, D, and the factorisation of D G D^T that decides rank: 444 operations, 837786 before sharing."""
    # inputs
    q0 = y[0]  # P0.angle [rad]
    q1 = y[1]  # P5.angle [rad]
    q2 = y[2]  # P1.angle [rad]
    q3 = y[3]  # P4.angle [rad]
    q4 = y[4]  # P2.angle [rad]
    mask_0 = w[MASK]  # P3.x
    mask_1 = w[MASK + 1]  # P3.y
    mask_2 = w[MASK + 2]  # P3.z
    mask_3 = w[MASK + 3]  # P3.first
    mask_4 = w[MASK + 4]  # P3.second
    gauge_0 = w[GAUGE]  # P0.angle.rate
    gauge_1 = w[GAUGE + 1]  # P5.angle.rate
    gauge_2 = w[GAUGE + 2]  # P1.angle.rate
    gauge_3 = w[GAUGE + 3]  # P4.angle.rate
    gauge_4 = w[GAUGE + 4]  # P2.angle.rate
    status_6 = w[LENGTH_SCALE]  # length_scale
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = math.cos(q1)
    s3 = math.sin(q1)
    s4 = math.cos(q2)
    s5 = math.sin(q2)
    s6 = s0*s4
    s7 = s1*s4
    s8 = s0*s5
    s9 = s1*s5
    s10 = math.cos(q3)
    s11 = math.sin(q3)
    s12 = s2*s11
    s13 = s3*s11
    s14 = s2*s10
    s15 = s3*s10
    s16 = math.cos(q4)
    s17 = math.sin(q4)
    s18 = s8*s16
    s19 = s1*s17
    s20 = s19 - s18
    s21 = s4*s16
    s22 = s9*s16 + s0*s17
    s23 = s8*s17 + s1*s16
    s24 = s4*s17
    s25 = s9*s17
    s26 = s0*s16
    s27 = s26 - s25
    s28 = -1.0 - s5
    s29 = s17*s28
    s30 = s16*s28
    s31 = s2 + s12
    s32 = s10 - (s23 + s0 + s8)
    s33 = s4 + s24 - s31
    s34 = s13 + 1.0 + s3 - (s27 - (s1 + s9))
    s35 = s5*s20 - (s20*s29 + s23*s30) - s6*s21
    s36 = s6 + s6*s17
    s37 = s5*s21
    s38 = s24*s30 - s21*s29 + s37 - s37
    s39 = s5 + s5*s17
    s40 = s3 + s13
    s41 = s5*s22 - (s22*s29 + s27*s30) + s7*s21
    s42 = s7 + s7*s17
    s43 = s6*s11 + s5*s14 + s7*s15
    s44 = s11*s23
    s45 = s14*s24
    s46 = s14*s21
    s47 = s15*s22
    s48 = s5*s12 - s6*s10 + s7*s13
    s49 = s15*(s25 - s26) - (s45 - s44)
    s50 = s47 - (s11*s20 + s46)
    s51 = s2*s7 - s3*s5
    s52 = s21*s49 - s24*s50
    s53 = s17*s49 + s16*s50
    s54 = s10*s51
    s55 = s49*s49 + s50*s50 + s51*s51 + s48*s48
    s56 = s44 - s45 - s15*s27
    s57 = s47 + s11*(s18 - s19) - s46
    s58 = s2*s27 - s3*s24
    s59 = s10*s23 + s12*s24 + s13*s27
    s60 = s5*s57 + s21*s43
    s61 = s17*s43
    s62 = s10*s58
    s63 = s43*s43
    s64 = s57*s57 + s63 + s58*s58 + s59*s59
    s65 = 0.5*s17
    s66 = 0.5*s16
    s67 = s65 + s65
    s68 = 0.3325*s17
    s69 = s17*s68
    s70 = 0.0016666666666666392 + 0.33333333333333337 - s69
    s71 = 0.5*s11
    s72 = s5*(-1.5 - s65)
    s73 = s35*gauge_0
    s74 = s36*gauge_2
    s75 = s11*gauge_3
    s76 = s20*gauge_4
    s77 = s38*gauge_0
    s78 = s40*gauge_1
    s79 = s39*gauge_2
    s80 = s14*gauge_3
    s81 = s21*gauge_4
    s82 = s41*gauge_0
    s83 = s31*gauge_1
    s84 = s42*gauge_2
    s85 = s15*gauge_3
    s86 = s22*gauge_4
    s87 = s52*gauge_0
    s88 = s54*gauge_1
    s89 = s53*gauge_2
    s90 = s48*gauge_3
    s91 = s35*s73 + s36*s74 + s11*s75 + s20*s76
    s92 = s38*s73 + s39*s74 + s14*s75 + s21*s76
    s93 = s41*s73 - s42*s74 - s15*s75 + s22*s76
    s94 = s52*s73 - s53*s74 - s48*s75
    s95 = s60*s73 - s61*s74 - s59*s75 + s57*s76
    s96 = s38*s77 + s40*s78 + s39*s79 + s14*s80 + s21*s81
    s97 = s41*s82 + s31*s83 + s42*s84 + s15*s85 + s22*s86
    s98 = s52*s87 + s54*s88 + s53*s89 + s48*s90
    s99 = s60*(s60*gauge_0) + s62*(s62*gauge_1) + s61*(s61*gauge_2) + s59*(s59*gauge_3) + s57*(s57*gauge_4)
    s100 = max(s91, 2.0)
    s101 = 1.0*(s91 > mask_0 + 1e-12*s100)
    s102 = s101/max(s91, 1e-300)
    s103 = s92*s102
    s104 = s93*s102
    s105 = s94*s102
    s106 = s95*s102
    s107 = s96 - s92*s103
    s108 = s41*s77 + s31*s78 - s42*s79 - s15*s80 + s22*s81 - s93*s103
    s109 = s52*s77 - s54*s78 - s53*s79 - s48*s80 - s94*s103
    s110 = s60*s77 - s62*s78 - s61*s79 - s59*s80 + s57*s81 - s95*s103
    s111 = max(s96, 2.0)
    s112 = 1.0*(s107 > mask_1 + 1e-12*s111)
    s113 = s112/max(s107, 1e-300)
    s114 = s108*s113
    s115 = s109*s113
    s116 = s110*s113
    s117 = s97 - s93*s104 - s108*s114
    s118 = s52*s82 - s54*s83 + s53*s84 + s48*s85 - s94*s104 - s109*s114
    s119 = s60*s82 - s62*s83 + s61*s84 + s59*s85 + s57*s86 - s95*s104 - s110*s114
    s120 = max(s97, 2.0)
    s121 = 1.0*(s117 > mask_2 + 1e-12*s120)
    s122 = s121/max(s117, 1e-300)
    s123 = s118*s122
    s124 = s119*s122
    s125 = s98 - s94*s105 - s109*s115 - s118*s123
    s126 = s60*s87 + s62*s88 + s61*s89 + s59*s90 - s95*s105 - s110*s115 - s119*s123
    s127 = gauge_3 + gauge_2 + gauge_0 + gauge_1
    s128 = max(s98, s55*(0.25*s127))
    s129 = 1.0*(s125 > mask_3 + 1e-12*s128)
    s130 = s129/max(s125, 1e-300)
    s131 = s126*s130
    s132 = s99 - s95*s106 - s110*s116 - s119*s124 - s126*s131
    s133 = max(s99, s64*(0.2*(gauge_4 + s127)))
    s134 = 1.0*(s132 > mask_4 + 1e-12*s133)
    s135 = s43*status_6
    s136 = s56*status_6
    s137 = s32*s32 + s33*s33 + s34*s34
    s138 = s91/s100
    s139 = s107/s111
    s140 = s117/s120
    s141 = s125/s128
    s142 = s132/s133
    s143 = min(min(min(min(min(1.0, mask_0 + s138), mask_1 + s139), mask_2 + s140), mask_3 + s141), mask_4 + s142)
    # outputs
    w[RESIDUAL] = s32  # P3.x
    w[RESIDUAL + 1] = s33  # P3.y
    w[RESIDUAL + 2] = s34  # P3.z
    w[RESIDUAL + 3] = -s43  # P3.first
    w[RESIDUAL + 4] = s56  # P3.second
    w[POSITION_VIOLATION] = math.sqrt(s63 + s137 + s56*s56)  # position_violation
    w[POSITION_MEASURE] = math.sqrt(s137 + s135*s135 + s136*s136)  # position_measure
    w[JACOBIAN] = s35  # D P3.x, P0.angle.rate
    w[JACOBIAN + 1] = -s36  # D P3.x, P1.angle.rate
    w[JACOBIAN + 2] = -s11  # D P3.x, P4.angle.rate
    w[JACOBIAN + 3] = s20  # D P3.x, P2.angle.rate
    w[JACOBIAN + 4] = s38  # D P3.y, P0.angle.rate
    w[JACOBIAN + 5] = s40  # D P3.y, P5.angle.rate
    w[JACOBIAN + 6] = -s39  # D P3.y, P1.angle.rate
    w[JACOBIAN + 7] = -s14  # D P3.y, P4.angle.rate
    w[JACOBIAN + 8] = s21  # D P3.y, P2.angle.rate
    w[JACOBIAN + 9] = s41  # D P3.z, P0.angle.rate
    w[JACOBIAN + 10] = s31  # D P3.z, P5.angle.rate
    w[JACOBIAN + 11] = s42  # D P3.z, P1.angle.rate
    w[JACOBIAN + 12] = s15  # D P3.z, P4.angle.rate
    w[JACOBIAN + 13] = s22  # D P3.z, P2.angle.rate
    w[JACOBIAN + 14] = s52  # D P3.first, P0.angle.rate
    w[JACOBIAN + 15] = -s54  # D P3.first, P5.angle.rate
    w[JACOBIAN + 16] = s53  # D P3.first, P1.angle.rate
    w[JACOBIAN + 17] = s48  # D P3.first, P4.angle.rate
    w[JACOBIAN + 18] = s60  # D P3.second, P0.angle.rate
    w[JACOBIAN + 19] = -s62  # D P3.second, P5.angle.rate
    w[JACOBIAN + 20] = s61  # D P3.second, P1.angle.rate
    w[JACOBIAN + 21] = s59  # D P3.second, P4.angle.rate
    w[JACOBIAN + 22] = s57  # D P3.second, P2.angle.rate
    w[PIVOT] = s138  # P3.x
    w[PIVOT + 1] = s139  # P3.y
    w[PIVOT + 2] = s140  # P3.z
    w[PIVOT + 3] = s141  # P3.first
    w[PIVOT + 4] = s142  # P3.second
    w[RANK] = s134 + s129 + s121 + s101 + s112  # rank
    w[SMALLEST_PIVOT] = s143  # smallest_pivot
    w[SHORTEST_ROW] = min(min(1.0, s55), s64)  # shortest_row
    w[LOWER] = s103
    w[LOWER + 1] = s104
    w[LOWER + 2] = s105
    w[LOWER + 3] = s106
    w[LOWER + 4] = s114
    w[LOWER + 5] = s115
    w[LOWER + 6] = s116
    w[LOWER + 7] = s123
    w[LOWER + 8] = s124
    w[LOWER + 9] = s131
    w[RECIPROCAL] = s102
    w[RECIPROCAL + 1] = s113
    w[RECIPROCAL + 2] = s122
    w[RECIPROCAL + 3] = s130
    w[RECIPROCAL + 4] = s134/max(s132, 1e-300)
    w[MASS_ENTRY] = 2.335 + s70 + s5*(s5*(1.3333333333333335 + 0.33416666666666667 + s67 - s70)) - (s72 + s72)
    w[MASS_ENTRY + 1] = s4*(s16*s68 + 0.5*(s66 + s66))
    w[MASS_ENTRY + 2] = s65 + s5*(0.33416666666666667 + s65)
    w[MASS_ENTRY + 3] = 1.335 + s67 + 0.000833333333333342 + s69
    w[MASS_ENTRY + 4] = 1.335 + s71 + s71 + 0.000833333333333342 + s11*(0.3325*s11)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 91 operations, 3157 before sharing."""
    # inputs
    gauge_0 = w[GAUGE]  # P0.angle.rate
    gauge_1 = w[GAUGE + 1]  # P5.angle.rate
    gauge_2 = w[GAUGE + 2]  # P1.angle.rate
    gauge_3 = w[GAUGE + 3]  # P4.angle.rate
    gauge_4 = w[GAUGE + 4]  # P2.angle.rate
    lower_0 = w[LOWER]
    lower_1 = w[LOWER + 1]
    lower_2 = w[LOWER + 2]
    lower_3 = w[LOWER + 3]
    lower_4 = w[LOWER + 4]
    lower_5 = w[LOWER + 5]
    lower_6 = w[LOWER + 6]
    lower_7 = w[LOWER + 7]
    lower_8 = w[LOWER + 8]
    lower_9 = w[LOWER + 9]
    reciprocal_0 = w[RECIPROCAL]
    reciprocal_1 = w[RECIPROCAL + 1]
    reciprocal_2 = w[RECIPROCAL + 2]
    reciprocal_3 = w[RECIPROCAL + 3]
    reciprocal_4 = w[RECIPROCAL + 4]
    residual_0 = w[RESIDUAL]  # P3.x
    residual_1 = w[RESIDUAL + 1]  # P3.y
    residual_2 = w[RESIDUAL + 2]  # P3.z
    residual_3 = w[RESIDUAL + 3]  # P3.first
    residual_4 = w[RESIDUAL + 4]  # P3.second
    jacobian_0 = w[JACOBIAN]  # D P3.x, P0.angle.rate
    jacobian_1 = w[JACOBIAN + 1]  # D P3.x, P1.angle.rate
    jacobian_2 = w[JACOBIAN + 2]  # D P3.x, P4.angle.rate
    jacobian_3 = w[JACOBIAN + 3]  # D P3.x, P2.angle.rate
    jacobian_4 = w[JACOBIAN + 4]  # D P3.y, P0.angle.rate
    jacobian_5 = w[JACOBIAN + 5]  # D P3.y, P5.angle.rate
    jacobian_6 = w[JACOBIAN + 6]  # D P3.y, P1.angle.rate
    jacobian_7 = w[JACOBIAN + 7]  # D P3.y, P4.angle.rate
    jacobian_8 = w[JACOBIAN + 8]  # D P3.y, P2.angle.rate
    jacobian_9 = w[JACOBIAN + 9]  # D P3.z, P0.angle.rate
    jacobian_10 = w[JACOBIAN + 10]  # D P3.z, P5.angle.rate
    jacobian_11 = w[JACOBIAN + 11]  # D P3.z, P1.angle.rate
    jacobian_12 = w[JACOBIAN + 12]  # D P3.z, P4.angle.rate
    jacobian_13 = w[JACOBIAN + 13]  # D P3.z, P2.angle.rate
    jacobian_14 = w[JACOBIAN + 14]  # D P3.first, P0.angle.rate
    jacobian_15 = w[JACOBIAN + 15]  # D P3.first, P5.angle.rate
    jacobian_16 = w[JACOBIAN + 16]  # D P3.first, P1.angle.rate
    jacobian_17 = w[JACOBIAN + 17]  # D P3.first, P4.angle.rate
    jacobian_18 = w[JACOBIAN + 18]  # D P3.second, P0.angle.rate
    jacobian_19 = w[JACOBIAN + 19]  # D P3.second, P5.angle.rate
    jacobian_20 = w[JACOBIAN + 20]  # D P3.second, P1.angle.rate
    jacobian_21 = w[JACOBIAN + 21]  # D P3.second, P4.angle.rate
    jacobian_22 = w[JACOBIAN + 22]  # D P3.second, P2.angle.rate
    # intermediate terms
    s0 = lower_0*residual_0 - residual_1
    s1 = lower_1*residual_0 - residual_2 - lower_4*s0
    s2 = lower_2*residual_0 - residual_3 - lower_5*s0 - lower_7*s1
    s3 = reciprocal_4*(lower_3*residual_0 - residual_4 - lower_6*s0 - lower_8*s1 - lower_9*s2)
    s4 = reciprocal_3*s2 - lower_9*s3
    s5 = reciprocal_2*s1 - lower_7*s4 - lower_8*s3
    s6 = reciprocal_1*s0 - lower_4*s5 - lower_5*s4 - lower_6*s3
    s7 = reciprocal_0*residual_0 + lower_0*s6 + lower_1*s5 + lower_2*s4 + lower_3*s3
    # outputs
    w[CHANGE] = gauge_0*(s6*jacobian_4 - s7*jacobian_0 + s5*jacobian_9 + s4*jacobian_14 + s3*jacobian_18)  # P0.angle.rate
    w[CHANGE + 1] = gauge_1*(s6*jacobian_5 + s5*jacobian_10 + s4*jacobian_15 + s3*jacobian_19)  # P5.angle.rate
    w[CHANGE + 2] = gauge_2*(s6*jacobian_6 - s7*jacobian_1 + s5*jacobian_11 + s4*jacobian_16 + s3*jacobian_20)  # P1.angle.rate
    w[CHANGE + 3] = gauge_3*(s6*jacobian_7 - s7*jacobian_2 + s5*jacobian_12 + s4*jacobian_17 + s3*jacobian_21)  # P4.angle.rate
    w[CHANGE + 4] = gauge_4*(s6*jacobian_8 - s7*jacobian_3 + s5*jacobian_13 + s3*jacobian_22)  # P2.angle.rate
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def measure(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left, and the energies: 186 operations, 493 before sharing."""
    # inputs
    q0 = y[0]  # P0.angle [rad]
    q1 = y[1]  # P5.angle [rad]
    q2 = y[2]  # P1.angle [rad]
    q3 = y[3]  # P4.angle [rad]
    q4 = y[4]  # P2.angle [rad]
    v0 = y[5]  # P0.angle.rate [rad/s]
    v1 = y[6]  # P5.angle.rate [rad/s]
    v2 = y[7]  # P1.angle.rate [rad/s]
    v3 = y[8]  # P4.angle.rate [rad/s]
    v4 = y[9]  # P2.angle.rate [rad/s]
    winding_0 = w[WINDING]
    status_6 = w[LENGTH_SCALE]  # length_scale
    jacobian_0 = w[JACOBIAN]  # D P3.x, P0.angle.rate
    jacobian_1 = w[JACOBIAN + 1]  # D P3.x, P1.angle.rate
    jacobian_2 = w[JACOBIAN + 2]  # D P3.x, P4.angle.rate
    jacobian_3 = w[JACOBIAN + 3]  # D P3.x, P2.angle.rate
    jacobian_4 = w[JACOBIAN + 4]  # D P3.y, P0.angle.rate
    jacobian_5 = w[JACOBIAN + 5]  # D P3.y, P5.angle.rate
    jacobian_6 = w[JACOBIAN + 6]  # D P3.y, P1.angle.rate
    jacobian_7 = w[JACOBIAN + 7]  # D P3.y, P4.angle.rate
    jacobian_8 = w[JACOBIAN + 8]  # D P3.y, P2.angle.rate
    jacobian_9 = w[JACOBIAN + 9]  # D P3.z, P0.angle.rate
    jacobian_10 = w[JACOBIAN + 10]  # D P3.z, P5.angle.rate
    jacobian_11 = w[JACOBIAN + 11]  # D P3.z, P1.angle.rate
    jacobian_12 = w[JACOBIAN + 12]  # D P3.z, P4.angle.rate
    jacobian_13 = w[JACOBIAN + 13]  # D P3.z, P2.angle.rate
    jacobian_14 = w[JACOBIAN + 14]  # D P3.first, P0.angle.rate
    jacobian_15 = w[JACOBIAN + 15]  # D P3.first, P5.angle.rate
    jacobian_16 = w[JACOBIAN + 16]  # D P3.first, P1.angle.rate
    jacobian_17 = w[JACOBIAN + 17]  # D P3.first, P4.angle.rate
    jacobian_18 = w[JACOBIAN + 18]  # D P3.second, P0.angle.rate
    jacobian_19 = w[JACOBIAN + 19]  # D P3.second, P5.angle.rate
    jacobian_20 = w[JACOBIAN + 20]  # D P3.second, P1.angle.rate
    jacobian_21 = w[JACOBIAN + 21]  # D P3.second, P4.angle.rate
    jacobian_22 = w[JACOBIAN + 22]  # D P3.second, P2.angle.rate
    # intermediate terms
    s0 = math.sin(q0)
    s1 = math.cos(q1)
    s2 = math.sin(q1)
    s3 = math.cos(q2)
    s4 = math.sin(q2)
    s5 = v0*s4
    s6 = v0*s3
    s7 = math.sin(q3)
    s8 = v1*math.cos(q3)
    s9 = v1*s7
    s10 = math.cos(q4)
    s11 = math.sin(q4)
    s12 = s3*s11
    s13 = s6*s10 + v2*s11
    s14 = v2*s10 - s6*s11
    s15 = v4 + s5
    s16 = v0 + s5
    s17 = s10*s16
    s18 = 0.5*v0
    s19 = 0.5*v2
    s20 = v0 + 0.5*s5
    s21 = v2 + 0.5*s13
    s22 = s11*s16 + 0.5*s15
    s23 = 0.5*v3
    s24 = v1 + 0.5*s9
    s25 = 0.5*v1
    s26 = 0.5*(s5*(0.08416666666666667*s5) + s6*(0.0016666666666666668*s6) + v2*(0.08416666666666667*v2))
    s27 = 0.5*(s18*s18) + 0.5*(v0*(0.08416666666666667*v0)) + 0.5*(s19*s19 + s20*s20) + s26 + 0.5*(s21*s21 + s22*s22 + s17*s17)
    s28 = s15*(0.08416666666666667*s15) + s13*(0.08416666666666667*s13) + s14*(0.0016666666666666668*s14)
    s29 = 0.5*(s8*(0.0016666666666666668*s8) + s9*(0.08416666666666667*s9) + v3*(0.08416666666666667*v3))
    s30 = s27 + 0.5*s28 + 0.5*(s23*s23 + s24*s24) + s29 + 0.5*(s25*s25) + 0.5*(v1*(0.08416666666666667*v1))
    s31 = math.atan2(s2*s4 - s1*(s0*s3), s1*(math.cos(q0)*s10 - s0*s4*s11) - s2*s12)
    s32 = v0*jacobian_0 + v2*jacobian_1 + v3*jacobian_2 + v4*jacobian_3
    s33 = v0*jacobian_4 + v1*jacobian_5 + v2*jacobian_6 + v3*jacobian_7 + v4*jacobian_8
    s34 = v0*jacobian_9 + v1*jacobian_10 + v2*jacobian_11 + v3*jacobian_12 + v4*jacobian_13
    s35 = v0*jacobian_14 + v1*jacobian_15 + v2*jacobian_16 + v3*jacobian_17
    s36 = v0*jacobian_18 + v1*jacobian_19 + v2*jacobian_20 + v3*jacobian_21 + v4*jacobian_22
    s37 = status_6*s35
    s38 = status_6*s36
    s39 = s32*s32 + s33*s33 + s34*s34
    # outputs
    w[RESIDUAL] = s32  # P3.x
    w[RESIDUAL + 1] = s33  # P3.y
    w[RESIDUAL + 2] = s34  # P3.z
    w[RESIDUAL + 3] = s35  # P3.first
    w[RESIDUAL + 4] = s36  # P3.second
    w[VELOCITY_VIOLATION] = math.sqrt(s39 + s35*s35 + s36*s36)  # velocity_violation
    w[VELOCITY_MEASURE] = math.sqrt(s39 + s37*s37 + s38*s38)  # velocity_measure
    w[KINETIC] = s30  # kinetic
    w[POTENTIAL] = -(4.905*s3 + 9.81*(s3 + 0.5*s12) + 9.81*(s1 + 0.5*(s1*s7)) + 4.905*s1)  # potential
    w[WINDING] = s31 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s31))
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def observe(t, y, p, w, ydot, out):
    """D v' - gamma, then joint coordinates and their rates: 447 operations, 3178 before sharing."""
    # inputs
    q0 = y[0]  # P0.angle [rad]
    q1 = y[1]  # P5.angle [rad]
    q2 = y[2]  # P1.angle [rad]
    q3 = y[3]  # P4.angle [rad]
    q4 = y[4]  # P2.angle [rad]
    v0 = y[5]  # P0.angle.rate [rad/s]
    v1 = y[6]  # P5.angle.rate [rad/s]
    v2 = y[7]  # P1.angle.rate [rad/s]
    v3 = y[8]  # P4.angle.rate [rad/s]
    v4 = y[9]  # P2.angle.rate [rad/s]
    winding_0 = w[WINDING]
    ydot_5 = ydot[5]  # rate of P0.angle.rate
    ydot_6 = ydot[6]  # rate of P5.angle.rate
    ydot_7 = ydot[7]  # rate of P1.angle.rate
    ydot_8 = ydot[8]  # rate of P4.angle.rate
    ydot_9 = ydot[9]  # rate of P2.angle.rate
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = v0*v0
    s3 = math.cos(q1)
    s4 = math.sin(q1)
    s5 = 9.81*s4
    s6 = math.cos(q2)
    s7 = math.sin(q2)
    s8 = s0*s6
    s9 = s1*s6
    s10 = s0*s7
    s11 = s1*s7
    s12 = v0*s7
    s13 = v0*s6
    s14 = v2*s13
    s15 = v2*s12
    s16 = s14 + s14
    s17 = math.cos(q3)
    s18 = math.sin(q3)
    s19 = s3*s18
    s20 = s4*s18
    s21 = s3*s17
    s22 = s4*s17
    s23 = v1*s17
    s24 = v1*s18
    s25 = v3*s24
    s26 = v3*s23
    s27 = 9.81*s3 + v1*v1
    s28 = s18*s27
    s29 = s17*s27
    s30 = v3*v3
    s31 = s24*s24 + s30
    s32 = s23*s24
    s33 = s23*s23 + s30
    s34 = math.cos(q4)
    s35 = math.sin(q4)
    s36 = s10*s34
    s37 = s1*s35
    s38 = s37 - s36
    s39 = s6*s34
    s40 = s11*s34 + s0*s35
    s41 = s10*s35 + s1*s34
    s42 = s6*s35
    s43 = s11*s35
    s44 = s0*s34
    s45 = s44 - s43
    s46 = s13*s34 + v2*s35
    s47 = s13*s35
    s48 = v2*s34
    s49 = s48 - s47
    s50 = v4 + s12
    s51 = v4*s49 - s15*s34
    s52 = 9.81*s7 - s2*s6 - s12*s13
    s53 = s2*s7 + 9.81*s6 + s12*s12 + v2*v2
    s54 = -1.0 - s7
    s55 = s35*s54
    s56 = s34*s54
    s57 = s34*s53 - s16*s35
    s58 = s35*s53 + s16*s34
    s59 = s46*s46
    s60 = s46*s50
    s61 = s46*s49
    s62 = s50*s50 + s59
    s63 = s49*s50
    s64 = s8*s63 + s38*s61 - s41*s62
    s65 = s7*s63 + s39*s61 + s42*s62
    s66 = s40*s61 - s9*s63 - s45*s62
    s67 = s4*s26
    s68 = s3*s26
    s69 = s18*s32 - s17*s31 - s64 + s18*s29 - s17*s28 + s41*s58 - (s8*s52 + s38*s57) + s14*s38 - s8*s51
    s70 = s7*s39
    s71 = -9.81 + s19*s28 + s21*s29 + s4*s5 + s14*s39 - (-9.81 + s7*s52 + s39*s57 + s42*s58) - s7*s51
    s72 = s68 - (s20*s31 + s22*s32) - s66 + s68 + s3*s5 - (s20*s28 + s22*s29) + s45*s58 - (s40*s57 - s9*s52) + s14*s40 + s9*s51
    s73 = s49*(s47 - s48) - s59
    s74 = v3*s17
    s75 = v3*s19 + s4*s23
    s76 = v3*s20 - s3*s23
    s77 = s17*s32 - s18*s33
    s78 = s4*s25 - (s19*s32 + s21*s33)
    s79 = s20*s32 + s22*s33 + s3*s25
    s80 = s8*s18 + s7*s21 + s9*s22
    s81 = s21*s42 - s18*s41
    s82 = s43 - s44
    s83 = s21*s39
    s84 = s22*s40
    s85 = s4*s7
    s86 = s3*s9
    s87 = s85 - s86
    s88 = s8*s17
    s89 = s7*s19
    s90 = s9*s20
    s91 = s8*s77 + s7*s78 - s9*s79 + s18*(s8*s73 + s38*s60 + s41*s63) + s21*(s7*s73 + s39*s60 - s42*s63)
    s92 = s91 - s22*(s40*s60 - s9*s73 + s45*s63) + s74*(2.0*(s38*s49 - s41*s46)) - s75*(2.0*(s39*s49 + s42*s46))
    s93 = s22*s82 - s81
    s94 = s84 - (s18*s38 + s83)
    s95 = s86 - s85
    s96 = s84 + s18*(s36 - s37) - s83
    s97 = s4*s42
    s98 = s3*s45 - s97
    s99 = s17*s41 + s19*s42 + s20*s45
    s100 = s41*s77 - s42*s78 + s45*s79 + s18*s64 + s21*s65 - s22*s66 + s74*(2.0*(s8*s46 - s38*s50)) - s75*(2.0*(s7*s46 - s39*s50))
    s101 = s4*s39 + s3*s40
    s102 = s98*s98 + s87*s87
    s103 = s98/s102
    s104 = s87/s102
    s105 = math.atan2(s87, s98)
    s106 = s50*(s101*s104) + s46*((s97 + s3*s82)*s103 - s87*s104) + s49*(s101*s103) + s23*(s80*s103 + (s81 + s22*s45)*s104)
    s107 = (s7*s38 - (s38*s55 + s41*s56) - s8*s39)*ydot_5 - (s8 + s8*s35)*ydot_7 - s18*ydot_8 + s38*ydot_9
    s108 = (s42*s56 - s39*s55 + s70 - s70)*ydot_5 + (s4 + s20)*ydot_6 - (s7 + s7*s35)*ydot_7 - s21*ydot_8
    s109 = (s7*s40 - (s40*s55 + s45*s56) + s9*s39)*ydot_5 + (s3 + s19)*ydot_6 + (s9 + s9*s35)*ydot_7 + s22*ydot_8
    s110 = (s39*s93 - s42*s94)*ydot_5 - s17*s95*ydot_6 + (s35*s93 + s34*s94)*ydot_7 + (s89 - s88 + s90)*ydot_8
    s111 = s110 - (s92 + s76*(2.0*(s40*s49 - s45*s46)) - (s51*s93 + (s15*s35 - v4*s46)*s94 + s25*s95))
    s112 = s100 - s76*(2.0*(s9*s46 + s40*s50)) + s14*s96 + s51*s80 + s25*s98 + (s7*s96 + s39*s80)*ydot_5 - s17*s98*ydot_6 + s35*s80*ydot_7 + s99*ydot_8 + s96*ydot_9
    # outputs
    out[0] = s69 + s107  # P3.x
    out[1] = s19*s31 + s21*s32 + s67 - s65 + s67 + s71 + s108 + s39*ydot_9  # P3.y
    out[2] = s72 + s109 + s40*ydot_9  # P3.z
    out[3] = s111  # P3.first
    out[4] = s112  # P3.second
    out[5] = q0  # P0.angle
    out[6] = v0  # rate of P0.angle
    out[7] = q2  # P1.angle
    out[8] = v2  # rate of P1.angle
    out[9] = q4  # P2.angle
    out[10] = v4  # rate of P2.angle
    out[11] = s105 + 6.283185307179586*math.floor(0.5 + 0.15915494309189535*(winding_0 - s105))  # P3.angle
    out[12] = s106 - s24*((s88 - s89 - s90)*s103 - s99*s104)  # rate of P3.angle
    out[13] = q3  # P4.angle
    out[14] = v3  # rate of P4.angle
    out[15] = q1  # P5.angle
    out[16] = v1  # rate of P5.angle
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def masses(p, w):
    """Diagonal of M: 0 operations, 0 before sharing."""
    # outputs
    w[MASS] = 2.67  # P0.angle.rate
    w[MASS + 2] = 1.3358333333333332  # P1.angle.rate
    w[MASS + 4] = 0.33416666666666667  # P2.angle.rate
    w[MASS + 1] = 1.3358333333333332  # P5.angle.rate
    w[MASS + 3] = 0.33416666666666667  # P4.angle.rate
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def bodies(t, y, p, w, ydot, out):
    """Coordinates, velocities and accelerations of bodies: 379 operations, 2816 before sharing."""
    # inputs
    q0 = y[0]  # P0.angle [rad]
    q1 = y[1]  # P5.angle [rad]
    q2 = y[2]  # P1.angle [rad]
    q3 = y[3]  # P4.angle [rad]
    q4 = y[4]  # P2.angle [rad]
    v0 = y[5]  # P0.angle.rate [rad/s]
    v1 = y[6]  # P5.angle.rate [rad/s]
    v2 = y[7]  # P1.angle.rate [rad/s]
    v3 = y[8]  # P4.angle.rate [rad/s]
    v4 = y[9]  # P2.angle.rate [rad/s]
    ydot_5 = ydot[5]  # rate of P0.angle.rate
    ydot_6 = ydot[6]  # rate of P5.angle.rate
    ydot_7 = ydot[7]  # rate of P1.angle.rate
    ydot_8 = ydot[8]  # rate of P4.angle.rate
    ydot_9 = ydot[9]  # rate of P2.angle.rate
    # intermediate terms
    s0 = math.cos(q0)
    s1 = math.sin(q0)
    s2 = 0.5*q0
    s3 = 0.5*math.cos(s2)
    s4 = 0.5*math.sin(s2)
    s5 = 0.5*(s3 + s4)
    s6 = 0.5*(s4 - s3)
    s7 = s5 - (s6 + s6 - s5)
    s8 = s5 + s6
    s9 = s8 + s8
    s10 = v0*v0
    s11 = math.cos(q1)
    s12 = math.sin(q1)
    s13 = -0.5*q1
    s14 = 0.5*math.cos(s13)
    s15 = 0.5*math.sin(s13)
    s16 = 0.5*(s14 - s15)
    s17 = 0.5*(s14 + s15)
    s18 = s16 + s17 + s16 + s17
    s19 = s17 - s16
    s20 = s19 + s19
    s21 = s19 + s16 - s17
    s22 = 9.81*s11
    s23 = 9.81*s12
    s24 = v1*v1
    s25 = math.cos(q2)
    s26 = math.sin(q2)
    s27 = 0.5*q2
    s28 = math.cos(s27)
    s29 = math.sin(s27)
    s30 = s0*s25
    s31 = s1*s25
    s32 = s0*s26
    s33 = s1*s26
    s34 = s7*s28
    s35 = s9*s29
    s36 = s9*s28
    s37 = s7*s29
    s38 = v0*s26
    s39 = v0*s25
    s40 = v2*s39
    s41 = v2*s38
    s42 = 9.81*s26 - s10*s25
    s43 = s10*s26 + 9.81*s25
    s44 = s38*s39
    s45 = s38*s38 + v2*v2
    s46 = s40 + s40
    s47 = math.cos(q3)
    s48 = math.sin(q3)
    s49 = -0.5*q3
    s50 = math.cos(s49)
    s51 = math.sin(s49)
    s52 = s11*s48
    s53 = s12*s48
    s54 = s11*s47
    s55 = s12*s47
    s56 = v1*s47
    s57 = v1*s48
    s58 = v3*s56
    s59 = s22 + s24
    s60 = math.cos(q4)
    s61 = math.sin(q4)
    s62 = 0.5*q4
    s63 = 0.5*math.cos(s62)
    s64 = 0.5*math.sin(s62)
    s65 = 0.5*(s63 - s64)
    s66 = 0.5*(s63 + s64)
    s67 = s65 + s66 + s65 + s66
    s68 = s66 - s65
    s69 = s68 + s68
    s70 = s68 + s65 - s66
    s71 = s1*s61 - s32*s60
    s72 = s25*s60
    s73 = s33*s60 + s0*s61
    s74 = s32*s61 + s1*s60
    s75 = s25*s61
    s76 = s0*s60 - s33*s61
    s77 = s39*s60 + v2*s61
    s78 = v2*s60 - s39*s61
    s79 = v4 + s38
    s80 = v0 + s38
    s81 = s43 + s45
    s82 = -1.0 - s26
    s83 = s60*s80
    s84 = 0.5*v0
    s85 = 0.5*v2
    s86 = v0 + 0.5*s38
    s87 = v2 + 0.5*s77
    s88 = s61*s80 + 0.5*s79
    s89 = 0.5*v3
    s90 = v1 + 0.5*s57
    s91 = 0.5*v1
    s92 = 0.5*s10
    s93 = 0.5*ydot_5
    s94 = s40 + s26*ydot_5
    s95 = s42 - 0.5*(s44 - ydot_7)
    s96 = s43 + 0.5*s45
    s97 = ydot_5 + 0.5*(s40 + s94)
    s98 = ydot_9 + s94
    s99 = s61*ydot_7 + v4*s78 - s41*s60 + s72*ydot_5
    s100 = s42 - s44 + ydot_7 + 0.5*(s78*s79 + s99)
    s101 = s60*s81 - s46*s61 + s61*s82*ydot_5 + 0.5*(s77*s78 - s98)
    s102 = s60*s82*ydot_5 - (s61*s81 + s46*s60) - 0.5*(s79*s79 + s77*s77)
    s103 = s58 + s48*ydot_6
    s104 = s48*s59 + 0.5*(s57*s57 + v3*v3)
    s105 = s47*s59 + 0.5*(s56*s57 - ydot_8)
    s106 = s23 + ydot_6 + 0.5*(s58 + s103)
    s107 = s22 + 0.5*s24
    s108 = s23 + 0.5*ydot_6
    # outputs
    out[0] = 0.5*s0
    out[1] = 0.0
    out[2] = -0.5*s1
    out[3] = s7
    out[4] = 0.0
    out[5] = s9
    out[6] = 0.0
    out[7] = s0 + 0.5*s32
    out[8] = -0.5*s25
    out[9] = -(s1 + 0.5*s33)
    out[10] = s34
    out[11] = s35
    out[12] = s36
    out[13] = s37
    out[14] = s0 + s32 + 0.5*s74
    out[15] = -(s25 + 0.5*s75)
    out[16] = 0.5*s76 - (s1 + s33)
    out[17] = s34*s67 - (s35*s69 + s37*s70)
    out[18] = s34*s69 + s35*s67 + s36*s70
    out[19] = s36*s67 + s37*s69 - s35*s70
    out[20] = s34*s70 + s37*s67 - s36*s69
    out[21] = 0.5*s47
    out[22] = -(s11 + 0.5*s52)
    out[23] = 1.0 + s12 + 0.5*s53
    out[24] = s18*s50 - s21*s51
    out[25] = s20*s50
    out[26] = -s20*s51
    out[27] = s18*s51 + s21*s50
    out[28] = 0.0
    out[29] = -0.5*s11
    out[30] = 1.0 + 0.5*s12
    out[31] = s18
    out[32] = s20
    out[33] = 0.0
    out[34] = s21
    out[35] = -s1*s84
    out[36] = 0.0
    out[37] = -s0*s84
    out[38] = 0.0
    out[39] = v0
    out[40] = 0.0
    out[41] = s30*s85 - s1*s86
    out[42] = s26*s85
    out[43] = -(s31*s85 + s0*s86)
    out[44] = s38
    out[45] = s39
    out[46] = v2
    out[47] = s30*s87 - s71*s88 - s74*s83
    out[48] = s75*s83 + s26*s87 - s72*s88
    out[49] = -(s76*s83 + s31*s87 + s73*s88)
    out[50] = s79
    out[51] = s77
    out[52] = s78
    out[53] = -s48*s89
    out[54] = s12*s90 - s54*s89
    out[55] = s55*s89 + s11*s90
    out[56] = -s56
    out[57] = -s57
    out[58] = -v3
    out[59] = 0.0
    out[60] = s12*s91
    out[61] = s11*s91
    out[62] = -v1
    out[63] = 0.0
    out[64] = 0.0
    out[65] = -(s0*s92 + s1*s93)
    out[66] = 0.0
    out[67] = s1*s92 - s0*s93
    out[68] = 0.0
    out[69] = ydot_5
    out[70] = 0.0
    out[71] = s30*s95 - s32*s96 - s1*s97
    out[72] = -9.81 + s26*s95 + s25*s96
    out[73] = s33*s96 - s31*s95 - s0*s97
    out[74] = s94
    out[75] = s25*ydot_5 - s41
    out[76] = ydot_7
    out[77] = s30*s100 + s71*s101 + s74*s102
    out[78] = -9.81 + s26*s100 + s72*s101 - s75*s102
    out[79] = s73*s101 - s31*s100 + s76*s102
    out[80] = s98
    out[81] = s99
    out[82] = s60*ydot_7 + s41*s61 - v4*s77 - s75*ydot_5
    out[83] = s48*s105 - s47*s104
    out[84] = -9.81 + s52*s104 + s54*s105 + s12*s106
    out[85] = s11*s106 - (s53*s104 + s55*s105)
    out[86] = v3*s57 - s47*ydot_6
    out[87] = -s103
    out[88] = -ydot_8
    out[89] = 0.0
    out[90] = -9.81 + s11*s107 + s12*s108
    out[91] = s11*s108 - s12*s107
    out[92] = -ydot_6
    out[93] = 0.0
    out[94] = 0.0
    return 0
