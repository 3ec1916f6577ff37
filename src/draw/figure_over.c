/* figure_over.c - fst_figure_over(): files laid over each other, and what differs between them. */
#include <festoon/bead_files.h>

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "draw/caption.h"
#include "draw/charts_over.h"
#include "draw/figure_sweep.h"
#include "draw/figure_trajectory.h"

/* What is asked for. */
typedef struct wanted {
    const fst_figure_options *trajectories;
    fst_sweep_figure sweeps;
    int used[FST_AXIS_LIMIT]; /* by place in sweeps.at: whether a sweep varies that key */
    const char *observable;   /* of branches; NULL: the keys of sweeps, or chosen */
    int branches;             /* how many there are */
    int others;               /* there are other files, and these know keys that no branch has */
} wanted;

/* One file. */
typedef struct source {
    const char *path;
    fst_chart *chart;
    fst_params *scene; /* NULL: the file does not say */
    const char *shown[FST_AXIS_LIMIT];
    int shown_count;  /* keys that the figure shows anyway */
    char at[192];     /* of a sweep, the values of its other axes */
    fst_carry carry;  /* of a sweep */
    const char *kind; /* of a branch; NULL: it is none */
    char lacks[192];  /* of a branch, the keys that it has no value of: ", no std_r" */
} source;

static fst_status no_memory(fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "fst_figure_over", "no memory for a figure");
}

static int is_branch(const char *path)
{
    const char *ending = strrchr(path, '.');
    return ending && strcmp(ending, ".json") == 0;
}

static void note_key(source *s, const char *key)
{
    s->shown[s->shown_count++] = fst_param_at(fst_param_find(key))->key;
}

/* ------------------------------------------------------------------ reading */

/* Add the one panel of a chart below those of the file's chart; the former is freed. */
static fst_status add_panel(source *s, fst_chart *one, fst_error *error)
{
    fst_chart *all = s->chart;
    if (!all) {
        s->chart = one;
        return FST_OK;
    }
    const size_t count = (size_t)all->panel_count;
    fst_status status = FST_OK;
    fst_chart_panel *panels = fst_chart_keep(all, (count + 1) * sizeof *panels);
    if (strcmp(all->x_label, one->x_label) != 0) {
        status = fst_fail(error, FST_BAD_INPUT, s->path, "multipliers are drawn alone");
    } else if (!panels) {
        status = no_memory(error);
    } else {
        memcpy(panels, all->panels, count * sizeof *panels);
        panels[count] = one->panels[0];
        all->panels = panels;
        ++all->panel_count;
        fst_chart_adopt(all, one);
    }
    fst_chart_free(one);
    return status;
}

/* A panel for each key that the branch has values of; beside files of another kind it may lack some, but not all. */
static fst_status take_keys(source *s, const fst_branch *branch, const wanted *w, fst_error *error)
{
    const char *own[FST_SWEEP_FIGURE_KEYS] = {w->observable ? w->observable : fst_branch_observable(branch)};
    const char *const *keys = w->observable || !w->sweeps.keys[0] ? own : w->sweeps.keys;
    fst_error first = {.where = ""};
    fst_status status = FST_OK;
    for (int k = 0; k < FST_SWEEP_FIGURE_KEYS && keys[k] && status == FST_OK; ++k) {
        const size_t used = strlen(s->lacks);
        fst_error why = {.where = ""};
        fst_chart *one;
        status = fst_chart_of_branch(branch, keys[k], w->sweeps.units, NULL, 0, &one, &why);
        first = used ? first : why;
        if (status == FST_OK) {
            status = add_panel(s, one, &first);
        } else if (status == FST_BAD_INPUT && w->others) {
            (void)snprintf(s->lacks + used, sizeof s->lacks - used, ", no %s", keys[k]);
            status = FST_OK;
        }
    }
    if (status == FST_OK && !s->chart)
        status = FST_BAD_INPUT;
    if (status != FST_OK && error)
        *error = first;
    return status;
}

static fst_status take_branch(source *s, const wanted *w, fst_error *error)
{
    fst_branch branch;
    fst_status status = fst_branch_read(s->path, &branch, error);
    if (status != FST_OK)
        return status;
    status = take_keys(s, &branch, w, error);
    s->kind = fst_branch_kind_name(branch.kind);
    note_key(s, branch.key);
    if (branch.second_key[0])
        note_key(s, branch.second_key);
    s->scene = branch.scene;
    branch.scene = NULL;
    fst_branch_free(&branch);
    return status;
}

static fst_status take_sweep(source *s, wanted *w, fst_error *error)
{
    fst_sweep_table table;
    fst_status status = fst_sweep_read(s->path, NULL, 0, &table, error);
    if (status != FST_OK)
        return status;
    const fst_grid *grid = table.grid;
    s->carry = table.carry;
    const fst_sweep_figure figure = fst_sweep_figure_of(grid, &w->sweeps, w->used);
    fst_sweep_slice slice;
    status = fst_chart_of_sweep(s->path, &figure, &s->chart, &slice, error);
    s->scene = malloc(sizeof *s->scene);
    if (status == FST_OK && s->scene) {
        if (fst_grid_params(grid, slice.start, s->scene, NULL) != FST_OK)
            *s->scene = *fst_grid_base(grid);
        note_key(s, fst_grid_key(grid, slice.axes[0].index));
        (void)snprintf(s->at, sizeof s->at, "%s", slice.words);
    } else if (status == FST_OK) {
        status = no_memory(error);
    }
    fst_sweep_table_free(&table);
    return status;
}

static fst_status take_trajectory(source *s, const wanted *w, fst_error *error)
{
    fst_table table;
    int has_beads = 0;
    fst_status status = fst_trajectory_has_beads(s->path, &has_beads, error);
    if (status == FST_OK && has_beads)
        status = fst_fail(error, FST_BAD_INPUT, s->path,
                          "a trajectory of several beads or in a world is drawn alone");
    if (status == FST_OK)
        status = fst_trajectory_read(s->path, &table, error);
    if (status != FST_OK)
        return status;
    status = fst_chart_of_trajectory(&table, w->trajectories, 1, &s->chart, error);
    s->scene = malloc(sizeof *s->scene);
    if (s->scene)
        *s->scene = table.params;
    else if (status == FST_OK)
        status = no_memory(error);
    fst_table_free(&table);
    return status;
}

static fst_status take(source *s, wanted *w, fst_error *error)
{
    int is_sweep = 0;
    if (is_branch(s->path))
        return take_branch(s, w, error);
    const fst_status status = fst_is_sweep(s->path, &is_sweep, error);
    if (status != FST_OK)
        return status;
    return is_sweep ? take_sweep(s, w, error) : take_trajectory(s, w, error);
}

static void add_words(char name[FST_CAPTION_SIZE], const char *between, const char *words)
{
    const size_t used = strlen(name);
    (void)snprintf(name + used, FST_CAPTION_SIZE - used, "%s%s", between, words);
}

/* A name for each file: what differs, and the file's name where that does not tell it from another. */
static void name_files(const source *sources, int count, char (*names)[FST_CAPTION_SIZE], char *same,
                       size_t size)
{
    const fst_params *scenes[FST_CHARTS_OVER];
    const char *shown[FST_CHARTS_OVER * FST_AXIS_LIMIT], *paths[FST_CHARTS_OVER], *slices[FST_CHARTS_OVER];
    const char *kind = NULL;
    int shown_count = 0, kinds_differ = 0;
    for (int i = 0; i < count; ++i) {
        kinds_differ |= kind && sources[i].kind && strcmp(kind, sources[i].kind) != 0;
        kind = sources[i].kind ? sources[i].kind : kind;
        scenes[i] = sources[i].scene;
        paths[i] = sources[i].path;
        slices[i] = sources[i].at;
        for (int k = 0; k < sources[i].shown_count; ++k)
            shown[shown_count++] = sources[i].shown[k];
    }
    fst_caption_of_files(scenes, paths, count, shown, shown_count, names, same, size);
    fst_caption_slices(slices, count, names[0], same, size);
    for (int i = 0; i < count; ++i) {
        if (sources[i].carry != FST_CARRY_NO) /* runs that were begun where their neighbours ended */
            add_words(names[i], ", ", sources[i].carry == FST_CARRY_UP ? "upwards" : "downwards");
        if (kinds_differ && sources[i].kind)
            add_words(names[i], ", ", sources[i].kind);
        add_words(names[i], "", sources[i].lacks);
    }
}

/* ------------------------------------------------------------------ the figure */

static fst_status draw(const source *sources, int count, const wanted *w, const char *out, fst_error *error)
{
    char names[FST_CHARTS_OVER][FST_CAPTION_SIZE], same[FST_CAPTION_SIZE];
    fst_chart *charts[FST_CHARTS_OVER], *all;
    const char *words[FST_CHARTS_OVER];
    name_files(sources, count, names, same, sizeof same);
    for (int i = 0; i < count; ++i) {
        charts[i] = sources[i].chart;
        words[i] = names[i];
    }
    fst_status status = fst_charts_over(charts, words, count, same, &all, error);
    if (status == FST_OK)
        fst_sweep_trim_words(all);
    if (status == FST_OK)
        status = fst_figure_chart_as(out, all, w->sweeps.title ? w->sweeps.title : w->trajectories->title,
                                     w->sweeps.size[0] > 0.0 ? w->sweeps.size : w->trajectories->size, error);
    fst_chart_free(all);
    return status;
}

/* A branch shows the keys of sweeps, and beside one a sweep shows what the branch does, so that they have something in
 * common. */
static void match_keys(const char *const *paths, int count, wanted *w)
{
    for (int i = 0; i < count; ++i)
        w->branches += is_branch(paths[i]);
    w->others = w->branches < count;
    if (w->branches && w->others && !w->sweeps.keys[0])
        w->sweeps.keys[0] = w->observable ? w->observable : "mean_r";
}

/* Beside other keys the regime is the colour of a sweep's points, which here tells the files. */
static fst_status check_keys(const wanted *w, fst_error *error)
{
    const char *const *keys = w->sweeps.keys;
    for (int k = 1; k < FST_FIGURE_KEYS && keys[0] && keys[k]; ++k)
        if (strcmp(keys[k], "regime") == 0)
            return fst_fail(error, FST_BAD_INPUT, "fst_sweep_figure.keys",
                            "of several files a colour tells the file, and not the regime of a point: ask for "
                            "the regime first, as in regime,%s, or draw each file alone",
                            keys[0]);
    return FST_OK;
}

fst_status fst_figure_over(const char *const *paths, int count, const fst_figure_options *trajectories,
                           const fst_sweep_figure *sweeps, const char *observable, const char *out,
                           fst_error *error)
{
    const fst_figure_options usual = fst_default_figure_options();
    wanted w = {.trajectories = trajectories ? trajectories : &usual, .observable = observable};
    source sources[FST_CHARTS_OVER] = {{.path = NULL}};
    if (count < 1 || count > FST_CHARTS_OVER)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_over",
                        "%d files are laid over each other, not 1 to %d", count, FST_CHARTS_OVER);
    if (sweeps)
        w.sweeps = *sweeps;
    match_keys(paths, count, &w);
    fst_status status =
        observable && w.branches == 0
            ? fst_fail(error, FST_BAD_INPUT, "fst_figure_branch.observable",
                       "\"%.60s\" is asked for of branches, and none of these is one", observable)
            : check_keys(&w, error);
    for (int i = 0; i < count && status == FST_OK; ++i) {
        sources[i].path = paths[i];
        status = take(&sources[i], &w, error);
    }
    if (status == FST_OK)
        status = fst_sweep_check_used(&w.sweeps, w.used, error);
    if (status == FST_OK)
        status = draw(sources, count, &w, out, error);
    for (int i = 0; i < count; ++i) {
        fst_chart_free(sources[i].chart);
        free(sources[i].scene);
    }
    return status;
}
