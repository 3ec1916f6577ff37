/* beads.c - several beads from frame to frame, each under its name.
 *
 *   spots of the frame --> split.c --> places --> the assignment of places to beads that fits best
 *                                                  where each should be --'     `--> is another one possible too?
 *
 * A bead should be where it would get at its last velocity, by a straight line.  Of all assignments of places to beads, or
 * to none, that one is taken whose sum of squared misses is least.
 *
 * Then comes the question whether another assignment is possible too.  A bead can be at a place that it misses by no more
 * than noise, the greatest acceleration of late, and, where beads have come close to each other, an impact can explain.  If
 * there is another assignment under which each bead can be at its place, then from this frame on the names of these beads
 * may be exchanged.  This is told once, and again after a frame in which they were certain.
 *
 * A place that a lost bead can be at too has no name: both are lost, until both are seen.  So it is where one hides another.
 */
#include "follow/beads.h"

#include <math.h>
#include <string.h>

#define LEAST_AREA 0.55 /* of a bead's: a spot with less is cut off, or something else */
#define MOST_AREA 1.4   /* of one bead */
#define FAR 3.0         /* a place so many times as far as the bead may be is not the bead's */
#define FORGET 8.0      /* lost for so many frames, a bead may be anywhere */
#define GONE 100.0      /* and here it is not behind another one any more */

/* What a bead may miss the straight line by: */
#define NOISE 0.5      /* of a place, pixels */
#define LEAST_BEND 0.1 /* parts of its diameter in a frame, besides */
#define SAFETY 1.5     /* times the greatest acceleration of late */
#define FADES 0.98     /* of which a frame leaves so much */
#define NEAR 1.3       /* diameters between the centres of beads that may hit each other */
#define BOUNCE 1.5     /* of the closing speed, which an impact may give to the lighter bead */
#define AS_BAD 2.0     /* times as far as the taken place is another one not to be excluded */

enum { MOST_PLACES = 12, NOWHERE = -1 };

/* A frame being looked at: places where beads may be, where they should be, and who is where. */
typedef struct sight {
    const follow_beads *f;
    double time;
    follow_place places[MOST_PLACES];
    double strange[MOST_PLACES]; /* by their areas */
    int count;
    double expected[FST_TRACKED_BEADS][2], reach[FST_TRACKED_BEADS]; /* INFINITY: it may be anywhere */
    double bound[FST_TRACKED_BEADS], way[FST_TRACKED_BEADS]; /* how far off it can be, and can have come */
    int taken[FST_TRACKED_BEADS], tried[FST_TRACKED_BEADS];
    double best;
    unsigned doubt;
} sight;

fst_status follow_beads_begin(follow_beads *follower, follow_blobs *blobs, const follow_look *look, int count,
                              fst_error *error)
{
    *follower = (follow_beads){.count = count};
    return follow_bead_begin(&follower->film, blobs, look, error);
}

void follow_beads_end(follow_beads *follower)
{
    follow_bead_end(&follower->film);
}

/* ------------------------------------------------------------------ places */

/* Add a place; where there are too many, that of the strangest area gives way. */
static void add_place(sight *s, const follow_cover *cover, double diameter)
{
    const double strange = 2.0 * fabs(log(cover->area / s->f->film.look->area));
    int at = 0;
    for (int i = 1; i < s->count; ++i)
        at = s->strange[i] > s->strange[at] ? i : at;
    if (s->count < MOST_PLACES)
        at = s->count++;
    else if (strange >= s->strange[at])
        return;
    s->places[at] = (follow_place){cover->column, cover->row, diameter, 0};
    s->strange[at] = strange;
}

static fst_status find_places(sight *s, const unsigned char *frame, fst_error *error)
{
    const follow_bead *film = &s->f->film;
    for (int i = 0; i < film->blobs->count; ++i) {
        const follow_box *box = &film->blobs->boxes[i];
        const double area = film->look->area;
        follow_cover cover, parts[FST_TRACKED_BEADS];
        if (box->pixels < 0.3 * area || box->pixels > 20.0 * area)
            continue;
        const fst_status status =
            follow_blobs_cover(film->blobs, frame, film->gains, film->look, box, &cover, error);
        if (status != FST_OK)
            return status;
        const double beads = cover.area / area, k = floor(beads + 0.5);
        if (cover.cut || !(beads > LEAST_AREA))
            continue;
        if (beads < MOST_AREA)
            add_place(s, &cover, cover.narrow);
        else if (k >= 2.0 && k <= s->f->count && follow_split(film->blobs, box, area, (int)k, parts))
            for (int part = 0; part < (int)k; ++part)
                add_place(s, &parts[part], NAN);
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ where beads should be */

static double gap_of(const sight *s, int bead)
{
    return s->time - s->f->movers[bead].when;
}

/* Whether a bead was not seen for so long that it may be anywhere. */
static int is_forgotten(const sight *s, int bead)
{
    const follow_mover *m = &s->f->movers[bead];
    return m->step > 0.0 && gap_of(s, bead) > FORGET * m->step;
}

/* Whether it was not seen for so long that it has left the picture. */
static int is_gone(const sight *s, int bead)
{
    return gap_of(s, bead) > GONE * s->f->movers[bead].step;
}

static void expect(sight *s, int bead)
{
    const follow_mover *m = &s->f->movers[bead];
    const double gap = gap_of(s, bead), diameter = s->f->film.look->diameter;
    s->expected[bead][0] = m->last.column + m->rate[0] * gap;
    s->expected[bead][1] = m->last.row + m->rate[1] * gap;
    if (!(m->step > 0.0) || is_forgotten(s, bead)) {
        s->reach[bead] = INFINITY;
        s->bound[bead] = m->step > 0.0 ? INFINITY : NOISE + SAFETY * s->f->fastest * gap;
        return;
    }
    const double way = hypot(m->rate[0], m->rate[1]) * gap, steps = gap / m->step;
    s->reach[bead] = FAR * (2.0 * diameter + 1.5 * way);
    s->bound[bead] = NOISE * (1.0 + 2.0 * steps) + 0.5 * LEAST_BEND * diameter * steps * (steps + 1.0) +
                     0.5 * SAFETY * s->f->bend * gap * (gap + m->step);
}

/* How fast two beads close in on each other where they may hit each other before this frame, pixels a second; 0: they do
 * not. */
static double closing_speed(const sight *s, int i, int j)
{
    const follow_mover *a = &s->f->movers[i], *b = &s->f->movers[j];
    const double begin = fmax(a->when, b->when), rate[2] = {b->rate[0] - a->rate[0], b->rate[1] - a->rate[1]};
    const double off[2] = {
        b->last.column + b->rate[0] * (begin - b->when) - a->last.column - a->rate[0] * (begin - a->when),
        b->last.row + b->rate[1] * (begin - b->when) - a->last.row - a->rate[1] * (begin - a->when)};
    const double square = rate[0] * rate[0] + rate[1] * rate[1];
    const double along = -(off[0] * rate[0] + off[1] * rate[1]); /* of the way, times the speed */
    if (!(along > 0.0 && square > 0.0))
        return 0.0;
    const double soonest = fmin(along / square, s->time - begin);
    const double least = hypot(off[0] + rate[0] * soonest, off[1] + rate[1] * soonest);
    const double touch = NEAR * s->f->film.look->diameter + s->bound[i] + s->bound[j];
    /* On straight ways it only falls until they are closest to each other. */
    return least < touch ? along / fmax(hypot(off[0], off[1]), 1e-9) : 0.0;
}

/* Allow for impacts between beads that come close to each other. */
static void allow_for_impacts(sight *s)
{
    double more[FST_TRACKED_BEADS] = {0.0};
    for (int i = 0; i < s->f->count; ++i) {
        const follow_mover *a = &s->f->movers[i];
        s->way[i] = INFINITY;
        for (int j = 0; j < s->f->count; ++j) {
            const follow_mover *b = &s->f->movers[j];
            const double speed = i != j && isfinite(s->bound[i] + s->bound[j]) ? closing_speed(s, i, j) : 0.0;
            if (!(speed > 0.0))
                continue;
            const double both = hypot(hypot(a->rate[0], a->rate[1]), hypot(b->rate[0], b->rate[1]));
            more[i] = fmax(more[i], BOUNCE * speed * gap_of(s, i));
            s->way[i] = s->bound[i] + both * gap_of(s, i);
        }
    }
    for (int i = 0; i < s->f->count; ++i)
        s->bound[i] += more[i];
}

/* ------------------------------------------------------------------ who is where */

static double miss(const sight *s, int bead, int place)
{
    return hypot(s->places[place].column - s->expected[bead][0], s->places[place].row - s->expected[bead][1]);
}

/* Try all places for this bead and those after it, at a cost so far. */
static void search(sight *s, int bead, unsigned used, double cost)
{
    if (cost >= s->best)
        return;
    if (bead == s->f->count) {
        s->best = cost;
        memcpy(s->taken, s->tried, sizeof s->taken);
        return;
    }
    for (int i = 0; i < s->count; ++i) {
        const double off = isinf(s->reach[bead]) ? (s->f->movers[bead].step > 0.0 ? 0.5 * FAR : 0.0)
                                                 : FAR * miss(s, bead, i) / s->reach[bead];
        if (used & 1U << i || off > FAR)
            continue;
        s->tried[bead] = i;
        /* A bead whose velocity is not known yet goes to what is near, in diameters. */
        const double square = s->f->movers[bead].step > 0.0
                                  ? off * off
                                  : pow(miss(s, bead, i) / (100.0 * s->f->film.look->diameter), 2.0);
        search(s, bead + 1, used | 1U << i, cost + square + s->strange[i]);
    }
    s->tried[bead] = NOWHERE;
    search(s, bead + 1, used, cost + FAR * FAR);
}

/* Whether a bead can be at a place; `far` is how far off a bead is that is where none can be, 0 if there is none. */
static int can_be(const sight *s, int bead, int place, double far)
{
    const follow_place *last = &s->f->movers[bead].last;
    if (place == NOWHERE)
        return is_forgotten(s, bead);
    const double off = miss(s, bead, place),
                 way = hypot(s->places[place].column - last->column, s->places[place].row - last->row);
    return off <= fmax(s->bound[bead], AS_BAD * far) && way <= fmax(s->way[bead], AS_BAD * far);
}

/* Lose beads at places that a lost bead can be at. */
static void share_losses(sight *s)
{
    for (int again = 0; again < s->f->count; ++again)
        for (int lost = 0; lost < s->f->count; ++lost)
            for (int bead = 0; bead < s->f->count && s->taken[lost] == NOWHERE; ++bead)
                if (s->taken[bead] != NOWHERE &&
                    (is_forgotten(s, lost) ? is_forgotten(s, bead) && !is_gone(s, lost)
                                           : can_be(s, lost, s->taken[bead], 0.0)))
                    s->taken[bead] = NOWHERE;
}

/* Look for another assignment of the taken places, from `bead` on; `moved` are the beads that have another place by it. */
static void look_for_others(sight *s, int bead, unsigned used, unsigned moved, double far)
{
    if (bead == s->f->count) {
        s->doubt |= moved;
        return;
    }
    for (int other = 0; other < s->f->count; ++other) {
        if (used & 1U << other)
            continue;
        const int stays = other == bead || s->taken[other] == s->taken[bead];
        if (stays || can_be(s, bead, s->taken[other], far))
            look_for_others(s, bead + 1, used | 1U << other, stays ? moved : moved | 1U << bead, far);
    }
}

static void assign(sight *s)
{
    double far = 0.0;
    s->best = INFINITY;
    for (int bead = 0; bead < s->f->count; ++bead)
        expect(s, bead);
    allow_for_impacts(s);
    search(s, 0, 0, 0.0);
    share_losses(s);
    for (int bead = 0; bead < s->f->count; ++bead)
        if (s->taken[bead] != NOWHERE && !can_be(s, bead, s->taken[bead], 0.0))
            far = fmax(far, miss(s, bead, s->taken[bead]));
    look_for_others(s, 0, 0, 0, far);
}

/* The first names, in a frame that shows all beads: from the left to the right. */
static void name(sight *s)
{
    for (int bead = 0; bead < s->f->count; ++bead)
        s->taken[bead] = NOWHERE;
    if (s->count < s->f->count)
        return;
    for (int bead = 0; bead < s->f->count; ++bead) { /* the places of the most usual areas */
        int best = bead;
        for (int i = bead; i < s->count; ++i)
            best = s->strange[i] < s->strange[best] ? i : best;
        const follow_place place = s->places[best];
        s->places[best] = s->places[bead];
        s->strange[best] = s->strange[bead];
        s->places[bead] = place;
    }
    for (int i = 0; i < s->f->count; ++i) {
        int rank = 0;
        for (int j = 0; j < s->f->count; ++j)
            rank += s->places[j].column < s->places[i].column ||
                    (s->places[j].column == s->places[i].column && j < i);
        s->taken[rank] = i;
    }
}

/* ------------------------------------------------------------------ the next frame */

static void remember(follow_beads *f, const sight *s)
{
    double most = 0.0, fastest = 0.0;
    for (int bead = 0; bead < f->count; ++bead) {
        follow_mover *m = &f->movers[bead];
        if (s->taken[bead] == NOWHERE)
            continue;
        const follow_place *place = &s->places[s->taken[bead]];
        const double gap = s->time - m->when;
        const int broken = isinf(s->bound[bead]) || (isfinite(s->way[bead]) && gap > 1.5 * m->step);
        if (f->named && m->step > 0.0 && isinf(s->way[bead]) && !broken)
            most = fmax(most, 2.0 * miss(s, bead, s->taken[bead]) / (gap * (gap + m->step)));
        /* What it did while it was lost is not known, where beads may have hit each other. */
        m->step = f->named && !broken ? gap : 0.0;
        m->rate[0] = m->step > 0.0 ? (place->column - m->last.column) / gap : 0.0;
        m->rate[1] = m->step > 0.0 ? (place->row - m->last.row) / gap : 0.0;
        fastest = fmax(fastest, hypot(m->rate[0], m->rate[1]));
        m->last = *place;
        m->when = s->time;
    }
    f->bend = fmax(FADES * f->bend, s->doubt ? 0.0 : most);
    f->fastest = fmax(FADES * f->fastest, fastest);
}

fst_status follow_beads_next(follow_beads *follower, const unsigned char *frame, double time,
                             follow_place places[FST_TRACKED_BEADS], unsigned *doubt, fst_error *error)
{
    *doubt = 0;
    if (follower->count == 1)
        return follow_bead_next(&follower->film, frame, time, places, error);
    sight s = {.f = follower, .time = time};
    if (follow_bead_see(&follower->film, frame)) {
        for (int bead = 0; bead < follower->count; ++bead) {
            places[bead] = follower->places[bead];
            places[bead].twin = 1;
        }
        return FST_OK;
    }
    const fst_status status = find_places(&s, frame, error);
    if (status != FST_OK)
        return status;
    (follower->named ? assign : name)(&s);
    remember(follower, &s);
    follower->named = follower->named || s.taken[0] != NOWHERE;
    *doubt = s.doubt & ~follower->doubtful ? s.doubt : 0;
    follower->doubtful = s.doubt;
    for (int bead = 0; bead < follower->count; ++bead) {
        const int lost = s.taken[bead] == NOWHERE;
        places[bead] = lost ? (follow_place){NAN, NAN, NAN, 0} : s.places[s.taken[bead]];
        follower->places[bead] = places[bead];
    }
    return FST_OK;
}
