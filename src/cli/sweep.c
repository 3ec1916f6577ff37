/* sweep.c - festoon sweep: a run at every point of a grid, into a database. */
#include <stdlib.h>
#include <string.h>

#include <festoon/beads.h>

#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"over", '\0', "KEY=VALUES",
     "vary KEY: LO:HI:COUNT, LO:HI:COUNT:log, A,B,C or LO:HI:random:COUNT (again, for up to 8)"},
    {"output", 'o', "FILE.db", "the database; the same command again goes on with it"},
    {"carry", '\0', FST_WORDS(FST_CARRIES),
     "start each point from the end of its neighbour along the first --over (hysteresis)"},
    {"refine", '\0', "N",
     "compute every 2^N-th value of each LO:HI:COUNT first, then N times between where the regime changes"},
    {"refine-by", '\0', "KEY[:STEP]",
     "refine where KEY changes instead: regime, symmetry, or a number that changes by more than STEP"},
    {"shard", '\0', "I/N",
     "compute the I-th of N shares of the points, in a database of its own; festoon merge joins them"},
    {"levitation", '\0', NULL,
     "rows tell where the bead floats below and above the magnet (festoon locked), not what a run does"},
    {"threads", '\0', "N", "number of threads (as many as this process has processors)"},
    SEED_OPTION,
    {"portable", EXPERT, NULL,
     "as --arithmetic portable: the bits of festoon run, the same on every machine; slower"},
    {"arithmetic", EXPERT, FST_WORDS(FST_ARITHMETICS),
     "kind of arithmetic (the fastest that this processor has)"},
    {"lanes", EXPERT, "N",
     "runs side by side on a thread: 8; avx2: 4; portable: 1, 4, 8; no row depends on it"},
    {"checkpoint", EXPERT, "SECONDS",
     "save the state of a run after so many seconds of work on it; a kill costs no more of it (3)"},
    {NULL, '\0', NULL, NULL},
};

/* --refine N and --refine-by KEY[:STEP]; the key is copied to `key`. */
static fst_status read_refining(const arguments *given, char key[64], fst_sweep_options *sweep,
                                fst_error *error)
{
    const char *by = option_value(given, "refine-by");
    double levels = 0;
    const value_option row = {"refine", VALUE_WHOLE, &levels, 1, 28};
    fst_status status = read_values(given, &row, 1, error);
    sweep->refine = (int)levels;
    if (status != FST_OK || !by)
        return status;
    if (sweep->refine == 0)
        return fail(error, FST_BAD_INPUT, "--refine-by", "this belongs to --refine N, which is missing");
    const size_t length = strcspn(by, ":");
    (void)snprintf(key, 64, "%.*s", (int)(length < 63 ? length : 63), by);
    sweep->refine_by = key;
    if (by[length] == ':') {
        status = read_numbers("--refine-by", by + length + 1, &sweep->refine_step, 1, error);
        if (status == FST_OK && !(sweep->refine_step > 0))
            status = fail(error, FST_BAD_INPUT, "--refine-by", "the step in \"%.80s\" must be positive", by);
    }
    return status;
}

/* --shard I/N. */
static fst_status read_shard(const arguments *given, fst_sweep_options *sweep, fst_error *error)
{
    const char *text = option_value(given, "shard");
    int length = 0;
    if (!text)
        return FST_OK;
    if (sscanf(text, "%*9[0-9]/%*9[0-9]%n", &length) == 0 && length > 0 && !text[length]) {
        sweep->shard = atoi(text);
        sweep->shards = atoi(strchr(text, '/') + 1);
    }
    if (sweep->shard >= 1 && sweep->shard <= sweep->shards)
        return FST_OK;
    return fail(error, FST_BAD_INPUT, "--shard", "\"%.40s\" must be I/N, the I-th of N shares, as in 2/8",
                text);
}

static fst_status read_sweep(const arguments *given, const char **axes, char key[64], fst_sweep_options *sweep,
                             fst_error *error)
{
    *sweep = fst_default_sweep_options();
    for (int i = 0; i < given->option_count; ++i)
        if (strcmp(given->options[i].row->name, "over") == 0)
            axes[sweep->axis_count++] = given->options[i].value;
    sweep->axes = axes;
    double threads = 0, seed = 1, lanes = 0;
    const value_option rows[] = {{"threads", VALUE_WHOLE, &threads, 1, 256},
                                 {"seed", VALUE_WHOLE, &seed, 0, 9007199254740991.0},
                                 {"lanes", VALUE_WHOLE, &lanes, 1, 8},
                                 {"checkpoint", FST_UNIT_NUMBER, &sweep->checkpoint_seconds, 0, 0}};
    fst_status status = read_values(given, rows, sizeof rows / sizeof *rows, error);
    if (status == FST_OK && !(sweep->checkpoint_seconds > 0 && sweep->checkpoint_seconds <= 1e9))
        status = fail(error, FST_BAD_INPUT, "--checkpoint", "\"%.40s\" must be positive seconds, at most 1e9",
                      option_value(given, "checkpoint"));
    sweep->threads = (int)threads;
    sweep->seed = (uint64_t)seed;
    sweep->lanes = (int)lanes;
    if (status == FST_OK)
        status = read_refining(given, key, sweep, error);
    if (status == FST_OK)
        status = read_shard(given, sweep, error);
    sweep->levitation = option_value(given, "levitation") != NULL;
    if (option_value(given, "portable"))
        sweep->arithmetic = FST_ARITHMETIC_PORTABLE;
    const char *arithmetic = option_value(given, "arithmetic");
    int kind = (int)sweep->arithmetic, carry = FST_CARRY_NO;
    if (status == FST_OK)
        status =
            read_choice("--arithmetic", arithmetic, "arithmetic", FST_WORDS(FST_ARITHMETICS), &kind, error);
    if (status == FST_OK)
        status = read_choice("--carry", option_value(given, "carry"), "direction", FST_WORDS(FST_CARRIES),
                             &carry, error);
    sweep->arithmetic = (fst_arithmetic)kind;
    sweep->carry = (fst_carry)carry;
    return status;
}

/* What the progress line shows while the sweep is at work. */
typedef struct display {
    progress_line line;
    int refined;             /* how many points there will be is an estimate until the end */
    double told;             /* the greatest part that was shown as done */
    fst_sweep_counts counts; /* the library keeps them up to date */
    char material[512];      /* why a bead cannot be made of any material; "": each can */
    char idle[512];          /* which keys are varied in vain; "": none */
    char follows[160];       /* which given key does not count beside a varied one; "": none */
    int can_draw;            /* it varies so few parameters that festoon plot shows it */
} display;

/* Warn once; of several ranks only rank 0 does. */
static void warn_once(display *shown, int rank)
{
    if (shown->material[0] && rank == 0)
        (void)fprintf(stderr, "festoon: warning: %s\n", shown->material);
    if (shown->idle[0] && rank == 0)
        (void)fprintf(stderr, "festoon: %s\n", shown->idle);
    if (shown->follows[0] && rank == 0)
        (void)fprintf(stderr, "festoon: warning: %s\n", shown->follows);
    shown->material[0] = shown->idle[0] = shown->follows[0] = '\0';
}

/* Look over the grid: for a contradiction, of which one warning is enough, and whether a figure can show it. */
static fst_status look_over(display *shown, const fst_params *params, const fst_sweep_options *sweep,
                            fst_error *error)
{
    int64_t varied = 0, stride = 0;
    fst_grid *grid = NULL;
    const fst_status status = fst_grid_new(params, sweep->axes, sweep->axis_count, sweep->seed, &grid, error);
    if (status != FST_OK)
        return status == FST_NO_MEMORY ? status : FST_OK; /* the sweep itself will say why */
    if (!fst_grid_contradiction(grid, shown->material, sizeof shown->material))
        shown->material[0] = '\0';
    if (!sweep->levitation)
        (void)fst_grid_idle_axes(grid, shown->idle, sizeof shown->idle);
    (void)fst_grid_followers(grid, shown->follows, sizeof shown->follows);
    shown->can_draw = params->bead_count == 0;
    for (int a = 0; a < fst_grid_axis_count(grid); ++a)
        if (fst_grid_axis_points(grid, a) > 1) {
            varied += 1;
            shown->can_draw &= fst_grid_axis_stride(grid, a) != stride; /* random values are drawn together */
            stride = fst_grid_axis_stride(grid, a);
        }
    shown->can_draw &= varied == 1 || varied == 2;
    fst_grid_free(grid);
    return FST_OK;
}

static fst_status show(void *user, double fraction, const char *part, fst_error *error)
{
    (void)part;
    char what[96];
    display *all = user;
    const fst_sweep_counts *p = &all->counts;
    warn_once(all, p->rank);
    if (p->rank != 0)
        return interrupted() ? fail(error, FST_INTERRUPTED, "", "interrupted") : FST_OK;
    /* How many points a refined sweep will have is an estimate to the end: the part that is done falls when
     * more turn out to be wanted, and the line says so.  The time left follows from the speed of this call. */
    const double rate = p->seconds > 0 ? (double)p->added / p->seconds : 0.0;
    const double part_done = all->refined ? (double)p->computed / (double)p->expected : fraction;
    const char *about = !all->refined ? "" : part_done < all->told ? "now about " : "about ";
    all->told = fmax(all->told, part_done);
    (void)snprintf(what, sizeof what, "%lld of %s%lld points, %.3g a second", (long long)p->computed, about,
                   (long long)p->expected, rate);
    return progress_show_left(&all->line, part_done,
                              rate > 0 ? (double)(p->expected - p->computed) / rate : INFINITY, what, error);
}

/* The place of the next outcome that occurs; FST_SWEEP_OUTCOMES: there is none. */
static int next_outcome(const fst_sweep_counts *p, int place)
{
    while (place < FST_SWEEP_OUTCOMES && p->outcomes[place].points == 0)
        ++place;
    return place;
}

/* What became of the points, and what share of the work they took. */
static void print_outcomes(FILE *out, const fst_sweep_counts *p, int json)
{
    double all = 0.0;
    for (int i = 0; i < FST_SWEEP_OUTCOMES; ++i)
        all += (double)p->outcomes[i].rhs_calls;
    if (!json && all > 0.0)
        (void)fprintf(out, "%-16s %10s %8s %14s\n", "outcome", "points", "work", "mean periods");
    for (int i = next_outcome(p, 0); i < FST_SWEEP_OUTCOMES; i = next_outcome(p, i + 1)) {
        const fst_sweep_outcome *o = &p->outcomes[i];
        const char *name = fst_sweep_outcome_name(p->kind, i),
                   *comma = next_outcome(p, i + 1) < FST_SWEEP_OUTCOMES ? "," : "";
        const double share = (double)o->rhs_calls / all, periods = o->periods / (double)o->points;
        if (o->rhs_calls == 0)
            (void)fprintf(out, json ? "    {\"outcome\": \"%s\", \"points\": %lld}%s\n" : "%-16s %10lld%s\n",
                          name, (long long)o->points, json ? comma : "");
        else if (json)
            (void)fprintf(out,
                          "    {\"outcome\": \"%s\", \"points\": %lld, \"rhs_calls\": %lld, \"share\": %.6g, "
                          "\"mean_periods\": %.6g}%s\n",
                          name, (long long)o->points, (long long)o->rhs_calls, share, periods, comma);
        else
            (void)fprintf(out, "%-16s %10lld %6.2f %% %14.4g\n", name, (long long)o->points, 100.0 * share,
                          periods);
    }
}

static void print_sweep(FILE *out, const char *path, const fst_sweep_counts *p, const fst_sweep_options *sweep,
                        int can_draw, int json)
{
    if (json) {
        (void)fprintf(out,
                      "{\n  \"points\": %lld,\n  \"computed\": %lld,\n  \"rows\": %lld,\n  \"added\": %lld,\n  "
                      "\"failed\": %lld,\n"
                      "  \"lost\": %lld,\n"
                      "  \"seconds\": %.17g,\n  \"processor_seconds\": %.17g,\n  \"journal_seconds\": %.17g,\n "
                      " \"outcomes\": [\n",
                      (long long)p->points, (long long)p->computed, (long long)p->there, (long long)p->added,
                      (long long)p->failed, (long long)p->lost, p->seconds, p->processor_seconds,
                      p->journal_seconds);
        print_outcomes(out, p, 1);
        (void)fputs("  ]\n}\n", out);
        return;
    }
    char name[SHOWN_SIZE];
    path = shown(path, name);
    if (sweep->refine > 0)
        (void)fprintf(out, "%s: %lld point%s, %.3g %% of %lld", path, (long long)p->computed,
                      p->computed == 1 ? "" : "s", 100.0 * (double)p->computed / (double)p->points,
                      (long long)p->points);
    else
        (void)fprintf(out, p->computed == 1 ? "%s: %lld point" : "%s: all %lld points", path,
                      (long long)p->computed);
    if (sweep->shards > 1)
        (void)fprintf(out, " of shard %d/%d", sweep->shard, sweep->shards);
    if (p->added < p->computed)
        (void)fprintf(out, ", %lld of them new", (long long)p->added);
    if (p->failed > 0)
        (void)fprintf(out, "; %lld run%s failed, %s why", (long long)p->failed, p->failed == 1 ? "" : "s",
                      p->failed == 1 ? "its row says" : "their rows say");
    (void)fprintf(out, " (%.3g s)\nfestoon export %s --csv prints the rows", p->seconds, path);
    if (sweep->shards > 1)
        (void)fputs(", festoon merge joins the shards", out);
    else if (can_draw)
        (void)fprintf(out, ", festoon plot %s -o FIG.svg draws them", path);
    (void)fputc('\n', out);
    print_outcomes(out, p, 0);
}

static void tell_of_repair(const char *path, const fst_sweep_counts *counts)
{
    (void)fprintf(stderr,
                  "festoon: %s: this database was damaged; its sound rows were kept, the lost ones (%lld) "
                  "are computed again, and the damaged file was kept as %s.damaged\n",
                  path, (long long)counts->lost, path);
}

/* Say why a sweep that was to be refined was not, though all went well. */
static void tell_of_undefined(const char *path, const char *key, const fst_sweep_counts *counts)
{
    char name[SHOWN_SIZE];
    if (counts->undefined > 0 && counts->undefined == counts->computed)
        (void)fprintf(stderr, "festoon: %s: %s has no value in any of the %lld rows, so nothing was refined\n",
                      shown(path, name), key ? key : "regime", (long long)counts->undefined);
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_sweep_options sweep;
    char key[64];
    const char *axes[OPTION_LIMIT], *path = option_value(given, "output");
    if (!path)
        return fail(error, FST_BAD_INPUT, "", "say where the rows go: -o FILE.db");
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK)
        status = read_sweep(given, axes, key, &sweep, error);
    if (status != FST_OK)
        return status;
    display shown = {.refined = sweep.refine > 0};
    status = look_over(&shown, &params, &sweep, error);
    if (status != FST_OK)
        return status;
    progress_begin(&shown.line);
    const fst_progress progress = {&shown, show};
    sweep.progress = &progress;
    sweep.with_ranks = 1;
    status = fst_sweep(&params, path, &sweep, &shown.counts, error);
    progress_end(&shown.line);
    if (status == FST_OK)
        warn_once(&shown, shown.counts.rank);
    /* Rank 0 reports what happened to all, by its words and its status.  The others end with status 0, because
     * mpirun kills all ranks as soon as one has ended with another status, even if rank 0 is still about to
     * speak. */
    if (shown.counts.rank != 0)
        return FST_OK;
    if (shown.counts.repaired)
        tell_of_repair(path, &shown.counts);
    if (shown.counts.begun_anew > 0)
        (void)fprintf(stderr,
                      "festoon: %s: what was saved of unfinished runs was damaged: %lld are made anew\n", path,
                      (long long)shown.counts.begun_anew);
    if (status == FST_INTERRUPTED)
        return fail(error, FST_INTERRUPTED, path,
                    "interrupted with %lld of %s%lld points done; the same command goes on",
                    (long long)shown.counts.computed, sweep.refine ? "about " : "",
                    (long long)shown.counts.expected);
    if (status != FST_OK)
        return status;
    tell_of_undefined(path, sweep.refine_by, &shown.counts);
    print_sweep(out, path, &shown.counts, &sweep, shown.can_draw, option_value(given, "json") != NULL);
    if (!shown.counts.all_failed[0])
        return FST_OK;
    output_keep();
    return fail(error, FST_NO_CONVERGENCE, path, "no run of this sweep could be made; the first: %s",
                shown.counts.all_failed);
}

const command sweep_command = {
    .name = "sweep",
    .synopsis = "[SCENE.yaml] --over KEY=LO:HI:COUNT... -o FILE.db [options]",
    .summary = "Run every point of a grid into a database, and go on where it stopped",
    .details = "Each point gets one row with the keys of festoon run, a run that fails too.  Several --over "
               "multiply, the last\n"
               "one running fastest; random ones are drawn together.  Killed or interrupted at any moment, the "
               "same command goes\n"
               "on; one at a time works on a FILE.db.  Under mpirun -n N or srun --mpi=pmix the points are "
               "shared between\n"
               "processes.  With --refine N what is smaller than 2^N points may be missed; another N goes on "
               "with the same file.\n"
               "Rows of several beads have outcome, the largest group, powers and counts of events, those of a "
               "bead in a world\n"
               "the frame, the mean height and the balance of energy.  docs/sweeps.md tells more.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
