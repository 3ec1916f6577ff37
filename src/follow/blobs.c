/* blobs.c - spots of a frame, and the cover of their pixels. */
#include "follow/blobs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

enum { FOUND = 1, FIRST_LABEL = 2, NO_LABEL = 255, LEAST_PIXELS = 4, MARGIN = 3, REACH = 2, LEVELS = 256 };

fst_status follow_blobs_begin(follow_blobs *blobs, const follow_still *still, fst_error *error)
{
    const size_t size = (size_t)still->width * (size_t)still->height;
    *blobs = (follow_blobs){.still = still, .mask = malloc(size), .stack = malloc(size * sizeof *blobs->stack)};
    return blobs->mask && blobs->stack ? FST_OK
                                       : fst_fail(error, FST_NO_MEMORY, "track", "no memory for a frame");
}

void follow_blobs_end(follow_blobs *blobs)
{
    free(blobs->mask);
    free(blobs->stack);
    free(blobs->cover);
    free(blobs->links);
    *blobs = (follow_blobs){.still = NULL};
}

/* ------------------------------------------------------------------ spots */

static void make_mask(follow_blobs *b, const unsigned char *frame, const float *gains, double sign,
                      double threshold)
{
    const int width = b->still->width;
    const float s = (float)sign, least = (float)threshold;
    for (int row = 0; row < b->still->height; ++row) {
        const size_t begin = (size_t)row * (size_t)width;
        const float *level = b->still->level + begin, factor = s * gains[row];
        const unsigned char *line = frame + begin;
        unsigned char *mask = b->mask + begin;
        for (int i = 0; i < width; ++i)
            mask[i] = factor * level[i] - s * (float)line[i] > least;
    }
}

/* Give all pixels that are connected with `start`, across corners too, the label; returns the spot. */
static follow_box flood(follow_blobs *b, const unsigned char *frame, const float *gains, double sign, int start,
                        int label)
{
    const int width = b->still->width, height = b->still->height;
    follow_box box = {width, 0, height, 0, label, 0, 0.0};
    int top = 0;
    b->stack[top++] = start;
    b->mask[start] = (unsigned char)label;
    while (top > 0) {
        const int at = b->stack[--top], column = at % width, row = at / width;
        box.left = column < box.left ? column : box.left;
        box.right = column > box.right ? column : box.right;
        box.top = row < box.top ? row : box.top;
        box.bottom = row > box.bottom ? row : box.bottom;
        ++box.pixels;
        box.sum += sign * ((double)(gains[row] * b->still->level[at]) - frame[at]);
        for (int y = row > 0 ? row - 1 : 0; y <= row + 1 && y < height; ++y)
            for (int x = column > 0 ? column - 1 : 0; x <= column + 1 && x < width; ++x)
                if (b->mask[y * width + x] == FOUND) {
                    b->mask[y * width + x] = (unsigned char)label;
                    b->stack[top++] = y * width + x;
                }
    }
    return box;
}

void follow_blobs_find(follow_blobs *blobs, const unsigned char *frame, const float *gains, double sign,
                       double threshold)
{
    const size_t size = (size_t)blobs->still->width * (size_t)blobs->still->height;
    make_mask(blobs, frame, gains, sign, threshold);
    blobs->count = 0;
    for (const unsigned char *at = blobs->mask;
         (at = memchr(at, FOUND, size - (size_t)(at - blobs->mask))) != NULL; ++at) {
        const int room = blobs->count < FOLLOW_MOST_BOXES, label = room ? FIRST_LABEL + blobs->count : NO_LABEL;
        const follow_box box = flood(blobs, frame, gains, sign, (int)(at - blobs->mask), label);
        if (box.pixels < LEAST_PIXELS)
            continue; /* its label goes to the next spot too, which is far from these few pixels of noise */
        if (room)
            blobs->boxes[blobs->count++] = box;
    }
}

/* ------------------------------------------------------------------ filling holes */

static int level_at(const float *cover, int at)
{
    return (int)fmaxf(0.0f, fminf(LEVELS - 1, cover[at] * (LEVELS - 1)));
}

/* Raise every hollow of the cover to the lowest level by which water would leave it: a highlight or a mark on
 * the bead becomes bead.  The water comes in from the edge, lowest level first: heads[] lists the pixels of
 * each level that it has reached. */
static void fill_hollows(float *cover, int *links, int width, int height)
{
    int heads[LEVELS];
    unsigned char *reached = (unsigned char *)(links + width * height);
    for (int i = 0; i < LEVELS; ++i)
        heads[i] = -1;
    memset(reached, 0, (size_t)(width * height));
    for (int at = 0; at < width * height; ++at) {
        const int x = at % width, y = at / width;
        if (x > 0 && y > 0 && x + 1 < width && y + 1 < height)
            continue;
        const int level = level_at(cover, at);
        links[at] = heads[level];
        heads[level] = at;
        reached[at] = 1;
    }
    for (int level = 0; level < LEVELS;) {
        const int at = heads[level];
        if (at < 0) {
            ++level;
            continue;
        }
        heads[level] = links[at];
        const int x = at % width, y = at / width;
        const int next[4] = {x > 0 ? at - 1 : -1, x + 1 < width ? at + 1 : -1, y > 0 ? at - width : -1,
                             y + 1 < height ? at + width : -1};
        for (int k = 0; k < 4; ++k) {
            if (next[k] < 0 || reached[next[k]])
                continue;
            reached[next[k]] = 1;
            cover[next[k]] = fmaxf(cover[next[k]], cover[at]);
            const int high = level_at(cover, next[k]) > level ? level_at(cover, next[k]) : level;
            links[next[k]] = heads[high];
            heads[high] = next[k];
        }
    }
}

/* ------------------------------------------------------------------ the cover */

/* Whether a pixel of the spot, or of its close surroundings. */
static int belongs(const follow_blobs *b, const follow_box *box, int column, int row)
{
    const int width = b->still->width, height = b->still->height;
    for (int y = row - REACH; y <= row + REACH; ++y)
        for (int x = column - REACH; x <= column + REACH; ++x)
            if (x >= 0 && y >= 0 && x < width && y < height && b->mask[y * width + x] == box->label)
                return 1;
    return 0;
}

static fst_status make_room(follow_blobs *b, size_t window, fst_error *error)
{
    if (window <= b->window)
        return FST_OK;
    free(b->cover);
    free(b->links);
    b->window = 0;
    b->cover = malloc(window * sizeof *b->cover);
    b->links = malloc(window * (sizeof *b->links + 1));
    if (!b->cover || !b->links)
        return fst_fail(error, FST_NO_MEMORY, "track", "no memory for a spot");
    b->window = window;
    return FST_OK;
}

void follow_blobs_window(const follow_blobs *blobs, const follow_box *box, int window[4])
{
    const int right = blobs->still->width - 1, bottom = blobs->still->height - 1;
    window[0] = box->left > MARGIN ? box->left - MARGIN : 0;
    window[1] = box->right + MARGIN < right ? box->right + MARGIN : right;
    window[2] = box->top > MARGIN ? box->top - MARGIN : 0;
    window[3] = box->bottom + MARGIN < bottom ? box->bottom + MARGIN : bottom;
}

double follow_blobs_part(const follow_blobs *blobs, const follow_box *box, const int window[4], int column,
                         int row)
{
    const int width = window[1] - window[0] + 1;
    const double part = (double)blobs->cover[(row - window[2]) * width + column - window[0]];
    return part > 0.0 && belongs(blobs, box, column, row) ? part : 0.0;
}

/* Sum what the window holds of the spot. */
static void sum_up(const follow_blobs *b, const follow_box *box, const int window[4], follow_cover *cover)
{
    double sum = 0.0, first[2] = {0.0, 0.0}, second[3] = {0.0, 0.0, 0.0};
    for (int row = window[2]; row <= window[3]; ++row)
        for (int column = window[0]; column <= window[1]; ++column) {
            const double part = follow_blobs_part(b, box, window, column, row);
            if (part <= 0.0)
                continue;
            const double x = column - box->left, y = row - box->top; /* small numbers keep the moments exact */
            sum += part;
            first[0] += part * x;
            first[1] += part * y;
            second[0] += part * x * x;
            second[1] += part * x * y;
            second[2] += part * y * y;
        }
    *cover = (follow_cover){.area = sum};
    if (!(sum > 0.0))
        return;
    const double x = first[0] / sum, y = first[1] / sum;
    /* A pixel is a square, whose second moment, 1/12, does not belong to the bead. */
    const double xx = second[0] / sum - x * x - 1.0 / 12.0, yy = second[2] / sum - y * y - 1.0 / 12.0;
    const double xy = second[1] / sum - x * y, half = 0.5 * (xx + yy), spread = hypot(0.5 * (xx - yy), xy);
    cover->column = box->left + x;
    cover->row = box->top + y;
    cover->narrow = 4.0 * sqrt(fmax(0.0, half - spread)); /* a disc's second moment is diameter^2/16 */
    cover->cut = box->left == 0 || box->top == 0 || box->right + 1 == b->still->width ||
                 box->bottom + 1 == b->still->height;
}

fst_status follow_blobs_cover(follow_blobs *blobs, const unsigned char *frame, const float *gains,
                              const follow_look *look, const follow_box *box, follow_cover *cover,
                              fst_error *error)
{
    const int width = blobs->still->width;
    int window[4];
    follow_blobs_window(blobs, box, window);
    const int across = window[1] - window[0] + 1, down = window[3] - window[2] + 1;
    const fst_status status = make_room(blobs, (size_t)across * (size_t)down, error);
    if (status != FST_OK)
        return status;
    for (int row = window[2]; row <= window[3]; ++row)
        for (int column = window[0]; column <= window[1]; ++column) {
            const size_t at = (size_t)row * (size_t)width + (size_t)column;
            const double behind = (double)(gains[row] * blobs->still->level[at]),
                         off = look->sign * (behind - frame[at]);
            const double full = look->sign > 0.0 ? look->contrast * behind : look->contrast;
            blobs->cover[(row - window[2]) * across + column - window[0]] =
                (float)fmax(0.0, fmin(1.0, off / fmax(full, look->threshold)));
        }
    fill_hollows(blobs->cover, blobs->links, across, down);
    sum_up(blobs, box, window, cover);
    return FST_OK;
}
