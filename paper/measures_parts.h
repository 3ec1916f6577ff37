/* measures_parts.h - what the files of measures share: how a measure is written down, and short ways to runs,
 * trajectories and models. */
#ifndef FST_PAPER_MEASURES_PARTS_H
#define FST_PAPER_MEASURES_PARTS_H

#include "base/constants.h"
#include "paper/measures.h"
#include "paper/runs.h"

#include <stdio.h>

/* ------------------------------------------------------------------ how a measure is written down */

#define NOTE(...) (void)snprintf(m->note, m->size, __VA_ARGS__)

/* A formula in what the run of a scan tells: `at` is its result, `run` and `p` are the run and its parameters.
 * NOTED has a note; VISCOUS in addition has a value only where friction is -m gamma V. */
#define FORMULA(name, scan, value)                                                                             \
    MEASURE(name)                                                                                              \
    {                                                                                                          \
        RUN_OF(scan);                                                                                          \
        return value;                                                                                          \
    }                                                                                                          \
    MEASURE(name)
#define NOTED(name, scan, value, ...)                                                                          \
    MEASURE(name)                                                                                              \
    {                                                                                                          \
        RUN_OF(scan);                                                                                          \
        const double measured_value = value;                                                                   \
        NOTE(__VA_ARGS__);                                                                                     \
        return measured_value;                                                                                 \
    }                                                                                                          \
    MEASURE(name)
#define VISCOUS(name, scan, value, ...)                                                                        \
    MEASURE(name)                                                                                              \
    {                                                                                                          \
        RUN_OF(scan);                                                                                          \
        if (!fst_measure_is_viscous(m, run))                                                                   \
            return NAN;                                                                                        \
        const double measured_value = value;                                                                   \
        NOTE(__VA_ARGS__);                                                                                     \
        return measured_value;                                                                                 \
    }                                                                                                          \
    MEASURE(name)
#define RUN_OF(scan)                                                                                           \
    const fst_paper_run *run = run_of(m, FST_SCAN_##scan);                                                     \
    const fst_run_result *at = &run->result;                                                                   \
    const fst_params *p = &run->params;                                                                        \
    (void)at, (void)p

/* A measure that needs the model of a scan: NAN if there is no memory for it. */
#define MEASURE_IN(name, scan)                                                                                 \
    static double name##_in(const fst_measuring *m, const fst_model *model);                                   \
    MEASURE(name)                                                                                              \
    {                                                                                                          \
        return fst_measure_in(m, FST_SCAN_##scan, name##_in);                                                  \
    }                                                                                                          \
    static double name##_in(const fst_measuring *m, const fst_model *model)

/* ------------------------------------------------------------------ runs */

/* The run of a scan that has only one, or the first. */
static inline const fst_paper_run *run_of(const fst_measuring *m, fst_scan scan)
{
    return m->paper->scans[scan][m->dynamics];
}

static inline const fst_paper_run *last_of(const fst_measuring *m, fst_scan scan)
{
    return run_of(m, scan) + m->paper->counts[scan] - 1;
}

static inline double eps_of(const fst_params *params)
{
    return params->bead_radius / params->magnet_half_length;
}

/* Runs of the experiment's range, both from the rolling start and from rest, between two frequencies (Hz); and
 * those from the rolling start that counter-rotate at drives from 0.2 to 0.41. */
enum { FST_MOST_LISTED = 256 };
typedef struct fst_run_list {
    int count;
    const fst_paper_run *runs[FST_MOST_LISTED];
} fst_run_list;
fst_run_list fst_runs_between(const fst_measuring *m, double low, double high);
fst_run_list fst_counter_rotating_runs(const fst_measuring *m);

/* Whether friction was -m gamma V in that run.  The paper's equations and balances take V for it, and say
 * nothing of another law: a measure of theirs then has no value, and the note tells why. */
int fst_measure_is_viscous(const fst_measuring *m, const fst_paper_run *run);

/* ------------------------------------------------------------------ trajectories */

/* The columns of a trajectory that measures read. */
typedef struct fst_path {
    size_t rows;
    const double *t, *x, *y, *X, *Y, *r, *alpha, *Phi, *nX, *nY, *nZ, *n_r, *n_alpha, *n_z, *angle, *slip,
        *friction_power;
} fst_path;
fst_path fst_path_of(const fst_paper_run *run);

/* The first row from `row` (at least 1) on at which r is greatest; `rows` if there is none. */
size_t fst_turning_point(const fst_path *path, size_t row);

/* ------------------------------------------------------------------ models and fields */

double fst_measure_in(const fst_measuring *m, fst_scan scan,
                      double (*measure)(const fst_measuring *m, const fst_model *model));

/* Where |B| is greatest on the magnet's axis. */
double fst_maximum_on_axis(const fst_params *params);

/* On a circle of radius r: the magnetic averages of Eqs. (12), (13) and (14) for phi = rate Phi + chi, and the
 * mean of n.B. */
typedef struct fst_averages {
    double radial, moment, torque, n_b;
} fst_averages;
fst_averages fst_averages_on_circle(const fst_model *model, double r, double rate, double chi);

/* The mean radial magnetic force (l gamma^2), over Phi, on a bead at radius r whose moment turns as phi = sense
 * Phi + pi (sense -1: the counter-rotating motion, +1: the corotating one). */
double fst_ansatz_force(const fst_model *model, double r, int sense);

/* On a circle of radius r: the mean squares of B's radial part and of B, and the size of the mean of
 * B.(sin(Phi) e_alpha + cos(Phi) e_z), the structure that the appendix assumes. */
typedef struct fst_circle_field {
    double radial, square, structured;
} fst_circle_field;
fst_circle_field fst_field_on_circle(const fst_model *model, double r);

static inline double fst_length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

#endif
