/* figures.c - the table of the paper's figures: what each shows, how it is drawn, and which statement says
 * what it shows. */
#include "paper/figures.h"
#include "paper/runs.h"
#include "paper/work.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"
#include "host/parallel.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fst_status draw_trajectory(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                  fst_error *error)
{
    const fst_paper_run *run = fst_paper_single(paper, figure->scan, figure->dynamics);
    fst_figure_options options = fst_default_figure_options();
    options.kind = figure->kind;
    options.colour = figure->colour;
    options.arrows = !figure->plain;
    options.inset = figure->inset;
    if (figure->zoomed) {
        options.zoom[0] = options.zoom[2] = 0.0;
        options.zoom[1] = options.zoom[3] = 1e3 * run->params.magnet_half_length;
    }
    return fst_figure_trajectory(&run->trajectory, out, &options, error);
}

static fst_status draw_field(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                             fst_error *error)
{
    return fst_figure_field(&fst_paper_single(paper, figure->scan, FST_DYNAMICS_RIGID)->params,
                            FST_SHOWN_SCALED, out, error);
}

static const fst_paper_figure figures[] = {
    {.name = "sketch",
     .source = "Fig. 1",
     .title = "The setup to scale",
     .caption = "A bead (vermilion) on a plate, and below it a bar magnet that turns anticlockwise; blue: the "
                "lines of dipoles that model it. The moment n has the angle θ against e_r; φ is the angle in "
                "the plane of e_α and e_z: n = cos θ e_r + sin θ (sin φ e_α − cos φ e_z).",
     .scan = FST_SCAN_FOLD4,
     .draw = fst_paper_draw_sketch},
    {.name = "camera",
     .source = "Fig. 2",
     .title = "A path at 10.7 Hz, as filmed",
     .caption =
         "The simulated path sampled like the experiment's, at 200 frames a second. The paper gives no scale; "
         "here a millimetre has 10 pixels.",
     .each = 1,
     .own = "fold4-festoons",
     .scan = FST_SCAN_FOLD4,
     .draw = fst_paper_draw_camera},
    {.name = "radius",
     .source = "Fig. 3",
     .title = "Radius and its deviation in the laboratory's units",
     .caption =
         "Mean radius of the path and its standard deviation against the magnet's frequency, where the bead "
         "counter-rotates.",
     .own = "shrinking",
     .scan = FST_SCAN_COMPARISON,
     .draw = fst_paper_draw_radius},
    {.name = "supercritical",
     .source = "Fig. 10",
     .title = "The period halving is supercritical",
     .caption = "Ratio p of successive swings of r where it is under 6 (inset: r(t) under the threshold, two "
                "unequal swings in "
                "turn), mean of n_z, "
                "and the time in which the motion settles. Dotted: the pitchfork of the periodic orbits.",
     .each = 1,
     .own = "halving",
     .scan = FST_SCAN_COMPARISON,
     .step = FST_PAPER_STEP_HALVING,
     .draw = fst_paper_draw_supercritical},
    {.name = "remanence",
     .source = "section on the paramagnetic bead, carried on",
     .title = "How much remanence a steel bead needs",
     .caption = "Least magnetic strength κ with which a bead that the field magnetises isotropically still "
                "counter-rotates 600 turns of the magnet after a free-rolling start (rigid). Points: computed; "
                "the lines guide the eye.",
     .scan = FST_SCAN_COMPARISON,
     .step = FST_PAPER_STEP_REMANENCE,
     .draw = fst_paper_draw_remanence},
    {.name = "portrait",
     .source = "Fig. 5",
     .title = "The magnet's field",
     .caption =
         "The field in which the bead moves: five lines of dipoles, two poles. Colour: strength; arrows: "
         "direction of its part in the plane. At the maxima the field stands almost upright.",
     .own = "maxima",
     .scan = FST_SCAN_FOLD15,
     .draw = draw_field},
    {.name = "comparison",
     .source = "Figs. 3 and 6",
     .title = "Radius, speed and fluctuation against the drive",
     .caption = "Mean radius (left ordinate) and mean angular velocity of the bead about the axis (right; "
                "negative: against "
                "the magnet); inset: standard deviation of the radius. Solid: farago2020, dashed: rigid. Where "
                "the bead does "
                "not counter-rotate regularly the lines end. The measured points are not in the paper's text; "
                "what the text "
                "tells of them is marked.",
     .own = "bell",
     .scan = FST_SCAN_COMPARISON,
     .draw = fst_paper_draw_comparison},
    {.name = "dotal",
     .source = "Fig. 4",
     .title = "How fast the bead circles",
     .caption = "The bead goes round with the magnet at low drives, and against it, more slowly, at high ones. "
                "Lines: counter-rotation from the rolling start, enlarged in the inset; circles: beads "
                "released at rest.",
     .own = "bell-shape",
     .scan = FST_SCAN_COMPARISON,
     .draw = fst_paper_draw_dotal},
    {.name = "f4",
     .source = "Fig. 7",
     .title = "Four festoons at 10.7 Hz",
     .caption =
         "Two revolutions of the bead at the drive 0.215. Colour: vertical part of the moment; arrows: its "
         "horizontal part.",
     .each = 1,
     .own = "fold4-festoons",
     .scan = FST_SCAN_FOLD4,
     .draw = draw_trajectory},
    {.name = "f4detail-angle",
     .source = "Fig. 8, top",
     .title = "The moment follows the field",
     .caption = "The upper right corner of the same path, coloured by the angle between moment and field.",
     .each = 1,
     .own = "fold4-angle",
     .scan = FST_SCAN_FOLD4,
     .draw = draw_trajectory,
     .colour = "angle",
     .zoomed = 1},
    {.name = "f4detail-slip",
     .source = "Fig. 8, bottom",
     .title = "Friction acts at the turning points",
     .caption =
         "The same corner, coloured by the speed of the contact point, which friction is proportional to.",
     .each = 1,
     .own = "turning-points",
     .scan = FST_SCAN_FOLD4,
     .draw = draw_trajectory,
     .colour = "slip",
     .zoomed = 1},
    {.name = "om04",
     .source = "Fig. 9",
     .title = "Many festoons at 19.9 Hz",
     .caption =
         "Two revolutions of the bead at the drive 0.4, coloured by the speed of the contact point; inset: the "
         "closed path of the moment in the local frame, seen along the radius.",
     .plain = 1,
     .inset = 1,
     .each = 1,
     .own = "fold15-festoons",
     .scan = FST_SCAN_FOLD15,
     .draw = draw_trajectory,
     .colour = "slip"},
    {.name = "om04-n",
     .source = "Fig. 9, inset, larger and from two sides",
     .title = "The closed path of the moment",
     .caption = "The moment's direction in the local frame at the drive 0.4, seen along the radius and along "
                "the circle; grey: the unit sphere's outline.",
     .each = 1,
     .own = "fold15-closed",
     .scan = FST_SCAN_FOLD15,
     .draw = draw_trajectory,
     .kind = FST_FIGURE_LOCAL_N},
    {.name = "magint",
     .source = "Fig. 13",
     .title = "Where the festoons come from",
     .caption = "Radius and field strength while the magnet turns by half a revolution under the bead, at the "
                "drive 0.4. "
                "The radius is least over the ends of the magnet, where the field is strongest and the "
                "magnet's force on "
                "the bead weakest; the pull inwards is greatest over the middle (force-ends, pull-weakens).",
     .each = 1,
     .own = "magint-least",
     .scan = FST_SCAN_FOLD15,
     .draw = draw_trajectory,
     .kind = FST_FIGURE_RADIUS_FIELD},
    {.name = "test",
     .source = "Fig. 11",
     .title = "Free rolling at high drives",
     .caption =
         "Solid: mean angular velocities of the bead about the axis and of its moment; dashed: the paper's "
         "formulas for free rolling, with the mean radius of each run. Under the drive 0.185 the moment swings "
         "without turning over, ⟨φ′⟩ = 0: left out.",
     .own = "rolling-alpha",
     .scan = FST_SCAN_COMPARISON,
     .draw = fst_paper_draw_test},
    {.name = "evolution",
     .source = "Fig. 12",
     .title = "The radial balance of forces",
     .caption = "The three terms of the averaged radial equation (12); their exact sum is zero. The paper "
                "drops n_r from the magnetic term: dashed.",
     .each = 1,
     .own = "friction",
     .scan = FST_SCAN_COMPARISON,
     .draw = fst_paper_draw_evolution},
    {.name = "magnets-field",
     .source = "section IV, carried on",
     .title = "The field of real magnets of the bar's outline",
     .caption =
         "Strength of the field at the bead's centre over the magnet's long axis and across it. All magnets "
         "have the remanence that gives the greatest field of the five lines at κ = 1.5.",
     .scan = FST_SCAN_COMPARISON,
     .step = FST_PAPER_STEP_MAGNETS,
     .draw = fst_paper_draw_magnet_fields},
    {.name = "magnets-speed",
     .source = "Fig. 4, carried on",
     .title = "How fast the bead circles on real magnets",
     .caption = "Frequency of the bead about the axis (negative: against the magnet) on the same magnets, with "
                "viscous and with dry friction, where it counter-rotates regularly from the rolling start.",
     .scan = FST_SCAN_COMPARISON,
     .step = FST_PAPER_STEP_MAGNETS,
     .draw = fst_paper_draw_magnet_speeds},
};

enum { FIGURE_ROWS = sizeof figures / sizeof figures[0] };
_Static_assert(FST_PAPER_DYNAMICS *FIGURE_ROWS <= FST_MOST_FIGURES, "fst_paper_state.drawn is too short");

int fst_paper_figure_count(void)
{
    int count = 0;
    for (int row = 0; row < FIGURE_ROWS; ++row)
        count += figures[row].each ? FST_PAPER_DYNAMICS : 1;
    return count;
}

fst_paper_figure fst_paper_figure_at(int index)
{
    int row = 0;
    for (; row < FIGURE_ROWS - 1; ++row) {
        int here = figures[row].each ? FST_PAPER_DYNAMICS : 1;
        if (index < here)
            break;
        index -= here;
    }
    fst_paper_figure figure = figures[row];
    figure.dynamics = index == 0 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID;
    (void)snprintf(figure.file, sizeof figure.file, "%s%s", figure.name,
                   !figure.each                            ? ""
                   : figure.dynamics == FST_DYNAMICS_RIGID ? "-rigid"
                                                           : "-farago2020");
    return figure;
}

int fst_paper_figure_verdict(const fst_paper_state *paper, const fst_paper_figure *figure,
                             fst_dynamics dynamics, fst_verdict *verdict)
{
    const fst_statement *statement = figure->own ? fst_statement_named(figure->own) : NULL;
    if (!statement || !fst_statement_known(statement, paper))
        return 0;
    *verdict = fst_statement_check(statement, paper).verdict[dynamics];
    return 1;
}

/* Write the options of `festoon plot` that draw this figure. */
static void plot_options(const fst_paper_state *paper, const fst_paper_figure *figure, char *text, size_t size)
{
    static const char *const kinds[] = {[FST_FIGURE_PATH] = "",
                                        [FST_FIGURE_LOCAL_N] = " --kind local-n",
                                        [FST_FIGURE_RADIUS_FIELD] = " --kind radius-field"};
    double corner = 1e3 * fst_paper_single(paper, figure->scan, figure->dynamics)->params.magnet_half_length;
    char zoom[64] = "";
    if (figure->zoomed)
        (void)snprintf(zoom, sizeof zoom, " --zoom 0,%g,0,%g", corner, corner);
    (void)snprintf(text, size, "%s%s%s%s%s%s", kinds[figure->kind], figure->colour ? " --colour " : "",
                   figure->colour ? figure->colour : "", figure->plain ? " --no-arrows" : "",
                   figure->inset ? " --inset" : "", zoom);
}

void fst_paper_figure_command(const fst_paper_state *paper, const fst_paper_figure *figure, char *text,
                              size_t size)
{
    char run[256], options[128];
    fst_paper_scan_command(paper, figure->scan, figure->dynamics, run, sizeof run);
    plot_options(paper, figure, options, sizeof options);
    if (figure->draw == draw_field)
        (void)snprintf(text, size, "festoon field -o %s.svg", figure->file);
    else if (figure->draw == draw_trajectory)
        (void)snprintf(text, size, "%s --set run.samples=128 -o %s.h5\nfestoon plot %s.h5 -o %s.svg%s", run,
                       figure->file, figure->file, figure->file, options);
    else
        (void)snprintf(text, size, "festoon paper -o DIR%s\ngnuplot %s.gp   # in DIR",
                       paper->options->reduced ? " --reduced" : "", figure->file);
}

static fst_status draw_one(fst_paper_state *paper, int index, fst_error *error)
{
    fst_paper_figure figure = fst_paper_figure_at(index);
    char *out = fst_paper_path(paper, figure.file, "svg");
    if (!out)
        return fst_fail(error, FST_NO_MEMORY, figure.file, "no memory for a file name");
    fst_status status = figure.draw(paper, &figure, out, error);
    free(out);
    return status;
}

typedef struct gallery {
    fst_paper_state *paper;
    int list[FST_MOST_FIGURES], count;
} gallery;

/* Figures are drawn at the same time: each has its own place in `drawn`. */
static fst_status draw_piece(void *user, int place, fst_error *error)
{
    const gallery *all = user;
    int index = all->list[place];
    fst_status status = draw_one(all->paper, index, error);
    all->paper->drawn[index] = status == FST_OK;
    return status;
}

fst_status fst_paper_draw_figures(fst_paper_state *paper, double from, double to, fst_error *error)
{
    gallery all = {.paper = paper};
    for (int i = 0; i < fst_paper_figure_count(); ++i) {
        fst_paper_figure figure = fst_paper_figure_at(i);
        if (!paper->drawn[i] && fst_paper_has(paper, figure.step, figure.scan))
            all.list[all.count++] = i;
    }
    const double share = fst_paper_share(paper);
    fst_part part = {paper->options->progress, share * from, share * to, "figures"};
    const fst_progress progress = {&part, fst_part_tell};
    fst_work work = {.user = &all, .count = all.count, .piece = draw_piece, .progress = &progress};
    double began = fst_clock_seconds();
    fst_status status = fst_parallel(&work, error);
    fst_paper_note_time(paper, "figures", began);
    return status;
}
