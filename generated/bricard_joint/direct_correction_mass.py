"""Method `direct-correction` for model `bricard`. Emitted by symgen; do not edit.

Positions and velocities are projected after each step with the pseudoinverse of D.
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Eich, SIAM J. Numer. Anal. 30 (1993) 1467-1482, doi 10.1137/0730076; Yoon, Howe, Greenwood, J. Mech. D...
digest dc50b4bafc3843d522248ecf36306546216a47158252a42fd3a8f555947a7488, format 3, templates a1bfe8da2fcb1eac
option solver = elimination
option weight = mass
option when = step
p[0] tolerance (default 1e-13)

Constraints Phi(q, t) = 0, their rates D v = nu and D v' = gamma; M v' = f - D^T lambda; S = D M^-1 D^T.

Functions take the time t, the state y = (q, v, work), parameters p, scratch w and counters iw. Once: `prepare` of the
model, `prepare`, and `accept` with the start. Then `rhs` gives the rate of a state, `confirm` where `rhs` returns 1,
and `accept` corrects and measures the state at the end of each step.

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
w[113:123]  law_lower: L of the factorisation in the metric of this method
w[123:128]  law_reciprocal: reciprocals of its pivots
"""

import math

from numba import njit

from model import geometry as geometry_of_model, measure

MULTIPLIERS = 20  # sections of w
MASK = 25
SAVED = 30
RESIDUAL = 35
PIVOT = 45
CHANGE = 50
JACOBIAN = 70
RECIPROCAL = 103
MASS_ENTRY = 108
LAW_LOWER = 113
LAW_RECIPROCAL = 123
SMALLEST_PIVOT = 4  # numbers in w
LENGTH_SCALE = 6
POSITION_MEASURE = 8
SUSPECTS = 1  # counters in iw
LIGHT = 2
ITERATIONS = 3
FAILURES = 4
TOLERANCE = 0  # parameters of the method in p


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """Numbers that depend on parameters alone: 0 operations, 0 before sharing."""
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers; 1 where a pivot of S is suspicious: 852 operations, 33999802 before sharing."""
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
    mask_0 = w[MASK]  # P3.x
    mask_1 = w[MASK + 1]  # P3.y
    mask_2 = w[MASK + 2]  # P3.z
    mask_3 = w[MASK + 3]  # P3.first
    mask_4 = w[MASK + 4]  # P3.second
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
    s16 = 9.81*s7 - s2*s6
    s17 = s12*s13
    s18 = s14 + s14
    s19 = math.cos(q3)
    s20 = math.sin(q3)
    s21 = s3*s20
    s22 = s4*s20
    s23 = s3*s19
    s24 = s4*s19
    s25 = v1*s19
    s26 = v1*s20
    s27 = v3*s26
    s28 = v3*s25
    s29 = 9.81*s3 + v1*v1
    s30 = s20*s29
    s31 = s19*s29
    s32 = v3*v3
    s33 = s26*s26 + s32
    s34 = s25*s26
    s35 = s25*s25 + s32
    s36 = s28 + s28
    s37 = math.cos(q4)
    s38 = math.sin(q4)
    s39 = s10*s37
    s40 = s1*s38
    s41 = s40 - s39
    s42 = s6*s37
    s43 = s11*s37 + s0*s38
    s44 = s10*s38 + s1*s37
    s45 = s6*s38
    s46 = s11*s38
    s47 = s0*s37
    s48 = s47 - s46
    s49 = s13*s37 + v2*s38
    s50 = s13*s38
    s51 = v2*s37
    s52 = s51 - s50
    s53 = v4 + s12
    s54 = v4*s52 - s15*s37
    s55 = s15*s38 - v4*s49
    s56 = s16 - s17
    s57 = s2*s7 + 9.81*s6 + s12*s12 + v2*v2
    s58 = -1.0 - s7
    s59 = s38*s58
    s60 = s37*s58
    s61 = s37*s57 - s18*s38
    s62 = s38*s57 + s18*s37
    s63 = s49*s49
    s64 = s49*s53
    s65 = s49*s52
    s66 = s65 - s14
    s67 = s53*s53 + s63
    s68 = s52*s53
    s69 = s54 + s68
    s70 = s8*s68 + s41*s65 - s44*s67
    s71 = s7*s68 + s42*s65 + s45*s67
    s72 = s43*s65 - s9*s68 - s48*s67
    s73 = s3 + s21
    s74 = s4*s28
    s75 = s3*s28
    s76 = s8 + s8*s38
    s77 = s20*s34 - s19*s33 - s70 + s20*s31 - s19*s30 + s44*s62 - (s8*s56 + s41*s61) + s14*s41 - s8*s54
    s78 = s7*s42
    s79 = s7 + s7*s38
    s80 = -9.81 + s21*s30 + s23*s31 + s4*s5 + s14*s42 - (-9.81 + s7*s56 + s42*s61 + s45*s62) - s7*s54
    s81 = s4 + s22
    s82 = s9 + s9*s38
    s83 = s75 - (s22*s33 + s24*s34) - s72 + s75 + s3*s5 - (s22*s30 + s24*s31) + s48*s62 - (s43*s61 - s9*s56) + s14*s43 + s9*s54
    s84 = s52*(s50 - s51) - s63
    s85 = v3*s19
    s86 = v3*s21 + s4*s25
    s87 = v3*s22 - s3*s25
    s88 = s19*s34 - s20*s35
    s89 = s4*s27 - (s21*s34 + s23*s35)
    s90 = s22*s34 + s24*s35 + s3*s27
    s91 = s8*s20 + s7*s23 + s9*s24
    s92 = s23*s42
    s93 = s24*s43
    s94 = s7*s21 - s8*s19 + s9*s22
    s95 = s8*s88 + s7*s89 - s9*s90 + s20*(s8*s84 + s41*s64 + s44*s68) + s23*(s7*s84 + s42*s64 - s45*s68)
    s96 = s95 - s24*(s43*s64 - s9*s84 + s48*s68) + s85*(2.0*(s41*s52 - s44*s49)) - s86*(2.0*(s42*s52 + s45*s49))
    s97 = s24*(s46 - s47) - (s23*s45 - s20*s44)
    s98 = s93 - (s20*s41 + s92)
    s99 = s3*s9 - s4*s7
    s100 = s38*s97 + s37*s98
    s101 = s19*s99
    s102 = s93 + s20*(s39 - s40) - s92
    s103 = s3*s48 - s4*s45
    s104 = s19*s44 + s21*s45 + s22*s48
    s105 = s44*s88 - s45*s89 + s48*s90 + s20*s70 + s23*s71 - s24*s72 + s85*(2.0*(s8*s49 - s41*s53)) - s86*(2.0*(s7*s49 - s42*s53))
    s106 = s38*s91
    s107 = s19*s103
    s108 = 0.0008333333333333248*(s14 + s65) - 0.3333333333333333*s66
    s109 = 2.7755575615628914e-17*(s55 + s64) - 0.0008333333333333248*(s64 - s55)
    s110 = 0.5*s61
    s111 = 0.3333333333333333*s69 - 2.7755575615628914e-17*(s68 - s54) + 0.5*s56
    s112 = 0.3333333333333333*s34 - 0.0008333333333333248*s34 + 0.5*s31
    s113 = 0.5*s38
    s114 = 0.5*s37
    s115 = s113 + s113
    s116 = 0.3325*s38
    s117 = s38*s116
    s118 = 0.0016666666666666392 + 0.33333333333333337 - s117
    s119 = s38*(0.5*s66)
    s120 = s37*(0.5*s67)
    s121 = 0.5*s69 + 0.0016666666666665941*s17 - 1.3333333333333335*s17 + 1.5*s16 + s38*s111 + s37*s109
    s122 = 0.5*s20
    s123 = s19*(0.0008333333333333248*(s27 + s27)) - s20*(0.3333333333333333*s36 + 4.905*s4) - (0.5*s36 + 14.715*s4)
    s124 = s7*(-1.5 - s113)
    s125 = s6*(s37*s116 + 0.5*(s114 + s114))
    s126 = 2.335 + s118 + s7*(s7*(1.3333333333333335 + 0.33416666666666667 + s115 - s118)) - (s124 + s124)
    s127 = s7*(s108 - s110 + 1.3333333333333335*s18 + s120 - s119) + s6*(s37*s111 - s38*s109 - 0.0016666666666665941*(s15 + s15))
    s128 = s113 + s7*(0.33416666666666667 + s113)
    s129 = s110 - s108
    s130 = 1.0/(1.335 + s122 + s122 + 0.000833333333333342 + s20*(0.3325*s20))
    s131 = 1.0/(1.335 + s115 + 0.000833333333333342 + s117)
    s132 = s125*s131
    s133 = 2.9925187032418954*s128
    s134 = 1.0/(s126 - s125*s132 - s128*s133)
    s135 = s121*s132 - (1.5*s18 - (s119 - s120) + s127) - s129*s133
    s136 = s7*s41 - (s41*s59 + s44*s60) - s8*s42 + s76*s132 - s41*s133
    s137 = s45*s60 - s42*s59 + s78 - s78 + s79*s132 - s42*s133
    s138 = s7*s43 - (s43*s59 + s48*s60) + s9*s42 - s82*s132 - s43*s133
    s139 = s42*s97 - s45*s98 - s100*s132
    s140 = s7*s102 + s42*s91 - s106*s132 - s102*s133
    s141 = s134*s136
    s142 = s76*s131
    s143 = 2.9925187032418954*s20
    s144 = 2.9925187032418954*s41
    s145 = s134*s137
    s146 = s81*s130
    s147 = s79*s131
    s148 = 2.9925187032418954*s23
    s149 = 2.9925187032418954*s42
    s150 = s134*s138
    s151 = s73*s130
    s152 = s82*s131
    s153 = 2.9925187032418954*s24
    s154 = 2.9925187032418954*s43
    s155 = s134*s139
    s156 = s101*s130
    s157 = s100*s131
    s158 = 2.9925187032418954*s94
    s159 = s134*s140
    s160 = s107*s130
    s161 = s106*s131
    s162 = 2.9925187032418954*s104
    s163 = 2.9925187032418954*s102
    s164 = s77 + s135*s141 + s121*s142 - s112*s143 + s129*s144
    s165 = s21*s33 + s23*s34 + s74 - s71 + s74 + s80 + s135*s145 + s123*s146 + s121*s147 - s112*s148 + s129*s149
    s166 = s135*s155 - s123*s156 - s121*s157 + s112*s158 - (s96 + s87*(2.0*(s43*s52 - s48*s49)) - (s54*s97 + s55*s98 + s27*s99))
    s167 = s105 - s87*(2.0*(s9*s49 + s43*s53)) + s14*s102 + s54*s91 + s27*s103 + s135*s159 - s123*s160 - s121*s161 + s112*s162 + s129*s163
    s168 = s137*s141 + s79*s142 + s23*s143 + s42*s144
    s169 = s138*s141 - s82*s142 - s24*s143 + s43*s144
    s170 = s139*s141 - s100*s142 - s94*s143
    s171 = s140*s141 - s106*s142 - s104*s143 + s102*s144
    s172 = s137*s145 + s81*s146 + s79*s147 + s23*s148 + s42*s149
    s173 = s138*s150 + s73*s151 + s82*s152 + s24*s153 + s43*s154
    s174 = s139*s155 + s101*s156 + s100*s157 + s94*s158
    s175 = s140*s159 + s107*s160 + s106*s161 + s104*s162 + s102*s163
    s176 = 1.0/(mask_0 + s136*s141 + s76*s142 + s20*s143 + s41*s144)
    s177 = s168*s176
    s178 = s169*s176
    s179 = s170*s176
    s180 = s171*s176
    s181 = s138*s145 + s73*s146 - s82*s147 - s24*s148 + s43*s149 - s169*s177
    s182 = s139*s145 - s101*s146 - s100*s147 - s94*s148 - s170*s177
    s183 = s140*s145 - s107*s146 - s106*s147 - s104*s148 + s102*s149 - s171*s177
    s184 = mask_1 + s172 - s168*s177
    s185 = 1.0/s184
    s186 = s181*s185
    s187 = s182*s185
    s188 = s183*s185
    s189 = s139*s150 - s101*s151 + s100*s152 + s94*s153 - s170*s178 - s182*s186
    s190 = s140*s150 - s107*s151 + s106*s152 + s104*s153 + s102*s154 - s171*s178 - s183*s186
    s191 = mask_2 + s173 - s169*s178 - s181*s186
    s192 = 1.0/s191
    s193 = s189*s192
    s194 = s190*s192
    s195 = s140*s155 + s107*s156 + s106*s157 + s104*s158 - s171*s179 - s183*s187 - s190*s193
    s196 = mask_3 + s174 - s170*s179 - s182*s187 - s189*s193
    s197 = 1.0/s196
    s198 = s195*s197
    s199 = mask_4 + s175 - s171*s180 - s183*s188 - s190*s194 - s195*s198
    s200 = s165 - s164*s177
    s201 = s83 + s135*s150 + s123*s151 - s121*s152 + s112*s153 + s129*s154 - s164*s178 - s186*s200
    s202 = s166 - s164*s179 - s187*s200 - s193*s201
    s203 = 1.0/s199*(s167 - s164*s180 - s188*s200 - s194*s201 - s198*s202)
    s204 = s197*s202 - s198*s203
    s205 = s192*s201 - s193*s204 - s194*s203
    s206 = s185*s200 - s186*s205 - s187*s204 - s188*s203
    s207 = s164*s176 - s177*s206 - s178*s205 - s179*s204 - s180*s203
    s208 = s134*(s135 - (s136*s207 + s137*s206 + s138*s205 + s139*s204 + s140*s203))
    s209 = ((((s184 < 1e-06*s172) | (s191 < 1e-06*s173)) | (s196 < 1e-06*s174)) | (s199 < 1e-06*s175))
    # outputs
    ydot[0] = v0  # rate of P0.angle
    ydot[1] = v1  # rate of P5.angle
    ydot[2] = v2  # rate of P1.angle
    ydot[3] = v3  # rate of P4.angle
    ydot[4] = v4  # rate of P2.angle
    ydot[5] = s208  # rate of P0.angle.rate
    ydot[6] = s130*(s123 - (s81*s206 + s73*s205 - s101*s204 - s107*s203))  # rate of P5.angle.rate
    ydot[7] = -(s131*(s121 + s82*s205 - (s76*s207 + s79*s206) + s100*s204 + s106*s203) + s132*s208)  # rate of P1.angle.rate
    ydot[8] = 2.9925187032418954*(s112 - (s24*s205 - (s20*s207 + s23*s206) + s94*s204 + s104*s203))  # rate of P4.angle.rate
    ydot[9] = 2.9925187032418954*(s129 - (s41*s207 + s42*s206 + s43*s205 + s102*s203)) - s133*s208  # rate of P2.angle.rate
    ydot[10] = 0.0  # rate of work
    w[MULTIPLIERS] = s207  # P3.x
    w[MULTIPLIERS + 1] = s206  # P3.y
    w[MULTIPLIERS + 2] = s205  # P3.z
    w[MULTIPLIERS + 3] = s204  # P3.first
    w[MULTIPLIERS + 4] = s203  # P3.second
    return int(s209)


@njit(error_model="numpy", fastmath={"contract"})
def refactor(p, w):
    """The factorisation of D M^-1 D^T from D, without the rows that depend on others: 230 operations, 20436 before sharing."""
    # inputs
    reciprocal_0 = w[RECIPROCAL]
    reciprocal_1 = w[RECIPROCAL + 1]
    reciprocal_2 = w[RECIPROCAL + 2]
    reciprocal_3 = w[RECIPROCAL + 3]
    reciprocal_4 = w[RECIPROCAL + 4]
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
    mass_entry_0 = w[MASS_ENTRY]
    mass_entry_1 = w[MASS_ENTRY + 1]
    mass_entry_2 = w[MASS_ENTRY + 2]
    mass_entry_3 = w[MASS_ENTRY + 3]
    mass_entry_4 = w[MASS_ENTRY + 4]
    # intermediate terms
    s0 = 2.9925187032418954*jacobian_2
    s1 = 2.9925187032418954*jacobian_3
    s2 = 2.9925187032418954*jacobian_7
    s3 = 2.9925187032418954*jacobian_8
    s4 = 2.9925187032418954*jacobian_12
    s5 = 2.9925187032418954*jacobian_13
    s6 = 2.9925187032418954*jacobian_17
    s7 = 1.0/mass_entry_4
    s8 = 1.0/mass_entry_3
    s9 = mass_entry_1*s8
    s10 = 2.9925187032418954*mass_entry_2
    s11 = 1.0/(mass_entry_0 - mass_entry_1*s9 - mass_entry_2*s10)
    s12 = jacobian_0 - jacobian_1*s9 - jacobian_3*s10
    s13 = jacobian_4 - jacobian_6*s9 - jacobian_8*s10
    s14 = jacobian_9 - jacobian_11*s9 - jacobian_13*s10
    s15 = jacobian_14 - jacobian_16*s9
    s16 = jacobian_18 - jacobian_20*s9 - jacobian_22*s10
    s17 = s11*s12
    s18 = jacobian_1*s8
    s19 = s11*s13
    s20 = jacobian_5*s7
    s21 = jacobian_6*s8
    s22 = s11*s14
    s23 = jacobian_10*s7
    s24 = jacobian_11*s8
    s25 = s11*s15
    s26 = jacobian_15*s7
    s27 = jacobian_16*s8
    s28 = jacobian_8*s1 + jacobian_7*s0 + s13*s17 + jacobian_6*s18
    s29 = jacobian_13*s1 + jacobian_12*s0 + s14*s17 + jacobian_11*s18
    s30 = jacobian_17*s0 + s15*s17 + jacobian_16*s18
    s31 = jacobian_22*s1 + jacobian_21*s0 + s16*s17 + jacobian_20*s18
    s32 = jacobian_21*(2.9925187032418954*jacobian_21) + s16*(s11*s16) + jacobian_19*(jacobian_19*s7) + jacobian_20*(jacobian_20*s8)
    s33 = 1.0*(reciprocal_0 > 0.0)/max(jacobian_3*s1 + jacobian_2*s0 + s12*s17 + jacobian_1*s18, 1e-300)
    s34 = s28*s33
    s35 = s29*s33
    s36 = s30*s33
    s37 = s31*s33
    s38 = jacobian_13*s3 + jacobian_12*s2 + s14*s19 + jacobian_10*s20 + jacobian_11*s21 - s29*s34
    s39 = jacobian_17*s2 + s15*s19 + jacobian_15*s20 + jacobian_16*s21 - s30*s34
    s40 = jacobian_22*s3 + jacobian_21*s2 + s16*s19 + jacobian_19*s20 + jacobian_20*s21 - s31*s34
    s41 = max(jacobian_8*s3 + jacobian_7*s2 + s13*s19 + jacobian_5*s20 + jacobian_6*s21 - s28*s34, 1e-300)
    s42 = 1.0*(reciprocal_1 > 0.0)/s41
    s43 = s38*s42
    s44 = s39*s42
    s45 = s40*s42
    s46 = jacobian_13*s5 + jacobian_12*s4 + s14*s22 + jacobian_10*s23 + jacobian_11*s24 - s29*s35 - s38*s43
    s47 = jacobian_17*s4 + s15*s22 + jacobian_15*s23 + jacobian_16*s24 - s30*s35 - s39*s43
    s48 = jacobian_22*s5 + jacobian_21*s4 + s16*s22 + jacobian_19*s23 + jacobian_20*s24 - s31*s35 - s40*s43
    s49 = 1.0*(reciprocal_2 > 0.0)/max(s46, 1e-300)
    s50 = s47*s49
    s51 = s48*s49
    s52 = jacobian_21*s6 + s16*s25 + jacobian_19*s26 + jacobian_20*s27 - s31*s36 - s40*s44 - s48*s50
    s53 = max(jacobian_17*s6 + s15*s25 + jacobian_15*s26 + jacobian_16*s27 - s30*s36 - s39*s44 - s47*s50, 1e-300)
    s54 = 1.0*(reciprocal_3 > 0.0)/s53
    s55 = s52*s54
    s56 = max(jacobian_22*(2.9925187032418954*jacobian_22) + s32 - s31*s37 - s40*s45 - s48*s51 - s52*s55, 1e-300)
    # outputs
    w[LAW_LOWER] = s34
    w[LAW_LOWER + 1] = s35
    w[LAW_LOWER + 2] = s36
    w[LAW_LOWER + 3] = s37
    w[LAW_LOWER + 4] = s43
    w[LAW_LOWER + 5] = s44
    w[LAW_LOWER + 6] = s45
    w[LAW_LOWER + 7] = s50
    w[LAW_LOWER + 8] = s51
    w[LAW_LOWER + 9] = s55
    w[LAW_RECIPROCAL] = s33
    w[LAW_RECIPROCAL + 1] = s42
    w[LAW_RECIPROCAL + 2] = s49
    w[LAW_RECIPROCAL + 3] = s54
    w[LAW_RECIPROCAL + 4] = 1.0*(reciprocal_4 > 0.0)/s56
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def spread(p, w):
    """The correction -D^+ times the section `residual`, of v, or of q by N: 108 operations, 8759 before sharing."""
    # inputs
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
    law_lower_0 = w[LAW_LOWER]
    law_lower_1 = w[LAW_LOWER + 1]
    law_lower_2 = w[LAW_LOWER + 2]
    law_lower_3 = w[LAW_LOWER + 3]
    law_lower_4 = w[LAW_LOWER + 4]
    law_lower_5 = w[LAW_LOWER + 5]
    law_lower_6 = w[LAW_LOWER + 6]
    law_lower_7 = w[LAW_LOWER + 7]
    law_lower_8 = w[LAW_LOWER + 8]
    law_lower_9 = w[LAW_LOWER + 9]
    law_reciprocal_0 = w[LAW_RECIPROCAL]
    law_reciprocal_1 = w[LAW_RECIPROCAL + 1]
    law_reciprocal_2 = w[LAW_RECIPROCAL + 2]
    law_reciprocal_3 = w[LAW_RECIPROCAL + 3]
    law_reciprocal_4 = w[LAW_RECIPROCAL + 4]
    residual_0 = w[RESIDUAL]  # P3.x
    residual_1 = w[RESIDUAL + 1]  # P3.y
    residual_2 = w[RESIDUAL + 2]  # P3.z
    residual_3 = w[RESIDUAL + 3]  # P3.first
    residual_4 = w[RESIDUAL + 4]  # P3.second
    mass_entry_0 = w[MASS_ENTRY]
    mass_entry_1 = w[MASS_ENTRY + 1]
    mass_entry_2 = w[MASS_ENTRY + 2]
    mass_entry_3 = w[MASS_ENTRY + 3]
    mass_entry_4 = w[MASS_ENTRY + 4]
    # intermediate terms
    s0 = law_lower_0*residual_0 - residual_1
    s1 = law_lower_1*residual_0 - residual_2 - law_lower_4*s0
    s2 = law_lower_2*residual_0 - residual_3 - law_lower_5*s0 - law_lower_7*s1
    s3 = law_reciprocal_4*(law_lower_3*residual_0 - residual_4 - law_lower_6*s0 - law_lower_8*s1 - law_lower_9*s2)
    s4 = law_reciprocal_3*s2 - law_lower_9*s3
    s5 = law_reciprocal_2*s1 - law_lower_7*s4 - law_lower_8*s3
    s6 = law_reciprocal_1*s0 - law_lower_4*s5 - law_lower_5*s4 - law_lower_6*s3
    s7 = law_reciprocal_0*residual_0 + law_lower_0*s6 + law_lower_1*s5 + law_lower_2*s4 + law_lower_3*s3
    s8 = jacobian_6*s6 - jacobian_1*s7 + jacobian_11*s5 + jacobian_16*s4 + jacobian_20*s3
    s9 = jacobian_8*s6 - jacobian_3*s7 + jacobian_13*s5 + jacobian_22*s3
    s10 = 2.9925187032418954*(jacobian_7*s6 - jacobian_2*s7 + jacobian_12*s5 + jacobian_17*s4 + jacobian_21*s3)
    s11 = 1.0/mass_entry_3
    s12 = mass_entry_1*s11
    s13 = 2.9925187032418954*mass_entry_2
    s14 = jacobian_4*s6 - jacobian_0*s7 + jacobian_9*s5 + jacobian_14*s4 + jacobian_18*s3 - s8*s12 - s9*s13
    s15 = 1.0/(mass_entry_0 - mass_entry_1*s12 - mass_entry_2*s13)*s14
    # outputs
    w[CHANGE] = s15  # P0.angle.rate
    w[CHANGE + 1] = (jacobian_5*s6 + jacobian_10*s5 + jacobian_15*s4 + jacobian_19*s3)*(1.0/mass_entry_4)  # P5.angle.rate
    w[CHANGE + 2] = s8*s11 - s12*s15  # P1.angle.rate
    w[CHANGE + 3] = s10  # P4.angle.rate
    w[CHANGE + 4] = 2.9925187032418954*s9 - s13*s15  # P2.angle.rate
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def geometry(t, y, p, w):
    """What the model's `geometry` leaves, and the factorisation of the law's own metric."""
    geometry_of_model(t, y, p, w)
    refactor(p, w)
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def drift(t, y, p, w):
    """D v - nu with the D and nu that `geometry` left: 41 operations, 41 before sharing."""
    # inputs
    v0 = y[5]  # P0.angle.rate [rad/s]
    v1 = y[6]  # P5.angle.rate [rad/s]
    v2 = y[7]  # P1.angle.rate [rad/s]
    v3 = y[8]  # P4.angle.rate [rad/s]
    v4 = y[9]  # P2.angle.rate [rad/s]
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
    # outputs
    w[RESIDUAL] = v0*jacobian_0 + v2*jacobian_1 + v3*jacobian_2 + v4*jacobian_3  # P3.x
    w[RESIDUAL + 1] = v0*jacobian_4 + v1*jacobian_5 + v2*jacobian_6 + v3*jacobian_7 + v4*jacobian_8  # P3.y
    w[RESIDUAL + 2] = v0*jacobian_9 + v1*jacobian_10 + v2*jacobian_11 + v3*jacobian_12 + v4*jacobian_13  # P3.z
    w[RESIDUAL + 3] = v0*jacobian_14 + v1*jacobian_15 + v2*jacobian_16 + v3*jacobian_17  # P3.first
    w[RESIDUAL + 4] = v0*jacobian_18 + v1*jacobian_19 + v2*jacobian_20 + v3*jacobian_21 + v4*jacobian_22  # P3.second
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    # each helper is called at one place only: the compiler copies it to every place it is called from
    tolerance = p[TOLERANCE] * w[LENGTH_SCALE]
    last = math.inf
    bits = 2
    for round in range(15):
        geometry(t, y, p, w)
        violation = w[POSITION_MEASURE]
        # at the floor of rounding another iteration gains nothing
        stalled = violation > 0.5 * last and violation <= 1e4 * tolerance
        # near a singular position what is left of a violation opens another way: no more than rounding may be left
        near = w[SMALLEST_PIVOT] < 1e-4
        closed = violation <= (0.01 * tolerance if near else tolerance) or stalled or round == 14
        if closed:
            drift(t, y, p, w)  # leaves D v - nu in the section that `spread` corrects
        spread(p, w)
        if closed:
            for j in range(5, 10):
                y[j] += w[CHANGE - 5 + j]
            break
        for j in range(5):
            y[j] += w[CHANGE + j]
        last = violation
        iw[ITERATIONS] += 1
    if not violation <= 1e4 * tolerance:
        iw[FAILURES] += 1
        bits |= 1
    measure(t, y, p, w)
    return bits


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(5):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(5):
        w[MASK + i] = w[SAVED + i]
    iw[SUSPECTS] += 1
    if skipped == 0:
        iw[LIGHT] += 1
    return 0
