/* made_tracks.c - filming beads that the library moves (made_tracks.h). */
#include "made_tracks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"

enum { MOMENTS = 16 }; /* of an exposure, that are averaged */

static void must(int true_here, const char *what)
{
    if (!true_here) {
        fprintf(stderr, "made_tracks: %s\n", what);
        abort();
    }
}

static fst_status keep_sample(void *user, const fst_sample *sample, fst_error *error)
{
    made_motion *m = user;
    (void)error;
    if (m->count == m->capacity) {
        m->capacity = m->capacity ? 2 * m->capacity : 4096;
        double **const arrays[] = {&m->t, &m->x, &m->y, &m->vx, &m->vy};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
            *arrays[i] = realloc(*arrays[i], m->capacity * sizeof **arrays);
            must(*arrays[i] != NULL, "no memory");
        }
    }
    const double length = 1e3 * m->length_unit, time = m->time_unit;
    m->t[m->count] = sample->t * time;
    m->x[m->count] = sample->x * length;
    m->y[m->count] = sample->y * length;
    m->vx[m->count] = sample->v_lab[0] * length / time;
    m->vy[m->count++] = sample->v_lab[1] * length / time;
    return FST_OK;
}

void made_motion_follow(made_motion *motion, const fst_params *params)
{
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    fst_model *model = NULL;
    fst_error error;
    memset(motion, 0, sizeof *motion);
    must(fst_model_new(params, &model, &error) == FST_OK, "no model");
    const fst_groups groups = fst_model_groups(model);
    fst_model_free(model);
    motion->time_unit = groups.time_unit;
    motion->length_unit = groups.length_unit;
    options.sink.user = motion;
    options.sink.sample = keep_sample;
    options.sample_from = params->run_discard;
    must(fst_run(params, &options, &result, &error) == FST_OK, error.sentence);
    motion->regime = result.regime;
    motion->drive = result.frequency_hz;
    motion->mean_r = 1e3 * groups.length_unit * result.mean_r;
    motion->std_r = 1e3 * groups.length_unit * result.std_r;
    motion->bead = result.mean_alpha_dot / groups.time_unit / FST_TWO_PI;
    motion->festoons = result.festoons;
}

void made_motion_free(made_motion *motion)
{
    free(motion->t);
    free(motion->x);
    free(motion->y);
    free(motion->vx);
    free(motion->vy);
    memset(motion, 0, sizeof *motion);
}

double made_chance(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    uint64_t z = *seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

double made_normal(uint64_t *seed)
{
    const double one = 1.0 - made_chance(seed), other = made_chance(seed);
    return sqrt(-2.0 * log(one)) * cos(FST_TWO_PI * other);
}

/* The place at a moment, by the cubic through the samples and their velocities. */
static void place_at(const made_motion *m, double t, double place[2])
{
    const double step = m->t[1] - m->t[0], at = (t - m->t[0]) / step;
    must(at >= 0 && at < (double)(m->count - 1), "the film is longer than the motion");
    const size_t i = (size_t)at;
    const double h = m->t[i + 1] - m->t[i], u = (t - m->t[i]) / h;
    const double a = (1 + 2 * u) * (1 - u) * (1 - u), b = u * (1 - u) * (1 - u);
    const double c = u * u * (3 - 2 * u), d = u * u * (u - 1);
    place[0] = a * m->x[i] + b * h * m->vx[i] + c * m->x[i + 1] + d * h * m->vx[i + 1];
    place[1] = a * m->y[i] + b * h * m->vy[i] + c * m->y[i + 1] + d * h * m->vy[i + 1];
}

made_film made_film_plain(void)
{
    return (made_film){.fps = 240.0, .seconds = 5.0, .scale = 4.0, .noise = 0.2, .clock = 1.0, .seed = 1};
}

void made_track(const made_motion *motion, const made_film *film, fst_track *track)
{
    uint64_t seed = film->seed;
    const double along = film->along * FST_PI / 180.0, c = cos(along), s = sin(along);
    const double shrunk = cos(film->tilt * FST_PI / 180.0);
    *track = (fst_track){.fps = film->fps / film->clock, .steady = 1, .length_unit = "px"};
    for (int64_t frame = 0; (double)frame < film->seconds * film->fps; ++frame) {
        const double t = (double)frame / film->fps;
        const int moments = film->exposure > 0 ? MOMENTS : 1;
        double sum[2] = {0, 0};
        for (int k = 0; k < moments; ++k) {
            double place[2];
            const double later = film->exposure * ((k + 0.5) / moments - 0.5);
            place_at(motion, motion->t[0] + film->start + 0.1 + t + later, place);
            sum[0] += place[0] / moments;
            sum[1] += place[1] / moments;
        }
        if (film->mirrored)
            sum[1] = -sum[1];
        const double u = c * sum[0] + s * sum[1], v = shrunk * (c * sum[1] - s * sum[0]);
        double x = 640.0 + film->scale * (c * u - s * v) + film->noise * made_normal(&seed);
        double y = 360.0 + film->scale * (s * u + c * v) + film->noise * made_normal(&seed);
        if (made_chance(&seed) < film->lost)
            continue;
        if (made_chance(&seed) < film->wild) {
            x = 1280.0 * made_chance(&seed);
            y = 720.0 * made_chance(&seed);
        }
        must(fst_track_append(track, frame, t * film->clock, x, y, NULL) == FST_OK, "no memory");
    }
}
