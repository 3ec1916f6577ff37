/* beads_file.c - trajectories of several beads, and of one in a world, which is a list of one: their columns, writing and
 * reading them. */
#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "io/beads_text.h"
#include "io/csv.h"
#include "io/json.h"
#include "io/load_hdf5.h"
#include "io/rows_file.h"
#include "io/text_table.h"

/* ------------------------------------------------------------------ columns */

enum { TIMES = 2, OF_A_BEAD = FST_BEAD_NUMBERS + 1, NAME_SIZE = 32 };

static const fst_column_info times[TIMES] = {{"t", "1/gamma", "time since the start"},
                                             {"drive_turns", "turn", "turns of the magnet since the start"}};
static const fst_column_info of_a_bead[OF_A_BEAD] = {
    {"X", "l", "place along the magnet's lines, which turn; of a run in the laboratory's frame, along its x"},
    {"Y", "l", "place across the magnet's lines, which turn; of a run in the laboratory's frame, along its y"},
    {"Z", "l", "height of the centre over the plate; without one, over the magnet's reference plane"},
    {"vX", "l gamma", "laboratory velocity, component as of X"},
    {"vY", "l gamma", "laboratory velocity, component as of Y"},
    {"vZ", "l gamma", "vertical velocity"},
    {"nX", "1", "direction of the moment, component as of X"},
    {"nY", "1", "direction of the moment, component as of Y"},
    {"nZ", "1", "direction of the moment, vertical component"},
    {"WX", "gamma", "angular velocity, component as of X"},
    {"WY", "gamma", "angular velocity, component as of Y"},
    {"WZ", "gamma", "angular velocity, vertical component"},
    {"load", "l gamma^2",
     "force on the plate per mass of the first bead; not a number where the bead does not touch it"}};
static const fst_column_info of_a_pair = {
    "force", "l gamma^2",
    "force between the two per mass of the first bead; not a number where they do not touch"};

typedef struct column_list {
    int beads, count;
    char (*names)[NAME_SIZE];
    fst_column_info *infos;
    const fst_column_info **at;
} column_list;

static int pair_count(int beads)
{
    return beads > FST_BEADS_MOST ? 0 : beads * (beads - 1) / 2;
}

static int pair_column(int beads, int first, int second)
{
    const int before = first * (2 * beads - first - 1) / 2;
    return TIMES + OF_A_BEAD * beads + before + second - first - 1;
}

static void name_column(column_list *list, int column, const fst_column_info *kind, int bead, int other)
{
    fst_column_info *info = &list->infos[column];
    *info = *kind;
    if (other >= 0)
        (void)snprintf(list->names[column], NAME_SIZE, "%s_%d_%d", kind->name, bead, other);
    else
        (void)snprintf(list->names[column], NAME_SIZE, "%s_%d", kind->name, bead);
    info->name = list->names[column];
}

static void free_columns(column_list *list)
{
    free(list->names);
    free(list->infos);
    free(list->at);
}

static int list_columns(int beads, column_list *list)
{
    const size_t count = (size_t)(TIMES + OF_A_BEAD * beads + pair_count(beads));
    *list = (column_list){beads, (int)count, calloc(count, sizeof *list->names),
                          calloc(count, sizeof *list->infos), calloc(count, sizeof *list->at)};
    if (!list->names || !list->infos || !list->at)
        return 0;
    memcpy(list->infos, times, sizeof times);
    for (int bead = 0; bead < beads; ++bead)
        for (int k = 0; k < OF_A_BEAD; ++k)
            name_column(list, TIMES + OF_A_BEAD * bead + k, &of_a_bead[k], bead, -1);
    for (int bead = 0; bead < beads && pair_count(beads); ++bead)
        for (int other = bead + 1; other < beads; ++other)
            name_column(list, pair_column(beads, bead, other), &of_a_pair, bead, other);
    for (size_t i = 0; i < count; ++i)
        list->at[i] = &list->infos[i];
    return 1;
}

/* ------------------------------------------------------------------ writing */

struct fst_beads_trajectory {
    fst_params scene;
    column_list columns;
    fst_rows_file file;
};

static fst_status no_memory(const char *path, fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
}

/* How many beads the trajectories of a scene have; 0: it is one of a bead on the plate, which has files of its own. */
static int count_beads(const fst_params *scene)
{
    return scene->bead_count ? scene->bead_count : fst_key_of_world(scene) != NULL;
}

fst_status fst_beads_trajectory_create(const char *path, const fst_params *scene, fst_shown_units units,
                                       fst_beads_trajectory **out, fst_error *error)
{
    const int beads = count_beads(scene);
    *out = NULL;
    if (!beads)
        return fst_fail(error, FST_BAD_INPUT, path, "the scene lists no beads");
    fst_beads_trajectory *trajectory = calloc(1, sizeof *trajectory);
    if (!trajectory)
        return no_memory(path, error);
    trajectory->scene = *scene;
    const column_list *columns = &trajectory->columns;
    const fst_status status = list_columns(beads, &trajectory->columns)
                                  ? fst_rows_open(&trajectory->file, path, &trajectory->scene, 1, columns->at,
                                                  columns->count, units, error)
                                  : no_memory(path, error);
    if (status == FST_OK)
        *out = trajectory;
    else
        fst_beads_trajectory_discard(trajectory);
    return status;
}

/* The sample as a row. */
static void fill(fst_beads_trajectory *trajectory, const fst_beads_sample *sample)
{
    const int beads = trajectory->columns.beads;
    double *values = trajectory->file.values;
    for (int i = 0; i < trajectory->columns.count; ++i)
        values[i] = NAN;
    values[0] = sample->t;
    values[1] = sample->drive_turns;
    for (int bead = 0; bead < beads; ++bead)
        memcpy(values + TIMES + OF_A_BEAD * bead, sample->states + FST_BEAD_NUMBERS * bead,
               FST_BEAD_NUMBERS * sizeof *values);
    for (int k = 0; k < sample->touch_count; ++k) {
        const int *two = sample->touches[k].beads;
        if (two[1] < 0)
            values[TIMES + OF_A_BEAD * two[0] + FST_BEAD_NUMBERS] = sample->touches[k].force;
        else if (pair_count(beads))
            values[pair_column(beads, two[0] < two[1] ? two[0] : two[1], two[0] < two[1] ? two[1] : two[0])] =
                sample->touches[k].force;
    }
}

fst_status fst_beads_trajectory_append(fst_beads_trajectory *trajectory, const fst_beads_sample *sample,
                                       fst_error *error)
{
    fill(trajectory, sample);
    return fst_rows_append(&trajectory->file, error);
}

static fst_status close_with(fst_beads_trajectory *trajectory, int has_result, char *line, int complete,
                             fst_error *error)
{
    const fst_status status = fst_rows_close(&trajectory->file, has_result, line, complete, error);
    fst_beads_trajectory_discard(trajectory);
    return status;
}

fst_status fst_beads_trajectory_close(fst_beads_trajectory *trajectory, const fst_beads_result *result,
                                      int complete, fst_error *error)
{
    char *line = result ? fst_beads_line(&trajectory->scene, result) : NULL;
    return close_with(trajectory, result != NULL, line, complete, error);
}

fst_status fst_world_trajectory_close(fst_beads_trajectory *trajectory, const fst_world_result *result,
                                      int complete, fst_error *error)
{
    char *line = result ? fst_world_line(&trajectory->scene, result) : NULL;
    return close_with(trajectory, result != NULL, line, complete, error);
}

void fst_beads_trajectory_discard(fst_beads_trajectory *trajectory)
{
    if (!trajectory)
        return;
    fst_rows_discard(&trajectory->file);
    free_columns(&trajectory->columns);
    free(trajectory);
}

/* ------------------------------------------------------------------ reading */

/* What a file says before its columns are known. */
typedef struct head {
    int is_hdf5;
    const fst_hdf5_module_table *module;
    char *bytes; /* of an HDF5 file */
    size_t size, ended;
    fst_text text;          /* of another */
    fst_bead_params *beads; /* of a long list */
} head;

static void free_head(head *h)
{
    free(h->bytes);
    free(h->beads);
    if (!h->is_hdf5)
        fst_text_free(&h->text);
}

/* The scene of an HDF5 file, with its column of times. */
static fst_status read_hdf5_scene(const char *path, head *h, fst_params *scene, int *complete, fst_error *error)
{
    const fst_column_info *columns[] = {&times[0]};
    double *data[] = {NULL};
    size_t rows;
    char *text = NULL;
    fst_status status = fst_load_hdf5_file(&h->module, path, &h->bytes, &h->size, error);
    if (status == FST_OK)
        status =
            h->module->read(path, h->bytes, h->size, columns, 1, 1, data, &rows, &text, NULL, complete, error);
    if (status == FST_OK)
        status = fst_scene_parse_beads(text, strlen(text), path, scene, &h->beads, error);
    free(data[0]);
    free(text);
    return status;
}

static fst_status read_head(const char *path, head *h, fst_params *scene, int *complete, fst_error *error)
{
    *h = (head){.is_hdf5 = 0};
    *scene = fst_default_params();
    fst_status status = fst_look_for_hdf5(path, &h->is_hdf5, error);
    if (status == FST_OK && h->is_hdf5)
        return read_hdf5_scene(path, h, scene, complete, error);
    if (status == FST_OK)
        status = fst_text_read(&h->text, path, SIZE_MAX / 8, error);
    return status;
}

fst_status fst_trajectory_has_beads(const char *path, int *has_beads, fst_error *error)
{
    fst_params scene;
    head h;
    int complete;
    const fst_status status = read_head(path, &h, &scene, &complete, error);
    *has_beads = status == FST_OK && (h.is_hdf5 ? count_beads(&scene) > 0 : fst_csv_of_beads(&h.text));
    free_head(&h);
    return status;
}

/* The touches of a row. */
static void find_touches(const column_list *list, double *const *data, size_t row, fst_bead_touch *touches,
                         size_t *count)
{
    for (int i = 0; i < list->beads; ++i) {
        const double load = data[TIMES + OF_A_BEAD * i + FST_BEAD_NUMBERS][row];
        if (!isnan(load))
            touches[(*count)++] = (fst_bead_touch){{i, -1}, load};
        for (int j = i + 1; j < list->beads && pair_count(list->beads); ++j) {
            const double force = data[pair_column(list->beads, i, j)][row];
            if (!isnan(force))
                touches[(*count)++] = (fst_bead_touch){{i, j}, force};
        }
    }
}

/* Whether all numbers but forces are finite and times rise; *row and *column say where not.  A magnet may turn back. */
static int is_sound(const column_list *list, double *const *data, size_t rows, size_t *row, int *column)
{
    const int numbers = TIMES + OF_A_BEAD * list->beads;
    for (*row = 0; *row < rows; ++*row)
        for (*column = 0; *column < numbers; ++*column) {
            const double value = data[*column][*row];
            const int is_load = *column >= TIMES && (*column - TIMES) % OF_A_BEAD == FST_BEAD_NUMBERS;
            const int falls = *column == 0 && *row > 0 && !(value >= data[*column][*row - 1]);
            if ((!isfinite(value) && !is_load) || falls)
                return 0;
        }
    return 1;
}

/* From columns to the table. */
static fst_status fill_table(const char *path, const column_list *list, double **data, fst_beads_table *table,
                             fst_error *error)
{
    const size_t rows = table->rows, beads = (size_t)list->beads, n = FST_BEAD_NUMBERS;
    size_t bad = 0, most = 0;
    int column;
    if (!is_sound(list, data, rows, &bad, &column))
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "row %zu: the column %s holds \"%g\": numbers of a trajectory are finite, and its times rise",
            bad + 1, list->at[column]->name, data[column][bad]);
    for (int i = TIMES; i < list->count; ++i)
        for (size_t row = 0; row < rows; ++row)
            most += (size_t)!isnan(data[i][row]);
    table->states = malloc((rows * beads * n + 1) * sizeof *table->states);
    table->first = calloc(rows + 1, sizeof *table->first);
    table->touches = malloc((most + 1) * sizeof *table->touches);
    if (!table->states || !table->first || !table->touches)
        return no_memory(path, error);
    for (size_t row = 0; row < rows; ++row) {
        for (size_t bead = 0; bead < beads; ++bead)
            for (size_t k = 0; k < n; ++k)
                table->states[(row * beads + bead) * n + k] = data[TIMES + (size_t)OF_A_BEAD * bead + k][row];
        table->first[row + 1] = table->first[row];
        find_touches(list, data, row, table->touches, &table->first[row + 1]);
    }
    table->t = data[0];
    table->drive_turns = data[1];
    data[0] = data[1] = NULL;
    return FST_OK;
}

static fst_status find_radii(fst_beads_table *table, fst_error *error)
{
    fst_status status = FST_OK;
    table->radii = calloc((size_t)table->count, sizeof *table->radii);
    if (!table->radii)
        return no_memory("beads", error);
    for (int bead = 0; bead < table->count && status == FST_OK; ++bead) {
        fst_params alone = table->scene;
        if (alone.bead_count)
            status = fst_params_of_bead(&table->scene, bead, &alone, error);
        if (status == FST_OK)
            table->radii[bead] =
                isnan(alone.model_eps) ? alone.bead_radius / alone.magnet_half_length : alone.model_eps;
    }
    return status;
}

/* The outcome in the result of a run, as JSON; NULL: the file has none. */
static fst_beads_outcome outcome_in(const char *result)
{
    json_error_t why;
    fst_status status = FST_OK;
    json_t *document = result ? fst_json_read(result, strlen(result), &why, &status) : NULL;
    const char *name = json_string_value(json_object_get(document, "outcome"));
    int outcome = 0;
    while (outcome < FST_BEADS_OUTCOME_COUNT &&
           !(name && strcmp(name, fst_beads_outcome_name((fst_beads_outcome)outcome)) == 0))
        ++outcome;
    json_decref(document);
    return (fst_beads_outcome)outcome;
}

static fst_status read_columns(const char *path, head *h, fst_beads_table *table, fst_error *error)
{
    column_list list;
    char *scene = NULL, *result = NULL;
    const int listed = list_columns(table->count, &list);
    double **data = calloc((size_t)list.count, sizeof *data);
    fst_status status = listed && data ? FST_OK : no_memory(path, error);
    if (status == FST_OK && h->is_hdf5)
        status = h->module->read(path, h->bytes, h->size, list.at, list.count, list.count, data, &table->rows,
                                 &scene, &result, &table->complete, error);
    else if (status == FST_OK)
        status =
            fst_csv_rows(&h->text, h->ended, list.at, list.count, list.count, 1, data, &table->rows, error);
    if (status == FST_OK)
        status = fill_table(path, &list, data, table, error);
    table->outcome = outcome_in(h->is_hdf5 ? result : fst_csv_result(&h->text));
    for (int i = 0; data && i < list.count; ++i)
        free(data[i]);
    table->columns = list.count;
    free(data);
    free(scene);
    free(result);
    free_columns(&list);
    return status;
}

fst_status fst_beads_trajectory_read(const char *path, fst_beads_table *table, fst_error *error)
{
    head h;
    *table = (fst_beads_table){.count = 0};
    fst_status status = read_head(path, &h, &table->scene, &table->complete, error);
    if (status == FST_OK && !h.is_hdf5)
        status = fst_csv_comments(&h.text, 1, &table->scene, &h.beads, &h.ended, &table->complete, error);
    table->count = count_beads(&table->scene);
    table->frame = fst_frame_of_world(&table->scene);
    table->beads = h.beads;
    h.beads = NULL;
    if (status == FST_OK && table->count == 0)
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "this is a trajectory of a single bead, and one of several beads is wanted here");
    if (status == FST_OK)
        status = read_columns(path, &h, table, error);
    if (status == FST_OK)
        status = find_radii(table, error);
    free_head(&h);
    if (status != FST_OK)
        fst_beads_table_free(table);
    return status;
}

const double *fst_beads_table_state(const fst_beads_table *table, size_t row, int bead)
{
    return table->states + (row * (size_t)table->count + (size_t)bead) * FST_BEAD_NUMBERS;
}

void fst_beads_table_free(fst_beads_table *table)
{
    free(table->t);
    free(table->drive_turns);
    free(table->states);
    free(table->radii);
    free(table->first);
    free(table->touches);
    free(table->beads);
    *table = (fst_beads_table){.rows = 0};
}
