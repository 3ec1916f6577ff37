/* bead_columns.c - the columns of a sweep over a scene that lists beads: outcome, the largest group, powers, counts. */
#include "sweep/bead_columns.h"

#include <string.h>

#define OF(field) offsetof(fst_beads_row, field)
#define COUNT(NAME, name, doc) {name, FST_BEAD_COUNT, NULL, "1", OF(counts) + FST_##NAME * sizeof(int64_t)},

static const fst_bead_column columns[] = {
    {"outcome", FST_BEAD_NAME, FST_WORDS(FST_BEADS_OUTCOMES), "1", OF(outcome)},
    {"groups", FST_BEAD_INT, NULL, "1", OF(group_count)},
    {"largest_kind", FST_BEAD_NAME, FST_WORDS(FST_BEAD_GROUPS), "1", OF(largest_kind)},
    {"largest_beads", FST_BEAD_INT, NULL, "1", OF(largest_count)},
    {"mean_r", FST_BEAD_REAL, NULL, "l", OF(mean_r)},
    {"centre_rate", FST_BEAD_REAL, NULL, "gamma", OF(centre_rate)},
    {"axis_rate", FST_BEAD_REAL, NULL, "gamma", OF(axis_rate)},
    {"drive_power", FST_BEAD_REAL, NULL, "l^2 gamma^3", OF(drive_power)},
    {"plate_power", FST_BEAD_REAL, NULL, "l^2 gamma^3", OF(plate_power)},
    {"pair_power", FST_BEAD_REAL, NULL, "l^2 gamma^3", OF(pair_power)},
    {"impact_power", FST_BEAD_REAL, NULL, "l^2 gamma^3", OF(impact_power)},
    {"energy_residual", FST_BEAD_REAL, NULL, "l^2 gamma^2", OF(energy_residual)},
    FST_BEAD_EVENT_LIST(COUNT){"periods", FST_BEAD_REAL, NULL, "1", OF(periods)},
    {"method", FST_BEAD_NAME, FST_WORDS(FST_BEADS_METHODS), "1", OF(method)},
    {"rhs_calls", FST_BEAD_COUNT, NULL, "1", OF(rhs_calls)},
    {"steps_accepted", FST_BEAD_COUNT, NULL, "1", OF(accepted)},
    {"steps_rejected", FST_BEAD_COUNT, NULL, "1", OF(rejected)},
};

int fst_bead_column_count(void)
{
    return sizeof columns / sizeof *columns;
}

const fst_bead_column *fst_bead_column_at(int index)
{
    return &columns[index];
}

const fst_bead_column *fst_bead_column_find(const char *name)
{
    for (int i = 0; i < fst_bead_column_count(); ++i)
        if (strcmp(columns[i].name, name) == 0)
            return &columns[i];
    return NULL;
}

fst_beads_row fst_beads_row_of(const fst_beads_result *result)
{
    const fst_bead_group *largest = result->groups;
    for (int g = 1; g < result->group_count; ++g)
        if (result->groups[g].count > largest->count)
            largest = &result->groups[g];
    fst_beads_row row = {.outcome = (int)result->outcome,
                         .method = (int)result->method,
                         .group_count = result->group_count,
                         .mean_r = NAN,
                         .centre_rate = NAN,
                         .axis_rate = NAN,
                         .drive_power = result->drive_power,
                         .plate_power = result->plate_power,
                         .pair_power = result->pair_power,
                         .impact_power = result->impact_power,
                         .energy_residual = result->energy_residual,
                         .periods = result->periods,
                         .rhs_calls = (int64_t)result->rhs_calls,
                         .accepted = (int64_t)result->accepted,
                         .rejected = (int64_t)result->rejected};
    if (result->group_count) { /* else all beads are gone */
        row.largest_kind = (int)largest->kind;
        row.largest_count = largest->count;
        row.mean_r = largest->mean_r;
        row.centre_rate = largest->centre_rate;
        row.axis_rate = largest->axis_rate;
    }
    memcpy(row.counts, result->counts, sizeof row.counts);
    return row;
}
