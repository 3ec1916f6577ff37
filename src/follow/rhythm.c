/* rhythm.c - what of a filmed bead's motion repeats itself: two rates by its places, and W by its rotations, or by its
 * faces before these are known.
 *
 * A window of eleven frames flattens what changes within five.  What repeats itself is known better than any window
 * would have it, because the whole film shows it, so the window is left with the rest.
 */
#include "follow/rhythm.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/order.h"
#include "base/turn.h"
#include "follow/pose.h"

enum {
    UNKNOWNS = FOLLOW_WAVES,
    SUBSTEPS = 4,
    REPEATS = 4,
    MOST_REPEATS = 10,
    FIRST_LINES = 2,
    FIRST_FRAMES = 600,
    GRID = 4,
    FACE_LINES = 4,
    FACE_REPEATS = 10
};

#define MOST_APART 3e-3   /* of the squares of places, where these repeat themselves */
#define LEAST_TURNS 2.0   /* of the bead around the centre */
#define LEAST_FACING 0.45 /* cosine of the angle at which a face shows a mark well */
#define OUTLIER 1.0       /* the square of the marks' contrast */
#define RIDGE 0.1         /* of a face's knowledge of W: lest what no face tells be anything */
#define FASTEST 0.85 /* of the rate of the frames: the turning from one to the next still shows this rate */

/* Least squares with up to UNKNOWNS unknowns. */
typedef struct equations {
    int count;
    double normal[UNKNOWNS * UNKNOWNS], right[UNKNOWNS];
    double left; /* chi^2 of each number */
} equations;

static void add(equations *e, const double *row, double off, double weight)
{
    for (int p = 0; p < e->count; ++p) {
        e->right[p] += weight * row[p] * off;
        for (int q = 0; q < e->count; ++q)
            e->normal[p * e->count + q] += weight * row[p] * row[q];
    }
}

/* The arrow of number k, which turns at w_b + (k - lines) w_r. */
static double arrow(const follow_rhythm *r, int k, double time, double at[2])
{
    const double rate = r->rates[0] + (k - r->lines) * r->rates[1], angle = rate * (time - r->start);
    at[0] = cos(angle);
    at[1] = sin(angle);
    return rate;
}

double follow_usual_step(const follow_turning *t, double *room)
{
    for (int i = 0; i + 1 < t->count; ++i)
        room[i] = t->turns[i + 1].time - t->turns[i].time;
    return fst_median(room, (size_t)(t->count - 1));
}

/* ------------------------------------------------------------------ places */

void follow_rhythm_place(const follow_rhythm *r, double time, double place[2], double velocity[2])
{
    place[0] = place[1] = velocity[0] = velocity[1] = 0.0;
    for (int k = 0; k <= 2 * r->lines && r->lines > 0; ++k) {
        const double *c = r->place + 2 * k;
        double a[2];
        const double rate = arrow(r, k, time, a), x = c[0] * a[0] - c[1] * a[1], y = c[0] * a[1] + c[1] * a[0];
        place[0] += x;
        place[1] += y;
        velocity[0] -= rate * y;
        velocity[1] += rate * x;
    }
}

/* Fit arrows, the centre and, by the arrows there are, changes of the rates and of how the shutter rolls to the first
 * frames.  Returns the square that is left of the places before the changes. */
static double fit_places(const follow_turning *t, int frames, follow_rhythm *r, int rates)
{
    const int arrows = 2 * (2 * r->lines + 1);
    equations e = {.count = arrows + 2 + (rates ? 4 : 0)};
    double squares = 0.0;
    for (int i = 0; i < frames; ++i) {
        const follow_turn *f = &t->turns[i];
        const double time = f->time + (rates ? fst_dot(r->later, f->place, 2) : 0.0);
        double rows[2][UNKNOWNS] = {{0.0}, {0.0}}, unused[2], v[2] = {0.0, 0.0};
        squares += fst_dot(f->place, f->place, 2);
        for (int k = 0; k <= 2 * r->lines; ++k) {
            const double *c = r->place + 2 * k;
            double a[2];
            (void)arrow(r, k, time, a);
            rows[0][2 * k] = rows[1][2 * k + 1] = a[0];
            rows[0][2 * k + 1] = -a[1];
            rows[1][2 * k] = a[1];
            for (int which = 0; which < 2 && rates; ++which) {
                const double by = (time - r->start) * (which ? k - r->lines : 1);
                rows[0][arrows + 2 + which] -= by * (c[0] * a[1] + c[1] * a[0]);
                rows[1][arrows + 2 + which] += by * (c[0] * a[0] - c[1] * a[1]);
            }
        }
        if (rates)
            follow_rhythm_place(r, time, unused, v);
        for (int axis = 0; axis < 2; ++axis) {
            rows[axis][arrows + axis] = 1.0;
            for (int which = 0; which < 2 && rates; ++which)
                rows[axis][arrows + 4 + which] = v[axis] * f->place[which];
            add(&e, rows[axis], f->place[axis], 1.0);
        }
    }
    double found[UNKNOWNS];
    memcpy(found, e.right, sizeof found);
    if (!follow_solve(e.normal, found, e.count))
        return INFINITY;
    memcpy(r->place, found, (size_t)(arrows + 2) * sizeof *found);
    for (int which = 0; which < 2 && rates; ++which) {
        r->rates[which] += found[arrows + 2 + which];
        r->later[which] += found[arrows + 4 + which];
    }
    return squares - fst_dot(found, e.right, e.count);
}

/* The rate at which the bead goes round its centre.  Returns 0 where it hardly does. */
static int goes_round(const follow_turning *t, follow_rhythm *r)
{
    double middle[2] = {0.0, 0.0}, turned = 0.0, before = 0.0;
    for (int i = 0; i < t->count; ++i)
        for (int k = 0; k < 2; ++k)
            middle[k] += t->turns[i].place[k] / t->count;
    for (int i = 0; i < t->count; ++i) {
        const double *place = t->turns[i].place, angle = atan2(place[1] - middle[1], place[0] - middle[0]);
        turned += i > 0 ? remainder(angle - before, FST_TWO_PI) : 0.0;
        before = angle;
    }
    r->rates[0] = turned / (t->turns[t->count - 1].time - r->start);
    return fabs(turned) > LEAST_TURNS * FST_TWO_PI;
}

/* Both rates, first by the first frames: that of the distance is the one whose three arrows leave least of the places.
 * Returns the square that is left of them; INFINITY: they do not repeat themselves. */
static double find_rates(const follow_turning *t, follow_rhythm *r)
{
    int frames = t->count < FIRST_FRAMES ? t->count : FIRST_FRAMES;
    *r = (follow_rhythm){.start = t->turns[0].time};
    if (!goes_round(t, r))
        return INFINITY;
    const double span = t->turns[frames - 1].time - r->start;
    double least = INFINITY, rate = 0.0;
    r->lines = 1;
    for (int k = 2 * GRID; k < GRID * frames / 2; ++k) {
        r->rates[1] = FST_TWO_PI * k / (GRID * span);
        const double left = fit_places(t, frames, r, 0);
        if (left < least) {
            least = left;
            rate = r->rates[1];
        }
    }
    r->rates[1] = rate;
    for (int is_last = 0; !is_last; frames = 2 * frames < t->count ? 2 * frames : t->count) {
        is_last = frames == t->count;
        for (int repeat = 0; repeat < REPEATS; ++repeat) {
            r->lines = repeat == 0 ? 1 : FIRST_LINES;
            (void)fit_places(t, frames, r, 0);
            least = fit_places(t, frames, r, 1);
        }
    }
    return least;
}

void follow_rhythm_shutter(follow_turning *t, double usual)
{
    follow_rhythm r;
    double most = 0.0;
    const double left = find_rates(t, &r);
    for (int i = 0; i < t->count && isfinite(left); ++i)
        most = fmax(most, fabs(fst_dot(r.later, t->turns[i].place, 2)));
    if (!(left < MOST_APART * t->count * fst_dot(r.place, r.place, 2 * (2 * r.lines + 1))) ||
        most > 0.5 * usual) /* a shutter is done before the next frame */
        return;
    for (int i = 0; i < t->count; ++i)
        t->turns[i].time += fst_dot(r.later, t->turns[i].place, 2);
}

/* How many lines the turning from one frame to the next still shows. */
static int most_lines(const follow_rhythm *r, double usual, int most)
{
    const double fastest = FASTEST * FST_TWO_PI / usual - fabs(r->rates[0]);
    return (int)fmin(most, fastest / fabs(r->rates[1]));
}

/* ------------------------------------------------------------------ rotations */

/* W of each unknown at a time; returns how many there are. */
static int waves(const follow_rhythm *r, double time, double w[UNKNOWNS][3])
{
    int p = 0;
    for (int k = 0; k <= 2 * r->lines; ++k) {
        double a[2];
        (void)arrow(r, k, time, a);
        memcpy(w[p++], (double[3]){a[0], a[1], 0.0}, sizeof *w);
        memcpy(w[p++], (double[3]){-a[1], a[0], 0.0}, sizeof *w);
    }
    for (int j = 0; j <= r->lines; ++j) {
        const double angle = j * r->rates[1] * (time - r->start);
        memcpy(w[p++], (double[3]){0.0, 0.0, cos(angle)}, sizeof *w);
        if (j > 0)
            memcpy(w[p++], (double[3]){0.0, 0.0, sin(angle)}, sizeof *w);
    }
    return p;
}

void follow_rhythm_rate(const follow_rhythm *r, double time, double rate[3])
{
    double w[UNKNOWNS][3];
    const int count = r->lines > 0 ? waves(r, time, w) : 0;
    for (int i = 0; i < 3; ++i) {
        rate[i] = 0.0;
        for (int p = 0; p < count; ++p)
            rate[i] += r->rate[p] * w[p][i];
    }
}

/* The turning from one frame to the next by the waves, and how it changes with each of them. */
static void turning_of(const follow_rhythm *r, double from, double to, double turn[3][3],
                       double change[3][UNKNOWNS])
{
    const double step = (to - from) / SUBSTEPS;
    double sums[UNKNOWNS][3] = {{0.0}}, w[UNKNOWNS][3];
    int count = 0;
    memcpy(turn, (double[3][3]){{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, 9 * sizeof turn[0][0]);
    for (int k = 0; k < SUBSTEPS; ++k) {
        double half[3] = {0.0, 0.0, 0.0};
        count = waves(r, from + (k + 0.5) * step, w);
        for (int p = 0; p < count; ++p)
            for (int i = 0; i < 3; ++i)
                half[i] += 0.5 * step * r->rate[p] * w[p][i];
        fst_turn_by(turn, half);
        for (int p = 0; p < count; ++p) /* R(s)^T w, R being the turning since the first frame */
            for (int i = 0; i < 3; ++i)
                sums[p][i] += step * (turn[0][i] * w[p][0] + turn[1][i] * w[p][1] + turn[2][i] * w[p][2]);
        fst_turn_by(turn, half);
    }
    for (int p = 0; p < count; ++p)
        for (int i = 0; i < 3; ++i)
            change[i][p] = fst_dot(turn[i], sums[p], 3);
}

/* The same, and what is missing to the turning that was found. */
static void turning_between(const follow_rhythm *r, const follow_turn *a, const follow_turn *b, double off[3],
                            double change[3][UNKNOWNS])
{
    double by[3][3], turn[3][3];
    turning_of(r, a->time, b->time, by, change);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            turn[i][j] =
                by[i][0] * a->pose.turn[0][j] + by[i][1] * a->pose.turn[1][j] + by[i][2] * a->pose.turn[2][j];
    fst_turn_between((const double(*)[3])turn, b->pose.turn, off);
}

/* Add the normal equations of a turning, in terms of the waves. */
static void add_turning(equations *e, double change[3][UNKNOWNS], const double normal[3][3],
                        const double right[3])
{
    for (int k = 0; k < 3; ++k) {
        double row[UNKNOWNS];
        for (int p = 0; p < e->count; ++p) {
            row[p] = normal[k][0] * change[0][p] + normal[k][1] * change[1][p] + normal[k][2] * change[2][p];
            e->right[p] += change[k][p] * right[k];
        }
        for (int p = 0; p < e->count; ++p)
            for (int q = 0; q < e->count; ++q)
                e->normal[p * e->count + q] += change[k][p] * row[q];
    }
}

/* One step towards the waves that explain the rotations; `e` gets its equations.  Returns chi^2 before it, of `numbers` numbers. */
static double fit_rotations(const follow_turning *t, double usual, follow_rhythm *r, equations *e, int *numbers)
{
    double chi2 = 0.0;
    *e = (equations){.count = 3 * (2 * r->lines + 1)};
    *numbers = 0;
    for (int i = 0; i + 1 < t->count; ++i) {
        const follow_turn *a = &t->turns[i], *b = a + 1;
        double off[3], known_off[3], known[3][3], change[3][UNKNOWNS];
        if (!a->good || !b->good || b->time - a->time > 1.5 * usual ||
            !follow_known_together(a->known, b->known, known))
            continue;
        turning_between(r, a, b, off, change);
        for (int k = 0; k < 3; ++k)
            known_off[k] = fst_dot(known[k], off, 3);
        chi2 += fst_dot(off, known_off, 3);
        add_turning(e, change, (const double(*)[3])known, known_off);
        *numbers += 3;
    }
    double normal[UNKNOWNS * UNKNOWNS], more[UNKNOWNS];
    memcpy(normal, e->normal, sizeof normal);
    memcpy(more, e->right, sizeof more);
    if (!follow_solve(normal, more, e->count))
        return INFINITY;
    for (int p = 0; p < e->count; ++p)
        r->rate[p] += more[p];
    return chi2;
}

/* ------------------------------------------------------------------ faces */

/* The mark that a frame shows in a direction (in the laboratory), and how it changes with the direction.  0: none is seen
 * well there. */
static int mark_at(const follow_turning *t, const follow_turn *f, const double at[3], double *mark,
                   double slope[3])
{
    double across[3], node[2];
    for (int j = 0; j < 3; ++j)
        across[j] = f->view[0][j] * at[0] + f->view[1][j] * at[1] + f->view[2][j] * at[2];
    const double nearer = f->shrink * (1.0 - f->close * across[2]);
    if (across[2] < LEAST_FACING)
        return 0;
    for (int j = 0; j < 2; ++j)
        node[j] = FOLLOW_PER_RADIUS * (across[j] / nearer + f->shift[j]);
    const double x = floor(node[0]), y = floor(node[1]), p = node[0] - x, q = node[1] - y;
    double corner[2][2];
    for (int k = 0; k < 4; ++k) {
        const int point =
            follow_turning_point((x + (k & 1)) / FOLLOW_PER_RADIUS, (y + (k >> 1)) / FOLLOW_PER_RADIUS, t);
        if (point < 0 || !t->used[point] || !(t->even[point] > 0.0))
            return 0;
        corner[k >> 1][k & 1] = follow_seen(t, f, point) / t->even[point];
    }
    *mark = (1.0 - q) * ((1.0 - p) * corner[0][0] + p * corner[0][1]) +
            q * ((1.0 - p) * corner[1][0] + p * corner[1][1]);
    const double right = (1.0 - q) * (corner[0][1] - corner[0][0]) + q * (corner[1][1] - corner[1][0]),
                 up = (1.0 - p) * (corner[1][0] - corner[0][0]) + p * (corner[1][1] - corner[0][1]);
    for (int i = 0; i < 3; ++i)
        slope[i] = FOLLOW_PER_RADIUS / nearer * (right * f->view[i][0] + up * f->view[i][1]);
    return 1;
}

/* What two faces tell of the turning from one to the other, near the one that the waves have: its normal equations. */
static void compare(const follow_turning *t, const follow_turn *a, const follow_turn *b,
                    const double turn[3][3], double normal[3][3], double right[3])
{
    for (int k = 0; k < t->points; ++k) {
        double before[3], mark, slope[3], row[3];
        if (!t->used[k] || !(t->even[k] > 0.0))
            continue;
        follow_on_bead(turn, t->facing[k], before);
        if (!mark_at(t, a, before, &mark, slope))
            continue;
        const double off = follow_seen(t, b, k) / t->even[k] - mark, part = 1.0 / (1.0 + off * off / OUTLIER);
        double now[3];
        for (int i = 0; i < 3; ++i)
            now[i] = fst_dot(turn[i], slope, 3);
        for (int i = 0; i < 3; ++i)
            row[i] =
                now[(i + 1) % 3] * t->facing[k][(i + 2) % 3] - now[(i + 2) % 3] * t->facing[k][(i + 1) % 3];
        for (int i = 0; i < 3; ++i) {
            right[i] += part * part * row[i] * off;
            for (int j = 0; j < 3; ++j)
                normal[i][j] += part * part * row[i] * row[j];
        }
    }
}

/* One step towards the waves by which faces follow from each other.  Returns whether there is one. */
static int fit_faces(follow_turning *t, double usual, follow_rhythm *r, equations *e)
{
    *e = (equations){.count = 3 * (2 * r->lines + 1)};
    for (int i = 0; i + 1 < t->count; ++i) {
        const follow_turn *a = &t->turns[i], *b = a + 1;
        double turn[3][3], change[3][UNKNOWNS], normal[3][3] = {{0.0}}, right[3] = {0.0};
        if (b->time - a->time > 1.5 * usual)
            continue;
        turning_of(r, a->time, b->time, turn, change);
        follow_face(t, b);
        compare(t, a, b, (const double(*)[3])turn, normal, right);
        add_turning(e, change, (const double(*)[3])normal, right);
    }
    for (int p = 0; p < e->count; ++p)
        e->normal[(e->count + 1) * p] += RIDGE;
    if (!follow_solve(e->normal, e->right, e->count))
        return 0;
    for (int p = 0; p < e->count; ++p)
        r->rate[p] += e->right[p];
    return 1;
}

void follow_rhythm_turning(const follow_rhythm *r, double from, double to, double turn[3][3])
{
    double unused[3][UNKNOWNS];
    turning_of(r, from, to, turn, unused);
}

/* A line more on each side; what is new begins as rolling has it: W = e x v / R. */
static void widen(const follow_turning *t, follow_rhythm *r)
{
    double rate[UNKNOWNS], unused[2];
    const int had = 2 * (2 * r->lines + 1), has = had + 4;
    memcpy(rate, r->rate, sizeof rate);
    ++r->lines;
    (void)fit_places(t, t->count, r, 0);
    memset(r->rate, 0, sizeof r->rate);
    for (int k = 0; k < has; ++k)
        r->rate[k] = -arrow(r, k / 2, r->start, unused) * r->place[k] / t->millimetres;
    if (had > 2) {
        memcpy(r->rate + 2, rate, (size_t)had * sizeof *rate);
        memcpy(r->rate + has, rate + had, (size_t)(had / 2) * sizeof *rate);
    }
}

int follow_rhythm_begin(follow_turning *turning, double usual, follow_rhythm *rhythm)
{
    equations e;
    if (!isfinite(find_rates(turning, rhythm)))
        return 0;
    const int most = most_lines(rhythm, usual, FACE_LINES);
    rhythm->lines = 0;
    while (rhythm->lines < most) {
        widen(turning, rhythm);
        for (int repeat = 0; repeat < FACE_REPEATS; ++repeat)
            if (!fit_faces(turning, usual, rhythm, &e))
                return 0;
    }
    return most > 0;
}

/* So many lines.  Returns Schwarz's criterion, by which each number of the rhythm has to earn its place. */
static double try_lines(const follow_turning *t, double usual, follow_rhythm *r, equations *e)
{
    const double unknown = 3 * (2 * r->lines + 1);
    double chi2 = INFINITY, before = INFINITY;
    int numbers = 1;
    (void)fit_places(t, t->count, r, 0);
    memset(r->rate, 0, sizeof r->rate);
    for (int repeat = 0; repeat < MOST_REPEATS && (repeat < REPEATS || chi2 < (1.0 - 1e-6) * before);
         ++repeat) {
        before = chi2;
        chi2 = fit_rotations(t, usual, r, e, &numbers);
    }
    e->left = chi2 / numbers;
    return numbers > unknown ? numbers * log(chi2 / numbers) + unknown * log(numbers) : INFINITY;
}

/* What a component of the slip has beyond so many lines (mm/s), by as many as frames show, `all`, and the equations of these.
 * What chance makes of a line does not count.  Forces are finite, so V does not leap, but its slope does where dry slip
 * begins or ends.  The lines of such a V fall as 1/k^2: the squares beyond the last are to those of the upper half as sums
 * of 1/k^4. */
static double missing(double radius, const follow_rhythm *all, const equations *e, int lines)
{
    const int half = all->lines / 2;
    const double share = 1.0 / (pow((all->lines + 0.5) / (half + 0.5), 3.0) - 1.0);
    double left = 0.0, upper = 0.0;
    for (int p = 0; p < 2 * (2 * all->lines + 1); ++p) {
        const int k = abs(p / 2 - all->lines);
        double normal[UNKNOWNS * UNKNOWNS], column[UNKNOWNS] = {0.0}, unused[2];
        const double slip = arrow(all, p / 2, all->start, unused) * all->place[p] + radius * all->rate[p];
        memcpy(normal, e->normal, sizeof normal);
        column[p] = 1.0;
        if (k <= (lines < half ? lines : half) || !follow_solve(normal, column, e->count))
            continue;
        const double square = 0.5 * (slip * slip - radius * radius * e->left * column[p]);
        left += k > lines ? square : 0.0;
        upper += k > half ? square : 0.0;
    }
    return sqrt(fmax(0.0, left) + share * fmax(0.0, upper));
}

void follow_rhythm_find(const follow_turning *turning, double usual, follow_rhythm *rhythm)
{
    follow_rhythm tried;
    double least = INFINITY;
    *rhythm = (follow_rhythm){.lines = 0};
    if (!isfinite(find_rates(turning, &tried)))
        return;
    const int most = most_lines(&tried, usual, FOLLOW_LINES);
    equations e;
    for (int lines = 0; lines <= most; ++lines) {
        tried.lines = lines;
        const double criterion = try_lines(turning, usual, &tried, &e);
        if (criterion < least) {
            least = criterion;
            *rhythm = tried;
        }
    }
    if (most > 0)
        rhythm->missing = missing(turning->millimetres, &tried, &e, rhythm->lines);
}
