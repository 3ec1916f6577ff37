/* motion.c - where bead and magnet are at any moment between the samples of a trajectory.
 *
 * Positions and the magnet's angle are interpolated linearly.  The bead's rotation is not a part of the state:
 * it is integrated from W, sample by sample, and after each step its third axis is put on the n of the
 * trajectory, so that the poles in the film are always right.  The spin about n has no such reference and may
 * drift a little.
 */
#include "film/motion.h"

#include "base/constants.h"
#include "base/error.h"
#include "base/turn.h"

#include <stdio.h>
#include <string.h>

static fst_status find_colour(fst_film_motion *motion, const char *colour, fst_error *error)
{
    char names[1024] = "", suggestion[FST_SUGGESTION_SIZE];
    for (int i = 0; i < fst_column_count(); ++i) {
        const char *name = fst_column_at(i)->name;
        if (!strcmp(name, colour)) {
            if (!motion->table->columns[i])
                return fst_fail(
                    error, FST_BAD_INPUT, "fst_film_options.colour",
                    "the column \"%s\" is not known of this trajectory: it needs the field, or a flat "
                    "plate",
                    name);
            motion->colour = motion->table->columns[i];
            motion->colour_info = fst_column_at(i);
            return FST_OK;
        }
        size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", name);
    }
    return fst_fail(error, FST_BAD_INPUT, "fst_film_options.colour", "no column \"%.60s\"; %s", colour,
                    fst_suggest_name(colour, names, suggestion));
}

/* The same ranges as in figures: from -1 to 1 for n_z, symmetric for both signs, and from 0 where the least
 * value is close to 0. */
static void find_range(fst_film_motion *motion)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t row = motion->first; row <= motion->last; ++row) {
        if (!isfinite(motion->colour[row]))
            continue;
        low = fmin(low, motion->colour[row]);
        high = fmax(high, motion->colour[row]);
    }
    motion->both_signs = low < 0.0 && high > 0.0;
    if (!strcmp(motion->colour_info->name, "n_z"))
        low = -(high = 1.0);
    else if (motion->both_signs)
        low = -(high = fmax(high, -low));
    else if (low >= 0.0 && low < 0.25 * high)
        low = 0.0;
    if (!(high > low))
        high = low + 1.0;
    motion->low = low;
    motion->high = high;
}

/* The rotation whose third axis is n and whose first axis is as near as possible to its former place.  It puts
 * right what integrating W has lost against the n of the trajectory. */
static void straighten(double turn[3][3], const double n[3])
{
    double first[3], along = 0.0, length = 0.0;
    for (int i = 0; i < 3; ++i)
        along += turn[i][0] * n[i];
    for (int i = 0; i < 3; ++i) {
        first[i] = turn[i][0] - along * n[i];
        length += first[i] * first[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3; ++i)
        first[i] /= length;
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        turn[i][0] = first[i];
        turn[i][1] = n[j] * first[k] - n[k] * first[j];
        turn[i][2] = n[i];
    }
}

void fst_film_motion_roll(const fst_film_motion *motion, size_t row, double part, double turn[3][3])
{
    double step = part * (motion->t[row + 1] - motion->t[row]), angle[3], n[3], length = 0.0;
    for (int i = 0; i < 3; ++i) {
        angle[i] = step * (motion->w[i][row] + 0.5 * part * (motion->w[i][row + 1] - motion->w[i][row]));
        n[i] = motion->n[i][row] + part * (motion->n[i][row + 1] - motion->n[i][row]);
        length += n[i] * n[i];
    }
    for (int i = 0; i < 3; ++i)
        n[i] /= sqrt(length);
    fst_turn_by(turn, angle);
    straighten(turn, n);
}

fst_status fst_film_rows(const double *clock, size_t rows, double from, double to, size_t *first, size_t *end,
                         fst_error *error)
{
    const double slack = 1e-9; /* samples lie on their turn except for rounding */
    *first = 0;
    *end = rows;
    while (*first < *end && !isnan(from) && clock[*first] < from - slack)
        ++*first;
    while (*end > *first && !isnan(to) && clock[*end - 1] > to + slack)
        --*end;
    if (*end < *first + 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_film_options.from",
                        "the trajectory has no samples there: it covers the drive periods %.6g to %.6g",
                        rows ? clock[0] : 0.0, rows ? clock[rows - 1] : 0.0);
    return FST_OK;
}

fst_status fst_film_motion_begin(fst_film_motion *motion, const fst_table *table, const double *clock,
                                 double from, double to, const char *colour, fst_error *error)
{
    fst_params settled = table->params;
    (void)fst_params_settle(&settled, NULL); /* the caller may have changed them */
    *motion = (fst_film_motion){.table = table,
                                .millimetres = 1e3 * table->params.magnet_half_length,
                                .radius = 1e3 * settled.bead_radius};
    motion->t = fst_collected(table, "t");
    motion->drive_turns = fst_collected(table, "drive_turns");
    motion->clock = clock ? clock : motion->drive_turns;
    motion->x = fst_collected(table, "x");
    motion->y = fst_collected(table, "y");
    motion->z = fst_collected(table, "z");
    motion->alpha = fst_collected(table, "alpha");
    motion->flying = fst_collected(table, "flying");
    static const char *const names[6] = {"n_x", "n_y", "n_z", "w_x", "w_y", "w_z"};
    for (int i = 0; i < 6; ++i)
        *(i < 3 ? &motion->n[i] : &motion->w[i - 3]) = fst_collected(table, names[i]);
    const int law = table->params.friction_law;
    motion->sticking =
        law == FST_FRICTION_COULOMB || law == FST_FRICTION_ROLLING ? fst_collected(table, "sticking") : NULL;
    size_t first = 0, end = 0;
    fst_status status = colour ? find_colour(motion, colour, error) : FST_OK;
    if (status == FST_OK)
        status = fst_film_rows(motion->clock, table->rows, from, to, &first, &end, error);
    if (status != FST_OK)
        return status;
    motion->first = first;
    motion->last = end - 1;
    motion->row = first;
    if (colour)
        find_range(motion);
    double n[3] = {motion->n[0][first], motion->n[1][first], motion->n[2][first]};
    motion->turn[fabs(n[0]) < 0.7 ? 0 : 1][0] = 1.0;
    straighten(motion->turn, n);
    return FST_OK;
}

void fst_film_motion_to(fst_film_motion *motion, double periods)
{
    while (motion->row + 1 < motion->last && motion->clock[motion->row + 1] <= periods) {
        fst_film_motion_roll(motion, motion->row, 1.0, motion->turn);
        ++motion->row;
    }
    double low = motion->clock[motion->row], high = motion->clock[motion->row + 1];
    motion->part = fmax(0.0, fmin(1.0, (periods - low) / (high - low)));
}

double fst_film_motion_at(const fst_film_motion *motion, const double *column)
{
    const double before = column[motion->row];
    return before + motion->part * (column[motion->row + 1] - before);
}

void fst_film_motion_bead(const fst_film_motion *motion, fst_film_bead *bead)
{
    const double mm = motion->millimetres;
    const size_t nearest = motion->part < 0.5 ? motion->row : motion->row + 1;
    const int flies = motion->flying && motion->flying[nearest] > 0.5;
    bead->place[0] = mm * fst_film_motion_at(motion, motion->x);
    bead->place[1] = mm * fst_film_motion_at(motion, motion->y);
    /* files of before have no heights */
    bead->place[2] = motion->radius + (motion->z ? mm * fst_film_motion_at(motion, motion->z) : 0.0);
    bead->radius = motion->radius;
    bead->flies = flies;
    bead->contact = !motion->sticking                 ? FST_CONTACT_UNTOLD
                    : flies                           ? FST_CONTACT_FLIES
                    : motion->sticking[nearest] > 0.5 ? FST_CONTACT_STICKS
                                                      : FST_CONTACT_SLIPS;
    memcpy(bead->turn, motion->turn, sizeof bead->turn);
    fst_film_motion_roll(motion, motion->row, motion->part, bead->turn);
}
