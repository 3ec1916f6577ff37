/* bead_table.c - one bead of a trajectory of several as a table of its own, which figures and films take. */
#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "io/columns.h"

void fst_beads_table_vector(const fst_beads_table *table, size_t row, int bead, int from, int from_magnet,
                            double vector[3])
{
    const double *given = fst_beads_table_state(table, row, bead) + from;
    const int turns = table->frame == FST_FRAME_TURNING;
    const double angle = FST_TWO_PI * fmod(table->drive_turns[row], 1.0) * (turns - (from_magnet != 0));
    const double c = cos(angle), s = sin(angle);
    vector[0] = c * given[0] - s * given[1];
    vector[1] = s * given[0] + c * given[1];
    vector[2] = given[2];
}

/* The drive's rate between a row and the next. */
static double omega_at(const fst_beads_table *all, size_t row)
{
    const size_t next = row + 1 < all->rows ? row + 1 : row, from = next > row ? row : row ? row - 1 : row;
    const double time = all->t[next] - all->t[from];
    return time > 0.0 ? FST_TWO_PI * (all->drive_turns[next] - all->drive_turns[from]) / time : NAN;
}

/* What is seen of a bead without its field; of the slip only where the plate is flat. */
static const int seen_anywhere[] = {FST_COLUMN_r, FST_COLUMN_n_r, FST_COLUMN_n_alpha, FST_COLUMN_spin,
                                    FST_COLUMN_z, FST_COLUMN_vz,  FST_COLUMN_flying};
static const int seen_on_a_plate[] = {FST_COLUMN_V_r, FST_COLUMN_V_alpha, FST_COLUMN_slip, FST_COLUMN_sticking};

static int is_known(int column, const fst_params *p)
{
    enum { ANYWHERE = sizeof seen_anywhere / sizeof *seen_anywhere };
    enum { ON_A_PLATE = sizeof seen_on_a_plate / sizeof *seen_on_a_plate };
    int known = column < FST_COLUMN_r;
    for (int i = 0; i < ANYWHERE; ++i)
        known |= column == seen_anywhere[i];
    for (int i = 0; i < ON_A_PLATE; ++i)
        known |= column == seen_on_a_plate[i] && p->plate_shape == FST_PLATE_FLAT;
    return known;
}

static int touches_plate(const fst_beads_table *all, size_t row, int bead)
{
    for (size_t k = all->first[row]; k < all->first[row + 1]; ++k)
        if (all->touches[k].beads[0] == bead && all->touches[k].beads[1] < 0)
            return 1;
    return 0;
}

/* The sample of a bead in a row; `before` is the one of the row before, from which its angle goes on.  `base` is the
 * height of its centre where it rests. */
static fst_sample sample_of(const fst_beads_table *all, const fst_model *model, size_t row, int bead,
                            double base, const fst_sample *before)
{
    fst_sample sample = {.t = all->t[row], .drive_turns = all->drive_turns[row], .omega = omega_at(all, row)};
    double turning[FST_BEAD_NUMBERS], place[3], velocity[3];
    for (int from = 0; from < FST_BEAD_NUMBERS; from += 3)
        fst_beads_table_vector(all, row, bead, from, 1, turning + from);
    memcpy(sample.state, turning, 2 * sizeof *turning);
    memcpy(sample.state + FST_VX, turning + 3, 2 * sizeof *turning);
    memcpy(sample.state + FST_NX, turning + 6, 6 * sizeof *turning);
    fst_beads_table_vector(all, row, bead, 0, 0, place);
    fst_beads_table_vector(all, row, bead, 3, 0, velocity);
    fst_beads_table_vector(all, row, bead, 6, 0, sample.n_lab);
    fst_beads_table_vector(all, row, bead, 9, 0, sample.w_lab);
    sample.x = place[0];
    sample.y = place[1];
    memcpy(sample.v_lab, velocity, sizeof sample.v_lab);
    sample.height = place[2] - base;
    sample.climb = velocity[2];
    sample.flies = !touches_plate(all, row, bead);
    sample.seen = fst_observe(model, sample.state);
    const double alpha = atan2(sample.y, sample.x);
    sample.alpha = before ? before->alpha + remainder(alpha - before->alpha, FST_TWO_PI) : alpha;
    sample.bead_angle = sample.alpha - FST_TWO_PI * all->drive_turns[row];
    return sample;
}

fst_status fst_beads_table_alone(const fst_beads_table *all, int bead, size_t first, size_t last,
                                 fst_table *table, fst_error *error)
{
    fst_model *model;
    const size_t rows = last - first;
    *table = (fst_table){.rows = rows, .complete = all->complete, .params = all->scene};
    fst_status status = FST_OK;
    if (all->scene.bead_count)
        status = fst_params_of_bead(&all->scene, bead, &table->params, error);
    if (status == FST_OK)
        status = fst_field_model_new(&table->params, NAN, &model, error);
    if (status != FST_OK)
        return status;
    table->columns = calloc(FST_COLUMN_COUNT, sizeof *table->columns);
    int good = table->columns != NULL;
    for (int i = 0; i < FST_COLUMN_COUNT && good; ++i)
        if (is_known(i, &table->params))
            good = (table->columns[i] = malloc((rows + 1) * sizeof **table->columns)) != NULL;
    if (!good) {
        fst_table_free(table);
        fst_model_free(model);
        return fst_fail(error, FST_NO_MEMORY, "trajectory", "no memory for %zu samples of a bead", rows);
    }
    const fst_params *p = &table->params;
    const double plate = p->plate_shape == FST_PLATE_NONE ? p->magnet_depth / p->magnet_half_length : 0.0;
    fst_sample sample;
    for (size_t row = 0; row < rows; ++row) {
        double values[FST_COLUMN_COUNT];
        sample = sample_of(all, model, first + row, bead, plate + all->radii[bead], row ? &sample : NULL);
        fst_column_values(&sample, values);
        for (int i = 0; i < FST_COLUMN_COUNT; ++i)
            if (table->columns[i])
                table->columns[i][row] = values[i];
    }
    fst_model_free(model);
    return FST_OK;
}
