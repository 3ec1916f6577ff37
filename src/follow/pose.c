/* pose.c - one frame against the surface: how well a rotation explains it, the best rotation, and where its centre is. */
#include "follow/pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/turn.h"

enum { TERMS = 6, STEPS = 12, BEST = 4, STRIDE = 2 };

#define CUT 9.0          /* squares, in sigma^2, at which an outlier counts half */
#define GRID 0.2         /* rad between the rotations that are tried */
#define MOST_SHIFT 0.1   /* radii that the centre moves at once */
#define LEAST_KNOWN 1e-3 /* 1/rad^2: where nothing is known, the error is many turns */
#define LIMB 0.97        /* radii: what is seen farther out is blurred with the plate, and counts as the limb */

double follow_seen(const follow_turning *t, const follow_turn *f, int k)
{
    return t->levels[(size_t)(f - t->turns) * (size_t)t->points + (size_t)k] / f->bright;
}

void follow_slopes(follow_turning *t)
{
    const double step = 1.0 / FOLLOW_PER_RADIUS;
    const double *const of[2] = {t->even, t->marked};
    for (int k = 0; k < t->points; ++k)
        for (int axis = 0; axis < 2; ++axis) {
            int sides[2];
            for (int side = 0; side < 2; ++side) {
                const double way = side ? step : -step;
                const int other = follow_turning_point(t->grid[k][0] + (axis == 0 ? way : 0.0),
                                                       t->grid[k][1] + (axis == 1 ? way : 0.0), t);
                sides[side] = other < 0 ? k : other;
            }
            const double apart = t->grid[sides[1]][axis] - t->grid[sides[0]][axis];
            for (int i = 0; i < 2; ++i)
                t->slopes[k][i][axis] = apart > 0.0 ? (of[i][sides[1]] - of[i][sides[0]]) / apart : 0.0;
        }
}

/* Lines of sight converge on the camera, so that all points of the face lie nearer to its middle than parallel lines
 * would have them.  The lamps stand still in the laboratory, while the camera sees the bead from another side at each
 * place: inside of the face the light belongs to a direction in the laboratory, at the outline to a place in the
 * picture. */
void follow_face(follow_turning *t, const follow_turn *f)
{
    for (int k = 0; k < t->points; ++k) {
        double right = f->shrink * (t->grid[k][0] - f->shift[0]),
               up = f->shrink * (t->grid[k][1] - f->shift[1]);
        const double far = fmax(1.0, hypot(right, up) / LIMB);
        right /= far;
        up /= far;
        const double across = right * right + up * up, front = sqrt(fmax(0.01, 1.0 - across)),
                     nearer = 1.0 - f->close * front;
        const double *of[2] = {t->even, t->marked};
        double by[2] = {-f->shift[0], -f->shift[1]};
        for (int i = 0; i < 3; ++i)
            t->facing[k][i] = nearer * (f->view[i][0] * right + f->view[i][1] * up) +
                              f->view[i][2] * (front + f->close * across);
        for (int j = 0; j < 2 && hypot(t->grid[k][0], t->grid[k][1]) < FOLLOW_INNER; ++j)
            by[j] = t->view[0][j] * t->facing[k][0] + t->view[1][j] * t->facing[k][1] +
                    t->view[2][j] * t->facing[k][2] - t->grid[k][j];
        for (int i = 0; i < 2; ++i)
            t->light[k][i] = of[i][k] + fst_dot(t->slopes[k][i], by, 2);
    }
}

void follow_on_bead(const double turn[3][3], const double facing[3], double point[3])
{
    for (int i = 0; i < 3; ++i)
        point[i] = turn[0][i] * facing[0] + turn[1][i] * facing[1] + turn[2][i] * facing[2];
}

double follow_bound(double square)
{
    return square / (1.0 + square / CUT);
}

/* What is expected of a rotation besides what the frame shows: its equations, and a misfit. */
static double expect(const follow_turn *f, const follow_pose *pose, double *normal, double *right)
{
    double off[3];
    if (!(f->trust > 0.0))
        return 0.0;
    fst_turn_between(pose->turn, f->expected, off);
    for (int i = 0; i < 3 && normal; ++i) {
        normal[(TERMS + 1) * i] += f->trust;
        right[i] += f->trust * off[i];
    }
    return f->trust * fst_dot(off, off, 3);
}

/* What a rotation leaves of a frame; what no frame has shown yet counts as it would on average. */
static double misfit(const follow_turning *t, const follow_turn *f, const follow_pose *pose, int stride)
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < t->points; k += stride) {
        double point[3], a;
        if (!t->used[k])
            continue;
        follow_on_bead(pose->turn, t->facing[k], point);
        const double off = follow_sphere_at(&t->sphere, point, &a, NULL)
                               ? follow_seen(t, f, k) - pose->gain * (t->light[k][0] + t->light[k][1] * a)
                               : t->spread[k];
        sum += follow_bound(off * off / (t->sigma[k] * t->sigma[k]));
        ++count;
    }
    return count ? (sum + expect(f, pose, NULL, NULL) / stride) / count : INFINITY;
}

/* How the level of a point changes with the shift, in units of sigma: `up` is its change with the place on the front. */
static void change_with_shift(const follow_turning *t, const follow_turn *f, int k, double a,
                              const double up[3], double gain, double change[2])
{
    double across[2], front = 0.0;
    for (int j = 0; j < 2; ++j)
        across[j] = f->shrink * (t->grid[k][j] - f->shift[j]);
    front = sqrt(fmax(0.01, 1.0 - across[0] * across[0] - across[1] * across[1]));
    for (int j = 0; j < 2; ++j) {
        double moved = 0.0;
        for (int i = 0; i < 3; ++i)
            moved += up[i] * f->shrink * (f->view[i][j] - across[j] / front * f->view[i][2]);
        change[j] = -moved - gain * (t->slopes[k][0][j] + t->slopes[k][1][j] * a) / t->sigma[k];
    }
}

/* The normal equations of a rotation vector, the gain and the shift, in units of sigma. */
static void equations(const follow_turning *t, const follow_turn *f, const follow_pose *pose,
                      double normal[TERMS * TERMS], double right[TERMS])
{
    memset(normal, 0, TERMS * TERMS * sizeof *normal);
    memset(right, 0, TERMS * sizeof *right);
    for (int k = 0; k < t->points; ++k) {
        double point[3], a, slope[3], up[3], row[TERMS];
        if (!t->used[k])
            continue;
        follow_on_bead(pose->turn, t->facing[k], point);
        if (!follow_sphere_at(&t->sphere, point, &a, slope))
            continue;
        const double level = t->light[k][0] + t->light[k][1] * a;
        const double off = (follow_seen(t, f, k) - pose->gain * level) / t->sigma[k],
                     part = 1.0 / (1.0 + off * off / CUT);
        for (int i = 0; i < 3; ++i)
            up[i] = pose->gain * t->light[k][1] / t->sigma[k] * fst_dot(pose->turn[i], slope, 3);
        /* A turn by d moves what is seen there back by d x facing: up . (facing x d) = d . (up x facing). */
        for (int i = 0; i < 3; ++i)
            row[i] = up[(i + 1) % 3] * t->facing[k][(i + 2) % 3] - up[(i + 2) % 3] * t->facing[k][(i + 1) % 3];
        row[3] = level / t->sigma[k];
        change_with_shift(t, f, k, a, up, pose->gain, row + 4);
        for (int i = 0; i < TERMS; ++i) {
            right[i] += part * part * row[i] * off;
            for (int j = 0; j < TERMS; ++j)
                normal[TERMS * i + j] += part * part * row[i] * row[j];
        }
    }
}

/* Solve the first `count` of the equations. */
static int solve(const double normal[TERMS * TERMS], const double right[TERMS], int count, double damp,
                 double *by)
{
    double a[TERMS * TERMS];
    const double ridge = 1e-6 * (normal[0] + normal[TERMS + 1] + normal[2 * (TERMS + 1)]) + 1e-9;
    for (int i = 0; i < count; ++i) {
        by[i] = right[i];
        for (int j = 0; j < count; ++j)
            a[count * i + j] = normal[TERMS * i + j];
        a[(count + 1) * i] += damp * normal[(TERMS + 1) * i] + ridge;
    }
    return follow_solve(a, by, count);
}

void follow_refine(const follow_turning *t, const follow_turn *f, int steps, follow_pose *pose)
{
    double damp = 1e-2;
    pose->misfit = misfit(t, f, pose, 1);
    for (int step = 0; step < steps && damp < 1e3; ++step) {
        double normal[TERMS * TERMS], right[TERMS], by[TERMS];
        follow_pose next = *pose;
        equations(t, f, pose, normal, right);
        (void)expect(f, pose, normal, right);
        if (!solve(normal, right, 4, damp, by))
            return;
        const double size = sqrt(fst_dot(by, by, 3));
        for (int i = 0; i < 3 && size > GRID; ++i)
            by[i] *= GRID / size;
        fst_turn_by(next.turn, by);
        next.gain = fmax(0.8, fmin(1.25, pose->gain + by[3]));
        next.misfit = misfit(t, f, &next, 1);
        if (next.misfit < pose->misfit) {
            *pose = next;
            damp *= 0.2;
            if (size < 1e-4)
                return;
        } else {
            damp *= 8.0;
        }
    }
}

void follow_recentre(follow_turning *t, follow_turn *f, int steps)
{
    double normal[TERMS * TERMS], right[TERMS], by[TERMS];
    const follow_turn before = *f;
    equations(t, f, &f->pose, normal, right);
    (void)expect(f, &f->pose, normal, right);
    if (!solve(normal, right, TERMS, 0.0, by) || !(hypot(by[4], by[5]) < MOST_SHIFT) ||
        !(fst_dot(by, by, 3) < GRID * GRID))
        return;
    for (int i = 0; i < 2; ++i)
        f->shift[i] += by[4 + i];
    fst_turn_by(f->pose.turn, by);
    follow_face(t, f);
    follow_refine(t, f, steps, &f->pose);
    if (!(f->pose.misfit < before.pose.misfit)) {
        *f = before;
        follow_face(t, f);
    }
}

void follow_search(const follow_turning *t, const follow_turn *f, double reach, follow_pose *pose)
{
    follow_pose best[BEST];
    const int most = (int)(reach / GRID);
    for (int i = 0; i < BEST; ++i)
        best[i] = (follow_pose){.misfit = INFINITY};
    for (int k = 0; k < (2 * most + 1) * (2 * most + 1) * (2 * most + 1); ++k) {
        const int side = 2 * most + 1;
        const double by[3] = {GRID * (k % side - most), GRID * (k / side % side - most),
                              GRID * (double)(k / side / side - most)};
        follow_pose next = *pose;
        if (fst_dot(by, by, 3) > reach * reach)
            continue;
        fst_turn_by(next.turn, by);
        /* Of equal ones the nearest to the prediction. */
        next.misfit = misfit(t, f, &next, STRIDE) *
                      (1.0 + (reach > 0.0 ? 0.1 * fst_dot(by, by, 3) / (reach * reach) : 0.0));
        for (int i = 0; i < BEST; ++i)
            if (next.misfit < best[i].misfit) {
                const follow_pose other = best[i];
                best[i] = next;
                next = other;
            }
    }
    pose->misfit = INFINITY;
    for (int i = 0; i < BEST && best[i].misfit < INFINITY; ++i) {
        follow_refine(t, f, STEPS, &best[i]);
        if (best[i].misfit < pose->misfit)
            *pose = best[i];
    }
}

static void show(follow_turning *t, const follow_turn *f, int rest)
{
    for (int k = 0; k < t->points; ++k) {
        double point[3], a;
        const double marked = t->light[k][1], scale = marked / t->sigma[k];
        if (!t->used[k] || !(marked > 0.0) || hypot(t->grid[k][0], t->grid[k][1]) > FOLLOW_INNER)
            continue;
        follow_on_bead(f->pose.turn, t->facing[k], point);
        double value = (follow_seen(t, f, k) / f->pose.gain - t->light[k][0]) / marked, weight = scale * scale;
        if (follow_sphere_at(&t->sphere, point, &a, NULL)) {
            const double off = (value - a) * scale, part = 1.0 / (1.0 + off * off / CUT);
            weight *= part;
            value -= rest ? a : 0.0;
        }
        follow_sphere_add(rest ? &t->rest : &t->sphere, point, value, weight);
    }
}

void follow_show(follow_turning *t, const follow_turn *f)
{
    show(t, f, 0);
}

void follow_show_rest(follow_turning *t, const follow_turn *f)
{
    show(t, f, 1);
}

void follow_known(follow_turning *t, follow_turn *f)
{
    double normal[TERMS * TERMS], right[TERMS];
    follow_face(t, f);
    equations(t, f, &f->pose, normal, right);
    for (int k = TERMS - 1; k >= 3; --k) /* eliminate the others, one after another */
        for (int j = 0; j < k && normal[(TERMS + 1) * k] > 0.0; ++j)
            for (int l = 0; l < k; ++l)
                normal[TERMS * j + l] -=
                    normal[TERMS * j + k] * normal[TERMS * k + l] / normal[(TERMS + 1) * k];
    for (int j = 0; j < 3; ++j)
        memcpy(f->known[j], normal + TERMS * j, sizeof f->known[j]);
}

double follow_unsure(const double known[3][3], const double n[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        double a[9], column[3] = {k == 0, k == 1, k == 2};
        for (int i = 0; i < 9; ++i)
            a[i] = known[i / 3][i % 3] + (i % 4 == 0 ? LEAST_KNOWN : 0.0);
        if (!follow_solve(a, column, 3))
            return INFINITY;
        for (int i = 0; i < 3; ++i) /* n turns by what is across it */
            sum += 0.5 * column[i] * ((i == k) - n[i] * n[k]);
    }
    return sqrt(fmax(0.0, sum));
}

int follow_known_together(const double one[3][3], const double other[3][3], double both[3][3])
{
    for (int j = 0; j < 3; ++j) {
        double sum[9], column[3];
        for (int i = 0; i < 9; ++i)
            sum[i] = one[i / 3][i % 3] + other[i / 3][i % 3] + (i % 4 == 0 ? LEAST_KNOWN : 0.0);
        for (int i = 0; i < 3; ++i)
            column[i] = other[i][j];
        if (!follow_solve(sum, column, 3))
            return 0;
        for (int i = 0; i < 3; ++i)
            both[i][j] = fst_dot(one[i], column, 3);
    }
    return 1;
}
