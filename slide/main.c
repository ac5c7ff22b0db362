/* slide from its start to 10.0 s: coordinates and velocities of bodies as CSV. Written by symgen.

       sim [UNTIL [STEP]] */
#include "slide.h"

#include <stdio.h>
#include <stdlib.h>

static void row(slide *model) {
    slide_real columns[SLIDE_COLUMNS];
    slide_bodies(model, model->t, model->y, columns);
    printf("%.17g", (double)model->t);
    for (int i = 0; i < SLIDE_COLUMNS; i++) printf(",%.17g", (double)columns[i]);
    printf("\n");
}

/* The sentence on the end of a motion that cannot go on from the state of `model`. */
static void sentence(slide *model, char *text, size_t size) {
    snprintf(text, size, "the motion cannot be continued at t = %.6g s", (double)model->t);
}

int main(int count, char **words) {
    static slide model;
    const double until = count > 1 ? atof(words[1]) : 10.0, step = count > 2 ? atof(words[2]) : 0.001;
    const long every = count > 2 ? 1 : 1;
    if (!(until >= 0) || !(step > 0)) {
        fprintf(stderr, "expected UNTIL of at least 0 s and STEP above 0 s\n");
        return 2;
    }
    slide_init(&model);
    if (slide_start(&model)) {
        fprintf(stderr, "the joints cannot be closed\n");
        return 1;
    }
    printf("t,b.x,b.y,b.theta,b.vx,b.vy,b.omega\n");
    row(&model);
    for (long k = 1; (double)model.t < until*(1 - 1e-12); k++) {
        const double end = (double)k*step < until*(1 - 1e-12) ? (double)k*step : until;
        int event;
        if (slide_advance(&model, (slide_real)end, (slide_real)step, &event)) {
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
