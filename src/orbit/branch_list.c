/* branch_list.c - the growing lists of a branch, and which of its branches passes through a state. */
#include "orbit/branch_list.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/grow.h"

/* ------------------------------------------------------------------ growing lists */

static fst_status append(void **list, size_t *count, const void *element, size_t size, fst_error *error)
{
    if (!fst_grow(list, *count, size))
        return fst_fail(error, FST_NO_MEMORY, "branch", "out of memory");
    memcpy((char *)*list + (*count)++ * size, element, size);
    return FST_OK;
}

fst_status fst_branch_add_point(fst_branch *out, const fst_branch_point *seen, int branch, fst_error *error)
{
    fst_branch_point point = *seen;
    point.branch = branch;
    return append((void **)&out->points, &out->point_count, &point, sizeof point, error);
}

fst_status fst_branch_add_special(fst_branch *out, const fst_special *special, fst_error *error)
{
    return append((void **)&out->specials, &out->special_count, special, sizeof *special, error);
}

fst_status fst_branch_add_end(fst_branch *out, int branch, int family, double value, const fst_curve_end *why,
                              fst_error *error)
{
    fst_branch_end end = {.branch = branch, .family = family, .image = -1, .value = value, .type = why->type};
    (void)snprintf(end.reason, sizeof end.reason, "%s", why->reason);
    return append((void **)&out->ends, &out->end_count, &end, sizeof end, error);
}

void fst_curve_end_set(fst_curve_end *end, fst_end_type type, const char *format, ...)
{
    va_list arguments;
    end->type = type;
    va_start(arguments, format);
    (void)vsnprintf(end->reason, sizeof end->reason, format, arguments);
    va_end(arguments);
}

void fst_branch_reverse(fst_branch *out, size_t first)
{
    fst_branch_point *points = out->points + first;
    const size_t count = out->point_count - first;
    for (size_t i = 0; i + 1 < count - i; ++i) {
        const fst_branch_point kept = points[i];
        points[i] = points[count - 1 - i];
        points[count - 1 - i] = kept;
    }
}

/* ------------------------------------------------------------------ looking things up */

int fst_branch_find_special(const fst_branch *out, const fst_special *special, double scale)
{
    for (size_t i = 0; i < out->special_count; ++i)
        if (out->specials[i].type == special->type &&
            fabs(out->specials[i].value - special->value) < 1e-8 * scale &&
            fabs(out->specials[i].at.mean_r - special->at.mean_r) < 1e-6)
            return (int)i;
    return -1;
}

int fst_branch_of_last(const fst_branch *out)
{
    const double same = 1e-7;
    const fst_branch_point *b = &out->points[out->point_count - 1];
    for (const fst_branch_point *a = out->points; a < b; ++a)
        if (a->branch != b->branch && a->multipliers == b->multipliers &&
            fabs(a->value - b->value) < 1e-12 * fabs(b->value) &&
            fabs(a->period - b->period) < same * b->period && fabs(a->mean_r - b->mean_r) < same &&
            fabs(a->min_r - b->min_r) < same && fabs(a->mean_nz - b->mean_nz) < same)
            return a->branch;
    return -1;
}

/* Whether a quantity may have this value between two neighbours a and b, x of the way from a: within `least` of
 * the straight line, and what a curve, steep as a square root beside a pitchfork, may differ from that. */
static int lies_between(double a, double b, double x, double value, double least)
{
    return fabs(a + x * (b - a) - value) < least + 0.25 * fabs(b - a);
}

/* The least distance from the axis, negative where the orbit does not go round it: so it passes through zero. */
static double side_of_axis(const fst_branch_point *p)
{
    return p->turns == 0 ? -p->min_r : p->min_r;
}

int fst_branch_of_orbit(const fst_branch *out, const fst_branch_point *seen, int has_s2)
{
    for (size_t i = 0; i + 1 < out->point_count; ++i) {
        const fst_branch_point *a = &out->points[i], *b = a + 1;
        const double x = (seen->value - a->value) / (b->value - a->value);
        if (a->branch != b->branch || a->multipliers != seen->multipliers ||
            (a->symmetry != seen->symmetry && b->symmetry != seen->symmetry) || !(x >= 0.0 && x <= 1.0))
            continue;
        if (lies_between(a->mean_r, b->mean_r, x, seen->mean_r, 2e-3) &&
            lies_between(side_of_axis(a), side_of_axis(b), x, side_of_axis(seen), 2e-2) &&
            lies_between(a->period, b->period, x, seen->period, 2e-3 * seen->period) &&
            (lies_between(a->mean_nz, b->mean_nz, x, seen->mean_nz, 5e-3) ||
             (has_s2 && lies_between(a->mean_nz, b->mean_nz, x, -seen->mean_nz, 5e-3))))
            return a->branch;
    }
    return -1;
}

int fst_branch_of_state(const fst_branch *out, double value, const double *state)
{
    int best = -1;
    double least = 1.0;
    for (size_t i = 0; i + 1 < out->point_count; ++i) {
        const fst_branch_point *a = &out->points[i], *b = a + 1;
        if (a->branch != b->branch || (a->value > value) == (b->value > value))
            continue;
        const double x = (value - a->value) / (b->value - a->value);
        double greatest = 0.0;
        for (int k = 0; k < FST_STATE_SIZE; ++k) {
            const double there = a->state[k] + x * (b->state[k] - a->state[k]);
            const double bent = 0.02 + 0.3 * fabs(b->state[k] - a->state[k]);
            greatest = fmax(greatest, fabs(there - state[k]) / bent);
        }
        if (greatest < least) {
            least = greatest;
            best = a->branch;
        }
    }
    return best;
}

void fst_branch_find_images(fst_branch *out)
{
    for (size_t e = 0; e < out->end_count; ++e) {
        fst_branch_end *end = &out->ends[e];
        size_t first = 0, count = 0;
        for (size_t i = 0; i < out->point_count; ++i)
            if (out->points[i].branch == end->branch && count++ == 0)
                first = i;
        const fst_branch_point *middle = &out->points[first + count / 2];
        double image[FST_STATE_SIZE];
        end->image = -1;
        if (count == 0 || out->second_key[0])
            continue;
        fst_apply_s2(middle->state, image);
        if (middle->symmetry == FST_SYMMETRY_S2)
            end->image = end->branch;
        else if (middle->multipliers == FST_EIGENVALUE_COUNT)
            end->image = fst_branch_of_state(out, middle->value, image);
    }
}
