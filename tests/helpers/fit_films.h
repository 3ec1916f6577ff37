/* fit_films.h - synthetic tracks: a run's samples, with noise, tilt and exposure on top. */
#ifndef FESTOON_TESTS_FIT_FILMS_H
#define FESTOON_TESTS_FIT_FILMS_H

#include <stdio.h>
#include <string.h>

#include "fit_tables.h"

enum { SAMPLES = 64, PERIODS = 48, EACH = 4 }; /* samples a turn of the magnet; turns; samples a frame */

static const char *const fit_keys[] = {"model.kappa", "friction.gamma"};

typedef struct film {
    double t[SAMPLES * PERIODS + 1], x[SAMPLES * PERIODS + 1], y[SAMPLES * PERIODS + 1]; /* s, mm */
    double slip[SAMPLES * PERIODS + 1][2],
        slid[SAMPLES * PERIODS + 1][2]; /* V = v - R W x e, mm/s; its integral, mm */
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
        const double slip[2] = {unit * (sample->v_lab[0] - eps * sample->w_lab[1]),
                                unit * (sample->v_lab[1] + eps * sample->w_lab[0])};
        memcpy(f->slip[f->count], slip, sizeof slip);
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

static inline void make_film_of(const fst_params *setup, film *f)
{
    fst_params params = *setup;
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
    for (int i = 1; i + 2 < f->count; ++i) /* by the cubic through four samples */
        for (int k = 0; k < 2; ++k)
            f->slid[i + 1][k] = f->slid[i][k] + (f->t[i + 1] - f->t[i]) / 24.0 *
                                                    (13.0 * (f->slip[i][k] + f->slip[i + 1][k]) -
                                                     f->slip[i - 1][k] - f->slip[i + 2][k]);
}

static inline void make_film(film *f)
{
    const fst_params params = truth();
    make_film_of(&params, f);
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

/* The slope in the middle of eleven values of which a polynomial of seventh order goes by the least squares (Savitzky and
 * Golay): the weights of the five on each side. */
static const double slope_weights[5] = {0.4176881942, 0.2369277781, -0.2076766371, 0.0692498678, -0.009102662};

/* The slip as a film tells it that shows lengths `scale` times as large as they are, with `noise` (mm) in the rolling of each
 * frame, and a bead that is larger by the share `larger` than it was taken for.  Returns in how many frames it is; there are
 * gaps. */
static inline int add_slip(const film *f, int mirrored, double scale, double larger, double noise,
                           uint64_t *seed, fst_track *track)
{
    static double off[SAMPLES * PERIODS / EACH + 1][2];
    const double step = f->t[EACH] - f->t[0];
    const int frames = (int)track->rows;
    int told = 0;
    assert_int_equal(fst_track_add_turning(track, NULL), FST_OK);
    for (int i = 0; i < frames; ++i)
        for (int k = 0; k < 2; ++k)
            off[i][k] = noise * fit_normal(seed);
    for (int i = 6; i + 6 < frames; i += i % 50 ? 1 : 5) {
        double v[2] = {0.0, 0.0}, slip[2] = {0.0, 0.0}, gain = 0.0;
        for (int k = 1; k <= 5; ++k) {
            const int a = EACH * (i - k), b = EACH * (i + k);
            const double w = slope_weights[k - 1] / step;
            v[0] += w * (f->x[b] - f->x[a]);
            v[1] += w * (f->y[b] - f->y[a]);
            for (int q = 0; q < 2; ++q)
                slip[q] += w * (f->slid[b][q] - f->slid[a][q] + off[i + k][q] - off[i - k][q]);
            gain += 2.0 * w * w;
        }
        for (int q = 0; q < 2; ++q) /* from the velocity and a rolling that is too small */
            track->turning[i].slip[q] =
                (mirrored && q == 0 ? -1.0 : 1.0) * (scale * v[q] - (v[q] - slip[q]) / (1.0 + larger));
        track->turning[i].slip_error = noise * sqrt(gain);
        ++told;
    }
    return told;
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
