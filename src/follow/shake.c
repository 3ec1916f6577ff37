/* shake.c - the shift of a frame, by least squares of its differences from a picture.
 *
 * Where the frame is the picture shifted by d, their difference is the picture's gradient times d, to first order:
 * d follows from all pixels by two equations, and again from what is left.  Eighths of the pictures come first, which
 * shifts of many pixels do not confuse, then quarters, halves and the pictures themselves.  A pixel that differs by
 * much more than most, as where the bead is, counts little.
 */
#include "follow/shake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_SIDE = 24, ROUNDS = 8, MOST_PIXELS = 60000, FIELD = 32 };

#define CLOSE 0.005     /* pixels: the search ends */
#define LEAST_SURE 0.08 /* pixels: a shift that is known worse is not known */
#define MOST_APART 2.0  /* pixels: halves that differ by more do not see one shift */
#define MOST_ROLL 0.2   /* rad: a search that comes so far is lost */

int follow_shake_begin(follow_shake *shake, const float *level, int width, int height, int margin)
{
    *shake = (follow_shake){.margin = margin};
    for (int k = 0; k < FOLLOW_SHAKE_LEVELS; ++k) {
        const int across = width >> k, down = height >> k;
        if (k > 0 && (across < LEAST_SIDE || down < LEAST_SIDE))
            break;
        const size_t size = (size_t)across * (size_t)down * sizeof(float);
        shake->width[k] = across;
        shake->height[k] = down;
        shake->picture[k] = malloc(size);
        shake->frame[k] = malloc(size);
        ++shake->count;
        if (!shake->picture[k] || !shake->frame[k])
            return 0;
    }
    memcpy(shake->picture[0], level, (size_t)width * (size_t)height * sizeof *level);
    return 1;
}

void follow_shake_end(follow_shake *shake)
{
    for (int k = 0; k < shake->count; ++k) {
        free(shake->picture[k]);
        free(shake->frame[k]);
    }
    shake->count = 0;
}

/* Make the smaller ones of the whole: means of four pixels. */
static void halve(const follow_shake *shake, float *const levels[FOLLOW_SHAKE_LEVELS])
{
    for (int k = 1; k < shake->count; ++k)
        for (int row = 0; row < shake->height[k]; ++row)
            for (int column = 0; column < shake->width[k]; ++column) {
                const float *at = levels[k - 1] + 2 * row * shake->width[k - 1] + 2 * column;
                levels[k][row * shake->width[k] + column] =
                    0.25f * (at[0] + at[1] + at[shake->width[k - 1]] + at[shake->width[k - 1] + 1]);
            }
}

static float between(const float *level, int width, float column, float row)
{
    const int i = (int)column, j = (int)row;
    const float p = column - (float)i, q = row - (float)j, *at = level + j * width + i;
    return (1.0f - q) * ((1.0f - p) * at[0] + p * at[1]) + q * ((1.0f - p) * at[width] + p * at[width + 1]);
}

/* Whether a pixel of a level is in the half that is compared; a field of the chequerboard is wider than a block of the
 * film's compression, whose noise is alike. */
static int compared(const follow_shake *shake, int k, int row, int column)
{
    return shake->half == 0 || 1 + ((((row << k) / FIELD) + ((column << k) / FIELD)) & 1) == shake->half;
}

/* The equations for the next step of a shift. */
typedef struct equations {
    double xx, xy, yy, x, y;
    double size;          /* of the differences: what is larger counts little */
    double total, weight; /* of differences up to three times that size; of all pixels */
    int count;
} equations;

static void gather(const follow_shake *shake, int k, const double shift[2], equations *e)
{
    const int width = shake->width[k], height = shake->height[k];
    const float *picture = shake->picture[k], dx = (float)shift[0], dy = (float)shift[1];
    const int rim = 1 + (shake->margin >> k);
    const int left = rim + (dx < 0.0f ? (int)-dx + 1 : 0),
              right = width - 1 - rim - (dx > 0.0f ? (int)dx + 1 : 0);
    const int top = rim + (dy < 0.0f ? (int)-dy + 1 : 0),
              bottom = height - 1 - rim - (dy > 0.0f ? (int)dy + 1 : 0);
    const int stride = 1 + width * height / MOST_PIXELS;
    const double size = e->size;
    *e = (equations){.size = size};
    for (int row = top; row < bottom; ++row)
        for (int column = left + row % stride; column < right; column += stride) {
            if (!compared(shake, k, row, column))
                continue;
            const float *at = picture + row * width + column;
            const double gx = 0.5 * (double)(at[1] - at[-1]), gy = 0.5 * (double)(at[width] - at[-width]);
            const double off =
                (double)(between(shake->frame[k], width, (float)column + dx, (float)row + dy) - at[0]);
            const double w = 1.0 / (1.0 + off * off / (size * size));
            e->xx += w * gx * gx;
            e->xy += w * gx * gy;
            e->yy += w * gy * gy;
            e->x += w * gx * off;
            e->y += w * gy * off;
            e->total += fmin(fabs(off), 3.0 * size);
            e->weight += w;
            ++e->count;
        }
}

/* Improve a shift on one level; returns a standard deviation of it in that level's pixels, INFINITY where the level
 * cannot tell. */
static double improve(const follow_shake *shake, int k, double shift[2])
{
    equations e = {.size = 16.0};
    double sure = INFINITY;
    for (int round = 0; round < ROUNDS; ++round) {
        if (!(fabs(shift[0]) < 0.4 * shake->width[k] && fabs(shift[1]) < 0.4 * shake->height[k]))
            return INFINITY;
        gather(shake, k, shift, &e);
        const double determinant = e.xx * e.yy - e.xy * e.xy, half = 0.5 * (e.xx + e.yy);
        if (e.count == 0 || !(determinant > 1e-6 * half * half))
            return INFINITY;
        const double least = half - sqrt(fmax(0.0, half * half - determinant));
        /* frame(x + shift) - picture(x) is gradient (shift - d), where frame(x + d) is the picture. */
        const double step[2] = {-(e.yy * e.x - e.xy * e.y) / determinant,
                                -(e.xx * e.y - e.xy * e.x) / determinant};
        const double limit = fmax(1.0, hypot(step[0], step[1]) / 2.0);
        shift[0] += step[0] / limit;
        shift[1] += step[1] / limit;
        e.size = fmax(1.0, 2.0 * e.total / e.count);
        sure = e.size / sqrt(least);
        if (hypot(step[0], step[1]) < CLOSE)
            break;
    }
    return sure;
}

/* How much of the picture's gradient a shifted frame has: 1 where the shift is right, whatever the noise, and about 0
 * where the search ended in a wrong place. */
static double likeness(const follow_shake *shake, const double shift[2])
{
    const int width = shake->width[0], height = shake->height[0], stride = 1 + width * height / MOST_PIXELS;
    const float *picture = shake->picture[0], *frame = shake->frame[0];
    double same = 0.0, all = 0.0;
    const int rim = 1 + shake->margin;
    for (int row = rim; row + rim < height; ++row)
        for (int column = rim + row % stride; column + rim < width; column += stride) {
            const float x = (float)(column + shift[0]), y = (float)(row + shift[1]);
            if (!(x >= 1.0f && y >= 1.0f && x < (float)width - 2.0f && y < (float)height - 2.0f))
                continue;
            const float *at = picture + row * width + column;
            const double gx = (double)(at[1] - at[-1]), gy = (double)(at[width] - at[-width]);
            const double fx = (double)(between(frame, width, x + 1.0f, y) - between(frame, width, x - 1.0f, y));
            const double fy = (double)(between(frame, width, x, y + 1.0f) - between(frame, width, x, y - 1.0f));
            const double steep = 1.0 / (1.0 + gx * gx + gy * gy); /* an edge counts no more than many a grain */
            same += steep * (gx * fx + gy * fy);
            all += steep * (gx * gx + gy * gy);
        }
    return all > 0.0 ? same / all : 0.0;
}

double follow_shake_find(follow_shake *shake, const unsigned char *frame, const float *gains, double shift[2])
{
    double found[2] = {shift[0], shift[1]}, sure = INFINITY;
    for (int row = 0; row < shake->height[0]; ++row)
        for (int column = 0; column < shake->width[0]; ++column) {
            const int at = row * shake->width[0] + column;
            shake->frame[0][at] = (float)frame[at] / gains[row];
        }
    halve(shake, shake->frame);
    halve(shake, shake->picture);
    for (int k = shake->count - 1; k >= 0; --k) {
        double here[2] = {ldexp(found[0], -k), ldexp(found[1], -k)};
        sure = improve(shake, k, here);
        if (sure < LEAST_SURE * (k + 1))
            for (int i = 0; i < 2; ++i)
                found[i] = ldexp(here[i], k);
    }
    if (!(sure < LEAST_SURE))
        return NAN;
    memcpy(shift, found, sizeof found);
    return likeness(shake, found);
}

/* One step of the search for a roll on one level; returns the standard deviation of the angle. */
static double improve_roll(const follow_shake *shake, int k, const double shift[2], double *size, double *roll)
{
    const int width = shake->width[k], height = shake->height[k], stride = 1 + width * height / MOST_PIXELS,
              rim = 1 + (shake->margin >> k);
    const double middle[2] = {0.5 * (width - 1), 0.5 * (height - 1)};
    double along = 0.0, square = 0.0, total = 0.0;
    int count = 0;
    for (int row = rim; row + rim < height; ++row)
        for (int column = rim + row % stride; column + rim < width; column += stride) {
            const double x = column - middle[0], y = row - middle[1];
            const double at[2] = {column + ldexp(shift[0], -k) - *roll * y,
                                  row + ldexp(shift[1], -k) + *roll * x};
            if (!(at[0] >= 0.0 && at[1] >= 0.0 && at[0] < width - 1.001 && at[1] < height - 1.001) ||
                !compared(shake, k, row, column))
                continue;
            const float *here = shake->picture[k] + row * width + column;
            const double slope = 0.5 *
                                 ((double)(here[width] - here[-width]) * x - (double)(here[1] - here[-1]) * y),
                         off = (double)(between(shake->frame[k], width, (float)at[0], (float)at[1]) - here[0]),
                         weight = 1.0 / (1.0 + off * off / (*size * *size));
            along += weight * slope * off;
            square += weight * slope * slope;
            total += fmin(fabs(off), 3.0 * *size);
            ++count;
        }
    if (!(square > 0.0))
        return INFINITY;
    *roll -= along / square;
    *size = fmax(1.0, 2.0 * total / count);
    return *size / sqrt(square);
}

double follow_shake_roll(const follow_shake *shake, const double shift[2])
{
    double roll = 0.0, sure = INFINITY;
    for (int k = shake->count - 1; k >= 0; --k) {
        double size = 16.0;
        for (int round = 0; round < ROUNDS && fabs(roll) < MOST_ROLL; ++round) {
            const double before = roll;
            sure = improve_roll(shake, k, shift, &size, &roll);
            if (round > 0 &&
                fabs(roll - before) * 0.5 * shake->width[k] < CLOSE) /* the first one finds the size */
                break;
        }
    }
    return fabs(roll) < MOST_ROLL && sure * 0.5 * shake->width[0] < LEAST_SURE ? roll : NAN;
}

void follow_shake_squares(follow_shake *shake, const double shift[2], double *moved, double *turned)
{
    double found[2][2], angle[2], sure[2], apart = 0.0;
    for (int i = 0; i < 2; ++i) {
        shake->half = i + 1;
        memcpy(found[i], shift, sizeof found[i]);
        sure[i] = improve(shake, 0, found[i]);
        angle[i] = follow_shake_roll(shake, shift);
        apart = fmax(apart, hypot(found[i][0] - shift[0], found[i][1] - shift[1]));
    }
    shake->half = 0;
    if (isinf(sure[0]) || isinf(sure[1])) /* all that can be seen lies in one half */
        *moved = 0.5 * (shift[0] * shift[0] + shift[1] * shift[1]);
    else
        *moved = apart < MOST_APART ? 0.5 * (found[0][0] * found[1][0] + found[0][1] * found[1][1]) : 0.0;
    *turned = isnan(angle[0]) || isnan(angle[1]) ? 0.0 : angle[0] * angle[1];
}

void follow_shake_undo(const follow_shake *shake, const float *gains, const double shift[2],
                       unsigned char *frame)
{
    const int width = shake->width[0], height = shake->height[0], margin = shake->margin;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const float x = (float)(column + shift[0]), y = (float)(row + shift[1]);
            const int inside = x >= 0.0f && y >= 0.0f && x < (float)width - 1.0f && y < (float)height - 1.0f &&
                               column >= margin && row >= margin && column < width - margin &&
                               row < height - margin;
            const float level =
                inside ? between(shake->frame[0], width, x, y) : shake->picture[0][row * width + column];
            frame[row * width + column] = (unsigned char)fminf(255.0f, gains[row] * level + 0.5f);
        }
}
