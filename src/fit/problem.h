/* problem.h - a fit as a problem of least squares: its residuals, their derivatives, and the search. */
#ifndef FST_FIT_PROBLEM_H
#define FST_FIT_PROBLEM_H

#include "fit/rows.h"
#include "fit/minpack.h"

/* A number of the table. */
typedef struct fit_number {
    int row;
    fst_measured what;
    double value, error;
    double by_frequency; /* d value/d frequency by the model */
    double by_scale;     /* what a deviation of the scale changes it by, in its errors */
    double weight;       /* 0: left out; of a bootstrap, how many times it was drawn */
} fit_number;

typedef struct fit_problem {
    fit_space space;
    fit_rows rows;
    fit_number *numbers;
    int count;
    double *frequency_error; /* of each row; 0: none */
    double robust;           /* residuals beyond this count by their logarithm; 0: all count by their square */
    const fst_minpack *minpack;
    double tolerance; /* of chi^2, relative, at which the search ends ... */
    int most_calls;   /* ... or the number of its trials */

    /* The latest evaluation. */
    fit_value *values;
    double at[FIT_MOST];
    int is_evaluated;
    double (*slopes)[FST_MEASURED_COUNT]; /* at `slopes_at`, if they are known */
    double slopes_at[FIT_MOST];
    double *f;      /* room for residuals */
    double *common; /* room for what a deviation of the scale does to those of numbers and frequencies */
    int has_slopes;
} fit_problem;

/* Residuals: of the numbers; of the frequencies of the rows, by their errors; of priors; of ranges. */
static inline int fit_residual_count(const fit_problem *p)
{
    return p->count + p->rows.count + 2 * p->space.count;
}

fst_status fit_problem_begin(fit_problem *p, const fst_params *params, const fst_points *points,
                             const fst_fit_options *options, const fst_progress *progress, fst_error *error);
void fit_problem_free(fit_problem *p);

/* The model at u, into p->values. */
fst_status fit_evaluate(fit_problem *p, const double *u, fst_error *error);

/* The residuals at u, into f; the sum of their squares, INFINITY where it fails, with the residuals in p->f. */
fst_status fit_sum(fit_problem *p, const double *u, double *sum, fst_error *error);
fst_status fit_residuals(fit_problem *p, const double *u, double *f, fst_error *error);

/* Their derivatives at u, jacobian[i + m k], at which the rows then stand. */
fst_status fit_derivatives(fit_problem *p, const double *u, double *jacobian, fst_error *error);

/* The same from the slopes where they were computed last, with the weights of now. */
void fit_weighted_derivatives(const fit_problem *p, double *jacobian);

/* The plain residual of a number, (model - value)/error, as it was evaluated last, with the error of its
 * frequency; and its derivative along each coordinate. */
double fit_plain_residual(const fit_problem *p, int number);
void fit_plain_slope(const fit_problem *p, int number, double slope[FIT_MOST]);

/* Search from u for the least sum of squares, which is left in *chi2. */
fst_status fit_solve(fit_problem *p, double *u, double *chi2, fst_error *error);

/* Take d value/d frequency anew where the rows stand; a no-op where no frequency has an error. */
fst_status fit_take_frequency_slopes(fit_problem *p, fst_error *error);

/* How many numbers are used; how many parameters no prior holds. */
int fit_used(const fit_problem *p);
int fit_unheld(const fit_problem *p);

#endif
