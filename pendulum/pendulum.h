/* pendulum: equations of motion by the method direct-correction. Written by symgen.
   Numbers are in SI units; `pendulum_real` is double, or float where PENDULUM_SINGLE is defined. */
#ifndef PENDULUM_H
#define PENDULUM_H

#ifdef PENDULUM_SINGLE
typedef float pendulum_real;
#else
typedef double pendulum_real;
#endif

enum {
    PENDULUM_NQ = 3, /* coordinates */
    PENDULUM_NV = 3, /* velocities */
    PENDULUM_NY = 7, /* coordinates, velocities, the work of forces without potential, states of the file, integrals */
    PENDULUM_M = 2, /* rows of constraints */
    PENDULUM_NU = 0, /* parameters */
    PENDULUM_NP = 1, /* parameters, and numbers that follow from them */
    PENDULUM_NW = 44, /* scratch */
    PENDULUM_NI = 12, /* counters */
    PENDULUM_COLUMNS = 6, /* coordinates and velocities of bodies */
    PENDULUM_OUTPUTS = 1,
    PENDULUM_EVENTS = 0
};


/* A mechanism: its state and the memory of its functions. The caller owns it; nothing is allocated, nothing is global. */
typedef struct {
    pendulum_real t, y[PENDULUM_NY];
    pendulum_real p[PENDULUM_NP], w[PENDULUM_NW];
    int iw[PENDULUM_NI];
    unsigned char set[PENDULUM_NU + 1]; /* parameters that are numbers although they have a formula */
    pendulum_real start_summary[29];
    pendulum_real start_w[44];
    pendulum_real start_y[7];
    pendulum_real start_x[3];
    pendulum_real start_scale[3];
    pendulum_real start_right[2];
    int start_order[2];
    pendulum_real start_numbers[17];
    pendulum_real start_first[3];
    pendulum_real start_velocities[3];
    pendulum_real start_direction[7];
    pendulum_real step_middle[7];
    pendulum_real step_first[7];
    pendulum_real step_second[7];
    pendulum_real step_third[7];
    pendulum_real step_fourth[7];
    pendulum_real step_y[7];
    pendulum_real step_w[44];
    int step_counters[12];
    pendulum_real step_clock[1];
} pendulum;

/* Functions that return a number return 0 where they succeed. */

/* Give parameters their defaults. The first call of all. */
void pendulum_init(pendulum *model);
/* Give a parameter another value, by its place; inputs may change at any time, others before pendulum_start. */
void pendulum_set(pendulum *model, int parameter, pendulum_real value);
/* Compute the numbers that follow from parameters; pendulum_start does so, and pendulum_set for inputs. */
void pendulum_prepare(pendulum *model);
/* Close the joints from the described positions, complete the velocities, t = 0. */
int pendulum_start(pendulum *model);
/* Rates of a state. */
int pendulum_rates(pendulum *model, pendulum_real t, const pendulum_real *y, pendulum_real *ydot);
/* Correct a state at the end of a step of length h as the method does. */
int pendulum_accept(pendulum *model, pendulum_real t, pendulum_real h, pendulum_real *y);
/* A step of length h from model->t, model->y: the classical Runge-Kutta scheme, then the correction. */
int pendulum_step(pendulum *model, pendulum_real h);
/* Steps of length h up to a time, the last one shorter; events happen at their times. Where one ends the run, its number
   is in *event, else -1. Where a step fails, the state is the last one from which the motion goes on. */
int pendulum_advance(pendulum *model, pendulum_real until, pendulum_real h, int *event);
/* Whether drivers lock at the state where a motion ends. Then drivers[PENDULUM_M] is 1 for rows of drivers that hold
   nothing there, and jumps[PENDULUM_NV] how far coordinates would jump, relative to each other. */
int pendulum_locks(pendulum *model, unsigned char *drivers, pendulum_real *jumps);
/* Coordinates, then velocities, of all bodies. */
void pendulum_bodies(pendulum *model, pendulum_real t, const pendulum_real *y, pendulum_real *columns);
/* Outputs: pin.force. */
int pendulum_outputs(pendulum *model, pendulum_real t, const pendulum_real *y, pendulum_real *values);

#endif
