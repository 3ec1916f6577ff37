/* cast.c - the beads of a film.  A bead of a list is cut out of its table as a table of its own, so that motion.c knows
 * but one kind of trajectory; a trajectory of one bead is a cast of one. */
#include "film/cast.h"

#include "base/constants.h"
#include "base/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static fst_status no_memory(fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "film", "no memory for the beads of a film");
}

/* Room for so many beads. */
static fst_status begin(fst_film_cast *cast, int count, fst_error *error)
{
    const size_t size = (size_t)count;
    *cast = (fst_film_cast){.count = count,
                            .motions = calloc(size, sizeof *cast->motions),
                            .beads = calloc(size, sizeof *cast->beads)};
    return cast->motions && cast->beads ? FST_OK : no_memory(error);
}

static void settle(fst_film_cast *cast, const fst_params *params)
{
    cast->params = *params;
    (void)fst_params_settle(&cast->params, NULL); /* the caller may have changed them */
}

static fst_status begin_one(fst_film_cast *cast, const fst_table *table, double from, double to,
                            const char *colour, fst_error *error)
{
    fst_status status = begin(cast, 1, error);
    if (status == FST_OK)
        status = fst_film_motion_begin(&cast->motions[0], table, NULL, from, to, colour, error);
    if (status != FST_OK)
        return status;
    settle(cast, &table->params);
    cast->omega = fst_collected(table, "omega")[cast->motions[0].first];
    return FST_OK;
}

fst_status fst_film_cast_one(fst_film_cast *cast, const fst_table *table, const fst_film_options *options,
                             fst_error *error)
{
    const char *colour = options->colour ? options->colour : "slip";
    return begin_one(cast, table, options->from, options->to, colour, error);
}

fst_status fst_film_cast_table(fst_film_cast *cast, const fst_table *table, double from, double to,
                               fst_error *error)
{
    return begin_one(cast, table, from, to, NULL, error);
}

/* ------------------------------------------------------------------ a list */

/* The drive periods of each row: the turns of the magnet, or where it does not turn steadily its frequency times the
 * time. */
static fst_status tell_clock(fst_film_cast *cast, const double **clock, fst_error *error)
{
    const fst_beads_table *all = cast->all;
    const fst_params *p = &cast->params;
    cast->omega =
        isfinite(p->drive_omega) ? p->drive_omega : p->drive_frequency * FST_TWO_PI / p->friction_gamma;
    *clock = all->drive_turns;
    if (p->drive_waveform == FST_WAVEFORM_STEADY)
        return FST_OK;
    *clock = cast->periods = malloc((all->rows + 1) * sizeof *cast->periods);
    if (!cast->periods)
        return no_memory(error);
    for (size_t row = 0; row < all->rows; ++row)
        cast->periods[row] = fst_drive_periods(p, all->t[row], all->drive_turns[row]);
    return FST_OK;
}

/* Free the columns of a table that its motion does not read, for there may be a thousand beads. */
static void keep_columns(fst_table *table, const fst_film_motion *m)
{
    const double *const read[] = {m->t,
                                  m->drive_turns,
                                  m->x,
                                  m->y,
                                  m->z,
                                  m->alpha,
                                  m->flying,
                                  m->n[0],
                                  m->n[1],
                                  m->n[2],
                                  m->w[0],
                                  m->w[1],
                                  m->w[2],
                                  fst_collected(table, "vx"),
                                  fst_collected(table, "vy"),
                                  fst_collected(table, "vz")};
    for (int i = 0; i < fst_column_count(); ++i) {
        int kept = 0;
        for (size_t k = 0; k < sizeof read / sizeof *read; ++k)
            kept |= table->columns[i] == read[k];
        if (kept)
            continue;
        free(table->columns[i]);
        table->columns[i] = NULL;
    }
}

/* The column that colours the trail of one bead: its slip on a flat plate, its height in a bowl. */
static const char *choose_column(const fst_film_cast *cast, const fst_film_options *options)
{
    static const char *const usual[] = {
        [FST_PLATE_FLAT] = "slip", [FST_PLATE_BOWL] = "z", [FST_PLATE_NONE] = "n_z"};
    if (cast->count > 1)
        return NULL;
    if (options->colour)
        return options->colour;
    return usual[cast->params.plate_shape];
}

static fst_status begin_bead(fst_film_cast *cast, int bead, const double *clock, size_t end, const char *colour,
                             fst_error *error)
{
    fst_table *table = &cast->tables[bead];
    fst_film_motion *motion = &cast->motions[bead];
    fst_status status = fst_beads_table_alone(cast->all, bead, cast->first, end, table, error);
    if (status == FST_OK)
        status =
            fst_film_motion_begin(motion, table, clock ? clock + cast->first : NULL, NAN, NAN, colour, error);
    if (status == FST_OK && cast->count > 1)
        keep_columns(table, motion);
    return status;
}

static fst_status begin_list(fst_film_cast *cast, const fst_beads_table *all, double from, double to,
                             const fst_film_options *options, fst_error *error)
{
    const double *clock;
    size_t end = 0;
    fst_status status = begin(cast, all->count, error);
    cast->all = all;
    cast->tables = status == FST_OK ? calloc((size_t)all->count, sizeof *cast->tables) : NULL;
    if (!cast->tables)
        return no_memory(error);
    settle(cast, &all->scene);
    status = tell_clock(cast, &clock, error);
    if (status == FST_OK)
        status = fst_film_rows(clock, all->rows, from, to, &cast->first, &end, error);
    const char *colour = options ? choose_column(cast, options) : NULL;
    for (int bead = 0; bead < all->count && status == FST_OK; ++bead)
        status = begin_bead(cast, bead, cast->periods, end, colour, error);
    if (status == FST_OK)
        settle(cast, &cast->tables[0].params);
    return status;
}

/* The colours of the beads, and room for pairs that touch. */
static fst_status begin_looks(fst_film_cast *cast, fst_error *error)
{
    size_t most = 0;
    for (size_t row = 0; row < cast->all->rows; ++row)
        most = cast->all->first[row + 1] - cast->all->first[row] > most
                   ? cast->all->first[row + 1] - cast->all->first[row]
                   : most;
    cast->colours = calloc((size_t)cast->count, sizeof *cast->colours);
    cast->touches = malloc((most + 1) * sizeof *cast->touches);
    if (!cast->colours || !cast->touches)
        return no_memory(error);
    for (int bead = 0; bead < cast->count; ++bead) {
        const unsigned long code = strtoul(fst_colour_code(fst_bead_colour(bead)) + 1, NULL, 16);
        for (int k = 0; k < 3; ++k)
            cast->colours[bead][k] = (double)(code >> (16 - 8 * k) & 0xff) / 255.0;
        cast->beads[bead].colour = cast->colours[bead];
    }
    return FST_OK;
}

fst_status fst_film_cast_list(fst_film_cast *cast, const fst_beads_table *all, const fst_film_options *options,
                              fst_error *error)
{
    if (all->count > 1 && options->colour)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_film_options.colour",
            "a column colours the trail of one bead: those of several have the colours of their beads");
    fst_status status = begin_list(cast, all, options->from, options->to, options, error);
    return status == FST_OK && cast->count > 1 ? begin_looks(cast, error) : status;
}

fst_status fst_film_cast_tables(fst_film_cast *cast, const fst_beads_table *all, double from, double to,
                                fst_error *error)
{
    return begin_list(cast, all, from, to, NULL, error);
}

void fst_film_cast_free(fst_film_cast *cast)
{
    for (int bead = 0; cast->tables && bead < cast->count; ++bead)
        fst_table_free(&cast->tables[bead]);
    free(cast->tables);
    free(cast->motions);
    free(cast->beads);
    free(cast->periods);
    free(cast->colours);
    free(cast->touches);
    *cast = (fst_film_cast){.count = 0};
}

/* ------------------------------------------------------------------ a moment */

/* The pairs that touch in the row that is nearest. */
static void tell_touches(const fst_film_cast *cast, fst_film_frame *frame)
{
    const fst_film_motion *m = &cast->motions[0];
    const size_t row = cast->first + m->row + (m->part >= 0.5);
    frame->touch_count = 0;
    frame->touches = (const int(*)[2])cast->touches;
    for (size_t k = cast->all->first[row]; k < cast->all->first[row + 1]; ++k) {
        const int *two = cast->all->touches[k].beads;
        if (two[1] >= 0)
            memcpy(cast->touches[frame->touch_count++], two, sizeof *cast->touches);
    }
}

void fst_film_cast_to(fst_film_cast *cast, double periods, fst_film_frame *frame)
{
    const fst_film_motion *m = &cast->motions[0];
    for (int bead = 0; bead < cast->count; ++bead) {
        fst_film_motion_to(&cast->motions[bead], periods);
        fst_film_motion_bead(&cast->motions[bead], &cast->beads[bead]);
    }
    frame->count = cast->count;
    frame->beads = cast->beads;
    frame->magnet_angle = 2.0 * FST_PI * fmod(fst_film_motion_at(m, m->drive_turns), 1.0);
    frame->phase = FST_TWO_PI * fmod(periods, 1.0);
    const double seconds = fst_film_motion_at(m, m->t) / cast->params.friction_gamma;
    for (int k = 0; k < 2; ++k)
        if (cast->params.drive_waveform == FST_WAVEFORM_CARRIED && isfinite(cast->params.drive_velocity[k]))
            frame->magnet_place[k] = 1e3 * cast->params.drive_velocity[k] * seconds;
    if (cast->touches)
        tell_touches(cast, frame);
}
