/* turning.c - the rotation of the bead in each frame.
 *
 * A bead that is filmed 240 times a second turns by up to 120 degrees from a frame to the next, so that little of what
 * was seen is seen again.  What helps is that it nearly rolls, and that its surface is learnt on the way:
 *
 *   1. From a frame on, each next one is predicted: by what repeats itself (rhythm.c), which all pairs of neighbouring
 *      faces tell together; where nothing does, it turned as before, but for what rolling changed.  Rotations
 *      around the prediction are tried against the surface seen so far, the best are refined by Gauss and Newton's
 *      method, and the face is added to the surface.
 *   2. That is tried from several frames; the one from which the next frames are foretold best begins the whole film,
 *      forwards and then backwards.
 *   3. A few times over all frames: the surface from all faces, the light on each point of the face, and each rotation
 *      against that surface, from where it was and from where its neighbours would have it.  Where some frames show few
 *      marks, or none, each rotation is also drawn to where what repeats itself has it between its neighbours.
 */
#include "follow/pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "base/order.h"
#include "base/turn.h"
#include "base/watch.h"
#include "follow/rhythm.h"

enum {
    WINDOWS = 24,
    WINDOW = 60,
    EARLY = 6,
    PASSES = 100,
    SEARCHES = 3,
    ROUNDS = 3,
    SPELL = 20,
    RESTS = 2,
    UNTWISTS = 5
};

#define WIDE 1.1     /* rad around the prediction: at the start ... */
#define LITTLE 0.25  /* ... and around what repeats itself */
#define USUAL 0.5    /* ... and later */
#define ROUGHLY 0.04 /* rad in a frame by which the bead may turn otherwise than it repeats: at the start ... */
#define LATER 0.02   /* ... and once it has been found by the rotations */
#define NEARLY_ALL 0.95     /* of the frames ... */
#define ABOUT_AS_WELL 3.0   /* ... and times the median error of a rotation */
#define LEAST_SPREAD 2.0    /* gray levels that marks change on a point of the face */
#define ENOUGH 0.5          /* of what is foretold from a frame: no better one is looked for */
#define LEAST_GAIN 5e-6     /* of what is explained, for another pass */
#define MOST_MOVED 0.05     /* rad in a pass, by a rotation that finds its place */
#define LEAST_KEPT 0.5      /* of a pass's movement by the next */
#define LEAP 8.0            /* times the movement of a pass */
#define LEAST_EXPLAINED 0.8 /* chains that are wrong in part explain up to 0.8 */

/* ------------------------------------------------------------------ from frame to frame */

/* The angular velocity with which the bead would roll from one frame to another: e x v / R. */
static void rolls(const follow_turning *t, const follow_turn *from, const follow_turn *to, double w[3])
{
    const double step = (to->time - from->time) * t->millimetres;
    w[0] = -(to->place[1] - from->place[1]) / step;
    w[1] = (to->place[0] - from->place[0]) / step;
    w[2] = 0.0;
}

/* The rotation that what repeats itself has in the next frame, or (way < 0) in the one before, of which `step` is. */
static void stepped(const follow_turn *from, const follow_turn *step, int way, double turn[3][3])
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            turn[i][j] = 0.0;
            for (int k = 0; k < 3; ++k)
                turn[i][j] += (way > 0 ? step->step[i][k] : step->step[k][i]) * from->pose.turn[k][j];
        }
}

/* Follow the bead from frame `from` towards frame `to`, which is not reached; frame `from` is known, and its face shown.
 * Returns which part of the faces, on the mean over all frames but the early ones, the surface foretold. */
static double follow(follow_turning *t, int from, int to, int shows)
{
    const int way = to < from ? -1 : 1;
    double w[3] = {0.0, 0.0, 0.0}, rolled[3] = {0.0, 0.0, 0.0}, left = 0.0, unknown = 0.0;
    int count = 0;
    for (int i = from + way; way * (to - i) > 0; i += way, ++count) {
        follow_turn *f = &t->turns[i], *before = f - way;
        const double step = f->time - before->time;
        double roll[3], by[3], spread = 0.0;
        rolls(t, before, f, roll);
        for (int k = 0; k < 3; ++k)
            by[k] = (w[k] + roll[k] - rolled[k]) * step;
        follow_face(t, f);
        f->pose = before->pose;
        f->pose.gain = 1.0;
        f->trust = t->trust;
        if (t->trust > 0.0) {
            stepped(before, way > 0 ? f : before, way, f->pose.turn);
            memcpy(f->expected, f->pose.turn, sizeof f->expected);
            follow_search(t, f, LITTLE, &f->pose);
        } else {
            fst_turn_by(f->pose.turn, by);
            follow_search(t, f, count < EARLY ? WIDE : USUAL, &f->pose);
        }
        for (int k = 0; k < t->points; ++k)
            spread += t->used[k]
                          ? follow_bound(t->spread[k] * t->spread[k] / (t->sigma[k] * t->sigma[k])) / t->points
                          : 0.0;
        if (count >= EARLY) {
            left += f->pose.misfit;
            unknown += spread;
        }
        if (shows)
            follow_show(t, f);
        fst_turn_between((const double(*)[3])before->pose.turn, (const double(*)[3])f->pose.turn, by);
        for (int k = 0; k < 3; ++k)
            w[k] = by[k] / step;
        memcpy(rolled, roll, sizeof rolled);
    }
    return unknown > 0.0 ? 1.0 - left / unknown : 0.0;
}

/* Begin with a frame in any rotation. */
static void begin_at(follow_turning *t, int from)
{
    follow_turn *f = &t->turns[from];
    f->pose = (follow_pose){.turn = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, .gain = 1.0};
    follow_sphere_clear(&t->sphere);
    follow_face(t, f);
    follow_show(t, f);
}

/* ------------------------------------------------------------------ all frames */

/* The pose that two frames on one side foretell. */
static int foretell(const follow_turning *t, int i, int way, follow_pose *pose)
{
    const int near = i + way, far = i + 2 * way;
    if (far < 0 || far >= t->count || !t->turns[near].good || !t->turns[far].good)
        return 0;
    const follow_turn *one = &t->turns[near], *other = &t->turns[far];
    double by[3];
    fst_turn_between((const double(*)[3])other->pose.turn, (const double(*)[3])one->pose.turn, by);
    for (int k = 0; k < 3; ++k)
        by[k] *= (t->turns[i].time - one->time) / (one->time - other->time);
    *pose = one->pose;
    fst_turn_by(pose->turn, by);
    return 1;
}

/* Expect what repeats itself, so surely (rad) from a frame to the next. */
static void expect_rhythm(follow_turning *t, const follow_rhythm *rhythm, double surely)
{
    t->trust = 1.0 / (surely * surely);
    for (int i = 1; i < t->count; ++i)
        follow_rhythm_turning(rhythm, t->turns[i - 1].time, t->turns[i].time, t->turns[i].step);
}

/* Where all frames tell their rotation about as well, expect no more of them.  Else expect what the rotations that were
 * found repeat, for those frames which show but one mark, or none. */
static void expect_better(follow_turning *t, double *room)
{
    const int most = (int)(NEARLY_ALL * (t->count - 1));
    follow_rhythm rhythm;
    for (int i = 0; i < t->count; ++i) {
        follow_known(t, &t->turns[i]);
        room[i] = follow_unsure((const double(*)[3])t->turns[i].known, (const double[3]){0.0, 0.0, 0.0});
    }
    qsort(room, (size_t)t->count, sizeof *room, fst_ascending);
    if (room[most] < ABOUT_AS_WELL * room[t->count / 2]) {
        t->trust = 0.0;
        return;
    }
    follow_rhythm_find(t, follow_usual_step(t, room), &rhythm);
    if (rhythm.lines > 0)
        expect_rhythm(t, &rhythm, LATER);
}

/* What the neighbours of a frame expect of its rotation. */
static void expect(follow_turning *t, int i)
{
    follow_turn *f = &t->turns[i];
    double other[3][3], by[3];
    const int both = i > 0 && i + 1 < t->count;
    f->trust = t->trust * (both ? 2.0 : 1.0);
    if (!(t->trust > 0.0))
        return;
    if (i > 0)
        stepped(f - 1, f, 1, f->expected);
    if (i + 1 < t->count)
        stepped(f + 1, f + 1, -1, i > 0 ? other : f->expected);
    if (!both)
        return;
    fst_turn_between((const double(*)[3])f->expected, (const double(*)[3])other, by);
    for (int k = 0; k < 3; ++k)
        by[k] *= 0.5;
    fst_turn_by(f->expected, by);
}

/* Improve the pose of a frame: from where it was, and in the first passes from where its neighbours would have it. */
static void improve(follow_turning *t, int i, int pass)
{
    const int steps = pass < SEARCHES ? 12 : 3;
    follow_turn *f = &t->turns[i];
    follow_face(t, f);
    expect(t, i);
    follow_refine(t, f, steps, &f->pose);
    for (int way = -1; way <= 1 && pass < SEARCHES; way += 2) {
        follow_pose other;
        if (!foretell(t, i, way, &other))
            continue;
        follow_search(t, f, pass == 0 ? USUAL : 0.0, &other);
        if (other.misfit < f->pose.misfit)
            f->pose = other;
    }
    for (int repeat = 0; repeat < 2 && pass > 0; ++repeat)
        follow_recentre(t, f, steps);
}

/* Frames that are explained about as well as the others are good. */
static void judge(follow_turning *t, double most, double *room)
{
    for (int i = 0; i < t->count; ++i)
        room[i] = t->turns[i].pose.misfit;
    const double usual = fst_median(room, (size_t)t->count);
    for (int i = 0; i < t->count; ++i)
        t->turns[i].good = t->turns[i].pose.misfit <= most * usual;
}

/* A frame from which the next ones are foretold well, or else the best one, of the windows from number `next` on. */
static fst_status choose_start(follow_turning *t, const fst_progress *progress, int *next, int *start,
                               fst_error *error)
{
    double most = -INFINITY;
    for (; *next < WINDOWS && most < ENOUGH; ++*next) {
        /* Windows far apart come first. */
        const int from = (int)(fmod(0.61803398875 * *next, 1.0) * fmax(0.0, t->count - WINDOW));
        begin_at(t, from);
        const double foretold = follow(t, from, from + WINDOW < t->count ? from + WINDOW : t->count, 1);
        if (foretold > most) {
            most = foretold;
            *start = from;
        }
        const fst_status status = fst_tell(progress, 0.4 * *next / WINDOWS, NULL, error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

/* Follow the bead once more, from where it was followed best, against the surface that the better half of the frames
 * shows: a chain that was lost on the way is found again. */
static void again(follow_turning *t, double *room)
{
    int best = 0;
    double least = INFINITY;
    judge(t, 1.0, room);
    follow_surface_learn(t);
    for (int i = 0; i + SPELL <= t->count; ++i) {
        double sum = 0.0;
        for (int k = 0; k < SPELL; ++k)
            sum += t->turns[i + k].pose.misfit;
        if (sum < least) {
            least = sum;
            best = i + SPELL / 2;
        }
    }
    (void)follow(t, best, t->count, 0);
    (void)follow(t, best, -1, 0);
}

/* Find all rotations roughly. */
static fst_status find_roughly(follow_turning *t, const fst_progress *progress, int *next, double *room,
                               fst_error *error)
{
    int from = 0;
    (void)follow_light_begin(t);
    for (int i = 0; i < t->count; ++i)
        t->turns[i].shift[0] = t->turns[i].shift[1] = 0.0;
    fst_status status = choose_start(t, progress, next, &from, error);
    if (status != FST_OK)
        return status;
    begin_at(t, from);
    (void)follow(t, from, t->count, 1);
    (void)follow(t, from, -1, 1);
    for (int round = 0; round < ROUNDS && status == FST_OK; ++round) {
        again(t, room);
        status = fst_tell(progress, 0.5 + 0.1 * round, NULL, error);
    }
    judge(t, 1.5, room);
    return status;
}

/* Where the rotations were a pass before, and how they moved in it. */
typedef struct past {
    double turn[3][3], moved[3];
} past;

/* The surface follows the rotations, and these the surface, so that what both have wrong, such as how far apart two dots
 * are, shrinks by a small part a pass.  Where two passes moved the rotations alike, move them on by as much as many such passes
 * would.  Returns whether it did; `may` is 0 where the passes after the last time have still to show their effect. */
static int leap(follow_turning *t, past *pasts, int may)
{
    double alike = 0.0, squares = 0.0;
    for (int i = 0; i < t->count; ++i) {
        double moved[3];
        fst_turn_between((const double(*)[3])pasts[i].turn, (const double(*)[3])t->turns[i].pose.turn, moved);
        if (t->turns[i].good && fst_dot(moved, moved, 3) < MOST_MOVED * MOST_MOVED) {
            alike += fst_dot(moved, pasts[i].moved, 3);
            squares += fst_dot(pasts[i].moved, pasts[i].moved, 3);
        } else {
            memset(moved, 0, sizeof moved);
        }
        memcpy(pasts[i].moved, moved, sizeof moved);
    }
    const double kept = squares > 0.0 ? alike / squares : 0.0;
    const int leaps = may && kept > LEAST_KEPT;
    for (int i = 0; i < t->count; ++i) {
        double by[3];
        for (int k = 0; k < 3 && leaps; ++k)
            by[k] = LEAP * pasts[i].moved[k];
        if (leaps)
            fst_turn_by(t->turns[i].pose.turn, by);
        memcpy(pasts[i].turn, t->turns[i].pose.turn, sizeof pasts[i].turn);
    }
    return leaps;
}

/* Improve all rotations until no more is explained.  Returns which part is. */
static fst_status improve_all(follow_turning *t, const fst_progress *progress, double *room, past *pasts,
                              double *explained, fst_error *error)
{
    double before = -INFINITY; /* what was explained where it was leapt last */
    fst_status status = FST_OK;
    int rests = 0, untwists = 0;
    *explained = 0.0;
    for (int pass = 0; pass < PASSES && status == FST_OK && (rests > 0 || *explained > before + LEAST_GAIN);
         ++pass) {
        if (pass == SEARCHES && *explained < LEAST_EXPLAINED)
            return FST_OK; /* a wrong chain does not become right */
        before = rests == 0 && pass > 2 ? *explained : before;
        follow_surface_learn(t);
        if (pass > 0)
            follow_light_learn(t);
        for (int i = 0; i < t->count; ++i)
            improve(t, pass % 2 ? t->count - 1 - i : i, pass);
        follow_centre(t);
        judge(t, 3.0, room);
        *explained = follow_explain(t);
        rests = leap(t, pasts, rests == 0 && pass > SEARCHES && pass + RESTS < PASSES) ? RESTS
                : rests > 0                                                            ? rests - 1
                                                                                       : 0;
        if (rests == 0 && *explained <= before + LEAST_GAIN && untwists++ < UNTWISTS && follow_untwist(t)) {
            before = -INFINITY;
            rests = RESTS;
        }
        if (pass == SEARCHES && t->trust > 0.0) {
            expect_better(t, room);
            before = -INFINITY;
        }
        status = fst_tell(progress, 0.8 + 0.2 * pass / PASSES, NULL, error);
    }
    return status;
}

fst_status follow_turning_find(follow_turning *turning, const fst_progress *progress, double *explained,
                               fst_error *error)
{
    follow_turning *t = turning;
    double *room = malloc((size_t)(t->count + 1) * sizeof *room);
    past *pasts = calloc((size_t)(t->count + 1), sizeof *pasts);
    *explained = 0.0;
    if (!room || !pasts) {
        free(room);
        free(pasts);
        return fst_fail(error, FST_NO_MEMORY, "track", "no memory for the turning of a bead");
    }
    fst_status status = FST_OK;
    const int marked = t->count >= WINDOW && follow_light_begin(t) >= LEAST_SPREAD;
    const double usual = marked ? follow_usual_step(t, room) : NAN;
    if (marked)
        follow_rhythm_shutter(t, usual);
    follow_rhythm rhythm = {.lines = 0};
    for (int repeats = 1; repeats >= 0 && marked && *explained < LEAST_EXPLAINED; --repeats) {
        t->trust = 0.0;
        if (repeats && !follow_rhythm_begin(t, usual, &rhythm))
            continue;
        if (repeats)
            expect_rhythm(t, &rhythm, ROUGHLY);
        for (int next = 0; status == FST_OK && next < WINDOWS && *explained < LEAST_EXPLAINED;) {
            status = find_roughly(t, progress, &next, room, error);
            if (status == FST_OK)
                status = improve_all(t, progress, room, pasts, explained, error);
            next = repeats ? WINDOWS : next; /* a wrong rhythm does not become right */
        }
    }
    const int is_found = *explained >= LEAST_EXPLAINED;
    if (!is_found)
        *explained = 0.0;
    t->few = is_found && (t->trust > 0.0 || !follow_sphere_is_half(&t->sphere));
    for (int i = 0; i < t->count && is_found; ++i)
        follow_known(t, &t->turns[i]);
    free(room);
    free(pasts);
    return status;
}
