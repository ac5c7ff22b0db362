"""Method `direct-correction` for model `andrews`. Emitted by symgen; do not edit.

positions and velocities are projected after each step with the pseudoinverse of D
Marques, Souto, Flores, Multibody Syst. Dyn. 39 (2017) 385-419, doi 10.1007/s11044-016-9530-y; Yoon, Howe, Greenwood, J. Mech. Des. 116 (1994) 1058-1064
digest 6cfd7ff3628f6b29fbe41b0d996b2b41bc32e77ad16c1372c56290eeefe62746, format 1, templates 8f8565515c2742ad
option weight = identity
p[4] tolerance (default 1e-13)
"""

import math

from numba import njit

from .model import drift, energies, geometry, spread

PHI = 68  # sections of w
DRIFT = 108
PIVOT = 128
MASK = 28
RIGHT = 148
CHANGE = 168
SAVED = 48


@njit(error_model="numpy", fastmath={"contract"})
def prepare(p):
    """numbers that depend on parameters alone: 3 operations, 3 before sharing."""
    # inputs
    p0 = p[0]  # drive_torque [N m]
    p1 = p[1]  # spring_stiffness [N/m]
    p2 = p[2]  # spring_length [m]
    # outputs
    p[5] = 0.5*p1
    p[6] = 2.0*p2
    p[7] = 455788.5141294439*p0
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def rhs(t, y, p, w, iw, ydot):
    """q', v', power and multipliers by direct-correction; 1 where a pivot of S is suspicious: 1057 operations, 7648249031 before sharing."""
    # inputs
    p0 = p[0]  # drive_torque [N m]
    v0 = y[21]  # K1.vx [m/s]
    v1 = y[22]  # K1.vy [m/s]
    q2 = y[2]  # K1.theta [rad]
    v2 = y[23]  # K1.omega [rad/s]
    v3 = y[24]  # K2.vx [m/s]
    v4 = y[25]  # K2.vy [m/s]
    q5 = y[5]  # K2.theta [rad]
    v5 = y[26]  # K2.omega [rad/s]
    q6 = y[6]  # K3.x [m]
    v6 = y[27]  # K3.vx [m/s]
    q7 = y[7]  # K3.y [m]
    v7 = y[28]  # K3.vy [m/s]
    q8 = y[8]  # K3.theta [rad]
    v8 = y[29]  # K3.omega [rad/s]
    v9 = y[30]  # K4.vx [m/s]
    v10 = y[31]  # K4.vy [m/s]
    q11 = y[11]  # K4.theta [rad]
    v11 = y[32]  # K4.omega [rad/s]
    v12 = y[33]  # K5.vx [m/s]
    v13 = y[34]  # K5.vy [m/s]
    q14 = y[14]  # K5.theta [rad]
    v14 = y[35]  # K5.omega [rad/s]
    v15 = y[36]  # K6.vx [m/s]
    v16 = y[37]  # K6.vy [m/s]
    q17 = y[17]  # K6.theta [rad]
    v17 = y[38]  # K6.omega [rad/s]
    v18 = y[39]  # K7.vx [m/s]
    v19 = y[40]  # K7.vy [m/s]
    q20 = y[20]  # K7.theta [rad]
    v20 = y[41]  # K7.omega [rad/s]
    p5 = p[5]
    p6 = p[6]
    mask_0 = w[28]
    mask_1 = w[29]
    mask_2 = w[30]
    mask_3 = w[31]
    mask_4 = w[32]
    mask_5 = w[33]
    mask_6 = w[34]
    mask_7 = w[35]
    mask_8 = w[36]
    mask_9 = w[37]
    mask_10 = w[38]
    mask_11 = w[39]
    mask_12 = w[40]
    mask_13 = w[41]
    mask_14 = w[42]
    mask_15 = w[43]
    mask_16 = w[44]
    mask_17 = w[45]
    mask_18 = w[46]
    mask_19 = w[47]
    p7 = p[7]
    # intermediate terms
    s0 = math.cos(q2)
    s1 = math.sin(q2)
    s2 = v2*v2
    s3 = 0.00092*s0
    s4 = 0.00092*s1
    s5 = 0.00092*s2
    s6 = math.cos(q5)
    s7 = math.sin(q5)
    s8 = v5*v5
    s9 = 0.0115*s6
    s10 = 0.00608*s0
    s11 = 0.0115*s7
    s12 = 0.00608*s1
    s13 = 0.00608*s2
    s14 = 0.0115*s8
    s15 = math.cos(q8)
    s16 = math.sin(q8)
    s17 = v8*v8
    s18 = 0.01043*s15
    s19 = 0.0165*s6
    s20 = 0.01043*s16
    s21 = 0.0165*s7
    s22 = 0.016260000000000004*s15 + s20
    s23 = 0.0165*s8
    s24 = s6*s23
    s25 = 0.016260000000000004*s17
    s26 = 0.01043*s17
    s27 = s15*s26
    s28 = 0.016260000000000004*s16 - s18
    s29 = s7*s23
    s30 = s16*s26
    s31 = math.cos(q11)
    s32 = math.sin(q11)
    s33 = v11*v11
    s34 = 0.01421*s32
    s35 = 0.01421*s31
    s36 = 0.01421*s33
    s37 = math.cos(q17)
    s38 = math.sin(q17)
    s39 = v17*v17
    s40 = 0.01421*s37
    s41 = 0.01421*s38
    s42 = 0.01421*s39
    s43 = s20 - 0.01874*s15
    s44 = 0.01874*s17
    s45 = s18 + 0.01874*s16
    s46 = math.cos(q14)
    s47 = math.sin(q14)
    s48 = v14*v14
    s49 = 0.00579*s32
    s50 = 0.02308*s47
    s51 = 0.02308*s46
    s52 = 0.00579*s31
    s53 = s51 - 0.03084*s47
    s54 = 0.00579*s33
    s55 = 0.02308*s48
    s56 = s47*s55
    s57 = 0.03084*s48
    s58 = 0.03084*s46 + s50
    s59 = s46*s55
    s60 = math.cos(q20)
    s61 = math.sin(q20)
    s62 = v20*v20
    s63 = 0.00449*s60
    s64 = 0.00579*s37
    s65 = 0.00449*s61
    s66 = 0.00579*s38
    s67 = 0.02772*s60 + s65
    s68 = 0.00579*s39
    s69 = 0.02772*s62
    s70 = 0.00449*s62
    s71 = s60*s70
    s72 = 0.02772*s61 - s63
    s73 = s61*s70
    s74 = s51 + 0.00916*s47
    s75 = 0.00916*s48
    s76 = s46*s75 - s56
    s77 = s50 - 0.00916*s46
    s78 = s65 - 0.01228*s60
    s79 = 0.01228*s62
    s80 = s71 + s61*s79
    s81 = s63 + 0.01228*s61
    s82 = q7 + 0.0007400000000000011*s15 + 0.00957*s16 - 0.072
    s83 = q6 + 0.00957*s15 - 0.0007400000000000011*s16
    s84 = s83 - 0.014
    s85 = math.sqrt(s82*s82 + s84*s84)
    s86 = 1.0/s85
    s87 = s15*(s86*(0.00957*s82 + 0.0007400000000000011*(0.014 - s83))) - s16*(s86*(0.0007400000000000011*s82 + 0.00957*s84))
    s88 = p5*(2.0*s85 - p6)
    s89 = s84*s86*s88
    s90 = s82*s86*s88
    s91 = s87*s88
    s92 = 42.14075010535187*s89
    s93 = 42.14075010535187*s90
    s94 = 190294.95718363466*s91
    s95 = s0*s5 + s4*p7
    s96 = s27 + s16*s44 - (s92 + s43*s94)
    s97 = 419.32543299908843*s1
    s98 = 419.32543299908843*s0
    s99 = 2771.194165907019*s1
    s100 = 26077.097505668935*s7
    s101 = 26077.097505668935*s6
    s102 = 37414.965986394556*s7
    s103 = 190294.95718363466*s22
    s104 = 37414.965986394556*s6
    s105 = 190294.95718363466*s28
    s106 = 25074.995588494796*s31
    s107 = 25074.995588494796*s32
    s108 = 25074.995588494796*s38
    s109 = 25074.995588494796*s37
    s110 = 190294.95718363466*s43
    s111 = 10217.046056114346*s31
    s112 = 85543.1993156544*s53
    s113 = 85543.1993156544*s58
    s114 = 10217.046056114346*s38
    s115 = 52301.25523012552*s67
    s116 = 52301.25523012552*s72
    s117 = 85543.1993156544*s74
    s118 = 52301.25523012552*s78
    s119 = s3*s97
    s120 = -23.121387283236995 + s12*s97
    s121 = s10*s97
    s122 = 23.121387283236995 + s3*s98
    s123 = 273.972602739726 + 23.121387283236995 + s12*s99 + s11*s100
    s124 = -273.972602739726 + s21*s100
    s125 = s19*s100
    s126 = 273.972602739726 + 23.121387283236995 + s10*(2771.194165907019*s0) + s9*s101
    s127 = 273.972602739726 + s21*s102
    s128 = 42.14075010535187 + s127 + s22*s103
    s129 = s19*s102
    s130 = 42.14075010535187 + s43*s103
    s131 = 273.972602739726 + s19*s104
    s132 = 42.14075010535187 + s131 + s28*s105
    s133 = s43*s105
    s134 = 141.64305949008497 + s127
    s135 = s134 + s35*s106
    s136 = -141.64305949008497 + s52*s106
    s137 = 141.64305949008497 + s131
    s138 = s137 + s34*s107
    s139 = s52*s107
    s140 = s134 + s41*s108
    s141 = -141.64305949008497 + s66*s108
    s142 = s137 + s40*s109
    s143 = s66*s109
    s144 = s45*s110
    s145 = 42.14075010535187 + s45*(190294.95718363466*s45)
    s146 = 14.184397163120568 + 141.64305949008497 + s52*s111 + s53*s112
    s147 = 14.184397163120568 + s74*s112
    s148 = 14.184397163120568 + 141.64305949008497 + s49*(10217.046056114346*s32) + s58*s113
    s149 = s74*s113
    s150 = 18.188432157148053 + 141.64305949008497 + s66*s114 + s67*s115
    s151 = 18.188432157148053 + s78*s115
    s152 = 18.188432157148053 + 141.64305949008497 + s64*(10217.046056114346*s37) + s72*s116
    s153 = s78*s116
    s154 = s77*s117
    s155 = 14.184397163120568 + s77*(85543.1993156544*s77)
    s156 = s81*s118
    s157 = 18.188432157148053 + s81*(52301.25523012552*s81)
    s158 = 1.0/(mask_0 + 23.121387283236995 + s4*s97)
    s159 = s119*s158
    s160 = s120*s158
    s161 = s121*s158
    s162 = s120*s159 - s12*s98
    s163 = -23.121387283236995 + s10*s98 - s121*s159
    s164 = mask_1 + s122 - s119*s159
    s165 = 1.0/s164
    s166 = s162*s165
    s167 = s163*s165
    s168 = s121*s160 - (s10*s99 + s9*s100) - s163*s166
    s169 = 1.0/(mask_10 + 42.14075010535187 + s43*s110)
    s170 = s144*s169
    s171 = s130*s169
    s172 = s133*s169
    s173 = s130*s170 - s45*s103
    s174 = 42.14075010535187 - s45*s105 + s133*s170
    s175 = mask_11 + s145 - s144*s170
    s176 = 1.0/s175
    s177 = s173*s176
    s178 = s174*s176
    s179 = 1.0/(mask_16 + 14.184397163120568 + s74*s117)
    s180 = s154*s179
    s181 = s147*s179
    s182 = s149*s179
    s183 = s77*s112 - s147*s180
    s184 = 14.184397163120568 + s77*s113 - s149*s180
    s185 = mask_17 + s155 - s154*s180
    s186 = 1.0/s185
    s187 = s183*s186
    s188 = s184*s186
    s189 = s49*s111 + s58*s112 - s149*s181 - s184*s187
    s190 = 1.0/(mask_18 + 18.188432157148053 + s78*s118)
    s191 = s156*s190
    s192 = s151*s190
    s193 = s153*s190
    s194 = s151*s191 - s81*s115
    s195 = 18.188432157148053 - s81*s116 + s153*s191
    s196 = mask_19 + s157 - s156*s191
    s197 = 1.0/s196
    s198 = s194*s197
    s199 = s195*s197
    s200 = s72*s115 - s64*s114 - s153*s192 - s195*s198
    s201 = mask_12 + s146 - s147*s181 - s183*s187
    s202 = 1.0/s201
    s203 = s189*s202
    s204 = s136*s202
    s205 = s139*s202
    s206 = s49*s106 - s136*s203
    s207 = -141.64305949008497 + s49*s107 - s139*s203
    s208 = mask_13 + s148 - s149*s182 - s184*s188 - s189*s203
    s209 = 1.0/s208
    s210 = s206*s209
    s211 = s207*s209
    s212 = mask_14 + s150 - s151*s192 - s194*s198
    s213 = 1.0/s212
    s214 = s200*s213
    s215 = s141*s213
    s216 = s143*s213
    s217 = s64*s108 + s141*s214
    s218 = -141.64305949008497 + s64*s109 + s143*s214
    s219 = mask_15 + s152 - s153*s193 - s195*s199 - s200*s214
    s220 = 1.0/s219
    s221 = s217*s220
    s222 = s218*s220
    s223 = mask_2 + s123 - s120*s160 - s162*s166
    s224 = 1.0/s223
    s225 = s168*s224
    s226 = s124*s224
    s227 = s125*s224
    s228 = s21*s101 + s124*s225
    s229 = -273.972602739726 + s19*s101 + s125*s225
    s230 = s124*s226
    s231 = s125*s226
    s232 = s125*s227
    s233 = mask_3 + s126 - s121*s161 - s163*s167 - s168*s225
    s234 = 1.0/s233
    s235 = s228*s234
    s236 = s229*s234
    s237 = s228*s235
    s238 = s229*s235
    s239 = s28*s103 - s129 - s133*s171 - s174*s177 + s231 + s238
    s240 = s127 - s230 - s237
    s241 = s231 - s129 + s238
    s242 = s229*s236
    s243 = s124*s227 - s21*s104 + s228*s236
    s244 = s131 - s232 - s242
    s245 = mask_4 + s128 - s130*s171 - s173*s177 - s230 - s237
    s246 = 1.0/s245
    s247 = s239*s246
    s248 = s240*s246
    s249 = s241*s246
    s250 = s243 - s240*s247
    s251 = s244 - s241*s247
    s252 = s240*s248
    s253 = s241*s248
    s254 = s241*s249
    s255 = mask_5 + s132 - s133*s172 - s174*s178 - s232 - s242 - s239*s247
    s256 = 1.0/s255
    s257 = s250*s256
    s258 = s251*s256
    s259 = s250*s257
    s260 = s251*s257
    s261 = s34*s106 - s129 - s139*s204 - s207*s210 + s231 + s238 - s253 - s260
    s262 = s240 - s252 - s259
    s263 = s241 - s253 - s260
    s264 = s251*s258
    s265 = mask_6 + s135 - s136*s204 - s206*s210 - s230 - s237 - s252 - s259
    s266 = 1.0/s265
    s267 = s261*s266
    s268 = s262*s266
    s269 = s263*s266
    s270 = s243 - s240*s249 - s250*s258 - s262*s267
    s271 = s244 - s254 - s264 - s263*s267
    s272 = mask_7 + s138 - s139*s205 - s207*s211 - s232 - s242 - s254 - s264 - s261*s267
    s273 = 1.0/s272
    s274 = s270*s273
    s275 = s271*s273
    s276 = s143*s215 - (s129 + s40*s108) + s218*s221 + s231 + s238 - s253 - s260 - s263*s268 - s271*s274
    s277 = mask_8 + s140 - s141*s215 - s217*s221 - s230 - s237 - s252 - s259 - s262*s268 - s270*s274
    s278 = 1.0/s277
    s279 = s276*s278
    s280 = s142 - s143*s216 - s218*s222 - s232 - s242 - s254 - s264 - s263*s269 - s271*s275 - s276*s279
    s281 = mask_9 + s280
    s282 = s1*s5 - s3*p7 + s95*s159
    s283 = s12*p7 - (s6*s14 - s0*s13) - s95*s160 - s166*s282
    s284 = s45*s94 - s93 - (s15*s44 - s30) + s96*s170
    s285 = s59 + s47*s75 - s76*s180
    s286 = s32*s54 + s56 + s46*s57 + s76*s181 + s187*s285
    s287 = s73 - s60*s79 + s80*s191
    s288 = s71 - (s37*s68 + s61*s69) - s80*s192 - s198*s287
    s289 = s31*s54 - s47*s57 + s59 - s76*s182 - s188*s285 + s203*s286
    s290 = s73 - s38*s68 + s60*s69 - s80*s193 - s199*s287 - s214*s288
    s291 = s95*s161 - (s7*s14 - s1*s13 + s10*p7) - s167*s282 - s225*s283
    s292 = s226*s283
    s293 = s227*s283
    s294 = s235*s291
    s295 = s294 - (s24 + s16*s25 - s27 + s92 + s22*s94 + s96*s171 + s177*s284 + s292)
    s296 = s236*s291
    s297 = s30 - s29 + s15*s25 - (s93 + s28*s94) - s96*s172 - s178*s284 + s293 - s296 - s247*s295
    s298 = s248*s295
    s299 = s249*s295
    s300 = s257*s297
    s301 = s204*s286 - (s24 + s32*s36) - s210*s289 - s292 + s294 - s298 - s300
    s302 = s258*s297
    s303 = s31*s36 - s29 + s205*s286 - s211*s289 + s293 - s296 - s299 - s302 - s267*s301
    s304 = s221*s290 - (s24 + s37*s42 + s215*s288) - s292 + s294 - s298 - s300 - s268*s301 - s274*s303
    s305 = s216*s288 - (s29 + s38*s42) - s222*s290 + s293 - s296 - s299 - s302 - s269*s301 - s275*s303
    s306 = 1.0/s281*(s305 - s279*s304)
    s307 = s278*s304
    s308 = s279*s306
    s309 = s307 - s308
    s310 = s273*s303 - s274*s309
    s311 = s275*s306
    s312 = s310 - s311
    s313 = s266*s301 - s267*s312 - s268*s309
    s314 = s269*s306
    s315 = s313 - s314
    s316 = s256*s297 - s257*s315 - s258*s312 - s257*s309
    s317 = s258*s306
    s318 = s316 - s317
    s319 = s246*s295 - s247*s318 - s248*s315 - s249*s312 - s248*s309
    s320 = s249*s306
    s321 = s319 - s320
    s322 = s234*s291 + s235*s321 - s236*s318 + s235*s315 - s236*s312 + s235*s309
    s323 = s236*s306
    s324 = s322 - s323
    s325 = s224*s283 - s225*s324 - s226*s321 + s227*s318 - s226*s315 + s227*s312 - s226*s309 + s227*s306
    s326 = s220*s290 + s221*s309
    s327 = s222*s306
    s328 = s326 - s327
    s329 = s213*s288 - s214*s328 - s215*s309 + s216*s306
    s330 = s209*s289 - s210*s315
    s331 = s211*s312
    s332 = s330 - s331
    s333 = s202*s286 + s203*s332 + s204*s315 + s205*s312
    s334 = s197*s287 - s198*s329 - s199*s328
    s335 = s80*s190 + s191*s334 - s192*s329 - s193*s328
    s336 = s186*s285 + s187*s333 - s188*s332
    s337 = s76*s179 - s180*s336 + s181*s333 - s182*s332
    s338 = s176*s284 - s177*s321 - s178*s318
    s339 = s96*s169 + s170*s338 - s171*s321 - s172*s318
    s340 = s165*s282 - s166*s325 - s167*s324
    s341 = s95*s158 + s159*s340 - s160*s325 + s161*s324
    s342 = 2267573.6961451247*(s9*s324 - s11*s325 - s21*s321 + s19*s318 - s21*s315 + s19*s312 - s21*s309 + s19*s306)
    s343 = ((((s164 < 1e-06*s122) | (s175 < 1e-06*s145)) | (s185 < 1e-06*s155)) | (s196 < 1e-06*s157))
    s344 = ((((s343 | (s201 < 1e-06*s146)) | (s208 < 1e-06*s148)) | (s212 < 1e-06*s150)) | (s219 < 1e-06*s152))
    s345 = ((((s344 | (s223 < 1e-06*s123)) | (s233 < 1e-06*s126)) | (s245 < 1e-06*s128)) | (s255 < 1e-06*s132))
    s346 = ((((s345 | (s265 < 1e-06*s135)) | (s272 < 1e-06*s138)) | (s277 < 1e-06*s140)) | (s281 < 1e-06*s142))
    # outputs
    ydot[0] = v0
    ydot[1] = v1
    ydot[2] = v2
    ydot[3] = v3
    ydot[4] = v4
    ydot[5] = v5
    ydot[6] = v6
    ydot[7] = v7
    ydot[8] = v8
    ydot[9] = v9
    ydot[10] = v10
    ydot[11] = v11
    ydot[12] = v12
    ydot[13] = v13
    ydot[14] = v14
    ydot[15] = v15
    ydot[16] = v16
    ydot[17] = v17
    ydot[18] = v18
    ydot[19] = v19
    ydot[20] = v20
    ydot[21] = 23.121387283236995*(s325 - s341)
    ydot[22] = -23.121387283236995*(s340 + s323 - s322)
    ydot[23] = 455788.5141294439*(p0 - (s4*s341 - s3*s340 + s12*s325 - s10*s324))
    ydot[24] = -273.972602739726*(s325 + s320 - s319 + s314 - s313 + s308 - s307)
    ydot[25] = 273.972602739726*(s306 - (s324 + s317 - s316 + s311 - s310))
    ydot[26] = -s342
    ydot[27] = -42.14075010535187*(s89 + s321 + s339)
    ydot[28] = -42.14075010535187*(s90 + s318 + s338)
    ydot[29] = -190294.95718363466*(s91 + s22*s321 + s28*s318 + s43*s339 - s45*s338)
    ydot[30] = -141.64305949008497*(s315 + s333)
    ydot[31] = -141.64305949008497*(s312 + s331 - s330)
    ydot[32] = -1764602.082230457*(s35*s315 + s34*s312 - s52*s333 + s49*s332)
    ydot[33] = 14.184397163120568*(s333 - s337)
    ydot[34] = -14.184397163120568*(s332 + s336)
    ydot[35] = -85543.1993156544*(s58*s332 - s53*s333 + s74*s337 + s77*s336)
    ydot[36] = 141.64305949008497*(s329 - s309)
    ydot[37] = -141.64305949008497*(s306 + s327 - s326)
    ydot[38] = -1764602.082230457*(s40*s306 - s41*s309 - s66*s329 + s64*s328)
    ydot[39] = -18.188432157148053*(s329 + s335)
    ydot[40] = -18.188432157148053*(s328 + s334)
    ydot[41] = 52301.25523012552*(s81*s334 - (s67*s329 + s72*s328 + s78*s335))
    ydot[42] = p0*v2
    w[8] = s341
    w[9] = s340
    w[10] = s325
    w[11] = s324
    w[12] = s321
    w[13] = s318
    w[14] = s315
    w[15] = s312
    w[16] = s309
    w[17] = s306
    w[18] = s339
    w[19] = s338
    w[20] = -s333
    w[21] = s332
    w[22] = s329
    w[23] = s328
    w[24] = s337
    w[25] = s336
    w[26] = s335
    w[27] = s334
    return int(s346)


@njit(error_model="numpy", fastmath={"contract"})
def confirm(t, y, p, w, iw, ydot):
    """Evaluate again with the rows that D D^T keeps, `rhs` having found a suspicious pivot of S."""
    geometry(t, y, p, w)
    skipped = 0
    for i in range(20):
        w[SAVED + i] = w[MASK + i]
        if w[PIVOT + i] < 1e-12:
            w[MASK + i] = math.inf
            skipped += 1
    rhs(t, y, p, w, iw, ydot)
    for i in range(20):
        w[MASK + i] = w[SAVED + i]
    iw[1] += 1
    if skipped == 0:
        iw[2] += 1
    return 0


@njit(error_model="numpy", fastmath={"contract"})
def norm(w, first):
    """Euclidean norm of a section of 20 rows."""
    total = 0.0
    for i in range(first, first + 20):
        total += w[i] * w[i]
    return math.sqrt(total)


@njit(error_model="numpy", fastmath={"contract"})
def accept(t, y, p, w, iw):
    """Correct an accepted state and measure it; bit 1: the correction failed, bit 2: the state was changed."""
    bits = 0
    geometry(t, y, p, w)
    violation = norm(w, PHI)
    tolerance = p[4] * w[6]
    last = math.inf
    for _ in range(12):
        # at the floor of rounding another iteration gains nothing
        if violation <= tolerance or (violation > 0.5 * last and violation <= 1e4 * tolerance):
            break
        last = violation
        for i in range(20):
            w[RIGHT + i] = -w[PHI + i]
        spread(p, w)
        for j in range(21):
            y[j] += w[CHANGE + j]
        iw[3] += 1
        bits |= 2
        geometry(t, y, p, w)
        violation = norm(w, PHI)
    if not violation <= 1e4 * tolerance:
        iw[4] += 1
        bits |= 1
    drift(y, w)
    for i in range(20):
        w[RIGHT + i] = -w[DRIFT + i]
    spread(p, w)
    for j in range(21):
        y[21 + j] += w[CHANGE + j]
    drift(y, w)
    bits |= 2
    energies(t, y, p, w)
    smallest = 1.0
    rank = 0
    for i in range(20):
        pivot = w[PIVOT + i]
        if pivot >= 1e-12:
            rank += 1
        if w[MASK + i] == 0.0 and pivot < smallest:
            smallest = pivot
    w[0] = violation
    w[1] = norm(w, DRIFT)
    w[4] = smallest
    w[5] = rank
    return bits
