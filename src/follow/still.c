/* still.c - the median of frames at random times, and its noise. */
#include "follow/still.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/chance.h"
#include "base/error.h"
#include "base/watch.h"
#include "follow/decoder.h"

#define DARK 16.0f       /* gray levels: of less a ratio tells little */
#define ALIKE 0.25       /* of the picture's gradient that a frame in the right place has */
#define LEAST_SHAKE 0.15 /* pixels, rms: less is not a shake */
#define LEAST_ROLL 0.3   /* pixels, rms, at the picture's sides: less is not a roll */
#define STEADY 0.03      /* pixels: shifting back once more changes nothing */
#define NEAR 0.08f       /* part of the level within which a pixel counts as background */

enum {
    STEADY_ROUNDS = 5,
    BAND = 30,
    MOST_BANDS = 48,
    MOST_MEMORY = 1 << 29,
    LEAST_SAMPLES = 15,
    LEVELS = 256,
    BINS = 1024,
    ROWS_BETWEEN_QUESTIONS = 16
};

/* ------------------------------------------------------------------ which frames */

/* Choose `count` of `frames` numbers, each set of them as likely as any other, in rising order. */
static void choose(int frames, int count, int *chosen)
{
    uint64_t state = 20200707;
    int left = count;
    for (int i = 0, k = 0; i < frames && left > 0; ++i)
        if (fst_draw(&state) % (uint64_t)(frames - i) < (uint64_t)left) {
            chosen[k++] = i;
            --left;
        }
}

/* ------------------------------------------------------------------ reading them */

static fst_status keep_frame(follow_still *s, const follow_decoder *d, fst_error *error)
{
    const size_t size = (size_t)d->width * (size_t)d->height;
    if (!s->samples) {
        s->width = d->width;
        s->height = d->height;
        s->samples = malloc(size * FOLLOW_SAMPLES);
        s->level = malloc(size * sizeof *s->level);
        if (!s->samples || !s->level)
            return fst_fail(error, FST_NO_MEMORY, d->source->path, "no memory for frames of %d x %d pixels",
                            d->width, d->height);
    }
    memcpy(s->samples + size * (size_t)s->count, d->pixels, size);
    /* Of very large frames fewer are kept, so that memory is bounded. */
    if (size * (size_t)(s->count + 1) <= MOST_MEMORY || s->count < LEAST_SAMPLES)
        ++s->count;
    return FST_OK;
}

static fst_status read_samples(follow_still *s, const follow_source *source, const fst_progress *progress,
                               fst_error *error)
{
    int chosen[FOLLOW_SAMPLES], there = 1;
    const int count = source->frames < FOLLOW_SAMPLES ? source->frames : FOLLOW_SAMPLES;
    follow_decoder decoder;
    choose(source->frames, count, chosen);
    fst_status status = follow_decoder_start(&decoder, source, chosen, count, progress, error);
    while (status == FST_OK && there) {
        status = follow_decoder_next(&decoder, &there, error);
        if (status == FST_OK && there && s->count < FOLLOW_SAMPLES)
            status = keep_frame(s, &decoder, error);
        decoder.child.fraction = 0.9 * decoder.frame / count;
        if (status == FST_OK)
            status = fst_tell(progress, decoder.child.fraction, NULL, error);
    }
    (void)follow_decoder_end(&decoder, status != FST_OK);
    if (status == FST_OK && s->count < FOLLOW_LEAST_FRAMES)
        status = fst_fail(error, FST_BAD_INPUT, source->path, "only %d of its frames can be decoded: %.200s",
                          s->count, decoder.child.said);
    return status;
}

/* ------------------------------------------------------------------ the picture */

/* The median of a few levels, by counting. */
static int median_of(const unsigned char *levels, int count, unsigned short counts[LEVELS])
{
    int seen = 0, level = 0;
    for (int i = 0; i < count; ++i)
        ++counts[levels[i]];
    while ((seen += counts[level]) * 2 <= count)
        ++level;
    for (int i = 0; i < count; ++i)
        counts[levels[i]] = 0;
    return level;
}

/* The mean of the samples near the median has finer steps and less noise than the median itself. */
static double level_of(const unsigned char *levels, const float *gains, int stride, int count, int median,
                       double near)
{
    double sum = 0.0;
    int used = 0;
    for (int i = 0; i < count; ++i) {
        const double level = levels[i] / (double)gains[i * stride];
        if (fabs(level - median) <= near) {
            sum += level;
            ++used;
        }
    }
    return used ? sum / used : median;
}

static fst_status make_picture(follow_still *s, double near, const fst_progress *progress, double fraction,
                               fst_error *error)
{
    const size_t size = (size_t)s->width * (size_t)s->height;
    unsigned short counts[LEVELS] = {0};
    unsigned char column[FOLLOW_SAMPLES];
    for (size_t i = 0; i < size; ++i) {
        const float *gains = s->gains + i / (size_t)s->width;
        for (int k = 0; k < s->count; ++k) {
            const float level = s->samples[(size_t)k * size + i] / gains[k * s->height] + 0.5f;
            column[k] = (unsigned char)(level < LEVELS ? level : LEVELS - 1);
        }
        const int median = median_of(column, s->count, counts);
        for (int k = 0; k < s->count; ++k)
            column[k] = s->samples[(size_t)k * size + i];
        s->level[i] = (float)level_of(column, gains, s->height, s->count, median, near);
        if (i % ((size_t)s->width * ROWS_BETWEEN_QUESTIONS) == 0) {
            const fst_status told = fst_tell(progress, fraction, NULL, error);
            if (told != FST_OK)
                return told;
        }
    }
    return FST_OK;
}

/* The factor of some rows: the median of the ratios of pixels, then their mean near it. */
static double gain_of_rows(const follow_still *still, const unsigned char *frame, int from, int to)
{
    const size_t begin = (size_t)from * (size_t)still->width, end = (size_t)to * (size_t)still->width;
    const size_t step = end - begin > 4000 ? (end - begin) / 1999 : 1;
    int counts[BINS] = {0}, all = 0, seen = 0, bin = 0;
    for (size_t i = begin; i < end; i += step) {
        if (still->level[i] < DARK)
            continue;
        const float part = (float)frame[i] / still->level[i] * (BINS / 4);
        ++counts[part < BINS - 1 ? (int)part : BINS - 1];
        ++all;
    }
    if (all == 0)
        return 1.0;
    while ((seen += counts[bin]) * 2 <= all)
        ++bin;
    const float middle = ((float)bin + 0.5f) * 4.0f / BINS;
    double over = 0.0, under = 0.0;
    for (size_t i = begin; i < end; i += step)
        if (still->level[i] >= DARK &&
            fabsf((float)frame[i] - middle * still->level[i]) < NEAR * still->level[i]) {
            over += frame[i];
            under += (double)still->level[i];
        }
    return fmax(0.05, under > 0.0 ? over / under : (double)middle);
}

void follow_still_gains(const follow_still *still, const unsigned char *frame, float *gains)
{
    double bands[MOST_BANDS];
    const int count = still->height / BAND < 1            ? 1
                      : still->height / BAND < MOST_BANDS ? still->height / BAND
                                                          : MOST_BANDS;
    for (int k = 0; k < count; ++k)
        bands[k] = gain_of_rows(still, frame, still->height * k / count, still->height * (k + 1) / count);
    for (int row = 0; row < still->height; ++row) { /* straight lines between the middles of the bands */
        const double at = fmax(0.0, fmin(count - 1.0, (row + 0.5) * count / still->height - 0.5));
        const int k = (int)at < count - 1 ? (int)at : count - 1, next = k + 1 < count ? k + 1 : k;
        gains[row] = (float)(bands[k] + (at - k) * (bands[next] - bands[k]));
    }
}

/* The deviation of the samples from the picture, by its median: what moves does not count. */
static double noise_of(const follow_still *s)
{
    const size_t size = (size_t)s->width * (size_t)s->height, step = size > 40000 ? size / 20011 : 1;
    int counts[4 * LEVELS] = {0}, all = 0, seen = 0, bin = 0;
    for (int k = 0; k < s->count; ++k)
        for (size_t i = step / 2; i < size; i += step) {
            const double off =
                fabs(s->samples[(size_t)k * size + i] -
                     (double)(s->gains[(size_t)k * (size_t)s->height + i / (size_t)s->width] * s->level[i]));
            ++counts[off < LEVELS - 1 ? (int)(4.0 * off) : 4 * LEVELS - 1];
            ++all;
        }
    while ((seen += counts[bin]) * 2 <= all)
        ++bin;
    return fmax(0.5, 1.4826 * (bin + 0.5) / 4.0);
}

/* First as if all frames were equally bright, then with the brightness that each turned out to have. */
static fst_status make_twice(follow_still *still, const fst_progress *progress, fst_error *error)
{
    const size_t size = (size_t)still->width * (size_t)still->height, rows = (size_t)still->height;
    for (size_t i = 0; i < rows * (size_t)still->count; ++i)
        still->gains[i] = 1.0f;
    fst_status status = make_picture(still, 1.0, progress, 0.92, error);
    for (int k = 0; k < still->count && status == FST_OK; ++k)
        follow_still_gains(still, still->samples + (size_t)k * size, still->gains + (size_t)k * rows);
    still->noise = noise_of(still);
    if (status == FST_OK)
        status = make_picture(still, 2.0 * still->noise + 1.0, progress, 0.96, error);
    for (int k = 0; k < still->count && status == FST_OK; ++k)
        follow_still_gains(still, still->samples + (size_t)k * size, still->gains + (size_t)k * rows);
    still->noise = noise_of(still);
    return status;
}

/* ------------------------------------------------------------------ a camera that shakes */

void follow_still_steady(const follow_still *still, follow_shake *shake, unsigned char *frame, float *room,
                         double shift[2])
{
    double found[2] = {shift[0], shift[1]};
    follow_still_gains(still, frame, room);
    if (follow_shake_find(shake, frame, room, found) > ALIKE)
        memcpy(shift, found, sizeof found);
    follow_shake_undo(shake, room, shift, frame);
}

/* What comparing the samples with their picture says: the root mean square of their shifts, the greatest, and how many
 * tell one, and are like the picture there; the same of how far they are turned. */
typedef struct comparison {
    double moved, most, roll; /* pixels; rad */
    int found, alike;
} comparison;

/* Compare all samples with the picture, and shift them back where they moved by more than `least`. */
static comparison compare_samples(follow_still *s, follow_shake *shake, double least)
{
    double shifts[FOLLOW_SAMPLES][2] = {{0.0}}, squares = 0.0, turns = 0.0;
    comparison c = {.moved = NAN};
    for (int k = 0; k < s->count; ++k) {
        unsigned char *sample = s->samples + (size_t)k * (size_t)s->width * (size_t)s->height;
        const double alike =
            follow_shake_find(shake, sample, s->gains + (size_t)k * (size_t)s->height, shifts[k]);
        double moved, turned;
        follow_shake_squares(shake, shifts[k], &moved, &turned);
        turns += turned / s->count;
        c.found += !isnan(alike);
        c.alike += alike > ALIKE;
        squares += moved;
        c.most = fmax(c.most, fmax(fabs(shifts[k][0]), fabs(shifts[k][1])));
    }
    c.roll = sqrt(fmax(0.0, turns));
    if (c.found > s->count * 3 / 4)
        c.moved = sqrt(fmax(0.0, squares / c.found));
    if (!(c.moved > least))
        return c;
    s->margin += (int)ceil(c.most);
    shake->margin = s->margin;
    for (int k = 0; k < s->count; ++k) {
        unsigned char *sample = s->samples + (size_t)k * (size_t)s->width * (size_t)s->height;
        const float *gains = s->gains + (size_t)k * (size_t)s->height;
        double again[2] = {shifts[k][0], shifts[k][1]};
        (void)follow_shake_find(shake, sample, gains, again); /* undoing takes the frame of the last search */
        follow_shake_undo(shake, gains, shifts[k], sample);
    }
    return c;
}

/* Where the camera shook, shift the samples back, and make the picture anew, which becomes sharper by it. */
static fst_status steady_samples(follow_still *s, const fst_progress *progress, fst_error *error)
{
    fst_status status = FST_OK;
    for (int round = 0; round < STEADY_ROUNDS && status == FST_OK; ++round) {
        follow_shake shake;
        if (!follow_shake_begin(&shake, s->level, s->width, s->height, s->margin)) {
            follow_shake_end(&shake);
            return fst_fail(error, FST_NO_MEMORY, "track", "no memory for the shake of the camera");
        }
        const double least = round == 0 ? LEAST_SHAKE : STEADY;
        const comparison c = compare_samples(s, &shake, least);
        follow_shake_end(&shake);
        s->unsteady = c.alike > s->count * 3 / 4 || round == 0 ? c.moved : INFINITY;
        if (round == 0 && c.moved > least)
            s->shake = c.moved;
        s->roll = 0.5 * s->width * c.roll > LEAST_ROLL ? c.roll : 0.0;
        if (!(c.moved > least))
            break;
        status = make_twice(s, progress, error);
    }
    return status;
}

fst_status follow_still_make(follow_still *still, const follow_source *source, const fst_progress *progress,
                             fst_error *error)
{
    *still = (follow_still){.width = 0};
    fst_status status = read_samples(still, source, progress, error);
    if (status != FST_OK)
        return status;
    const size_t rows = (size_t)still->height;
    still->gains = malloc(rows * (size_t)still->count * sizeof *still->gains);
    if (!still->gains)
        return fst_fail(error, FST_NO_MEMORY, source->path, "no memory for the brightness of its rows");
    status = make_twice(still, progress, error);
    return status == FST_OK ? steady_samples(still, progress, error) : status;
}

void follow_still_drop_samples(follow_still *still)
{
    free(still->samples);
    free(still->gains);
    still->samples = NULL;
    still->gains = NULL;
}

void follow_still_free(follow_still *still)
{
    follow_still_drop_samples(still);
    free(still->level);
    *still = (follow_still){.width = 0};
}
