/* refine.c - which points of a grid a refined sweep computes: coarse cells, divided where something changes.
 *
 * With N levels, the points of level 0 are every 2^N-th along each refined axis, and the last one; those of
 * level k are every 2^(N-k)-th.  Between them lie the cells of the level; each halves into those of the next:
 *
 *      level 0           level 1           level 2
 *      o-------o-------o o-------o---o---o o-------o---o-o-o      o computed
 *      |       |      /| |       |   |  /| |       |   |/| |      / here the regime changes
 *      |       |     / | |       o---o-/-o |       o---o-o-o
 *      |       |    /  | |       |   |/  | |       |   / | |
 *      o-------o---/---o o-------o---o---o o-------o-o/o---o      (without rule 4)
 *
 * The rules:
 * 1. The cells of level 0 exist.  When a cell is divided its parts exist.
 * 2. A cell that exists is active as soon as the values of two of its corners differ.
 * 3. An active cell is divided, unless it is of the last level.
 * 4. All neighbours of an active cell, across edges and corners, exist too: the cells of which they are parts
 *    are divided.  So a boundary is followed where it leaves the cells in which it was found.
 * 5. The corners of the cells that exist are the points that are computed.
 *
 * The rules only ever add cells, and what they add never depends on what is not there.  So they have one least
 * outcome, whatever the order in which values come: on threads, processes, kills and resuming nothing depends,
 * and no level has to wait for the one before it.
 *
 * Axes that are lists (LO:HI:COUNT and LO:HI:COUNT:log are not) have no order of their own: each combination of
 * their values is refined by itself.
 */
#include "sweep/refine.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "sweep/point_set.h"

enum { MOST_LEVELS = 28, MOST_CORNERS = 1 << FST_REFINED_AXES };
#define KNOWN (UINT32_C(1) << 31) /* in fst_point_entry.divided: the point has a value */
static const int64_t MOST_COARSE = 10000000;

typedef struct range {
    int64_t count, stride;
} range;

/* A cell by the indices of its least corner's point along the refined axes; `slice` is the point whose indices
 * along these are all 0. */
typedef struct cell {
    int level;
    int64_t slice, at[FST_REFINED_AXES];
} cell;

struct fst_refinement {
    range axes[FST_REFINED_AXES];
    int axis_count, levels;
    double step;
    int64_t points; /* of the whole grid */
    fst_point_set set;
    int64_t *queue; /* wanted points in the order in which they were found to be */
    size_t queue_size, queue_end, queue_next;
    cell *stack; /* active cells whose neighbours were not seen to yet */
    size_t stack_size, stack_count;
    int64_t known, undefined, wanted_by_level[MOST_LEVELS + 1], known_by_level[MOST_LEVELS + 1];
    int failed; /* no memory */
};

/* ------------------------------------------------------------------ cells */

static int64_t width(const fst_refinement *r, int level)
{
    return INT64_C(1) << (r->levels - level);
}

/* The level with which a point comes to the grid. */
static int level_of(const fst_refinement *r, int64_t point)
{
    int level = 0;
    for (int a = 0; a < r->axis_count; ++a) {
        const int64_t count = r->axes[a].count, index = point / r->axes[a].stride % count;
        while (index != count - 1 && (index & (width(r, level) - 1)) != 0)
            ++level;
    }
    return level;
}

static int64_t least_point(const fst_refinement *r, const cell *c)
{
    int64_t point = c->slice;
    for (int a = 0; a < r->axis_count; ++a)
        point += c->at[a] * r->axes[a].stride;
    return point;
}

/* The last cell of a row may be narrower, so that the last point is a corner. */
static int64_t corner(const fst_refinement *r, const cell *c, int number)
{
    int64_t point = c->slice;
    for (int a = 0; a < r->axis_count; ++a) {
        const int64_t last = r->axes[a].count - 1, high = c->at[a] + width(r, c->level);
        point += (number >> a & 1 ? (high < last ? high : last) : c->at[a]) * r->axes[a].stride;
    }
    return point;
}

/* The cell of the level before of which this one is a part. */
static cell whole_of(const fst_refinement *r, const cell *c)
{
    cell whole = *c;
    whole.level -= 1;
    for (int a = 0; a < r->axis_count; ++a)
        whole.at[a] &= ~(width(r, whole.level) - 1);
    return whole;
}

static int is_divided(const fst_refinement *r, const cell *c)
{
    const fst_point_entry *entry = fst_point_find(&r->set, least_point(r, c));
    return entry && entry->divided >> c->level & 1;
}

static int exists(const fst_refinement *r, const cell *c)
{
    if (c->level == 0)
        return 1;
    const cell whole = whole_of(r, c);
    return is_divided(r, &whole);
}

/* Whether the known values at the corners of a cell differ. */
static int differs(const fst_refinement *r, const cell *c)
{
    double least = INFINITY, greatest = -INFINITY;
    int defined = 0, undefined = 0;
    for (int i = 0; i < 1 << r->axis_count; ++i) {
        const fst_point_entry *entry = fst_point_find(&r->set, corner(r, c, i));
        if (!entry || !(entry->divided & KNOWN))
            continue;
        defined = defined || !isnan(entry->value);
        undefined = undefined || isnan(entry->value);
        least = fmin(least, entry->value);
        greatest = fmax(greatest, entry->value);
    }
    return defined && (undefined || greatest - least > r->step);
}

/* ------------------------------------------------------------------ growing */

static void want(fst_refinement *r, int64_t point)
{
    if (fst_point_find(&r->set, point) || r->failed)
        return;
    if (r->queue_end == r->queue_size) {
        const size_t size = r->queue_size > 0 ? 2 * r->queue_size : 1024;
        int64_t *larger = realloc(r->queue, size * sizeof *larger);
        r->failed = !larger;
        if (!larger)
            return;
        r->queue = larger;
        r->queue_size = size;
    }
    r->failed = !fst_point_add(&r->set, point);
    if (r->failed)
        return;
    r->queue[r->queue_end++] = point;
    r->wanted_by_level[level_of(r, point)] += 1;
}

/* Make a cell active if the values of its corners differ. */
static void look_at(fst_refinement *r, const cell *c)
{
    if (r->failed || !differs(r, c))
        return;
    fst_point_entry *entry = fst_point_find(&r->set, least_point(r, c));
    if (entry->active >> c->level & 1)
        return;
    if (r->stack_count == r->stack_size) {
        const size_t size = r->stack_size > 0 ? 2 * r->stack_size : 64;
        cell *larger = realloc(r->stack, size * sizeof *larger);
        r->failed = !larger;
        if (!larger)
            return;
        r->stack = larger;
        r->stack_size = size;
    }
    entry->active |= UINT32_C(1) << c->level;
    r->stack[r->stack_count++] = *c;
}

/* Divide a cell, and before it those of which it is a part. */
static void divide(fst_refinement *r, const cell *c)
{
    if (r->failed || is_divided(r, c))
        return;
    if (!exists(r, c)) {
        const cell whole = whole_of(r, c);
        divide(r, &whole);
    }
    fst_point_entry *entry = fst_point_find(&r->set, least_point(r, c));
    if (r->failed || !entry)
        return;
    entry->divided |= UINT32_C(1) << c->level;
    const int64_t half = width(r, c->level + 1);
    for (int i = 0; i < 1 << r->axis_count; ++i) {
        cell part = *c;
        int inside = 1;
        part.level += 1;
        for (int a = 0; a < r->axis_count; ++a) {
            part.at[a] += i >> a & 1 ? half : 0;
            inside = inside && part.at[a] < r->axes[a].count - 1;
        }
        for (int k = 0; inside && k < 1 << r->axis_count; ++k)
            want(r, corner(r, &part, k));
        if (inside)
            look_at(r, &part);
    }
}

/* See to it that the neighbours of an active cell exist. */
static void attend_neighbours(fst_refinement *r, const cell *c)
{
    int count = 1;
    for (int a = 0; a < r->axis_count; ++a)
        count *= 3;
    for (int i = 0; i < count && c->level > 0; ++i) {
        cell next = *c;
        int inside = 1;
        for (int a = 0, rest = i; a < r->axis_count; ++a, rest /= 3) {
            next.at[a] += (rest % 3 - 1) * width(r, c->level);
            inside = inside && next.at[a] >= 0 && next.at[a] < r->axes[a].count - 1;
        }
        if (inside) {
            const cell whole = whole_of(r, &next);
            divide(r, &whole);
        }
    }
}

static fst_status work_off(fst_refinement *r, fst_error *error)
{
    while (r->stack_count > 0 && !r->failed) {
        const cell c = r->stack[--r->stack_count];
        if (c.level < r->levels)
            divide(r, &c);
        attend_neighbours(r, &c);
    }
    return r->failed ? fst_fail(error, FST_NO_MEMORY, "fst_sweep",
                                "no memory for %lld points of a refined sweep", (long long)r->set.count)
                     : FST_OK;
}

/* ------------------------------------------------------------------ values */

/* Find the cell of a level that lies below (0) or above (1) a point along each axis; 0: there is none, or the
 * point is not a corner of it. */
static int cell_at(const fst_refinement *r, int64_t point, int level, int side, cell *c)
{
    *c = (cell){.level = level, .slice = point};
    for (int a = 0; a < r->axis_count; ++a) {
        const int64_t count = r->axes[a].count, index = point / r->axes[a].stride % count;
        const int64_t beyond = index & (width(r, level) - 1); /* how far it is beyond a point of the level */
        const int above = side >> a & 1;
        c->slice -= index * r->axes[a].stride;
        if (above ? beyond != 0 || index == count - 1 : beyond != 0 ? index != count - 1 : index == 0)
            return 0;
        c->at[a] = above ? index : index - (beyond != 0 ? beyond : width(r, level));
    }
    return 1;
}

fst_status fst_refinement_note(fst_refinement *r, int64_t point, double value, fst_error *error)
{
    fst_point_entry *entry = fst_point_find(&r->set, point);
    if (!entry || entry->divided & KNOWN)
        return FST_OK;
    entry->value = value;
    entry->divided |= KNOWN;
    r->known += 1;
    r->undefined += isnan(value) != 0;
    r->known_by_level[level_of(r, point)] += 1;
    for (int level = 0; level <= r->levels; ++level)
        for (int side = 0; side < 1 << r->axis_count; ++side) {
            cell c;
            if (cell_at(r, point, level, side, &c) && exists(r, &c))
                look_at(r, &c);
        }
    return work_off(r, error);
}

int fst_refinement_has_next(const fst_refinement *r)
{
    return r->queue_next < r->queue_end;
}

int fst_refinement_next(fst_refinement *r, int64_t *point)
{
    if (!fst_refinement_has_next(r))
        return 0;
    *point = r->queue[r->queue_next++];
    if (r->queue_next == r->queue_end)
        r->queue_next = r->queue_end = 0;
    return 1;
}

/* How many points there will be.  A boundary has 2^(d-1) times as many points on the next level, with d refined
 * axes: this is the first guess.  The values that are known tell how many points of the next level each point
 * brings, and so how many the others of its level will bring.  Near one end of the grid boundaries may be
 * denser than near the other, so the first guess has the weight of a whole level. */
static double expect(const fst_refinement *r)
{
    const double guess = ldexp(1.0, r->axis_count - 1);
    double before = (double)r->wanted_by_level[0], sum = before;
    for (int level = 1; level <= r->levels; ++level) {
        const double wanted = (double)r->wanted_by_level[level], known = (double)r->known_by_level[level - 1];
        const double brought = before > 0.0 ? (wanted + before * guess) / (known + before) : 0.0;
        before = wanted + brought * (before - known);
        sum += before;
    }
    return sum;
}

fst_refinement_counts fst_refinement_count(const fst_refinement *r)
{
    const double most = (double)r->points;
    const int64_t wanted = (int64_t)r->set.count;
    const int is_over = wanted == r->known && !fst_refinement_has_next(r);
    return (fst_refinement_counts){wanted, r->known, is_over ? wanted : (int64_t)fmin(expect(r), most),
                                   r->undefined};
}

/* ------------------------------------------------------------------ the cells at the end */

static void tell_cell(const fst_refinement *r, const cell *c,
                      void (*tell)(void *user, const fst_refined_cell *cell), void *user)
{
    fst_refined_cell told = {.axes = r->axis_count};
    for (int i = 0; i < 1 << r->axis_count; ++i) {
        told.corners[i] = corner(r, c, i);
        const fst_point_entry *entry = fst_point_find(&r->set, told.corners[i]);
        if (!entry || !(entry->divided & KNOWN))
            return;
        told.values[i] = entry->value;
    }
    for (int a = 0; a < r->axis_count; ++a) {
        told.strides[a] = r->axes[a].stride;
        told.lengths[a] = (told.corners[1 << a] - told.corners[0]) / r->axes[a].stride;
    }
    tell(user, &told);
}

void fst_refinement_tell_cells(const fst_refinement *r, void (*tell)(void *user, const fst_refined_cell *cell),
                               void *user)
{
    const int all = (1 << r->axis_count) - 1;
    for (int level = 0; level < r->levels; ++level)
        for (size_t i = 0; i < r->set.size; ++i) {
            cell c;
            const fst_point_entry *entry = &r->set.places[i];
            if (entry->point >= 0 && cell_at(r, entry->point, level, all, &c) && exists(r, &c) &&
                !is_divided(r, &c))
                tell_cell(r, &c, tell, user);
        }
}

/* ------------------------------------------------------------------ beginning */

/* The axes that are refined are even ranges. */
static fst_status find_axes(fst_refinement *r, const fst_grid *grid, fst_error *error)
{
    static const char *const where = "fst_sweep_options.refine";
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const fst_spacing spacing = fst_grid_axis_spacing(grid, i);
        if (spacing == FST_SPACING_RANDOM)
            return fst_fail(error, FST_BAD_INPUT, where,
                            "%s has random values, which have no neighbours between which to refine",
                            fst_grid_key(grid, i));
        if (spacing == FST_SPACING_LIST || fst_grid_axis_points(grid, i) == 1)
            continue;
        if (r->axis_count == FST_REFINED_AXES)
            return fst_fail(
                error, FST_BAD_INPUT, where,
                "a sweep is refined along %d ranges at most, and this one has more: give the others "
                "as lists",
                FST_REFINED_AXES);
        r->axes[r->axis_count++] = (range){fst_grid_axis_points(grid, i), fst_grid_axis_stride(grid, i)};
    }
    if (r->axis_count == 0)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "there is nothing to refine: vary a parameter as LO:HI:COUNT or LO:HI:COUNT:log");
    return FST_OK;
}

/* The coarsest grid has at least two cells along the longest axis, and not too many points. */
static fst_status check_levels(const fst_refinement *r, fst_error *error)
{
    static const char *const where = "fst_sweep_options.refine";
    int64_t longest = 0;
    double coarse = (double)r->points;
    int most = 0;
    for (int a = 0; a < r->axis_count; ++a)
        longest = r->axes[a].count > longest ? r->axes[a].count : longest;
    while (most < MOST_LEVELS && INT64_C(4) << most < longest)
        ++most;
    if (most == 0)
        return fst_fail(error, FST_BAD_INPUT, where, "a range needs 5 points at least to be refined");
    if (r->levels < 1 || r->levels > most)
        return fst_fail(
            error, FST_BAD_INPUT, where,
            "%d must be from 1 to %d here: the coarsest points are every 2^N-th of a range, and the "
            "longest one has %lld",
            r->levels, most, (long long)longest);
    for (int a = 0; a < r->axis_count; ++a) {
        const int64_t cells = (r->axes[a].count - 1 + width(r, 0) - 1) / width(r, 0);
        coarse *= (double)(cells + 1) / (double)r->axes[a].count;
    }
    if (coarse > (double)MOST_COARSE)
        return fst_fail(
            error, FST_BAD_INPUT, where,
            "the coarsest of %d levels has %.0f points, more than the %lld that are kept in memory: "
            "begin coarser",
            r->levels, coarse, (long long)MOST_COARSE);
    return FST_OK;
}

/* Want the corners of the cells of level 0. */
static void want_coarse(fst_refinement *r)
{
    for (int64_t point = 0; point < r->points && !r->failed;) {
        int64_t skip = 0; /* to the next coarse point along the refined axis whose index is wrong */
        for (int a = 0; a < r->axis_count; ++a) {
            const int64_t last = r->axes[a].count - 1, index = point / r->axes[a].stride % (last + 1);
            const int64_t beyond = index & (width(r, 0) - 1);
            if (beyond == 0 || index == last)
                continue;
            const int64_t next = index + width(r, 0) - beyond;
            const int64_t steps = (next < last ? next : last) - index;
            skip = steps * r->axes[a].stride;
            break;
        }
        if (skip == 0)
            want(r, point);
        point += skip > 0 ? skip : 1;
    }
}

fst_status fst_refinement_new(const fst_grid *grid, int levels, double step, fst_refinement **refinement,
                              fst_error *error)
{
    fst_refinement *r = *refinement = calloc(1, sizeof *r);
    if (!r)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    r->levels = levels;
    r->step = step;
    r->points = fst_grid_points(grid);
    fst_status status = find_axes(r, grid, error);
    if (status == FST_OK)
        status = check_levels(r, error);
    if (status == FST_OK) {
        want_coarse(r);
        status = work_off(r, error);
    }
    if (status != FST_OK) {
        fst_refinement_free(r);
        *refinement = NULL;
    }
    return status;
}

void fst_refinement_free(fst_refinement *r)
{
    if (!r)
        return;
    fst_point_set_free(&r->set);
    free(r->queue);
    free(r->stack);
    free(r);
}
