/* curve.c - the fitted model between and beside the frequencies of the table.
 *
 * The uncertainty of a curve is that of the parameters, carried along its derivatives: sqrt(g^T C g), g the
 * slopes at a frequency, C the covariance.  Far from the table it grows, as it should.
 */
#include "fit/curve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

void fit_curve_free(fit_curve *curve)
{
    free(curve->points);
    free(curve->slopes);
    *curve = (fit_curve){0};
}

void fit_frequency_range(const fit_problem *p, double widened, double *from, double *to)
{
    *from = INFINITY;
    *to = -INFINITY;
    for (int i = 0; i < p->rows.count; ++i) {
        *from = fmin(*from, p->rows.rows[i].frequency);
        *to = fmax(*to, p->rows.rows[i].frequency);
    }
    const double room = widened * fmax(*to - *from, 0.1 * fabs(*to));
    const double least = 0.2 * fmin(fabs(*from), fabs(*to));
    const double low = *from - room, high = *to + room;
    *from = *from > 0 ? fmax(low, least) : low;
    *to = *to < 0 ? fmin(high, -least) : high;
}

/* Each frequency begins with the orbit of the nearest one of the table. */
static void seed_rows(fit_rows *rows, const fit_problem *p, const double *u)
{
    for (int i = 0; i < rows->count; ++i) {
        const fit_row *nearest = NULL;
        for (int k = 0; k < p->rows.count; ++k) {
            const fit_row *row = &p->rows.rows[k];
            if (row->last.origin == FIT_ORBIT && row->frequency * rows->rows[i].frequency > 0 &&
                (!nearest || fabs(row->frequency - rows->rows[i].frequency) <
                                 fabs(nearest->frequency - rows->rows[i].frequency)))
                nearest = row;
        }
        if (nearest)
            rows->rows[i].last = nearest->last;
        memcpy(rows->rows[i].at, u, sizeof rows->rows[i].at);
    }
}

static void take_points(const fit_problem *p, const fit_estimate *e, double scale, const fit_rows *rows,
                        const fit_value *values, fit_curve *curve)
{
    const int n = p->space.count;
    for (int i = 0; i < curve->count; ++i) {
        fst_fit_curve_point *point = &curve->points[i];
        point->frequency = rows->rows[i].frequency;
        for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
            double slope[FIT_MOST];
            for (int k = 0; k < n; ++k)
                slope[k] = curve->slopes[i * n + k][q];
            const int found = values[i].origin == FIT_ORBIT;
            point->value[q] = found ? values[i].value[q] : NAN;
            point->spread[q] = found ? scale * sqrt(fit_product(&e->covariance, slope, slope)) : NAN;
        }
    }
}

fst_status fit_curve_make(const fit_problem *p, const fit_estimate *e, double scale, double from, double to,
                          int count, fit_curve *curve, fst_error *error)
{
    fit_rows rows = {0};
    double *frequencies = calloc((size_t)count, sizeof *frequencies);
    fit_value *values = calloc((size_t)count, sizeof *values);
    *curve = (fit_curve){.count = count};
    curve->points = calloc((size_t)count, sizeof *curve->points);
    curve->slopes = calloc((size_t)count * (size_t)p->space.count, sizeof *curve->slopes);
    fst_status status = frequencies && values && curve->points && curve->slopes
                            ? FST_OK
                            : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (int i = 0; i < count && status == FST_OK; ++i)
        frequencies[i] = from + (to - from) * i / (count > 1 ? count - 1 : 1);
    if (status == FST_OK)
        status = fit_rows_begin(&rows, &p->space, frequencies, count, p->rows.progress, error);
    if (status == FST_OK) {
        seed_rows(&rows, p, e->u);
        status = fit_rows_values(&rows, e->u, values, error);
    }
    if (status == FST_OK) {
        fit_rows_keep(&rows, e->u, values);
        status = fit_rows_slopes(&rows, curve->slopes, error);
    }
    if (status == FST_OK)
        take_points(p, e, scale, &rows, values, curve);
    else
        fit_curve_free(curve);
    fit_rows_free(&rows);
    free(frequencies);
    free(values);
    return status;
}
