/* pendulum from its start to 10.0 s: coordinates and velocities of bodies as CSV. Written by symgen.

       sim [UNTIL [STEP]] */
#include "pendulum.h"

#include <stdio.h>
#include <stdlib.h>

static void row(pendulum *model) {
    pendulum_real columns[PENDULUM_COLUMNS];
    pendulum_bodies(model, model->t, model->y, columns);
    printf("%.17g", (double)model->t);
    for (int i = 0; i < PENDULUM_COLUMNS; i++) printf(",%.17g", (double)columns[i]);
    printf("\n");
}

/* The sentence on the end of a motion that cannot go on from the state of `model`. */
static void sentence(pendulum *model, char *text, size_t size) {
    static const char *const driver_of[] = {"", ""}; /* of rows */
    static const char *const moving[] = {"bob.x", "bob.y", "bob.theta"}; /* coordinates, by their velocities */
    unsigned char drivers[PENDULUM_M + 1];
    pendulum_real jumps[PENDULUM_NV], largest = 0;
    char t[32];
    int used, last = -1;
    snprintf(t, sizeof t, "%.6g", (double)model->t);
    if (!pendulum_locks(model, drivers, jumps)) {
        snprintf(text, size, "the motion cannot be continued at t = %s s", t);
        return;
    }
    used = snprintf(text, size, "dead centre at t = %s s: ", t);
    for (int i = 0; i < PENDULUM_M && used < (int)size; i++) {
        if (!drivers[i] || (last >= 0 && driver_of[last] == driver_of[i])) continue;
        used += snprintf(text + used, size - (size_t)used, "%s'%s'", last < 0 ? "" : " and ", driver_of[i]);
        last = i;
    }
    for (int count = 0; count < 3 && used < (int)size; count++) {
        int best = 0;
        for (int k = 1; k < PENDULUM_NV; k++) {
            if (jumps[k] > jumps[best]) best = k;
        }
        if (count == 0) largest = jumps[best];
        if (!(jumps[best] > (pendulum_real)0.3*largest)) break;
        used += snprintf(text + used, size - (size_t)used, "%s%s", count ? ", " : " can go no further; ", moving[best]);
        jumps[best] = 0;
    }
    if (used < (int)size) snprintf(text + used, size - (size_t)used, " would have to jump");
}

int main(int count, char **words) {
    static pendulum model;
    const double until = count > 1 ? atof(words[1]) : 10.0, step = count > 2 ? atof(words[2]) : 0.001;
    const long every = count > 2 ? 1 : 1;
    if (!(until >= 0) || !(step > 0)) {
        fprintf(stderr, "expected UNTIL of at least 0 s and STEP above 0 s\n");
        return 2;
    }
    pendulum_init(&model);
    if (pendulum_start(&model)) {
        fprintf(stderr, "the joints cannot be closed\n");
        return 1;
    }
    printf("t,bob.x,bob.y,bob.theta,bob.vx,bob.vy,bob.omega\n");
    row(&model);
    for (long k = 1; (double)model.t < until*(1 - 1e-12); k++) {
        const double end = (double)k*step < until*(1 - 1e-12) ? (double)k*step : until;
        int event;
        if (pendulum_advance(&model, (pendulum_real)end, (pendulum_real)step, &event)) {
            char text[512];
            sentence(&model, text, sizeof text);
            fprintf(stderr, "%s\n", text);
            return 1;
        }
        if (event >= 0) {
            row(&model);
            return 0;
        }
        if (k % every == 0 || end >= until) row(&model);
    }
    return 0;
}
