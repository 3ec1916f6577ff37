/* beads.c - several beads: whether two come together, where opposition is stable, walkers, and bars that break. */
#include "paper/beads.h"
#include "paper/chart_parts.h"
#include "paper/figures.h"
#include "paper/work.h"

#include "base/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const fst_beads_question_names[FST_ASK_COUNT] = {"border", "opposite", "walker", "breaking"};

#define OPPOSITE(hertz)                                                                                        \
    {                                                                                                          \
        FST_ASK_OPPOSITE, hertz, 180.0, (hertz) == 30.0                                                        \
    }
#define WALKER(restitution)                                                                                    \
    {                                                                                                          \
        FST_ASK_WALKER, 30.0, restitution, (restitution) == 0.0                                                \
    }
const fst_beads_case fst_beads_cases[FST_BEADS_CASES] = {
    {FST_ASK_BREAKING, 30.0, 3.0, 0}, /* the slow ones first */
    {FST_ASK_BREAKING, 30.0, 2.0, 0},
    {FST_ASK_BORDER, 30.0, 105.0, 0},
    {FST_ASK_BORDER, 30.0, 106.0, 0},
    {FST_ASK_BORDER, 40.0, 99.8, 0},
    {FST_ASK_BORDER, 40.0, 100.2, 0},
    OPPOSITE(17.0),
    OPPOSITE(17.05),
    OPPOSITE(18.0),
    OPPOSITE(20.0),
    OPPOSITE(22.0),
    OPPOSITE(24.0),
    OPPOSITE(24.7),
    OPPOSITE(24.8),
    OPPOSITE(26.0),
    OPPOSITE(27.2),
    OPPOSITE(27.3),
    OPPOSITE(28.0),
    OPPOSITE(30.0),
    WALKER(0.0),
    WALKER(0.3),
    WALKER(0.6),
    WALKER(0.7),
};

/* ------------------------------------------------------------------ scenes */

static const char *const settings[FST_ASK_COUNT] = {
    "drive.frequency=%gHz beads[0].start.phi=3deg beads[1].start.phi=%gdeg start.r=0.95 run.periods=2500 "
    "run.discard=2400",
    "drive.frequency=%gHz beads[0].start.phi=3deg beads[1].start.phi=%gdeg",
    "drive.frequency=%gHz beads[0].start.phi=3deg beads[1].start.phi=40deg impact.restitution=%g "
    "run.periods=200 run.discard=100",
    "drive.frequency=%gHz start.spin=rest start.n[0]=1 start.n[1]=0 start.n[2]=0", /* and places */
};

void fst_beads_settings(const fst_beads_case *of, char *text, size_t size)
{
    const int by_angle = of->question == FST_ASK_BORDER || of->question == FST_ASK_OPPOSITE;
    /* The format of a bar leaves out the number of beads: here they follow. */
    int used = snprintf(text, size, settings[of->question], of->hertz, of->given + 3.0 * by_angle);
    for (int i = 0; of->question == FST_ASK_BREAKING && i < (int)of->given; ++i)
        used += snprintf(text + used, size - (size_t)used,
                         " beads[%d].start.position[0]=%gmm beads[%d].start.position[1]=0mm "
                         "beads[%d].start.position[2]=2.5mm",
                         i, 5.0 * (i - 0.5 * (of->given - 1.0)), i, i);
}

/* ------------------------------------------------------------------ answers */

static fst_status run_pair(const fst_params *scene, const fst_beads_options *options, fst_beads_answer *answer,
                           fst_error *error)
{
    fst_beads_result result;
    const fst_status status = fst_beads_run_scene(scene, options, &result, error);
    if (status != FST_OK)
        return status;
    answer->outcome = result.outcome;
    answer->value = result.groups[0].centre_rate / result.omega;
    answer->r = result.groups[0].mean_r;
    fst_beads_free(&result);
    return FST_OK;
}

static fst_status find_multiplier(const fst_params *scene, const fst_beads_options *options,
                                  fst_beads_answer *answer, fst_error *error)
{
    fst_beads_orbit *orbit = malloc(sizeof *orbit);
    const fst_status status =
        orbit ? fst_beads_orbit_scene(scene, options, orbit, error)
              : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for the orbit of two beads");
    if (status == FST_OK)
        answer->value = hypot(orbit->multiplier_re[0], orbit->multiplier_im[0]);
    free(orbit);
    return status;
}

static fst_status find_breaking(const fst_params *scene, const fst_beads_options *options,
                                fst_beads_answer *answer, fst_error *error)
{
    fst_beads_branch branch;
    const fst_status status =
        fst_beads_branch_scene(scene, options, "drive.frequency", 30.0, 300.0, &branch, error);
    if (status != FST_OK)
        return status;
    for (size_t i = 0; i < branch.special_count; ++i)
        if (branch.specials[i].type == FST_SPECIAL_CONTACT)
            answer->value = branch.specials[i].value;
    fst_beads_branch_free(&branch);
    return FST_OK;
}

static fst_status answer_piece(fst_paper_state *paper, int index, fst_error *error)
{
    const fst_beads_case *of = &fst_beads_cases[index];
    fst_beads_answer *answer = &paper->beads->answers[index];
    fst_beads_options options = fst_default_beads_options();
    fst_params scene = fst_default_params();
    char text[512];
    if (paper->options->reduced && !of->reduced)
        return FST_OK;
    options.progress = &paper->until_refused;
    answer->value = answer->r = NAN;
    fst_beads_settings(of, text, sizeof text);
    fst_status status = fst_paper_set(&scene, error, "%s", text);
    if (status == FST_OK)
        status = of->question == FST_ASK_OPPOSITE   ? find_multiplier(&scene, &options, answer, error)
                 : of->question == FST_ASK_BREAKING ? find_breaking(&scene, &options, answer, error)
                                                    : run_pair(&scene, &options, answer, error);
    answer->done = status == FST_OK;
    return status == FST_UNAVAILABLE || status == FST_NO_CONVERGENCE ? FST_OK : status; /* without LAPACK */
}

fst_status fst_paper_make_beads(fst_paper_state *paper, fst_error *error)
{
    const fst_paper_pieces part = {"several beads",      0.99,        0.995, FST_BEADS_CASES,
                                   FST_PAPER_STEP_BEADS, answer_piece};
    paper->beads = calloc(1, sizeof *paper->beads);
    return paper->beads ? fst_paper_do(paper, &part, error)
                        : fst_fail(error, FST_NO_MEMORY, "paper", "no memory for several beads");
}

/* ------------------------------------------------------------------ where opposition is stable */

/* Drives and by how much the multiplier exceeds 1; returns how many. */
static int multipliers(const fst_paper_beads *beads, double *drives, double *over)
{
    int count = 0;
    for (int i = 0; i < FST_BEADS_CASES; ++i)
        if (fst_beads_cases[i].question == FST_ASK_OPPOSITE && beads->answers[i].done) {
            drives[count] = fst_beads_cases[i].hertz;
            over[count++] = beads->answers[i].value - 1.0;
        }
    return count;
}

int fst_beads_changes(const fst_paper_beads *beads, double drives[FST_BEADS_CASES])
{
    double at[FST_BEADS_CASES], over[FST_BEADS_CASES];
    const int count = multipliers(beads, at, over);
    int found = 0;
    for (int i = 1; i < count; ++i)
        if ((over[i - 1] > 0) != (over[i] > 0))
            drives[found++] = at[i - 1] + (at[i] - at[i - 1]) * over[i - 1] / (over[i - 1] - over[i]);
    return found;
}

fst_status fst_paper_draw_opposition(const fst_paper_state *paper, const fst_paper_figure *figure,
                                     const char *out, fst_error *error)
{
    double at[FST_BEADS_CASES], over[FST_BEADS_CASES], changes[FST_BEADS_CASES];
    const double ends[2] = {16.0, 31.0}, zeros[2] = {0.0, 0.0};
    const int count = multipliers(paper->beads, at, over);
    for (int i = 0; i < count; ++i)
        over[i] *= 1e4;
    const fst_chart_curve curves[] = {
        curve_of("two opposite beads", at, over, (size_t)count, FST_COLOUR_BLUE, FST_CURVE_LINE_POINTS),
        curve_of("above: unstable", ends, zeros, 2, FST_COLOUR_BLACK, FST_CURVE_DASHED)};
    const fst_chart_panel panels[] = {panel_of("(|multiplier| − 1) 10⁴", -9.0, 3.0, LISTED(curves))};
    fst_chart_mark marks[FST_BEADS_CASES];
    char words[FST_BEADS_CASES][32];
    const int mark_count = fst_beads_changes(paper->beads, changes);
    for (int i = 0; i < mark_count; ++i) {
        (void)snprintf(words[i], sizeof words[i], "%.2f Hz", changes[i]);
        marks[i] = (fst_chart_mark){changes[i], words[i]};
    }
    fst_chart chart = chart_of(figure->title, "drive (Hz)", ends[0], ends[1], 260, LISTED(panels));
    chart_marks(&chart, marks, mark_count);
    return fst_figure_chart(out, &chart, error);
}
