/* fit_films.h - synthetic tracks: a run's samples, with noise, tilt and exposure on top. */
#ifndef FESTOON_TESTS_FIT_FILMS_H
#define FESTOON_TESTS_FIT_FILMS_H

#include <stdio.h>

#include "fit_tables.h"

enum { SAMPLES = 64, PERIODS = 48, EACH = 4 }; /* samples a turn of the magnet; turns; samples a frame */

static const char *const fit_keys[] = {"model.kappa", "friction.gamma"};

typedef struct film {
    double t[SAMPLES * PERIODS + 1], x[SAMPLES * PERIODS + 1], y[SAMPLES * PERIODS + 1]; /* s, mm */
    double slip[SAMPLES * PERIODS + 1][2]; /* V = v - R W x e, mm/s */
    int count;
    double time_unit;
} film;

static inline fst_status keep(void *user, const fst_sample *sample, fst_error *error)
{
    film *f = user;
    (void)error;
    if (f->count <= SAMPLES * PERIODS) {
        f->t[f->count] = sample->t * f->time_unit;
        const double unit = 23.0 / f->time_unit, eps = 2.5 / 23.0;
        f->slip[f->count][0] = unit * (sample->v_lab[0] - eps * sample->w_lab[1]);
        f->slip[f->count][1] = unit * (sample->v_lab[1] + eps * sample->w_lab[0]);
        f->x[f->count] = 23.0 * sample->x;
        f->y[f->count++] = 23.0 * sample->y;
    }
    return FST_OK;
}

static inline fst_params truth(void)
{
    fst_params params = fst_default_params();
    params.model_kappa = 1.7;
    params.friction_gamma = 290.0;
    params.drive_frequency = 11.3;
    return params;
}

static inline void make_film(film *f)
{
    fst_params params = truth();
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    params.run_periods = 80 + PERIODS;
    params.run_discard = 80;
    params.run_samples = SAMPLES;
    *f = (film){.time_unit = 1.0 / params.friction_gamma};
    options.sink = (fst_run_sink){.user = f, .sample = keep};
    options.sample_from = 80.0;
    assert_int_equal(fst_run(&params, &options, &result, NULL), FST_OK);
    assert_true(f->count >= SAMPLES * PERIODS);
}

/* What a camera makes of it: frames that last `blur` samples, tilted, mirrored where the magnet is to turn
 * clockwise. */
static inline void make_track(const film *f, int blur, double tilt_deg, int mirrored, double noise,
                              fst_track *track)
{
    uint64_t seed = 99;
    *track = (fst_track){.length_unit = "mm", .fps = 11.3 * SAMPLES / EACH, .steady = 1};
    for (int i = blur; i + blur < f->count; i += EACH) {
        double x = 0.0, y = 0.0;
        for (int k = i - blur; k <= i + blur; ++k) {
            x += f->x[k] / (2 * blur + 1);
            y += f->y[k] / (2 * blur + 1);
        }
        y *= cos(tilt_deg / 57.29577951308232);
        x = (mirrored ? -x : x) + 40.0 + noise * fit_normal(&seed);
        y += 30.0 + noise * fit_normal(&seed);
        assert_int_equal(fst_track_append(track, i / EACH, f->t[i], x, y, NULL), FST_OK);
    }
}

static inline void must_fit(fst_track *track, fst_fit_options *options, fst_fit *fit)
{
    const fst_params start = fst_default_params();
    fst_error error = {0};
    options->free = fit_keys;
    options->free_count = 2;
    if (fst_fit_track(&start, track, options, fit, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
}

/* Within four standard deviations, and these are as small as the film allows. */
static inline void check(const fst_fit *fit)
{
    const double strength = 1.7 * 290.0 * 290.0;
    assert_true(fabs(fit->parameters[0].value - 1.7) < 4.0 * fit->parameters[0].error);
    assert_true(fabs(fit->parameters[1].value - 290.0) < 4.0 * fit->parameters[1].error);
    assert_true(fabs(fit->kappa_gamma2 - strength) < 4.0 * fit->kappa_gamma2_error);
    assert_true(fit->parameters[1].error < 3.0 && fit->kappa_gamma2_error < 2e-3 * strength);
    assert_true(fit->correlation[0][1] < -0.98);
    assert_non_null(strstr(fit->weakest, "friction.gamma"));
    assert_true(fabs(fabs(fit->drive) - 11.3) < 4.0 * fit->drive_error && fit->drive_error < 0.01);
}

#endif
