/* slide: equations of motion by the method direct-correction. Written by symgen.
   Numbers are in SI units; `slide_real` is double, or float where SLIDE_SINGLE is defined. */
#ifndef SLIDE_H
#define SLIDE_H

#ifdef SLIDE_SINGLE
typedef float slide_real;
#else
typedef double slide_real;
#endif

enum {
    SLIDE_NQ = 3, /* coordinates */
    SLIDE_NV = 3, /* velocities */
    SLIDE_NY = 7, /* coordinates, velocities, the work of forces without potential, states of the file, integrals */
    SLIDE_M = 2, /* rows of constraints */
    SLIDE_NU = 3, /* parameters */
    SLIDE_NP = 5, /* parameters, and numbers that follow from them */
    SLIDE_NW = 43, /* scratch */
    SLIDE_NI = 12, /* counters */
    SLIDE_COLUMNS = 6, /* coordinates and velocities of bodies */
    SLIDE_OUTPUTS = 1,
    SLIDE_EVENTS = 0
};

/* Places of parameters. */
enum {
    SLIDE_P_part = 0, /* 0.5 */
    SLIDE_P_amplitude = 1, /* 0.02 */
    SLIDE_P_height = 2 /* 0.0, an input */
};

/* A mechanism: its state and the memory of its functions. The caller owns it; nothing is allocated, nothing is global. */
typedef struct {
    slide_real t, y[SLIDE_NY];
    slide_real p[SLIDE_NP], w[SLIDE_NW];
    int iw[SLIDE_NI];
    unsigned char set[SLIDE_NU + 1]; /* parameters that are numbers although they have a formula */
    slide_real start_summary[29];
    slide_real start_w[43];
    slide_real start_y[7];
    slide_real start_x[3];
    slide_real start_scale[3];
    slide_real start_right[2];
    int start_order[2];
    slide_real start_numbers[17];
    slide_real start_first[3];
    slide_real start_velocities[3];
    slide_real start_direction[7];
    slide_real step_middle[7];
    slide_real step_first[7];
    slide_real step_second[7];
    slide_real step_third[7];
    slide_real step_fourth[7];
    slide_real step_y[7];
    slide_real step_w[43];
    int step_counters[12];
    int step_ending[1];
    slide_real step_clock[1];
} slide;

/* Functions that return a number return 0 where they succeed. */

/* Give parameters their defaults. The first call of all. */
void slide_init(slide *model);
/* Give a parameter another value, by its place; inputs may change at any time, others before slide_start. */
void slide_set(slide *model, int parameter, slide_real value);
/* Compute the numbers that follow from parameters; slide_start does so, and slide_set for inputs. */
void slide_prepare(slide *model);
/* Close the joints from the described positions, complete the velocities, t = 0. */
int slide_start(slide *model);
/* Rates of a state. */
int slide_rates(slide *model, slide_real t, const slide_real *y, slide_real *ydot);
/* Correct a state at the end of a step of length h as the method does. */
int slide_accept(slide *model, slide_real t, slide_real h, slide_real *y);
/* A step of length h from model->t, model->y: the classical Runge-Kutta scheme, then the correction. */
int slide_step(slide *model, slide_real h);
/* Steps of length h up to a time, the last one shorter; events happen at their times. Where one ends the run, its number
   is in *event, else -1. Where a step fails, the state is the last one from which the motion goes on. */
int slide_advance(slide *model, slide_real until, slide_real h, int *event);
/* Coordinates, then velocities, of all bodies. */
void slide_bodies(slide *model, slide_real t, const slide_real *y, slide_real *columns);
/* Outputs: rail.lower.force. */
int slide_outputs(slide *model, slide_real t, const slide_real *y, slide_real *values);

#endif
