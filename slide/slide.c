/* slide: equations of motion by the method direct-correction, C99. Written by symgen; the same mechanism gives the same bytes. */
#include "slide.h"

#include <math.h>
#include <string.h>

typedef slide mechanism;
typedef slide_real real;
#ifdef SLIDE_SINGLE
#define M(function) function##f
#define SMALL(x) 1.2e-38f
#define LARGE(x) 3.4e38f
#define FINE(x, single) single
#define EPSILON 1.2e-7f
#else
#define M(function) function
#define SMALL(x) x
#define LARGE(x) x
#define FINE(x, single) x
#define EPSILON 2.2e-16
#endif
enum { NQ = SLIDE_NQ, NV = SLIDE_NV, NY = SLIDE_NY, ROWS = SLIDE_M };

/* -- emitted functions -------------------------------------------------------------------------------------------- */

static real least(real a, real b) { return b < a ? b : a; }

static real greatest(real a, real b) { return b > a ? b : a; }

static int least_of_integers(int a, int b) { return b < a ? b : a; }

static real square(real x) { return x*x; }

static int rest_of_integers(int a, int b) { return b == 0 ? 0 : a % b + ((a % b && (a < 0) != (b < 0)) ? b : 0); }

static const int table_entries[] = {0, 0, -1, 1, 2, -1};

static const real table_constants[] = {-1.0, 1.0};

static const real table_lengths[] = {1.0, 1.0, 0.0};

static const int table_spin[] = {-1, -1, 2};

static const int table_rows[] = {0, 1, 0, 0};

static const int table_1[] = {6, 7, 11, 29, 30, 37, 38, 39, 40, 41};

static int rhs(real t, const real *restrict y, const real *restrict p, real *restrict w, const int *restrict iw, real
*restrict ydot) {
(void)iw;
const real q1 = y[1];
const real v0 = y[3];
const real v1 = y[4];
const real v2 = y[5];
const real p3 = p[3];
const real s0 = 0.01*t - q1;
const real s1 = s0 > 0.0 ? greatest(1000.0*s0 - (v1 + -0.01)*p3, 0.0) : 0.0;
ydot[0] = v0;
ydot[1] = v1;
ydot[2] = v2;
ydot[3] = 0.0;
ydot[4] = 0.5*(s1 + -20.0);
ydot[5] = 0.0;
ydot[6] = v1*s1;
w[19] = 0.0;
w[20] = 0.0;
return 0;
}

static int geometry_2(real t, const real *restrict y, const real *restrict p, real *restrict w) {
(void)t;
(void)p;
const real q0 = y[0];
const real q2 = y[2];
const real gauge_2 = w[39];
const real status_6 = w[6];
const real row_weight_1 = w[41];
const real s0 = q2*status_6;
const real s1 = q0*q0;
w[25] = -q0;
w[26] = q2;
w[0] = M(sqrt)(s1 + q2*q2);
w[8] = M(sqrt)(s1 + s0*s0);
w[5] = 2.0;
w[4] = 1.0;
w[10] = least(1.0, gauge_2*row_weight_1);
w[42] = 1.0/gauge_2;
return 0;
}

static int refactor(const real *restrict p, const real *restrict w) {
(void)p;
(void)w;
return 0;
}

static int geometry(real t, const real *restrict y, const real *restrict p, real *restrict w) {
geometry_2(t, y, p, w);
refactor(p, w);
return 0;
}

static int measure(real t, const real *restrict y, const real *restrict p, real *restrict w) {
(void)t;
(void)p;
const real q1 = y[1];
const real v0 = y[3];
const real v1 = y[4];
const real v2 = y[5];
const real status_6 = w[6];
const real s0 = v2*v2;
const real s1 = v0*v0;
const real s2 = v2*status_6;
w[25] = -v0;
w[26] = v2;
w[1] = M(sqrt)(s0 + s1);
w[9] = M(sqrt)(s1 + s2*s2);
w[2] = s1 + v1*v1 + 0.05*s0;
w[3] = 20.0*q1;
return 0;
}

static int spread(const real *restrict p, real *restrict w) {
(void)p;
const real residual_0 = w[25];
const real residual_1 = w[26];
w[31] = residual_0;
w[32] = 0.0;
w[33] = -residual_1;
return 0;
}

static int accept(real t, real *restrict y, const real *restrict p, real *restrict w, int *restrict iw) {
real last = 0;
int bits = 0;
int round_ = 0;
real violation = 0;
int stalled = 0;
int near_ = 0;
int closed = 0;
int j = 0;
const real tolerance = p[4]*w[6];
last = INFINITY;
bits = 2;
for (int counter1 = 0, end = 15; counter1 < end; counter1 += 1) {
round_ = counter1;
geometry(t, y, p, w);
violation = w[8];
stalled = violation > 0.5*last && violation <= 10000.0*tolerance;
near_ = w[4] < 0.0001;
closed = violation <= (near_ ? 0.01*tolerance : tolerance) || (stalled || round_ == 14);
if (closed) {
measure(t, y, p, w);
}
spread(p, w);
if (closed) {
for (int counter2 = 3, end = 6; counter2 < end; counter2 += 1) {
j = counter2;
y[j] = y[j] + w[31 - 3 + j];
}
break;
}
for (int counter3 = 0, end = 3; counter3 < end; counter3 += 1) {
j = counter3;
y[j] = y[j] + w[31 + j];
}
last = violation;
iw[3] = iw[3] + 1;
}
if (!(violation <= 10000.0*tolerance)) {
iw[4] = iw[4] + 1;
bits = bits | 1;
}
measure(t, y, p, w);
return bits;
}

static int masses(const real *restrict p, real *restrict w) {
(void)p;
w[34] = 2.0;
w[35] = 2.0;
w[36] = 0.1;
return 0;
}

static int prepare_model(const real *restrict p) {
(void)p;
return 0;
}

static int prepare_law(real *restrict p) {
const real p0 = p[0];
p[3] = 20.0*p0;
return 0;
}

static int formulas_of_outputs(real t, const real *restrict y, const real *restrict p, const real *restrict w, const
real *restrict ydot, real *restrict out) {
(void)w;
(void)ydot;
const real p0 = p[0];
const real q1 = y[1];
const real v1 = y[4];
const real s0 = 0.01*t - q1;
out[0] = s0 > 0.0 ? greatest(1000.0*s0 - (v1 + -0.01)*(20.0*p0), 0.0) : 0.0;
return 0;
}

static int check_numbers(mechanism *model) {
int finite_ = 0;
int i = 0;
real __1 = 0;
int decided__2 = 0;
int j = 0;
int __3 = 0;
real __4 = 0;
real __5 = 0;
int decided__6 = 0;
finite_ = 1;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
i = counter1;
if (finite_) {
__1 = model->y[i];
decided__2 = M(fabs)(__1) < INFINITY;
} else {
decided__2 = 0;
}
finite_ = decided__2;
}
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
j = counter2;
if (finite_ && !(model->w[34 + j] > 0.0)) {
__3 = j;
__4 = model->w[34 + j];
model->start_summary[3] = (real)__3;
model->start_summary[4] = __4;
return 2;
}
}
for (int counter3 = 0, end = 5; counter3 < end; counter3 += 1) {
i = counter3;
if (finite_) {
__5 = model->p[i];
decided__6 = M(fabs)(__5) < INFINITY;
} else {
decided__6 = 0;
}
finite_ = decided__6;
}
return finite_ ? 0 : 1;
}

static real entry_of(const real *w, int k) {
const int slot = table_entries[3*k + 2];
return slot < 0 ? table_constants[k] : w[42 + slot];
}

static real extent_of(const real *y) {
real largest = 0;
int i = 0;
real away = 0;
real __1 = 0;
int decided__2 = 0;
largest = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
i = counter1;
away = M(fabs)(y[i] - 0.0);
if (table_lengths[i] != 0.0 && away > largest) {
__1 = away;
decided__2 = M(fabs)(__1) < INFINITY;
} else {
decided__2 = 0;
}
if (decided__2) {
largest = away;
}
}
return largest;
}

static real larger(real a, real b) {
return b > a ? b : a;
}

static real coarseness_of(const real *y) {
real largest = 0;
int i = 0;
real __1 = 0;
int decided__2 = 0;
largest = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
i = counter1;
if (table_lengths[i] != 0.0 && M(fabs)(y[i]) > largest) {
__1 = y[i];
decided__2 = M(fabs)(__1) < INFINITY;
} else {
decided__2 = 0;
}
if (decided__2) {
largest = M(fabs)(y[i]);
}
}
return largest;
}

static real turning_length(mechanism *model) {
real step = 0;
int i = 0;
int j = 0;
int row = 0;
real way = 0;
real size = 0;
real change = 0;
real length = 0;
int k = 0;
int here = 0;
int __3 = 0;
real __4 = 0;
real __5 = 0;
real before = 0;
real after = 0;
real __6 = 0;
const real __2 = larger(FINE(1e-12, 0.000537), 8.0*FINE(2.220446049250313e-16, 1.19e-07)*coarseness_of(model->y));
step = __2;
for (int counter1 = 0, end = 43; counter1 < end; counter1 += 1) {
i = counter1;
model->start_w[i] = model->w[i];
}
while (step < 1000000000000.0) {
j = 0;
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
i = counter2;
model->start_y[i] = model->y[i];
if (table_lengths[i] != 0.0) {
while (table_spin[j] >= 0) {
j = j + 1;
}
model->start_y[i] = model->start_y[i] + step*M(cos)((real)j + 1.0);
j = j + 1;
}
}
geometry(0.0, model->start_y, model->p, model->start_w);
row = -1;
way = 0.0;
size = 0.0;
change = 0.0;
length = 0.0;
for (int counter3 = 0, end = 3; counter3 < end; counter3 += 1) {
k = counter3;
here = k == 2 ? -2 : table_entries[3*k];
if (here != row) {
if (change >= 0.1*0.1*size && size > 0.0) {
length = larger(length, M(sqrt)(way*size/change));
}
__3 = here;
row = __3;
way = 0.0;
size = 0.0;
change = 0.0;
}
if (here >= 0 && (table_rows[2*here + 1] == 1 && table_spin[table_entries[3*k + 1]] < 0)) {
__4 = entry_of(model->w, k);
__5 = entry_of(model->start_w, k);
before = __4;
after = __5;
way = way + square(step*M(cos)((real)table_entries[3*k + 1] + 1.0));
size = size + before*before;
change = change + square(after - before);
}
}
if (length > 0.0) {
__6 = length;
return M(fabs)(__6) < INFINITY ? length : 0.0;
}
step = step*4.0;
}
return 0.0;
}

static real gyration_of(mechanism *model) {
real largest = 0;
int j = 0;
int first = 0;
largest = 0.0;
for (int counter1 = 1, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
first = table_spin[j];
if (first > 0 && model->w[34 + first - 1] > 0.0) {
largest = larger(largest, model->w[34 + j]/model->w[34 + first - 1]);
}
}
return largest;
}

static real mean_mass(mechanism *model) {
real total = 0;
int j = 0;
total = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
total = total + model->w[34 + j]*model->w[37 + j];
}
return total != 0.0 ? total/3.0 : 1.0;
}

static int measure_lengths(mechanism *model) {
int j = 0;
int joint = 0;
real longest = 0;
int k = 0;
int here = 0;
real value = 0;
real __1 = 0;
real square_ = 0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
model->w[37 + j] = 1.0;
model->start_x[j] = 0.0;
model->start_scale[j] = 0.0;
}
geometry(0.0, model->y, model->p, model->w);
joint = -1;
longest = 0.0;
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
k = counter2;
here = k == 2 ? -2 : table_rows[2*table_entries[3*k]];
if (here != joint) {
for (int counter3 = 0, end = 3; counter3 < end; counter3 += 1) {
j = counter3;
model->start_x[j] = 4.0*model->start_scale[j] > model->start_x[j] ? 4.0*model->start_scale[j] : model->start_x[j];
longest = model->start_x[j] > longest ? model->start_x[j] : longest;
model->start_scale[j] = 0.0;
}
joint = here;
}
if (here >= 0 && (table_rows[2*table_entries[3*k] + 1] == 1 && table_spin[table_entries[3*k + 1]] >= 0)) {
value = entry_of(model->w, k);
__1 = value;
if (M(fabs)(__1) < INFINITY) {
model->start_scale[table_spin[table_entries[3*k + 1]]] = model->start_scale[table_spin[table_entries[3*k + 1]]] +
value*value;
}
}
}
const real extent = extent_of(model->y);
longest = longest > 0.0 ? longest : square(turning_length(model));
const real __2 = extent*extent;
const real __3 = gyration_of(model);
const real apart = __2;
const real gyration = __3;
longest = longest > 0.0 ? longest : (apart > FINE(1e-06, 0.001)*gyration ? apart : gyration);
longest = longest > FINE(1e-12, 0.000537)*FINE(1e-12, 0.000537) ? longest : 1.0;
const real least_ = 0.01*0.01*longest;
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
if (table_spin[j] >= 0) {
square_ = model->start_x[table_spin[j]];
square_ = square_ == 0.0 ? longest : square_;
model->w[37 + j] = 1.0/(square_ > least_ ? square_ : least_);
}
}
model->w[6] = larger(M(sqrt)(longest), extent);
model->w[11] = mean_mass(model);
return 0;
}

static real free_scale(mechanism *model, int j) {
return model->w[6]*M(sqrt)(model->w[37 + j]);
}

static int place(mechanism *model, const real *now_0, real *now_2) {
geometry(0.0, now_0, model->p, now_2);
return 0;
}

static int is_off(int row, const real *w) {
(void)row;
(void)w;
return 0;
}

static real row_weight(const real *w, int i) {
return table_rows[2*i + 1] == 1 ? 1.0 : w[6];
}

static real weight_in_force(const real *w, int i) {
return is_off(i, w) ? 0.0 : row_weight(w, i);
}

static int reduce(mechanism *model, real *matrix, int n) {
int k = 0;
real square_ = 0;
int i = 0;
real head = 0;
real size = 0;
real diagonal = 0;
real factor = 0;
int j = 0;
real total = 0;
for (int counter1 = 0, end = n; counter1 < end; counter1 += 1) {
k = counter1;
square_ = 0.0;
for (int counter2 = k, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
square_ = square_ + matrix[5 + i*n + k]*matrix[5 + i*n + k];
}
head = matrix[5 + k*n + k];
size = M(sqrt)(square_);
diagonal = head > 0.0 ? -size : size;
factor = -1.0/(diagonal*(head - diagonal));
matrix[5 + k*n + k] = head - diagonal;
for (int counter3 = k + 1, end = n; counter3 < end; counter3 += 1) {
j = counter3;
total = 0.0;
for (int counter4 = k, end = 2; counter4 < end; counter4 += 1) {
i = counter4;
total = total + matrix[5 + i*n + k]*matrix[5 + i*n + j];
}
total = total*factor;
for (int counter5 = k, end = 2; counter5 < end; counter5 += 1) {
i = counter5;
matrix[5 + i*n + j] = matrix[5 + i*n + j] - total*matrix[5 + i*n + k];
}
}
total = 0.0;
for (int counter6 = k, end = 2; counter6 < end; counter6 += 1) {
i = counter6;
total = total + matrix[5 + i*n + k]*model->start_right[i];
}
total = total*factor;
for (int counter7 = k, end = 2; counter7 < end; counter7 += 1) {
i = counter7;
model->start_right[i] = model->start_right[i] - total*matrix[5 + i*n + k];
}
matrix[5 + k*n + k] = diagonal;
}
return 0;
}

static int least_norm_above(mechanism *model, real *room) {
int i = 0;
int rank = 0;
real first = 0;
int k = 0;
int __1 = 0;
real best = 0;
int at = 0;
int row = 0;
real square_ = 0;
int j = 0;
real __2 = 0;
int __3 = 0;
real size = 0;
int __4 = 0;
int __5 = 0;
real head = 0;
real diagonal = 0;
int other = 0;
real total = 0;
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
model->start_order[i] = i;
}
rank = 0;
first = 0.0;
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
k = counter2;
__1 = k;
best = 0.0;
at = __1;
for (int counter3 = k, end = 2; counter3 < end; counter3 += 1) {
i = counter3;
row = model->start_order[i]*3;
square_ = 0.0;
for (int counter4 = k, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
square_ = square_ + model->start_numbers[row + j]*model->start_numbers[row + j];
}
if (square_ > best) {
__2 = square_;
__3 = i;
best = __2;
at = __3;
}
}
size = M(sqrt)(best);
if (k == 0) {
first = size;
}
if (!(size > FINE(1e-06, 0.001)*first)) {
break;
}
__4 = model->start_order[at];
__5 = model->start_order[k];
model->start_order[k] = __4;
model->start_order[at] = __5;
row = model->start_order[k]*3;
head = model->start_numbers[row + k];
diagonal = head > 0.0 ? -size : size;
model->start_numbers[row + k] = head - diagonal;
room[0 + k] = -1.0/(diagonal*(head - diagonal));
for (int counter5 = k + 1, end = 2; counter5 < end; counter5 += 1) {
i = counter5;
other = model->start_order[i]*3;
total = 0.0;
for (int counter6 = k, end = 3; counter6 < end; counter6 += 1) {
j = counter6;
total = total + model->start_numbers[row + j]*model->start_numbers[other + j];
}
total = total*room[0 + k];
for (int counter7 = k, end = 3; counter7 < end; counter7 += 1) {
j = counter7;
model->start_numbers[other + j] = model->start_numbers[other + j] - total*model->start_numbers[row + j];
}
}
model->start_x[k] = diagonal;
rank = rank + 1;
}
for (int counter8 = 0, end = 2; counter8 < end; counter8 += 1) {
i = counter8;
for (int counter9 = 0, end = least_of_integers(i, rank); counter9 < end; counter9 += 1) {
k = counter9;
room[5 + i*rank + k] = model->start_numbers[model->start_order[i]*3 + k];
}
for (int counter10 = i, end = rank; counter10 < end; counter10 += 1) {
k = counter10;
room[5 + i*rank + k] = k == i ? model->start_x[k] : 0.0;
}
room[3 + i] = model->start_right[model->start_order[i]];
}
for (int counter11 = 0, end = 2; counter11 < end; counter11 += 1) {
i = counter11;
model->start_right[i] = room[3 + i];
}
if (rank < 2) {
reduce(model, room, rank);
for (int counter12 = rank - 1, end = -1; counter12 > end; counter12 += -1) {
k = counter12;
total = model->start_right[k];
for (int counter13 = k + 1, end = rank; counter13 < end; counter13 += 1) {
j = counter13;
total = total - room[5 + k*rank + j]*model->start_x[j];
}
model->start_x[k] = total/room[5 + k*rank + k];
}
} else {
for (int counter14 = 0, end = rank; counter14 < end; counter14 += 1) {
k = counter14;
total = model->start_right[k];
for (int counter15 = 0, end = k; counter15 < end; counter15 += 1) {
j = counter15;
total = total - room[5 + k*rank + j]*model->start_x[j];
}
model->start_x[k] = total/room[5 + k*rank + k];
}
}
for (int counter16 = rank, end = 3; counter16 < end; counter16 += 1) {
j = counter16;
model->start_x[j] = 0.0;
}
for (int counter17 = rank - 1, end = -1; counter17 > end; counter17 += -1) {
k = counter17;
row = model->start_order[k]*3;
total = 0.0;
for (int counter18 = k, end = 3; counter18 < end; counter18 += 1) {
j = counter18;
total = total + model->start_numbers[row + j]*model->start_x[j];
}
total = total*room[0 + k];
for (int counter19 = k, end = 3; counter19 < end; counter19 += 1) {
j = counter19;
model->start_x[j] = model->start_x[j] - total*model->start_numbers[row + j];
}
}
return rank;
}

static int least_norm(mechanism *model, real *room) {
return least_norm_above(model, room);
}

static int dense_change(mechanism *model, const real *now_y, const real *now_w) {
(void)now_y;
int i = 0;
int k = 0;
int __3 = 0;
int __4 = 0;
int row = 0;
int column = 0;
real value = 0;
int j = 0;
real *array__5 = 0;
for (int counter1 = 0, end = 6; counter1 < end; counter1 += 1) {
i = counter1;
model->start_numbers[i] = 0.0;
}
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
k = counter2;
__3 = table_entries[3*k];
__4 = table_entries[3*k + 1];
row = __3;
column = __4;
value = entry_of(now_w, k)*model->start_scale[column];
model->start_numbers[row*3 + column] = weight_in_force(now_w, row)*value;
}
for (int counter3 = 0, end = 2; counter3 < end; counter3 += 1) {
i = counter3;
model->start_right[i] = model->start_right[i]*weight_in_force(now_w, i);
}
array__5 = model->start_numbers + 6;
const int rank = least_norm(model, array__5);
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
model->start_x[j] = model->start_x[j]*model->start_scale[j];
}
return rank;
}

static real size_of_change(const real *w, const real *change) {
real largest = 0;
int j = 0;
real size = 0;
largest = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
size = table_spin[j] >= 0 ? M(fabs)(change[j]) : M(fabs)(change[j])/w[6];
largest = size > largest ? size : largest;
}
return largest;
}

static int shift(real *y, const real *w, const real *change, real factor) {
(void)w;
int j = 0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
y[j] = y[j] + factor*change[j];
}
return 0;
}

static int close_positions(mechanism *model, real *now_0, real *now_2) {
real best = 0;
int stalled = 0;
real square_ = 0;
int i = 0;
real __1 = 0;
real __2 = 0;
real size = 0;
real length = 0;
real __3 = 0;
real resolved = 0;
real rounding = 0;
real closed = 0;
real longest = 0;
best = INFINITY;
stalled = 0;
for (int counter1 = 0, end = 60; counter1 < end; counter1 += 1) {
place(model, now_0, now_2);
square_ = 0.0;
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
model->start_right[i] = -now_2[25 + i];
square_ = square_ + square(weight_in_force(now_2, i)*model->start_right[i]);
}
__1 = M(sqrt)(square_);
__2 = larger(now_2[6], extent_of(now_0));
size = __1;
length = __2;
stalled = size > 0.5*best ? stalled + 1 : 0;
best = size < best ? size : best;
__3 = size;
if (!(M(fabs)(__3) < INFINITY) || stalled >= 15) {
return 0;
}
resolved = larger(length, coarseness_of(now_0));
rounding = FINE(1e-15, 5.37e-07)*resolved*2.0;
closed = larger(FINE(1e-09, 0.537)*length, rounding);
if (size <= rounding || (stalled >= 3 && size < closed)) {
return 1;
}
dense_change(model, now_0, now_2);
longest = size_of_change(now_2, model->start_x);
shift(now_0, now_2, model->start_x, 1.0/larger(longest, 1.0));
}
place(model, now_0, now_2);
return 0;
}

static int reach(mechanism *model) {
int strides = 0;
int j = 0;
int i = 0;
int k = 0;
int closed = 0;
real moved = 0;
real length = 0;
real change = 0;
strides = 0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
model->start_scale[j] = free_scale(model, j);
}
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
i = counter2;
model->start_first[i] = model->y[i];
}
for (int counter3 = 0, end = 2001; counter3 < end; counter3 += 1) {
k = counter3;
closed = close_positions(model, model->y, model->w);
if (!closed) {
return 3;
}
if (k == 0) {
moved = 0.0;
length = larger(model->w[6], extent_of(model->y));
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
i = counter4;
change = M(fabs)(model->y[i] - model->start_first[i]);
if (change > moved && change > FINE(1e-09, 0.537)*(table_lengths[i] != 0.0 ? length : 1.0)) {
moved = change;
}
}
model->start_summary[1] = moved;
}
if (k == strides) {
break;
}
}
return 0;
}

static real speed_of(mechanism *model, const real *v) {
real largest = 0;
int j = 0;
real size = 0;
largest = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
size = M(fabs)(v[j])/M(sqrt)(model->w[37 + j]);
largest = size > largest ? size : largest;
}
return largest;
}

static int multiply(mechanism *model, const real *x) {
int i = 0;
int k = 0;
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
model->start_right[i] = 0.0;
}
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
k = counter2;
model->start_right[table_entries[3*k]] = model->start_right[table_entries[3*k]] + entry_of(model->w,
k)*x[table_entries[3*k + 1]];
}
return 0;
}

static real velocity_violation(mechanism *model) {
real square_ = 0;
int i = 0;
real *array__1 = 0;
square_ = 0.0;
array__1 = model->y + 3;
multiply(model, array__1);
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
model->start_right[i] = model->w[27 + i] - model->start_right[i];
square_ = square_ + square(weight_in_force(model->w, i)*model->start_right[i]);
}
return M(sqrt)(square_);
}

static real correct_velocities(mechanism *model) {
int j = 0;
dense_change(model, model->y, model->w);
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
model->y[3 + j] = model->y[3 + j] + model->start_x[j];
}
return velocity_violation(model);
}

static int complete_velocities(mechanism *model) {
int j = 0;
real __6 = 0;
real __7 = 0;
real speed = 0;
int i = 0;
real size = 0;
real heaviest = 0;
real least_ = 0;
real weight = 0;
real *array__1 = 0;
array__1 = model->y + 3;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
__6 = model->start_velocities[j];
array__1[j] = M(fabs)(__6) < INFINITY ? model->start_velocities[j] : 0.0;
__7 = model->start_velocities[j];
model->start_scale[j] = M(fabs)(__7) < INFINITY ? 0.0 : free_scale(model, j);
}
speed = speed_of(model, array__1);
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
speed = larger(speed, weight_in_force(model->w, i)*M(fabs)(model->w[27 + i]));
}
velocity_violation(model);
size = correct_velocities(model);
if (size <= FINE(1e-09, 0.537)*speed) {
for (int counter3 = 0, end = 3; counter3 < end; counter3 += 1) {
j = counter3;
model->start_scale[j] = free_scale(model, j);
}
correct_velocities(model);
return 0;
}
heaviest = 0.0;
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
heaviest = larger(heaviest, model->w[34 + j]*model->w[37 + j]);
}
for (int counter5 = 0, end = 3; counter5 < end; counter5 += 1) {
j = counter5;
least_ = FINE(1e-12, 0.000537)*(heaviest > 0.0 ? heaviest : 1.0)/model->w[37 + j];
weight = model->w[34 + j] > least_ ? model->w[34 + j] : least_;
model->start_scale[j] = 1.0/M(sqrt)(weight);
}
for (int counter6 = 0, end = 2; counter6 < end; counter6 += 1) {
size = correct_velocities(model);
}
return size <= FINE(1e-08, 5.37)*speed ? 6 : 4;
}

static int unseen(mechanism *model, real seed) {
int largest = 0;
real most = 0;
int j = 0;
real size = 0;
int __1 = 0;
real __2 = 0;
int __3 = 0;
real __4 = 0;
int chosen__5 = 0;
real chosen__6 = 0;
largest = 0;
most = 0.0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
model->start_direction[j] = model->start_scale[j]*M(cos)(seed*((real)j + 1.0));
model->start_x[j] = 0.0;
}
multiply(model, model->start_direction);
dense_change(model, model->y, model->w);
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
j = counter2;
model->start_direction[j] = model->start_direction[j] - model->start_x[j];
size = M(fabs)(model->start_direction[j])/free_scale(model, j);
if (size > most) {
__1 = j;
__2 = size;
chosen__5 = __1;
chosen__6 = __2;
} else {
__3 = largest;
__4 = most;
chosen__5 = __3;
chosen__6 = __4;
}
largest = chosen__5;
most = chosen__6;
}
return largest;
}

static int find_undetermined(mechanism *model) {
int massless = 0;
int j = 0;
massless = 0;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
j = counter1;
massless = massless + 0;
model->start_scale[j] = 0.0;
}
if (massless == 0) {
return -1;
}
const int largest = unseen(model, 1.0);
const real left = M(fabs)(model->start_direction[largest])/free_scale(model, largest);
return left > FINE(1e-06, 0.001) ? largest : -1;
}

static int square_rows(const real *w, real *squares) {
int i = 0;
int k = 0;
real value = 0;
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
squares[i] = 0.0;
}
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
k = counter2;
value = entry_of(w, k);
squares[table_entries[3*k]] = squares[table_entries[3*k]] + value*value*w[37 + table_entries[3*k + 1]];
}
return 0;
}

static int weigh_rows(mechanism *model) {
int i = 0;
real usual = 0;
real *array__2 = 0;
array__2 = model->w + 40;
square_rows(model->w, array__2);
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
usual = 0.01/(row_weight(model->w, i)*row_weight(model->w, i));
model->w[40 + i] = 1.0/larger(model->w[40 + i], usual);
}
return 0;
}

static int is_dependent(real pivot) {
return !(pivot >= FINE(1e-12, 0.000537));
}

static int mark(mechanism *model, const real *now_0, real *now_2) {
int count = 0;
int i = 0;
real usual = 0;
count = 0;
square_rows(now_2, model->start_right);
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
usual = row_weight(now_2, i);
if (model->start_right[i]*usual*usual < FINE(1e-18, 5.37e-10) && !is_off(i, now_2)) {
now_2[21 + i] = INFINITY;
count = count + 1;
}
}
if (count > 0) {
geometry(0.0, now_0, model->p, now_2);
}
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
if (now_2[21 + i] != 0.0) {
now_2[29 + i] = 0.0;
} else {
if (is_dependent(now_2[29 + i]) && !is_off(i, now_2)) {
now_2[21 + i] = INFINITY;
count = count + 1;
}
}
}
return count;
}

static int is_poor(real pivot) {
return pivot < 0.0001;
}

static real active_pivot(const real *w) {
real smallest = 0;
int i = 0;
real pivot = 0;
smallest = 1.0;
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
pivot = w[29 + i];
smallest = pivot < smallest && !is_dependent(pivot) ? pivot : smallest;
}
return smallest;
}

static int farthest(mechanism *model, int width, int count, real least_, const real *w) {
int i = 0;
int k = 0;
int __3 = 0;
int __4 = 0;
int row = 0;
int column = 0;
real square_ = 0;
int j = 0;
int vanished = 0;
int chosen = 0;
int best = 0;
real most = 0;
int __5 = 0;
real __6 = 0;
real total = 0;
for (int counter1 = 0, end = 2*width + 2; counter1 < end; counter1 += 1) {
i = counter1;
model->start_numbers[i] = 0.0;
}
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
k = counter2;
__3 = table_entries[3*k];
__4 = table_entries[3*k + 1];
row = __3;
column = __4;
model->start_numbers[row*width + column] = entry_of(w, k)*M(sqrt)(w[37 + column]);
}
const int lengths = 2*width;
for (int counter3 = 0, end = 2; counter3 < end; counter3 += 1) {
i = counter3;
square_ = 0.0;
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
square_ = square_ + model->start_numbers[i*width + j]*model->start_numbers[i*width + j];
}
vanished = square_*w[40 + i] < FINE(1e-18, 5.37e-10);
if (vanished || is_off(i, w)) {
for (int counter5 = 0, end = 3; counter5 < end; counter5 += 1) {
j = counter5;
model->start_numbers[i*width + j] = 0.0;
}
square_ = 0.0;
}
model->start_numbers[lengths + i] = square_ > 0.0 ? 1.0/square_ : 0.0;
if (width > 3) {
model->start_numbers[i*width + 3 + i] = square_ > 0.0 ? M(sqrt)(square_) : 1.0;
}
}
for (int counter6 = 0, end = count; counter6 < end; counter6 += 1) {
chosen = counter6;
best = -1;
most = -1.0;
for (int counter7 = 0, end = 2; counter7 < end; counter7 += 1) {
i = counter7;
if (model->start_numbers[lengths + i] >= 0.0) {
square_ = 0.0;
for (int counter8 = 0, end = 3; counter8 < end; counter8 += 1) {
j = counter8;
square_ = square_ + model->start_numbers[i*width + j]*model->start_numbers[i*width + j];
}
if (square_*model->start_numbers[lengths + i] > most*(1.0 + FINE(1e-09, 0.537))) {
__5 = i;
__6 = square_*model->start_numbers[lengths + i];
best = __5;
most = __6;
}
}
}
if (most < least_) {
return chosen;
}
if (most > 0.0) {
square_ = most/model->start_numbers[lengths + best];
for (int counter9 = 0, end = 2; counter9 < end; counter9 += 1) {
i = counter9;
if (i != best && model->start_numbers[lengths + i] >= 0.0) {
total = 0.0;
for (int counter10 = 0, end = 3; counter10 < end; counter10 += 1) {
j = counter10;
total = total + model->start_numbers[i*width + j]*model->start_numbers[best*width + j];
}
for (int counter11 = 0, end = width; counter11 < end; counter11 += 1) {
j = counter11;
model->start_numbers[i*width + j] = model->start_numbers[i*width + j] - total/square_*model->start_numbers[best*width +
j];
}
}
}
}
model->start_numbers[lengths + best] = -1.0;
}
return count;
}

static int dependent(mechanism *model, const real *w) {
int count = 0;
int i = 0;
count = -farthest(model, 3, 2, FINE(1e-12, 0.000537), w);
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
count = count + (is_off(i, w) ? 0 : 1);
}
return count;
}

static int copy_numbers(const real *source, real *copy, int count) {
int i = 0;
for (int counter1 = 0, end = count; counter1 < end; counter1 += 1) {
i = counter1;
copy[i] = source[i];
}
return 0;
}

static int copy(mechanism *model) {
copy_numbers(model->y, model->start_y, 7);
copy_numbers(model->w, model->start_w, 43);
return 0;
}

static int choose_rows(mechanism *model, int count, real *w) {
int i = 0;
int changed = 0;
int sum_ = 0;
int row = 0;
int k = 0;
real share = 0;
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
count = count - (is_off(i, w) ? 1 : 0);
}
if (farthest(model, 5, count, 0.0, w) < count) {
return 0;
}
changed = 0;
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
model->start_numbers[12 + i] = 0.0;
}
for (int counter3 = 0, end = 2 - count; counter3 < end; counter3 += 1) {
sum_ = -1;
row = -1;
if (row < 0) {
return 0;
}
model->start_numbers[12 + row] = INFINITY;
model->start_numbers[10 + sum_] = -1.0;
for (int counter4 = 0, end = 2; counter4 < end; counter4 += 1) {
i = counter4;
if (model->start_numbers[10 + i] >= 0.0) {
share = model->start_numbers[i*5 + 3 + row]/model->start_numbers[sum_*5 + 3 + row];
for (int counter5 = 0, end = 2; counter5 < end; counter5 += 1) {
k = counter5;
model->start_numbers[i*5 + 3 + k] = model->start_numbers[i*5 + 3 + k] - share*model->start_numbers[sum_*5 + 3 + k];
}
}
}
}
for (int counter6 = 0, end = 2; counter6 < end; counter6 += 1) {
i = counter6;
if (is_off(i, w)) {
model->start_numbers[12 + i] = 0.0;
}
changed = w[21 + i] == model->start_numbers[12 + i] ? changed : 1;
w[21 + i] = model->start_numbers[12 + i];
}
return changed;
}

static int masked(mechanism *model, int count, int alone, int same) {
int i = 0;
int left = 0;
real *array__3 = 0;
if (count == 0) {
for (int counter1 = 0, end = 2; counter1 < end; counter1 += 1) {
i = counter1;
model->w[21 + i] = 0.0;
}
return 0;
}
if (count == alone) {
array__3 = model->w;
} else {
array__3 = model->start_w;
}
if (!same || active_pivot(array__3) < 0.01) {
choose_rows(model, 2 - count, array__3);
for (int counter2 = 0, end = 2; counter2 < end; counter2 += 1) {
i = counter2;
model->w[21 + i] = array__3[21 + i];
}
geometry(0.0, model->y, model->p, model->w);
for (int counter3 = 0, end = 2; counter3 < end; counter3 += 1) {
i = counter3;
if (model->w[21 + i] != 0.0) {
model->w[29 + i] = 0.0;
}
}
return count;
}
if (count == alone && same) {
return count;
}
left = 0;
for (int counter4 = 0, end = 2; counter4 < end; counter4 += 1) {
i = counter4;
if (model->start_w[21 + i] == 0.0) {
model->w[21 + i] = 0.0;
}
left = left + (model->w[21 + i] != 0.0 ? 1 : 0);
}
return left;
}

static int mask_redundant(mechanism *model) {
int count = 0;
int same = 0;
int k = 0;
int j = 0;
real size = 0;
int i = 0;
int closed = 0;
int near_ = 0;
int __4 = 0;
weigh_rows(model);
count = mark(model, model->y, model->w);
const int poor = is_poor(active_pivot(model->w));
count = poor ? dependent(model, model->w) : count;
const int __2 = count;
const int __3 = !poor;
const int alone = __2;
same = __3;
for (int counter1 = 0, end = 3; counter1 < end; counter1 += 1) {
k = counter1;
for (int counter2 = 0, end = 3; counter2 < end; counter2 += 1) {
j = counter2;
model->start_scale[j] = free_scale(model, j);
}
if (count == 0) {
break;
}
unseen(model, (real)k + 1.0);
size = size_of_change(model->w, model->start_direction);
if (size < FINE(1e-09, 0.537)) {
break;
}
copy(model);
for (int counter3 = 0, end = 2; counter3 < end; counter3 += 1) {
i = counter3;
model->start_w[21 + i] = 0.0;
}
shift(model->start_y, model->start_w, model->start_direction, 0.03/size);
closed = close_positions(model, model->start_y, model->start_w);
near_ = mark(model, model->start_y, model->start_w);
if (closed) {
for (int counter4 = 0, end = 2; counter4 < end; counter4 += 1) {
i = counter4;
same = same && (model->w[21 + i] != 0.0 || model->start_w[21 + i] == 0.0);
}
if (is_poor(active_pivot(model->start_w))) {
__4 = dependent(model, model->start_w);
near_ = __4;
same = 0;
}
count = near_ < count ? near_ : count;
}
}
return masked(model, count, alone, same);
}

static int close_row(mechanism *model) {
int code = 0;
int undetermined = 0;
real *array__5 = 0;
code = check_numbers(model);
if (code == 0) {
measure_lengths(model);
}
if (code == 0) {
code = reach(model);
}
if (code == 0) {
code = complete_velocities(model);
}
if (code == 6) {
model->start_summary[2] = 1.0;
code = 0;
}
if (code == 0) {
undetermined = find_undetermined(model);
if (undetermined >= 0) {
model->start_summary[3] = (real)undetermined;
code = 7;
}
}
if (code == 0) {
model->start_summary[5] = (real)mask_redundant(model);
model->w[6] = larger(model->w[6], extent_of(model->y));
array__5 = model->y + 3;
model->w[7] = speed_of(model, array__5);
}
model->start_summary[0] = (real)code;
return code;
}

static int begin_row(mechanism *model, const real *state) {
int i = 0;
int j = 0;
for (int counter1 = 0, end = 43; counter1 < end; counter1 += 1) {
i = counter1;
model->w[i] = 0.0;
}
for (int counter2 = 0, end = 10; counter2 < end; counter2 += 1) {
i = counter2;
model->w[table_1[i]] = 1.0;
}
for (int counter3 = 0, end = 12; counter3 < end; counter3 += 1) {
i = counter3;
model->iw[i] = 0;
}
copy_numbers(state, model->y, 7);
for (int counter4 = 0, end = 3; counter4 < end; counter4 += 1) {
j = counter4;
model->start_velocities[j] = model->y[3 + j];
model->y[3 + j] = 0.0;
}
return 0;
}

static int set_rates(mechanism *model, real t, const real *y, real *rate) {
if (rhs(t, y, model->p, model->w, model->iw, rate) != 0) {
rhs(t, y, model->p, model->w, model->iw, rate);
}
return 0;
}

static int all_finite(const real *x) {
int finite_ = 0;
int i = 0;
real __1 = 0;
int decided__2 = 0;
finite_ = 1;
for (int counter1 = 0, end = 7; counter1 < end; counter1 += 1) {
i = counter1;
if (finite_) {
__1 = x[i];
decided__2 = M(fabs)(__1) < INFINITY;
} else {
decided__2 = 0;
}
finite_ = decided__2;
}
return finite_;
}

static int find_rates(mechanism *model, real t, const real *y, real *rate) {
set_rates(model, t, y, rate);
return all_finite(rate);
}

static int set_stage(mechanism *model, const real *y, real factor, const real *rate) {
int i = 0;
for (int counter1 = 0, end = 7; counter1 < end; counter1 += 1) {
i = counter1;
model->step_middle[i] = y[i] + factor*rate[i];
}
return 0;
}

static int take_step(mechanism *model, real t, real h, real *now_y) {
int i = 0;
model->w[12] = h;
set_rates(model, t, now_y, model->step_first);
set_stage(model, now_y, 0.5*h, model->step_first);
set_rates(model, t + 0.5*h, model->step_middle, model->step_second);
set_stage(model, now_y, 0.5*h, model->step_second);
set_rates(model, t + 0.5*h, model->step_middle, model->step_third);
set_stage(model, now_y, h, model->step_third);
set_rates(model, t + h, model->step_middle, model->step_fourth);
for (int counter1 = 0, end = 7; counter1 < end; counter1 += 1) {
i = counter1;
now_y[i] = now_y[i] + h/6.0*(model->step_first[i] + 2.0*(model->step_second[i] + model->step_third[i]) +
model->step_fourth[i]);
}
return rest_of_integers(accept(t + h, now_y, model->p, model->w, model->iw), 2) == 0 && all_finite(now_y);
}

static int copy_counters(const int *source, int *copy) {
int i = 0;
for (int counter1 = 0, end = 12; counter1 < end; counter1 += 1) {
i = counter1;
copy[i] = source[i];
}
return 0;
}

static int keep_beginning(mechanism *model, const real *now_0) {
copy_numbers(now_0, model->step_y, 7);
copy_numbers(model->w, model->step_w, 43);
return copy_counters(model->iw, model->step_counters);
}

static int take_step_2(mechanism *model, real t, real h, real *now_0) {
int i = 0;
model->w[12] = h;
set_rates(model, t, now_0, model->step_first);
set_stage(model, now_0, 0.5*h, model->step_first);
set_rates(model, t + 0.5*h, model->step_middle, model->step_second);
set_stage(model, now_0, 0.5*h, model->step_second);
set_rates(model, t + 0.5*h, model->step_middle, model->step_third);
set_stage(model, now_0, h, model->step_third);
set_rates(model, t + h, model->step_middle, model->step_fourth);
for (int counter1 = 0, end = 7; counter1 < end; counter1 += 1) {
i = counter1;
now_0[i] = now_0[i] + h/6.0*(model->step_first[i] + 2.0*(model->step_second[i] + model->step_third[i]) +
model->step_fourth[i]);
}
return rest_of_integers(accept(t + h, now_0, model->p, model->w, model->iw), 2) == 0 && all_finite(now_0);
}

static int attempt(mechanism *model, real t, real h, real *now_0) {
int count = 0;
if (!take_step_2(model, t, h, now_0)) {
return -1;
}
count = 0;
return count;
}

static real step_to_event(mechanism *model, real t, real h, real *now_0) {
int count = 0;
real high = 0;
keep_beginning(model, now_0);
count = attempt(model, t, h, now_0);
const real __1 = h;
high = __1;
return count >= 0 ? high : NAN;
}

static int restore(mechanism *model, real *now_0) {
copy_numbers(model->step_y, now_0, 7);
copy_numbers(model->step_w, model->w, 43);
return copy_counters(model->step_counters, model->iw);
}

static int take_steps(mechanism *model, real until, real h, real *now_y) {
int halving = 0;
real size = 0;
real __2 = 0;
real __3 = 0;
real t = 0;
real rest_ = 0;
real step = 0;
real length = 0;
int last = 0;
real __4 = 0;
const real __1 = h;
halving = 0;
size = __1;
model->step_ending[0] = -1;
while (model->step_clock[0] < until) {
__2 = model->step_clock[0];
__3 = until - model->step_clock[0];
t = __2;
rest_ = __3;
if (halving) {
size = 0.5*size;
if (!(size > FINE(1e-09, 0.537)*(1.0 + M(fabs)(t)))) {
return 2;
}
}
step = rest_ < size + FINE(2e-12, 0.00107)*size ? rest_ : size;
length = step_to_event(model, t, step, now_y);
if (length > 0.0) {
model->step_clock[0] = length == rest_ ? until : t + length;
last = -1;
if (last >= 0) {
model->step_ending[0] = last;
return 1;
}
} else {
restore(model, now_y);
__4 = step;
size = __4;
halving = 1;
}
}
return 0;
}

/* -- numbers ------------------------------------------------------------------------------------------------------ */

static const real defaults[] = {0.5, 0.02, 0.0, 10.0, FINE(1e-13, 2.4e-06)};
static const real state[] = {0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0};
/* Scratch as a start leaves it, where that is not 0: places and numbers. */
static const struct {
    int place;
    real value;
} scratch[] = {{4, 1.0}, {5, 2.0}, {6, 0.3}, {10, 1.0}, {11, 1.7037037037037035}, {29, 1.0}, {30, 1.0}, {34, 2.0}, {35, 2.0}, {36,
0.1}, {37, 1.0}, {38, 1.0}, {39, 11.11111111111111}, {40, 1.0}, {41, 0.09}};

/* -- parameters --------------------------------------------------------------------------------------------------- */

static void derive(slide *model) {
    real *p = model->p;
    (void)p;

}

void slide_prepare(slide *model) {
    derive(model);
    prepare_model(model->p);
    prepare_law(model->p);
    masses(model->p, model->w);
}

void slide_init(slide *model) {
    memset(model, 0, sizeof *model);
    for (unsigned i = 0; i < sizeof scratch / sizeof *scratch; i++) {
        if (scratch[i].place >= 0) model->w[scratch[i].place] = scratch[i].value;
    }
    for (unsigned i = 0; i < sizeof defaults / sizeof *defaults; i++) model->p[i] = defaults[i];
    for (int i = 0; i < NY; i++) model->y[i] = state[i];
    slide_prepare(model);
}

void slide_set(slide *model, int parameter, real value) {
    static const unsigned char is_input[] = {0, 0, 1};
    model->p[parameter] = value;
    model->set[parameter] = 1;
    if (is_input[parameter]) slide_prepare(model);
}

/* -- the start ---------------------------------------------------------------------------------------------------- */

/* Coordinates, velocities and states as described; velocities that nothing describes are not a number. */
static void describe(slide *model, real *q, real *v, real *own) {
    const real *p = model->p;
    (void)p;
    (void)own;
    const real a0 = M(cos)(0.0);
    const real a1 = M(sin)(0.0);
    const real a2 = a0 * 0.0;
    const real a3 = a1 * 0.0;
    const real a4 = a2 - a3;
    const real a5 = a1 * 0.0;
    const real a6 = 0.3 + a5;
    const real a7 = a0 * 0.0;
    const real a8 = a6 + a7;
    q[0] = a4;
    q[1] = a8;
    q[2] = 0.0;
    v[0] = 0.0;
    v[1] = 0.0;
    v[2] = NAN;
}

int slide_start(slide *model) {
    begin_row(model, state);
    slide_prepare(model);
    model->t = 0;
    describe(model, model->y, model->start_velocities, model->y + NQ + NV + 1);
    return close_row(model) || slide_accept(model, 0, 0.001, model->y);
}

/* -- the motion --------------------------------------------------------------------------------------------------- */

int slide_rates(slide *model, real t, const real *y, real *ydot) {
    return !find_rates(model, t, y, ydot);
}

int slide_accept(slide *model, real t, real h, real *y) {
    model->w[12] = h;
    return accept(t, y, model->p, model->w, model->iw) & 1;
}

int slide_step(slide *model, real h) {
    if (!take_step(model, model->t, h, model->y)) return 1;
    model->t += h;
    return 0;
}

int slide_advance(slide *model, real until, real h, int *event) {
    model->step_clock[0] = model->t;
    const int result = take_steps(model, until, h, model->y);
    model->t = model->step_clock[0];
    *event = model->step_ending[0];
    return result == 2;
}

/* -- functions of a state ----------------------------------------------------------------------------------------- */

void slide_bodies(slide *model, real t, const real *y, real *columns) {
    (void)model;
    (void)t;
    memcpy(columns, y, SLIDE_COLUMNS*sizeof *columns);
}

int slide_outputs(slide *model, real t, const real *y, real *values) {
    if (slide_rates(model, t, y, model->step_first)) return 1;
    formulas_of_outputs(t, y, model->p, model->w, model->step_first, values);
    return 0;
}
