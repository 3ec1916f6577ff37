/* waves.c - a bead that rolls in a field that travels along a line: where it is locked, lost and caught again.
 *
 * Its lag is a pendulum (docs/fields.md), and its lock against the wave is the paper's free rolling, alpha' = -eps w/(r - eps),
 * with k = 1/r.  The wave is as long as the circle at 10.7 Hz, so weak that the bead's weight keeps it down, and the plate
 * hardly lets the bead slip; a drag, without which no lock is ever lost, is chosen that leaves room for both ways.
 */
#include "paper/waves.h"
#include "paper/chart_parts.h"
#include "paper/figures.h"
#include "paper/report_parts.h"
#include "paper/work.h"

#include "base/constants.h"
#include "base/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double RADIUS = 2.5e-3, MASS = 0.5e-3, REMANENCE = 1.2, AMPLITUDE = 5e-5, DRAG = 12.0, BETA = 0.4,
                    LENGTH = 0.11127, SECONDS = 10.0, LEAST = 2.0, GREATEST = 12.0, SHARED_DRIVE = 5.0;
const double fst_wave_ratios[FST_WAVE_RATIOS] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
const char *const fst_wave_names[FST_WAVE_NUMBERS] = {"lost", "caught", "kept", "wins"};

/* ------------------------------------------------------------------ formulas */

static double k_radius(void)
{
    return 2.0 * FST_PI * RADIUS / LENGTH;
}

/* The rate of small swings about the field of one side, 1/s, of a bead that does not move along: it is less by
 * 1 - k eps in that from below and more by 1 + k eps in that from above. */
static double swing(void)
{
    const double moment = REMANENCE / FST_MU_0 * 4.0 / 3.0 * FST_PI * RADIUS * RADIUS * RADIUS;
    return sqrt(moment * AMPLITUDE / (MASS * RADIUS * RADIUS * (1.0 + BETA)));
}

double fst_wave_formula(fst_wave_number number)
{
    const double k = k_radius(), below = swing() * (1.0 - k), damping = DRAG / (1.0 + BETA),
                 turn = 2.0 * FST_PI;
    return number == FST_WAVE_LOST     ? below * below / damping / turn
           : number == FST_WAVE_CAUGHT ? 4.0 / FST_PI * below / turn
           : number == FST_WAVE_KEPT   ? (1.0 - k * k) * 2.0 * swing() / turn
                                       : pow((1.0 - k) / (1.0 + k), 2.0);
}

/* The bead's velocity in the lock against the wave (side = 1), or with it (-1), mm/s. */
static double lock_of(double hertz, int side)
{
    return -side * 2e3 * FST_PI * hertz * RADIUS / (1.0 - side * k_radius());
}

double fst_wave_found(const fst_paper_waves *w, fst_wave_number number)
{
    const fst_wave_way way = number == FST_WAVE_LOST     ? FST_WAVE_UP
                             : number == FST_WAVE_CAUGHT ? FST_WAVE_DOWN
                                                         : FST_WAVE_FORWARD;
    if (number == FST_WAVE_WINS) {
        for (int i = 1; i < FST_WAVE_RATIOS; ++i)
            if (w->share[i - 1] < 0.5 && w->share[i] >= 0.5)
                return fst_wave_ratios[i - 1] + (fst_wave_ratios[i] - fst_wave_ratios[i - 1]) *
                                                    (0.5 - w->share[i - 1]) / (w->share[i] - w->share[i - 1]);
        return NAN;
    }
    const fst_regime word = way == FST_WAVE_FORWARD ? FST_REGIME_FORWARD : FST_REGIME_BACKWARD;
    const int step = way == FST_WAVE_FORWARD ? 1 : -1; /* locked on the side to which this leads */
    for (int i = step > 0 ? 1 : w->drives - 2; i > 0 && i < w->drives - 1; i += step)
        if (w->regime[way][i] == word && w->regime[way][i - step] != word)
            return 0.5 * (w->hertz[i] + w->hertz[i - step]);
    return NAN;
}

/* ------------------------------------------------------------------ runs */

static fst_status set_wave(fst_params *params, double hertz, double ratio, double angle, double rate,
                           fst_error *error)
{
    *params = fst_default_params();
    const fst_status status = fst_paper_set(
        params, error,
        "magnet.shape=parts drive.waveform=wave wave.length=%.10g wave.amplitude=%.10g wave.ratio=%.10g "
        "drive.frequency=%.10g bead.radius=%.10g bead.mass=%.10g bead.remanence=%.10g medium.drag_rate=%.10g "
        "friction.gamma=3000 plate.radius=500 run.rtol=1e-8 run.periods=%.10g run.discard=%.10g",
        LENGTH, AMPLITUDE, ratio, hertz, RADIUS, MASS, REMANENCE, DRAG, SECONDS * hertz, 0.5 * SECONDS * hertz);
    return status != FST_OK
               ? status
               : fst_paper_set(
                     params, error,
                     "start.spin=rest start.position[0]=0 start.position[1]=0 start.position[2]=%.10g "
                     "start.velocity[0]=%.10g start.angular_velocity[1]=%.10g start.n[0]=%.10g start.n[1]=0 "
                     "start.n[2]=%.10g",
                     RADIUS, rate * RADIUS, rate, cos(angle), -sin(angle));
}

/* One way through the drives. */
static fst_status follow(fst_paper_state *paper, fst_wave_way way, fst_error *error)
{
    fst_paper_waves *w = paper->waves;
    fst_beads_options options = fst_default_beads_options();
    fst_status status = FST_OK;
    double state[FST_BEAD_NUMBERS];
    options.progress = &paper->until_refused;
    for (int k = 0; k < w->drives && status == FST_OK; ++k) {
        const int i = way == FST_WAVE_UP ? k : w->drives - 1 - k;
        const double rate = way == FST_WAVE_FORWARD ? lock_of(w->hertz[i], -1) / (1e3 * RADIUS) : 0.0;
        fst_params params;
        fst_world_result result;
        status = set_wave(&params, w->hertz[i], way == FST_WAVE_FORWARD ? 1.0 : 0.0, 0.0, rate, error);
        if (status == FST_OK)
            status = fst_world_run(&params, &options, &result, error);
        if (status != FST_OK)
            return status;
        w->velocity[way][i] = 1e3 * result.mean_velocity * params.magnet_half_length * params.friction_gamma;
        w->regime[way][i] = result.run.regime;
        memcpy(state, result.final_state, sizeof state);
        state[0] =
            remainder(state[0], LENGTH / params.magnet_half_length); /* nothing changes by a whole wave */
        options.state = state;
    }
    return status;
}

/* Beads let go at rest, their moments all round. */
static fst_status share_out(fst_paper_state *paper, int ratio, fst_error *error)
{
    fst_beads_options options = fst_default_beads_options();
    options.progress = &paper->until_refused;
    int with = 0;
    for (int i = 0; i < FST_WAVE_STARTS; ++i) {
        fst_params params;
        fst_world_result result;
        fst_status status = set_wave(&params, SHARED_DRIVE, fst_wave_ratios[ratio],
                                     2.0 * FST_PI * (i + 0.13) / FST_WAVE_STARTS, 0.0, error);
        if (status == FST_OK)
            status = fst_world_run(&params, &options, &result, error);
        if (status != FST_OK)
            return status;
        with += result.run.regime == FST_REGIME_FORWARD;
    }
    paper->waves->share[ratio] = (double)with / FST_WAVE_STARTS;
    return FST_OK;
}

static fst_status wave_piece(fst_paper_state *paper, int index, fst_error *error)
{
    return index < FST_WAVE_WAYS ? follow(paper, (fst_wave_way)index, error)
                                 : share_out(paper, index - FST_WAVE_WAYS, error);
}

fst_status fst_paper_make_waves(fst_paper_state *paper, fst_error *error)
{
    const int reduced = paper->options->reduced;
    const fst_paper_pieces part = {
        "a travelling field", 0.995,     0.997, FST_WAVE_WAYS + (reduced ? 0 : FST_WAVE_RATIOS),
        FST_PAPER_STEP_WAVES, wave_piece};
    fst_paper_waves *w = paper->waves = calloc(1, sizeof *w);
    if (!w)
        return fst_fail(error, FST_NO_MEMORY, "paper", "no memory for the travelling field");
    w->drives = reduced ? 11 : FST_WAVE_DRIVES;
    for (int i = 0; i < w->drives; ++i)
        w->hertz[i] = round(10.0 * (LEAST + (GREATEST - LEAST) * i / (w->drives - 1))) / 10.0;
    for (int i = 0; i < FST_WAVE_RATIOS; ++i)
        w->share[i] = NAN;
    return fst_paper_do(paper, &part, error);
}

/* ------------------------------------------------------------------ figure and chapter */

fst_status fst_paper_draw_waves(const fst_paper_state *paper, const fst_paper_figure *figure, const char *out,
                                fst_error *error)
{
    const fst_paper_waves *w = paper->waves;
    const size_t count = (size_t)w->drives;
    const double ends[2] = {LEAST, GREATEST}, against[2] = {lock_of(LEAST, 1), lock_of(GREATEST, 1)},
                 with[2] = {lock_of(LEAST, -1), lock_of(GREATEST, -1)};
    const fst_chart_curve curves[] = {
        curve_of("drive raised", w->hertz, w->velocity[FST_WAVE_UP], count, FST_COLOUR_BLUE,
                 FST_CURVE_LINE_POINTS),
        curve_of("lowered", w->hertz, w->velocity[FST_WAVE_DOWN], count, FST_COLOUR_VERMILION,
                 FST_CURVE_LINE_POINTS),
        curve_of("as much field from above, lowered", w->hertz, w->velocity[FST_WAVE_FORWARD], count,
                 FST_COLOUR_GREEN, FST_CURVE_LINE_POINTS),
        curve_of("free rolling, −εω/(1 − kε)", ends, against, 2, FST_COLOUR_BLACK, FST_CURVE_DASHED),
        curve_of("εω/(1 + kε)", ends, with, 2, FST_COLOUR_GREY, FST_CURVE_DASHED)};
    const fst_chart_panel panels[] = {panel_of("mean velocity (mm/s)", -220.0, 220.0, LISTED(curves))};
    const fst_chart_mark marks[] = {{fst_wave_formula(FST_WAVE_CAUGHT), "(4/π) Ω"},
                                    {fst_wave_formula(FST_WAVE_LOST), "Ω²/C"}};
    fst_chart chart =
        chart_of(figure->title, "frequency of the field (Hz)", LEAST, GREATEST, 300, LISTED(panels));
    chart_marks(&chart, LISTED(marks));
    return fst_figure_chart(out, &chart, error);
}

void fst_report_waves(FILE *out, const fst_paper_state *paper)
{
    static const char *const rows[FST_WAVE_NUMBERS] = {
        "drive raised: the lock against the field is lost at, Hz</td><td>Ω²/C",
        "drive lowered: it is caught again at, Hz</td><td>(4/π) Ω",
        "as much field from above, drive lowered: the lock with the field is lost at, Hz</td><td>"
        "overlap of the two locks (Chirikov), an upper bound",
        "share of the field from above with which half of the beads let go at rest go with it</td><td>a guess, "
        "that the faster swing wins: ((1 − kε)/(1 + kε))²"};
    if (!paper->waves || !paper->done[FST_PAPER_STEP_WAVES])
        return;
    fputs("<h2 id=\"waves\">A travelling field</h2>\n<p>Unrolled, the turning field is one that travels along "
          "a line. The "
          "part of it that an array of magnets under the plate makes turns so that the bead rolls "
          "<em>against</em> it, and "
          "the paper’s free rolling, α′ = −εω/(r − ε), is this lock with k = 1/r: U = −εω/(1 − kε). Its lag is "
          "a pendulum, "
          "which swings at Ω and is damped at the rate C = c/(1 + β) of a drag c: the lock is lost late and "
          "caught early. "
          "The part of an array above turns the other way and drives the bead along, U = εω/(1 + "
          "kε).</p>\n<table><thead>"
          "<tr><th></th><th>formula</th><th>value</th><th>found</th></tr></thead><tbody>\n",
          out);
    for (int i = 0; i < FST_WAVE_NUMBERS; ++i) {
        const double found = fst_wave_found(paper->waves, (fst_wave_number)i);
        fprintf(out, "<tr><td>%s</td><td class=\"n\">%.2f</td><td class=\"n\">", rows[i],
                fst_wave_formula((fst_wave_number)i));
        fprintf(out, isfinite(found) ? "%.2f</td></tr>\n" : "—</td></tr>\n", found);
    }
    fputs("</tbody></table>\n<p class=\"fine\">A wave of 111.27 mm, as long as the circle of r = 17.7 mm, and "
          "0.05 mT, under "
          "the paper’s bead of 0.5 g and 1.2 T, dragged at 12 1/s: docs/fields.md.</p>\n",
          out);
    fst_report_code(
        out, "festoon sweep wave.yaml --set wave.length=111.27mm --set wave.amplitude=0.05mT --set "
             "medium.drag_rate=12 --set friction.gamma=3000 --set plate.radius=500m --set run.duration=10s "
             "--over drive.frequency=2Hz:12Hz:51 --carry up -o up.db");
}
