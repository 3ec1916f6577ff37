/* split.c - beads that touch in the picture are one spot, which is cut half way between their centres.
 *
 *      .-""-. .-""-.        Each pixel belongs to the nearest centre, and each centre is the centroid of its pixels: both
 *     (   +  |  +   )       are put right in turns, from pixels that are far from each other.
 *      `-..-' `-..-'
 *          |h |             The centroid of a disc that touches another is its centre.  Of discs that overlap, as a
 *                           camera from the side sees them, the cut takes a segment away, at h < R from the centre, and the
 *                           centroid lies farther out, by (2/3) (R^2 - h^2)^(3/2) / (the area that is left).
 *
 * Discs of 13 pixels are found within 0.1 pixels where two touch, within 0.3 where they hide a part of each other, and
 * within 0.45 in a cluster (test_beads_followed.c).
 */
#include "follow/split.h"

#include <math.h>

#include "base/constants.h"

#define LEAST_PART 0.6 /* of a bead's area: a part with less is none */
#define MOST_PART 1.3
#define SOFT 1.0 /* pixels by which a bead's outline is soft */

/* A spot, and the window around it. */
typedef struct walk {
    const follow_blobs *blobs;
    const follow_box *box;
    int window[4];
} walk;

static double nearest(const follow_cover *parts, int count, double column, double row, int *which)
{
    double least = INFINITY;
    for (int k = 0; k < count; ++k) {
        const double far = hypot(column - parts[k].column, row - parts[k].row);
        if (far < least) {
            least = far;
            *which = k;
        }
    }
    return least;
}

/* Add a centre at the pixel that is farthest from all others. */
static void add_farthest(const walk *w, follow_cover *parts, int known)
{
    double most = -1.0;
    follow_cover found = parts[0];
    for (int row = w->window[2]; row <= w->window[3]; ++row)
        for (int column = w->window[0]; column <= w->window[1]; ++column) {
            int which;
            const double far = nearest(parts, known, column, row, &which);
            if (far > most && follow_blobs_part(w->blobs, w->box, w->window, column, row) > 0.5) {
                most = far;
                found = (follow_cover){.column = column, .row = row};
            }
        }
    parts[known] = found;
}

/* Put the centres at the centroids of the pixels that are nearest to them, and no farther than `reach`; returns by how much
 * the farthest one moved. */
static double improve(const walk *w, double reach, follow_cover *parts, int count)
{
    double sums[FST_TRACKED_BEADS][3] = {{0.0}}, moved = 0.0;
    for (int row = w->window[2]; row <= w->window[3]; ++row)
        for (int column = w->window[0]; column <= w->window[1]; ++column) {
            const double part = follow_blobs_part(w->blobs, w->box, w->window, column, row);
            int k = 0;
            if (part <= 0.0 || nearest(parts, count, column, row, &k) > reach)
                continue;
            sums[k][0] += part;
            sums[k][1] += part * (column - w->box->left);
            sums[k][2] += part * (row - w->box->top);
        }
    for (int k = 0; k < count; ++k) {
        parts[k].area = sums[k][0];
        if (!(sums[k][0] > 0.0))
            continue;
        const double column = w->box->left + sums[k][1] / sums[k][0],
                     row = w->box->top + sums[k][2] / sums[k][0];
        moved = fmax(moved, hypot(column - parts[k].column, row - parts[k].row));
        parts[k].column = column;
        parts[k].row = row;
    }
    return moved;
}

/* How far from its centre a disc of radius 1 has its centroid, where all beyond a distance h < 1 is cut off. */
static double outward(double h, double *left)
{
    *left = FST_PI - acos(h) + h * sqrt(1.0 - h * h);
    return 2.0 / 3.0 * pow(1.0 - h * h, 1.5) / *left;
}

/* Move the centres of two discs that overlap to where they are; `radius` is that of both.  A disc that keeps `left` of its
 * area is then whole. */
static void undo_overlap(follow_cover *a, follow_cover *b, double radius)
{
    const double across = b->column - a->column, down = b->row - a->row, apart = hypot(across, down);
    const double seen = 0.5 * apart / radius;
    double low = 0.0, high = 1.0, left = FST_PI;
    if (!(seen < 1.0 && apart > 0.0))
        return;
    for (int repeat = 0; repeat < 40; ++repeat) {
        const double h = 0.5 * (low + high);
        *(h + outward(h, &left) < seen ? &low : &high) = h;
    }
    const double inward = radius * (seen - low) / apart, hidden = (FST_PI - left) * radius * radius;
    a->column += inward * across;
    a->row += inward * down;
    b->column -= inward * across;
    b->row -= inward * down;
    a->area += hidden;
    b->area += hidden;
}

int follow_split(const follow_blobs *blobs, const follow_box *box, double area, int count,
                 follow_cover parts[FST_TRACKED_BEADS])
{
    enum { ROUNDS = 50 };
    walk w = {blobs, box, {0}};
    follow_blobs_window(blobs, box, w.window);
    parts[0] = (follow_cover){.column = 0.5 * (box->left + box->right), .row = 0.5 * (box->top + box->bottom)};
    add_farthest(&w, parts, 1);
    parts[0] = parts[1];
    for (int k = 1; k < count; ++k)
        add_farthest(&w, parts, k);
    const double radius = sqrt(area / FST_PI);
    for (int round = 0; round < ROUNDS && improve(&w, INFINITY, parts, count) > 0.01;)
        ++round;
    /* The gaps of a cluster, which count as covered, lie farther out than a bead. */
    for (int round = 0; round < ROUNDS && improve(&w, radius + SOFT, parts, count) > 1e-3;)
        ++round;
    if (count == 2) /* in a cluster what its gaps shift would look like an overlap */
        undo_overlap(&parts[0], &parts[1], radius);
    int good = 1;
    for (int k = 0; k < count; ++k)
        good = good && parts[k].area > LEAST_PART * area && parts[k].area < MOST_PART * area;
    return good;
}
