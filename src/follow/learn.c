/* learn.c - the bead's contrast and size, from frames at random times.
 *
 * What moves is one spot in nearly every sample, all of about the same area, or as many as there are beads, which make one
 * spot where they touch.  It is darker or brighter than the background: that sign is taken which most of the difference has.
 */
#include "follow/learn.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/order.h"
#include "base/watch.h"
#include "follow/shadow.h"
#include "follow/split.h"

#define MOST_ROLL 0.02     /* rad: where a camera rolls by more, places and n are worth nothing */
#define LEAST_CONTRAST 8.0 /* gray levels: less is not a bead that can be followed */
#define OF_NOISE 6.0       /* a bead's difference, in deviations of a pixel */
#define OF_CONTRAST 0.15   /* where a spot ends, in parts of the contrast */
#define SECOND 0.5         /* a second spot of this part of the first one's area is another bead */
#define SHARP 0.85         /* of the samples are blurred more: a blurred bead has less contrast */
#define NOISY 12.0         /* a bead that differs by less, in deviations of a pixel, is hard to follow */
#define DARK 40.0          /* gray levels of the brightest of a dark picture */
#define MOST_MARGIN 5      /* times a shake's margin must fit into the picture */
#define UNSTEADY 0.3       /* pixels that shifting back may leave */
#define SEEN 0.5           /* part of the samples in which a bead must be seen */
#define UNHIDDEN 0.75      /* of the samples show less of several beads, which hide each other */
#define TWICE 0.3          /* part of the samples in which one more is too many */

/* The value below which the given part of the values lies; 0 of none. */
static double quantile(double *values, int count, double part)
{
    qsort(values, (size_t)count, sizeof *values, fst_ascending);
    return count ? values[(int)(part * (count - 1) + 0.5)] : 0.0;
}

static const unsigned char *sample(const follow_blobs *blobs, int k)
{
    const follow_still *s = blobs->still;
    return s->samples + (size_t)k * (size_t)s->width * (size_t)s->height;
}

static const float *gains_of(const follow_blobs *blobs, int k)
{
    return blobs->still->gains + (size_t)k * (size_t)blobs->still->height;
}

/* The spot with the greatest sum; NULL: there is none. */
static const follow_box *greatest(const follow_blobs *blobs)
{
    const follow_box *best = NULL;
    for (int i = 0; i < blobs->count; ++i)
        if (!best || blobs->boxes[i].sum > best->sum)
            best = &blobs->boxes[i];
    return best;
}

/* Whether all eight pixels around one of a spot belong to it too, `depth` pixels deep. */
static int is_inside(const follow_blobs *b, const follow_box *box, int column, int row, int depth)
{
    for (int y = row - depth; y <= row + depth; ++y)
        for (int x = column - depth; x <= column + depth; ++x)
            if (x < box->left || x > box->right || y < box->top || y > box->bottom ||
                b->mask[y * b->still->width + x] != box->label)
                return 0;
    return 1;
}

/* The contrast of a spot: of its pixels well inside, the lower third: highlights and the lit side of a ball are
 * the lighter part of it, and count as covered then. */
static double contrast_of(const follow_blobs *b, const unsigned char *frame, const float *gains, double sign,
                          const follow_box *box)
{
    enum { MOST = 4096 };
    double values[MOST];
    int count = 0;
    for (int depth = 2; depth >= 0 && count < 5; --depth) {
        count = 0;
        for (int row = box->top; row <= box->bottom && count < MOST; ++row)
            for (int column = box->left; column <= box->right && count < MOST; ++column) {
                const size_t at = (size_t)row * (size_t)b->still->width + (size_t)column;
                const double behind = (double)(gains[row] * b->still->level[at]);
                if (is_inside(b, box, column, row, depth))
                    values[count++] =
                        sign > 0.0 ? (behind - frame[at]) / fmax(behind, 1.0) : frame[at] - behind;
            }
    }
    return quantile(values, count, 0.33);
}

/* Which sign the bead has: by the sums of the greatest spots of both. */
static fst_status find_sign(follow_blobs *b, double threshold, const fst_progress *progress, double *sign,
                            int *crowded, fst_error *error)
{
    double sums[2] = {0.0, 0.0};
    *crowded = 0;
    for (int k = 0; k < b->still->count; ++k) {
        const float *gains = gains_of(b, k);
        for (int bright = 0; bright < 2; ++bright) {
            follow_blobs_find(b, sample(b, k), gains, bright ? -1.0 : 1.0, threshold);
            const follow_box *box = greatest(b);
            sums[bright] += box ? box->sum : 0.0;
            *crowded += b->count > 30;
        }
        const fst_status told = fst_tell(progress, 0.5 * k / b->still->count, NULL, error);
        if (told != FST_OK)
            return told;
    }
    *sign = sums[1] > sums[0] ? -1.0 : 1.0;
    return FST_OK;
}

/* What the samples say of the bead. */
typedef struct learnt {
    double contrasts[FOLLOW_SAMPLES], areas[FOLLOW_SAMPLES];
    int beads;                        /* how many there are; `areas` are sums over them */
    double shifts[2][FOLLOW_SAMPLES]; /* pixels from the centroid of the cover to the centre of the outline */
    double behind;                    /* level of the background behind it, summed over the samples */
    int seen, twice;
    follow_outline outline;
} learnt;

static fst_status measure_size(follow_blobs *b, int k, const follow_look *look, learnt *lesson,
                               fst_error *error)
{
    const float *gains = gains_of(b, k);
    double best = 0.0, place[2] = {0.0, 0.0}, areas[FST_TRACKED_BEADS + 1] = {0.0}; /* the greatest first */
    follow_blobs_find(b, sample(b, k), gains, look->sign, look->threshold);
    for (int i = 0; i < b->count; ++i) {
        follow_cover cover;
        const fst_status status = follow_blobs_cover(b, sample(b, k), gains, look, &b->boxes[i], &cover, error);
        if (status != FST_OK)
            return status;
        if (cover.area > best) {
            best = cover.area;
            place[0] = cover.column;
            place[1] = cover.row;
        }
        for (int at = lesson->beads; at >= 0 && cover.area > areas[at]; --at) {
            if (at < lesson->beads)
                areas[at + 1] = areas[at];
            areas[at] = cover.area;
        }
    }
    if (!(best > 0.0))
        return FST_OK;
    double sum = 0.0;
    for (int i = 0; i < lesson->beads; ++i)
        sum += areas[i];
    for (int i = 0; i < 2; ++i)
        lesson->shifts[i][lesson->seen] = lesson->outline.places[k][i] - place[i];
    lesson->areas[lesson->seen++] = sum;
    lesson->twice += areas[lesson->beads] > SECOND * sum / lesson->beads;
    return FST_OK;
}

static fst_status measure_contrast(follow_blobs *b, int k, double sign, double threshold, learnt *lesson,
                                   fst_error *error)
{
    const float *gains = gains_of(b, k);
    follow_blobs_find(b, sample(b, k), gains, sign, threshold);
    const follow_box *box = greatest(b);
    if (!box)
        return FST_OK;
    const int row = (box->top + box->bottom) / 2, middle = row * b->still->width + (box->left + box->right) / 2;
    lesson->behind += (double)(gains[row] * b->still->level[middle]);
    lesson->contrasts[lesson->seen++] = contrast_of(b, sample(b, k), gains, sign, box);
    return follow_outline_add(&lesson->outline, b, k, sign, box, error);
}

/* How wide the bead is.  Where it has a shadow, take its darkness off the background, in the samples too: what is darker still is
 * the bead. */
static void learn_outline(const follow_blobs *b, learnt *lesson, follow_look *look)
{
    const int count = b->still->height * b->still->count;
    follow_outline_decide(&lesson->outline, look->sign);
    /* Beside another bead a shadow cannot be told from it. */
    look->shade = lesson->beads == 1 ? lesson->outline.shade : 0.0;
    look->diameter = lesson->outline.diameter;
    look->diameter_error = lesson->outline.error;
    if (!(look->shade > 0.0))
        return;
    const double whole = quantile(lesson->outline.contrasts, lesson->outline.seen, SHARP);
    look->contrast = (whole - look->shade) / (1.0 - look->shade);
    for (int i = 0; i < count; ++i)
        b->still->gains[i] *= (float)(1.0 - look->shade);
}

/* Why nothing can be followed, where it is the camera or the light that is at fault; FST_OK: neither. */
static fst_status blame_film(const char *path, const follow_blobs *b, const follow_look *look, fst_error *error)
{
    const follow_still *s = b->still;
    double bright = 0.0;
    for (int i = 0; i < s->width * s->height; ++i)
        bright = fmax(bright, (double)s->level[i]);
    if (look->levels > 0.0 && look->levels < NOISY * s->noise)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "too little light: the bead differs from the plate by %.0f gray levels of 255, and the noise "
            "of a pixel is %.1f; take more light or a longer exposure, so that it differs by %.0f times "
            "the noise",
            look->levels, s->noise, NOISY);
    if (OF_NOISE * s->noise > LEAST_CONTRAST || bright < DARK)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "too little light: the brightest of the picture has %.0f gray levels of 255, the noise of a "
            "pixel is %.1f, and no bead stands out by the %.0f levels that it takes; take more light or a "
            "longer exposure",
            bright, s->noise, fmax(OF_NOISE * s->noise, LEAST_CONTRAST));
    return FST_OK;
}

static fst_status no_bead(const char *path, const follow_blobs *b, const follow_look *look, int seen,
                          int crowded, fst_error *error)
{
    const fst_status status = blame_film(path, b, look, error);
    if (status != FST_OK)
        return status;
    if (crowded > b->still->count / 2)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "the picture changes in many places at once: the camera must not move while it films, "
                        "and the light must stay");
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "no bead was found: in %d of %d frames looked at, something stands out from what stays still by %.0f "
        "gray levels of 255 or more; a bead that rests, or hardly moves, cannot be told from the plate",
        seen, b->still->count, look->threshold);
}

static const char *const numbers[] = {"no", "one", "two", "three", "four", "five"};

static fst_status too_many(const char *path, const follow_blobs *b, const follow_look *look,
                           const learnt *lesson, fst_error *error)
{
    const fst_status status = blame_film(path, b, look, error);
    if (status != FST_OK)
        return status;
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "%s things of about the same size move in %d of %d frames looked at, where %s bead%s to be "
        "followed: %scut the others, or reflections, out of the picture, and see that the camera stands "
        "still",
        numbers[lesson->beads + 1], lesson->twice, b->still->count, numbers[lesson->beads],
        lesson->beads == 1 ? " was" : "s were",
        lesson->beads < FST_TRACKED_BEADS ? "say how many beads there are, or " : "");
}

/* A bead's area follows from its width, so that beads which touch are counted too. */
static fst_status check_count(const char *path, const learnt *lesson, double width, int count, fst_error *error)
{
    int enough = 0;
    for (int i = 0; i < lesson->seen; ++i)
        enough += lesson->areas[i] > (lesson->beads - 0.5) * 0.25 * FST_PI * width * width;
    return lesson->beads == 1 || enough >= SEEN * count
               ? FST_OK
               : fst_fail(error, FST_BAD_INPUT, path,
                          "%s beads were to be followed, and in %d of %d frames looked at fewer move: one that "
                          "rests, or hardly moves, cannot be told from the plate",
                          numbers[lesson->beads], count - enough, count);
}

/* A camera that rolled, or shook so much that the samples cannot be shifted back. */
static fst_status check_shake(const char *path, const follow_still *s, fst_error *error)
{
    if (s->roll > MOST_ROLL)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "the camera turns about its own axis by %.2g degrees (rms), which is too much: fix the camera",
            FST_DEGREES * s->roll);
    const int far = MOST_MARGIN * s->margin > (s->width < s->height ? s->width : s->height);
    if (!(s->shake > 0.0) || (s->unsteady < UNSTEADY && !far))
        return FST_OK;
    return fst_fail(
        error, FST_BAD_INPUT, path,
        "the camera moves: the background shifts by %.1f pixels (rms), by up to %d, which is too much to be "
        "followed: fix the camera",
        s->shake, s->margin);
}

fst_status follow_learn(follow_blobs *blobs, const char *path, int beads, const fst_progress *progress,
                        follow_look *look, fst_error *error)
{
    const int count = blobs->still->count;
    const double least = fmax(OF_NOISE * blobs->still->noise, LEAST_CONTRAST);
    learnt lesson = {.beads = beads};
    int crowded = 0;
    *look = (follow_look){.threshold = least};
    fst_status status = check_shake(path, blobs->still, error);
    if (status == FST_OK)
        status = find_sign(blobs, least, progress, &look->sign, &crowded, error);
    for (int k = 0; k < count && status == FST_OK; ++k)
        status = measure_contrast(blobs, k, look->sign, least, &lesson, error);
    if (status == FST_OK && lesson.seen < SEEN * count)
        return no_bead(path, blobs, look, lesson.seen, crowded, error);
    look->contrast = quantile(lesson.contrasts, lesson.seen, SHARP);
    learn_outline(blobs, &lesson, look);
    const double behind = lesson.seen ? (1.0 - look->shade) * lesson.behind / lesson.seen : 0.0;
    look->levels = look->contrast * (look->sign > 0.0 ? behind : 1.0);
    look->threshold = fmax(least, OF_CONTRAST * look->levels);
    lesson.seen = 0;
    for (int k = 0; k < count && status == FST_OK; ++k) {
        status = measure_size(blobs, k, look, &lesson, error);
        if (status == FST_OK)
            status = fst_tell(progress, 0.5 + 0.5 * k / count, NULL, error);
    }
    if (status != FST_OK)
        return status;
    if (lesson.seen < SEEN * count)
        return no_bead(path, blobs, look, lesson.seen, crowded, error);
    if (lesson.twice > TWICE * count)
        return too_many(path, blobs, look, &lesson, error);
    for (int i = 0; i < 2 && look->shade > 0.0; ++i)
        look->shift[i] = quantile(lesson.shifts[i], lesson.seen, 0.5);
    look->area = quantile(lesson.areas, lesson.seen, beads == 1 ? 0.5 : UNHIDDEN) / beads;
    return check_count(path, &lesson, look->diameter, count, error);
}
