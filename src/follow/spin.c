/* spin.c - n, W and slip in each frame, from the rotations around it.
 *
 * Over eleven frames W and the velocity are polynomials of sixth order in time, fitted to the frame and its neighbours.  A
 * rotation counts by what its frame knows of it: a frame that shows but one dot knows nothing of the turning about it.
 * By how much all rotations are off such smooth paths, beyond what was expected, tells by how much their errors have
 * to be widened.  Of a motion that repeats itself (rhythm.c) frames that show no mark are known by those before and after.
 */
#include "follow/pose.h"
#include "follow/rhythm.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"
#include "base/order.h"
#include "base/turn.h"

enum {
    SIDE = (FST_TURNING_WINDOW - 1) / 2,
    WIDER = SIDE + 1,
    MOST = 2 * WIDER + 1,
    ORDERS = FST_TURNING_ORDER,
    UNKNOWN = 3 + 3 * ORDERS,
    SUBSTEPS = 4,
    REPEATS = 4,
    PLACES = ORDERS + 1
};

/* A rotation that is less sure than this (rad) has no number, and W has none that turns the bead by as much less surely in the
 * time of a frame. */
#define MOST_ERROR 0.15
/* Chi^2 of nine degrees of freedom exceeds this once in a thousand: a rotation in such a window is wrong. */
#define MOST_CHI2 27.9
/* So many frames in a row err alike. */
#define ALIKE 5.0
/* Where frames show few marks: in so many the bead swings once, and by so much errors may be wider than these say. */
#define FEWEST_FRAMES 15.0
#define MOST_WIDENED 4.0
/* The mean of chi^2 of 15 degrees of freedom, which the wider window leaves, over its median. */
#define MEDIAN_CHI 1.046

static const fst_turning nothing = {{NAN, NAN, NAN}, NAN, {NAN, NAN, NAN}, NAN, {NAN, NAN}, NAN};

/* A frame of a window, and what of its rotation the fit expects. */
typedef struct near_frame {
    const follow_turn *turn;
    double time; /* since the frame in the middle, in usual steps */
    double expected[3][3];
    double change[3][UNKNOWN]; /* of its rotation vector with the unknowns */
} near_frame;

/* A window around a frame; its polynomials have what the rhythm leaves. */
typedef struct window {
    const follow_rhythm *rhythm;
    double start, step; /* of the frame in the middle, and the usual one: s */
    near_frame frames[MOST];
    int count;
    double turn[3][3];       /* in the middle */
    double rates[ORDERS][3]; /* W and its derivatives, in rad and usual steps */
    double covariance[UNKNOWN * UNKNOWN];
    double chi2;
} window;

/* ------------------------------------------------------------------ the path of a rotation */

/* W at a time. */
static void rate_at(const window *w, double time, double rate[3])
{
    double factor = 1.0;
    follow_rhythm_rate(w->rhythm, w->start + w->step * time, rate);
    for (int i = 0; i < 3; ++i)
        rate[i] *= w->step;
    for (int order = 0; order < ORDERS; ++order) {
        for (int i = 0; i < 3; ++i)
            rate[i] += factor * w->rates[order][i];
        factor *= time / (order + 1);
    }
}

/* Go from the middle to the frames on one side of it.  A change of W at a time s turns all that follows by as much, seen
 * from the laboratory: R(t) R(s)^T, R being the turning since the middle. */
static void go(window *w, int middle, int way)
{
    double turn[3][3], since[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}},
                       sums[ORDERS][3][3] = {{{0.0}}};
    double time = 0.0;
    memcpy(turn, w->turn, sizeof turn);
    for (int at = middle; at >= 0 && at < w->count; at += way) {
        near_frame *f = &w->frames[at];
        const double step = (f->time - time) / SUBSTEPS;
        for (int k = 0; k < SUBSTEPS && at != middle; ++k) {
            double by[3], half[3];
            rate_at(w, time + 0.5 * step, by);
            for (int i = 0; i < 3; ++i) {
                by[i] *= step;
                half[i] = 0.5 * by[i];
            }
            fst_turn_by(turn, by);
            fst_turn_by(since, half);
            double factor = step;
            for (int order = 0; order < ORDERS; ++order) {
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        sums[order][i][j] += factor * since[j][i];
                factor *= (time + 0.5 * step) / (order + 1);
            }
            fst_turn_by(since, half);
            time += step;
        }
        memcpy(f->expected, turn, sizeof turn);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                f->change[i][j] = since[i][j];
                for (int order = 0; order < ORDERS; ++order)
                    f->change[i][3 + 3 * order + j] = since[i][0] * sums[order][0][j] +
                                                      since[i][1] * sums[order][1][j] +
                                                      since[i][2] * sums[order][2][j];
            }
    }
}

/* The normal equations of the window; returns chi^2. */
static double add_up(const window *w, double normal[UNKNOWN * UNKNOWN], double right[UNKNOWN])
{
    double chi2 = 0.0;
    memset(normal, 0, UNKNOWN * UNKNOWN * sizeof *normal);
    memset(right, 0, UNKNOWN * sizeof *right);
    for (int at = 0; at < w->count; ++at) {
        const near_frame *f = &w->frames[at];
        double off[3];
        fst_turn_between((const double(*)[3])f->expected, (const double(*)[3])f->turn->pose.turn, off);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const double known = f->turn->known[i][j];
                chi2 += off[i] * known * off[j];
                for (int p = 0; p < UNKNOWN; ++p) {
                    right[p] += f->change[i][p] * known * off[j];
                    for (int q = 0; q < UNKNOWN; ++q)
                        normal[UNKNOWN * p + q] += f->change[i][p] * known * f->change[j][q];
                }
            }
    }
    for (int p = 0; p < UNKNOWN; ++p) /* what nothing is known of stays where it is, with a large error */
        normal[(UNKNOWN + 1) * p] += 1e-3;
    return chi2;
}

/* The inverse of the normal matrix, column by column. */
static int invert(const double normal[UNKNOWN * UNKNOWN], double inverse[UNKNOWN * UNKNOWN])
{
    for (int p = 0; p < UNKNOWN; ++p) {
        double copy[UNKNOWN * UNKNOWN], column[UNKNOWN] = {0.0};
        memcpy(copy, normal, sizeof copy);
        column[p] = 1.0;
        if (!follow_solve(copy, column, UNKNOWN))
            return 0;
        memcpy(inverse + UNKNOWN * p, column, sizeof column);
    }
    return 1;
}

/* W to begin with: the polynomial that has, from each frame to the next, the mean that takes one rotation to the other.
 * Returns 0 where there is none. */
static int begin(window *w)
{
    double normal[ORDERS * ORDERS] = {0.0}, columns[3][ORDERS] = {{0.0}};
    for (int at = 1; at < w->count; ++at) {
        const near_frame *a = &w->frames[at - 1], *b = &w->frames[at];
        const double step = b->time - a->time;
        double by[3], terms[ORDERS], powers[2] = {1.0, 1.0};
        if (step > 1.5) /* it may have turned by more than half a turn */
            continue;
        fst_turn_between((const double(*)[3])a->turn->pose.turn, (const double(*)[3])b->turn->pose.turn, by);
        for (int i = 0; i < ORDERS; ++i) {
            powers[0] *= a->time / (i + 1);
            powers[1] *= b->time / (i + 1);
            terms[i] = powers[1] - powers[0];
        }
        for (int i = 0; i < ORDERS; ++i) {
            for (int k = 0; k < 3; ++k)
                columns[k][i] += terms[i] * by[k];
            for (int j = 0; j < ORDERS; ++j)
                normal[ORDERS * i + j] += terms[i] * terms[j] + (i == j ? 1e-9 : 0.0);
        }
    }
    for (int k = 0; k < 3; ++k) {
        double copy[ORDERS * ORDERS];
        memcpy(copy, normal, sizeof copy);
        if (!follow_solve(copy, columns[k], ORDERS))
            return 0;
        for (int i = 0; i < ORDERS; ++i)
            w->rates[i][k] = columns[k][i];
    }
    return 1;
}

/* Fit a window whose middle is its frame number `middle`.  Returns 0 where it has no solution. */
static int fit(window *w, int middle)
{
    double normal[UNKNOWN * UNKNOWN], right[UNKNOWN];
    memcpy(w->turn, w->frames[middle].turn->pose.turn, sizeof w->turn);
    if (w->rhythm->lines > 0)
        memset(w->rates, 0, sizeof w->rates);
    else if (!begin(w))
        return 0;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        go(w, middle, -1);
        go(w, middle, 1);
        w->chi2 = add_up(w, normal, right);
        if (repeat + 1 == REPEATS)
            return invert(normal, w->covariance);
        if (!follow_solve(normal, right, UNKNOWN))
            return 0;
        fst_turn_by(w->turn, right);
        for (int order = 0; order < ORDERS; ++order)
            for (int i = 0; i < 3; ++i)
                w->rates[order][i] += right[3 + 3 * order + i];
    }
    return 0;
}

/* ------------------------------------------------------------------ the velocity */

/* The velocity in the middle of a window (mm per usual step), and by which factor the error of a place is in it; `off`
 * gets the squares that are left, and their number. */
static int velocity(const window *w, double v[2], double *factor, double off[2])
{
    double normal[PLACES * PLACES] = {0.0}, columns[3][PLACES] = {{0.0}};
    double left_place[MOST][2], rhythm[2], slope[2];
    columns[2][1] = 1.0;
    for (int at = 0; at < w->count; ++at) {
        const double t = w->frames[at].time;
        follow_rhythm_place(w->rhythm, w->frames[at].turn->time, rhythm, slope);
        for (int k = 0; k < 2; ++k)
            left_place[at][k] = w->frames[at].turn->place[k] - rhythm[k];
        double terms[PLACES] = {1.0};
        for (int i = 1; i < PLACES; ++i)
            terms[i] = terms[i - 1] * t;
        for (int i = 0; i < PLACES; ++i) {
            for (int k = 0; k < 2; ++k)
                columns[k][i] += terms[i] * left_place[at][k];
            for (int j = 0; j < PLACES; ++j)
                normal[PLACES * i + j] += terms[i] * terms[j];
        }
    }
    for (int k = 0; k < 3; ++k) {
        double copy[PLACES * PLACES];
        memcpy(copy, normal, sizeof copy);
        if (!follow_solve(copy, columns[k], PLACES))
            return 0;
    }
    for (int at = 0; at < w->count; ++at)
        for (int k = 0; k < 2; ++k) {
            const double t = w->frames[at].time, *c = columns[k];
            double left = left_place[at][k], power = 1.0;
            for (int i = 0; i < PLACES; ++i, power *= t)
                left -= c[i] * power;
            off[0] += left * left;
        }
    off[1] += 2.0 * (w->count - PLACES);
    v[0] = columns[0][1];
    v[1] = columns[1][1];
    *factor = sqrt(columns[2][1]);
    return 1;
}

/* ------------------------------------------------------------------ all frames */

/* Collect the good frames around one.  Returns its number in the window, or -1 where there are too few of them. */
static int collect(const follow_turning *t, int i, int side, double usual, window *w)
{
    int middle = -1;
    w->count = 0;
    w->start = t->turns[i].time;
    w->step = usual;
    for (int k = i > side ? i - side : 0; k <= i + side && k < t->count; ++k) {
        const follow_turn *f = &t->turns[k];
        const double time = (f->time - t->turns[i].time) / usual;
        if (!f->good || fabs(time) > side + 0.5)
            continue;
        middle = k == i ? w->count : middle;
        w->frames[w->count++] = (near_frame){.turn = f, .time = time};
    }
    return w->count >= 2 * side && middle > 0 && middle + 1 < w->count ? middle : -1;
}

/* By how much rotations are off smooth ones, over what was expected, and the error of a place, mm.  These windows
 * are wider than those from which W follows: errors of neighbouring frames are alike, so a narrow window would not show
 * them, nor that W changes faster than its polynomial. */
static void scatter(const follow_turning *t, const follow_rhythm *rhythm, double usual, double *room,
                    double *widen, double *place)
{
    double off[2] = {0.0, 0.0}, unused[2] = {0.0, 0.0};
    int count = 0;
    for (int i = 0; i < t->count; ++i) {
        window w = {.rhythm = rhythm};
        double v[2], factor;
        if (collect(t, i, SIDE, usual, &w) >= 0)
            (void)velocity(&w, v, &factor, w.count > 2 * SIDE ? off : unused);
        const int middle = collect(t, i, WIDER, usual, &w);
        if (middle >= 0 && w.count == MOST && fit(&w, middle))
            room[count++] = w.chi2 / (3 * MOST - UNKNOWN);
    }
    *widen = fmax(1.0, sqrt(MEDIAN_CHI * fst_median(room, (size_t)count)));
    *place = sqrt(off[0] / fmax(1.0, off[1]));
}

static void drop_unsure(fst_turning *told)
{
    for (int i = 0; i < 3 && !(told->n_error < MOST_ERROR); ++i)
        told->n[i] = NAN;
    if (isnan(told->n[0]))
        told->n_error = NAN;
}

/* What a window tells of its frame. */
static void tell(const follow_turning *t, const follow_turn *f, const window *w, double usual, double widen,
                 double place, const double axis[3], fst_turning *told)
{
    double v[2], factor, off[2] = {0.0, 0.0}, rate = 0.0, flat = 0.0;
    const double *c = w->covariance;
    for (int i = 0; i < 3; ++i) {
        told->n[i] = fst_dot(f->pose.turn[i], axis, 3);
        rate += c[(UNKNOWN + 1) * (3 + i)] / 3.0;
        flat += i < 2 ? 0.5 * c[(UNKNOWN + 1) * (3 + i)] : 0.0;
    }
    /* By what the frame alone knows: its neighbours err alike, so that their mean is no better. */
    told->n_error = widen * follow_unsure(f->known, told->n);
    drop_unsure(told);
    if (!(widen * sqrt(rate) < MOST_ERROR))
        return;
    for (int i = 0; i < 3; ++i)
        told->w[i] = w->rates[0][i] / usual;
    told->w_error = widen * sqrt(rate) / usual;
    if (!velocity(w, v, &factor, off))
        return;
    told->slip[0] = v[0] / usual - t->millimetres * told->w[1]; /* W x e = (W_y, -W_x, 0) */
    told->slip[1] = v[1] / usual + t->millimetres * told->w[0];
    told->slip_error = hypot(factor * place, t->millimetres * widen * sqrt(flat)) / usual;
}

/* What all windows tell, beyond a rhythm; the error of W is INFINITY where the rotation is wrong.  Returns by how much
 * errors are wider than frames alone say. */
static double tell_all(const follow_turning *t, const follow_rhythm *rhythm, double usual, const double axis[3],
                       double *room, fst_turning *told)
{
    double widen, place;
    scatter(t, rhythm, usual, room, &widen, &place);
    for (int i = 0; i < t->count; ++i) {
        window w = {.rhythm = rhythm};
        const int middle = collect(t, i, SIDE, usual, &w);
        told[i] = nothing;
        if (middle < 0 || !fit(&w, middle))
            continue;
        if (w.chi2 < MOST_CHI2 * widen * widen)
            tell(t, &t->turns[i], &w, usual, widen, place, axis, &told[i]);
        else
            told[i].w_error = INFINITY;
    }
    return widen;
}

/* The roots of the mean squares of W, the slip and the error of the slip. */
typedef struct sizes {
    double w, slip, slip_error;
} sizes;

static sizes sizes_of(const fst_turning *told, int count)
{
    sizes s = {0.0, 0.0, 0.0};
    double known = 0.0;
    for (int i = 0; i < count; ++i)
        if (isfinite(told[i].slip_error)) {
            s.w += fst_dot(told[i].w, told[i].w, 3) / 3.0;
            s.slip += fst_dot(told[i].slip, told[i].slip, 2) / 2.0;
            s.slip_error += told[i].slip_error * told[i].slip_error;
            known += 1.0;
        }
    return (sizes){sqrt(s.w / known), sqrt(s.slip / known), sqrt(s.slip_error / known)};
}

/* What is known of a rotation a turn later, `unsure` (rad^2) being what each component of the turn adds: (A^-1 + q)^-1. */
static void carry(const double known[3][3], const double from[3][3], const double to[3][3], double unsure,
                  double later[3][3])
{
    double turn[3][3], turned[3][3], a[3][3], sure[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            turn[i][j] = fst_dot(to[i], from[j], 3);
            sure[i][j] = i == j ? 1.0 / fmax(unsure, 1e-30) : 0.0;
        }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            turned[i][j] = fst_dot(turn[i], known[j], 3);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            a[i][j] = fst_dot(turned[i], turn[j], 3);
    if (!follow_known_together((const double(*)[3])a, (const double(*)[3])sure, later))
        memset(later, 0, 9 * sizeof later[0][0]);
}

/* What all frames know of each rotation, where what repeats itself tells the turning between them: `sure` gets it. */
static void know(const follow_turning *t, double widen, double unsure, double (*sure)[3][3])
{
    const double part = 1.0 / (ALIKE * widen * widen);
    for (int way = 1; way >= -1; way -= 2) {
        double others[3][3] = {{0.0}}, all[3][3];
        for (int k = 0; k < t->count; ++k) {
            const int i = way > 0 ? k : t->count - 1 - k;
            const follow_turn *f = &t->turns[i];
            for (int j = 0; j < 9; ++j) {
                const double own = f->good ? part * f->known[j / 3][j % 3] : 0.0;
                all[j / 3][j % 3] = own + others[j / 3][j % 3];
                sure[i][j / 3][j % 3] =
                    way > 0 ? all[j / 3][j % 3] : sure[i][j / 3][j % 3] + others[j / 3][j % 3];
            }
            if (k + 1 < t->count)
                carry((const double(*)[3])all, f->pose.turn, f[way].pose.turn, ALIKE * unsure * unsure, others);
        }
    }
}

/* Where less is left of a motion that repeats itself than windows err by, the rhythm tells W and slip, also in frames that
 * show no marks.  What is left is their error: chance, or by how much the motion does not repeat itself.  Returns whether
 * it was so. */
static int keep_rhythm(const follow_turning *t, const follow_rhythm *rhythm, double usual, double widen,
                       const double axis[3], const fst_turning *left, double (*sure)[3][3], fst_turning *told)
{
    const sizes beyond = sizes_of(left, t->count), plain = sizes_of(told, t->count);
    if (!(beyond.slip < plain.slip_error))
        return 0;
    const double w_error = hypot(beyond.w, rhythm->missing / t->millimetres);
    know(t, widen * fmax(1.0, beyond.slip / beyond.slip_error), usual * w_error, sure);
    for (int i = 0; i < t->count; ++i) {
        const double time = t->turns[i].time;
        double place[2], v[2], *w = told[i].w;
        told[i] = nothing;
        if (isinf(left[i].w_error) || !t->turns[i].good)
            continue;
        for (int k = 0; k < 3; ++k)
            told[i].n[k] = fst_dot(t->turns[i].pose.turn[k], axis, 3);
        told[i].n_error = follow_unsure((const double(*)[3])sure[i], told[i].n);
        drop_unsure(&told[i]);
        follow_rhythm_rate(rhythm, time, w);
        follow_rhythm_place(rhythm, time, place, v);
        told[i].slip[0] = v[0] - t->millimetres * w[1];
        told[i].slip[1] = v[1] + t->millimetres * w[0];
        told[i].w_error = w_error;
        told[i].slip_error = hypot(beyond.slip, rhythm->missing);
    }
    return 1;
}

/* Frames that show few marks hardly test the rhythm that they follow: it must be slow enough to be known, and the film show
 * all sides of the bead.  Rotations of these, and of a bead of which not all is seen, must be nearly as sure as they say. */
static int is_tested(const follow_turning *t, const follow_rhythm *rhythm, int kept, double usual, double widen,
                     const double axis[3])
{
    const int all_sides = isfinite(axis[0]), slow = fabs(rhythm->rates[1]) * usual < FST_TWO_PI / FEWEST_FRAMES;
    return (widen < MOST_WIDENED || (all_sides && !t->few)) && (!t->few || (kept > 0 && slow && all_sides));
}

fst_status follow_spin(const follow_turning *turning, fst_track *track, fst_error *error)
{
    const size_t count = (size_t)turning->count;
    double axis[3], *room = malloc((count + 1) * sizeof *room);
    fst_turning *told = malloc((2 * count + 1) * sizeof *told);
    double(*sure)[3][3] = malloc((count + 1) * sizeof *sure);
    fst_status status = room && told && sure
                            ? fst_track_add_turning(track, error)
                            : fst_fail(error, FST_NO_MEMORY, "track", "no memory for the turning of a bead");
    if (status == FST_OK && turning->count > 1) {
        const double usual = follow_usual_step(turning, room);
        follow_rhythm rhythm = {.lines = 0};
        if (!follow_sphere_axis(&turning->sphere, axis))
            axis[0] = axis[1] = axis[2] = NAN;
        double widen = tell_all(turning, &rhythm, usual, axis, room, told);
        follow_rhythm_find(turning, usual, &rhythm);
        if (rhythm.lines > 0) {
            widen = tell_all(turning, &rhythm, usual, axis, room, told + count);
            if (keep_rhythm(turning, &rhythm, usual, widen, axis, told + count, sure, told))
                track->rhythm = rhythm.lines;
        }
        const int refused = !is_tested(turning, &rhythm, track->rhythm, usual, widen, axis);
        track->rhythm = refused ? 0 : track->rhythm;
        for (size_t i = 0; i < count; ++i)
            track->turning[turning->turns[i].frame] = refused || isinf(told[i].w_error) ? nothing : told[i];
    }
    free(sure);
    free(told);
    free(room);
    return status;
}
