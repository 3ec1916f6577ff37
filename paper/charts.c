/* charts.c - the paper's figures of curves over the drive (Figs. 3, 4, 6, 11, 12). */
#include "base/constants.h"
#include "base/error.h"
#include "paper/chart_parts.h"
#include "paper/figures.h"

#include <stdlib.h>

enum { MOST_CURVES = 16 };

#define MARKED "dotted: what the paper's text tells of the experiment"

/* ------------------------------------------------------------------ curves out of runs */

/* The number that a curve shows of a run; NAN breaks the line. */
typedef double (*reading)(const fst_paper_run *run);

/* The curves of one chart, and the memory that they point into. */
typedef struct curves {
    fst_chart_curve curve[MOST_CURVES];
    double *memory[MOST_CURVES];
    int count;
    fst_status status;
} curves;

static void free_curves(curves *all)
{
    for (int i = 0; i < all->count; ++i)
        free(all->memory[i]);
}

/* Add the curve of `y` over `x` through the runs of one or two scans (FST_SCAN_COUNT: there is no
 * second one). */
static void add(curves *all, const fst_paper_state *paper, const fst_scan through[2], fst_dynamics dynamics,
                reading x, reading y, fst_chart_curve style)
{
    if (all->status != FST_OK || all->count == MOST_CURVES)
        return;
    size_t room = 0, used = 0;
    for (int s = 0; s < 2; ++s)
        room += through[s] < FST_SCAN_COUNT ? (size_t)paper->counts[through[s]] : 0;
    double *memory = malloc((2 * room + 1) * sizeof *memory);
    if (!memory) {
        all->status = FST_NO_MEMORY;
        return;
    }
    for (int s = 0; s < 2; ++s) {
        for (int i = 0; through[s] < FST_SCAN_COUNT && i < paper->counts[through[s]]; ++i) {
            const fst_paper_run *run = &paper->scans[through[s]][dynamics][i];
            memory[used] = x(run);
            memory[room + used] = y(run);
            ++used;
        }
    }
    style.x = memory;
    style.y = memory + room;
    style.count = used;
    all->memory[all->count] = memory;
    all->curve[all->count++] = style;
}

static fst_status draw_and_free(curves *all, const char *out, const fst_chart *chart, fst_error *error)
{
    fst_status status = all->status == FST_OK ? fst_figure_chart(out, chart, error)
                                              : fst_fail(error, all->status, out, "no memory for the curves");
    free_curves(all);
    return status;
}

static double omega_of(const fst_paper_run *run)
{
    return run->result.omega;
}

static double hertz_of(const fst_paper_run *run)
{
    return run->result.frequency_hz;
}

#define REGULAR(name, value)                                                                                   \
    static double name(const fst_paper_run *run)                                                               \
    {                                                                                                          \
        return fst_paper_counter_rotates(run) ? (value) : NAN;                                                 \
    }

static double eps_of(const fst_paper_run *run)
{
    return run->params.bead_radius / run->params.magnet_half_length;
}

static double omega_per_hertz(const fst_paper_state *paper)
{
    return 2.0 * FST_PI / paper->scans[FST_SCAN_COMPARISON][0][0].params.friction_gamma;
}

/* ------------------------------------------------------------------ Fig. 6 */

REGULAR(mean_r, run->result.mean_r)
REGULAR(mean_alpha_dot, run->result.mean_alpha_dot)
REGULAR(std_r, run->result.std_r)

static const fst_scan comparison[2] = {FST_SCAN_COMPARISON, FST_SCAN_COUNT};
static const fst_scan whole_range[2] = {FST_SCAN_COMPARISON, FST_SCAN_FAST};

static const struct {
    fst_dynamics dynamics;
    fst_curve_style style;
} two_dynamics[FST_PAPER_DYNAMICS] = {{FST_DYNAMICS_FARAGO2020, FST_CURVE_LINE},
                                      {FST_DYNAMICS_RIGID, FST_CURVE_DASHED}};

/* Names and colours of both dynamics, for add_both(). */
static const char *const both_names[FST_PAPER_DYNAMICS] = {"farago2020 (as printed)", "rigid (exact)"};
static const fst_colour both_colours[FST_PAPER_DYNAMICS] = {FST_COLOUR_BLUE, FST_COLOUR_VERMILION};

/* Add a curve for each dynamics through the runs of `through`, in the order of two_dynamics[]. */
static const fst_chart_curve *add_both(curves *all, const fst_paper_state *paper, const fst_scan through[2],
                                       reading x, reading y, const char *const titles[2],
                                       const fst_colour colours[2], int right)
{
    int first = all->count;
    for (int d = 0; d < FST_PAPER_DYNAMICS; ++d)
        add(all, paper, through, two_dynamics[d].dynamics, x, y,
            (fst_chart_curve){.title = titles ? titles[d] : NULL,
                              .colour = colours[d],
                              .style = two_dynamics[d].style,
                              .right = right});
    return all->curve + first;
}

/* As in the paper: two ordinates, colours for the quantities, and the deviation as an inset. */
fst_status fst_paper_draw_comparison(const fst_paper_state *paper, const fst_paper_figure *figure,
                                     const char *out, fst_error *error)
{
    static const char *const of_r[] = {"⟨r⟩, farago2020", "⟨r⟩, rigid"};
    static const char *const of_alpha[] = {"⟨α′⟩, farago2020", "⟨α′⟩, rigid"};
    static const fst_colour blue[] = {FST_COLOUR_BLUE, FST_COLOUR_BLUE};
    static const fst_colour red[] = {FST_COLOUR_VERMILION, FST_COLOUR_VERMILION};
    static const fst_colour green[] = {FST_COLOUR_GREEN, FST_COLOUR_GREEN};
    curves all = {.status = FST_OK};
    const fst_chart_curve *both = add_both(&all, paper, comparison, omega_of, mean_r, of_r, blue, 0);
    (void)add_both(&all, paper, comparison, omega_of, mean_alpha_dot, of_alpha, red, 1);
    const fst_chart_curve *deviation = add_both(&all, paper, comparison, omega_of, std_r, NULL, green, 0);
    const fst_chart_inset inset =
        inset_of((double[]){0.53, 0.95, 0.09, 0.28}, (double[]){0.15, 0.5, 0.0, NAN}, "δr (ℓ)", deviation, 2);
    fst_chart_panel panel = panel_of("⟨r⟩ (ℓ), blue", 0.3, 1.1, both, 2 * FST_PAPER_DYNAMICS);
    panel.right_label = "⟨α′⟩ (γ), orange";
    panel.left_colour = FST_COLOUR_BLUE;
    panel.right_colour = FST_COLOUR_VERMILION;
    panel.right_low = -0.085;
    panel.right_high = -0.045;
    panel.inset = &inset;
    const double per_hertz = omega_per_hertz(paper);
    const fst_chart_mark marks[] = {{7.0 * per_hertz, "7 Hz: lets go"},
                                    {10.7 * per_hertz, "10.7 Hz: 4 festoons"},
                                    {16.0 * per_hertz, "16 Hz: slowest"},
                                    {19.9 * per_hertz, "19.9 Hz: many"}};
    fst_chart chart = chart_of(figure->title, "drive ω (γ)", 0.13, 0.51, 330, &panel, 1);
    chart_second(&chart, "drive (Hz)", 1.0 / per_hertz);
    chart_marks(&chart, LISTED(marks));
    chart.remark = MARKED;
    return draw_and_free(&all, out, &chart, error);
}

/* ------------------------------------------------------------------ Fig. 3 */

static double millimetres_of(const fst_paper_run *run)
{
    return 1e3 * run->params.magnet_half_length;
}

REGULAR(mean_r_mm, millimetres_of(run) * run->result.mean_r)
REGULAR(std_r_mm, millimetres_of(run) * run->result.std_r)

fst_status fst_paper_draw_radius(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                 fst_error *error)
{
    curves all = {.status = FST_OK};
    const fst_chart_panel panels[] = {
        panel_of("mean radius (mm)", 10.0, 25.0,
                 add_both(&all, paper, comparison, hertz_of, mean_r_mm, both_names, both_colours, 0), 2),
        panel_of("its standard deviation (mm)", 0.0, 7.0,
                 add_both(&all, paper, comparison, hertz_of, std_r_mm, NULL, both_colours, 0), 2)};
    fst_chart chart = chart_of(figure->title, "drive (Hz)", 7.0, 25.0, 0, LISTED(panels));
    chart_second(&chart, "drive ω (γ)", omega_per_hertz(paper));
    return draw_and_free(&all, out, &chart, error);
}

/* ------------------------------------------------------------------ Fig. 4 */

static double bead_hertz(const fst_paper_run *run)
{
    return run->result.mean_alpha_dot * run->params.friction_gamma / (2.0 * FST_PI);
}

REGULAR(counter_hertz, bead_hertz(run))

fst_status fst_paper_draw_dotal(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                fst_error *error)
{
    static const fst_scan slow[2] = {FST_SCAN_SLOW, FST_SCAN_COUNT};
    static const double diagonal[] = {0.0, 10.0};
    curves all = {.status = FST_OK};
    all.curve[all.count++] = curve_of("⟨α′⟩ = ω", diagonal, diagonal, 2, FST_COLOUR_GREY, FST_CURVE_LINE);
    const fst_chart_curve *counter =
        add_both(&all, paper, comparison, hertz_of, counter_hertz, both_names, both_colours, 0);
    for (int d = 0; d < FST_PAPER_DYNAMICS; ++d) {
        fst_chart_curve points = {.title = d == 0 ? "released at rest, farago2020" : "the same, rigid",
                                  .colour = both_colours[d],
                                  .style = d == 0 ? FST_CURVE_POINTS : FST_CURVE_OPEN_POINTS};
        add(&all, paper, slow, two_dynamics[d].dynamics, hertz_of, bead_hertz, points);
    }
    const fst_chart_inset inset = inset_of((double[]){0.50, 0.97, 0.50, 0.82},
                                           (double[]){8.0, 25.0, -4.4, -2.6}, "enlarged (Hz)", counter, 2);
    fst_chart_panel panel = panel_of("⟨α′⟩/2π (Hz)", -12.0, 12.0, all.curve, all.count);
    panel.inset = &inset;
    const fst_chart_mark marks[] = {{7.0, "7 Hz: lets go"}, {16.0, "16 Hz: slowest"}};
    fst_chart chart = chart_of(figure->title, "drive (Hz)", 0.9, 25.0, 330, &panel, 1);
    chart_second(&chart, "drive ω (γ)", omega_per_hertz(paper));
    chart_marks(&chart, LISTED(marks));
    chart.remark = MARKED;
    return draw_and_free(&all, out, &chart, error);
}

/* ------------------------------------------------------------------ Fig. 11 */

/* At the lowest drives the moment swings without turning over; such runs are left out. */
REGULAR(mean_phi_dot, fabs(run->result.mean_phi_dot) > 0.5 * run->result.omega ? run->result.mean_phi_dot : NAN)
REGULAR(rolling_alpha_dot, -eps_of(run) * run->result.omega / (run->result.mean_r - eps_of(run)))
REGULAR(rolling_phi_dot, run->result.mean_r * run->result.omega / (run->result.mean_r - eps_of(run)))

fst_status fst_paper_draw_test(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                               fst_error *error)
{
    curves all = {.status = FST_OK};
    fst_chart_panel panels[2];
    static const char *const labels[] = {"⟨α′⟩ (γ)", "⟨φ′⟩ (γ)"};
    static const reading measured[] = {mean_alpha_dot, mean_phi_dot};
    static const reading formula[] = {rolling_alpha_dot, rolling_phi_dot};
    static const char *const names[] = {"free rolling, with the ⟨r⟩ of farago2020", "the same, of rigid"};
    for (int p = 0; p < 2; ++p) {
        int first = all.count;
        for (int d = 0; d < FST_PAPER_DYNAMICS; ++d) {
            fst_chart_curve line = {.title = p == 0 ? both_names[d] : NULL, .colour = both_colours[d]};
            add(&all, paper, whole_range, two_dynamics[d].dynamics, omega_of, measured[p], line);
            fst_chart_curve dashes = {
                .title = p == 0 ? names[d] : NULL, .colour = both_colours[d], .style = FST_CURVE_DASHED};
            add(&all, paper, whole_range, two_dynamics[d].dynamics, omega_of, formula[p], dashes);
        }
        panels[p] = panel_of(labels[p], NAN, NAN, all.curve + first, all.count - first);
    }
    const fst_chart_mark marks[] = {{0.5, "from here on good, says the paper"}};
    fst_chart chart = chart_of(figure->title, "drive ω (γ)", 0.15, 2.05, 0, LISTED(panels));
    chart_marks(&chart, LISTED(marks));
    return draw_and_free(&all, out, &chart, error);
}

/* ------------------------------------------------------------------ Fig. 12 */

REGULAR(centrifugal, run->result.eq21_centrifugal / (eps_of(run) * eps_of(run)))
REGULAR(magnetic, run->result.eq21_magnetic / (eps_of(run) * eps_of(run)))
REGULAR(magnetic_printed, run->result.eq21_magnetic_printed / (eps_of(run) * eps_of(run)))
/* -<V_r> is the friction of Eq. (12) on a viscous plate alone; under another law the curve stays empty. */
REGULAR(friction, run->params.friction_law == FST_FRICTION_VISCOUS
                      ? run->result.eq21_friction / (eps_of(run) * eps_of(run))
                      : NAN)
REGULAR(spin, run->result.eq21_spin / (eps_of(run) * eps_of(run)))

fst_status fst_paper_draw_evolution(const fst_paper_state *paper, const fst_paper_figure *figure,
                                    const char *out, fst_error *error)
{
    static const struct {
        reading term;
        const char *title;
        fst_colour colour;
        fst_curve_style style;
    } terms[] = {
        {centrifugal, "centrifugal", FST_COLOUR_BLUE, FST_CURVE_LINE},
        {magnetic, "magnetic, exact", FST_COLOUR_VERMILION, FST_CURVE_LINE},
        {magnetic_printed, "magnetic, as printed (without n_r)", FST_COLOUR_VERMILION, FST_CURVE_DASHED},
        {friction, "friction", FST_COLOUR_GREEN, FST_CURVE_LINE},
        {spin, "the spin's part of friction", FST_COLOUR_PURPLE, FST_CURVE_DASHED},
    };
    curves all = {.status = FST_OK};
    for (size_t i = 0; i < sizeof terms / sizeof terms[0]; ++i)
        add(&all, paper, whole_range, figure->dynamics, omega_of, terms[i].term,
            (fst_chart_curve){.title = terms[i].title, .colour = terms[i].colour, .style = terms[i].style});
    const fst_chart_panel panel =
        panel_of("terms of the radial balance, over ε² (ℓγ²)", NAN, NAN, all.curve, all.count);
    char about[64];
    (void)snprintf(about, sizeof about, "dynamics %s", fst_dynamics_name(figure->dynamics));
    fst_chart chart = chart_of(figure->title, "drive ω (γ)", 0.15, 2.05, 330, &panel, 1);
    chart.about = about;
    return draw_and_free(&all, out, &chart, error);
}
