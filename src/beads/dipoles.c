/* dipoles.c - the forces of many dipoles on each other, exactly: the sum over all pairs.
 *
 * Each dipole meets those behind it, tile by tile.  What a tile's dipoles feel is added to theirs one by one; what the
 * first one feels is kept, and then added up in eight sums, which are added last.  So no order depends on how many numbers a
 * register holds, and a pair's two forces are opposite to the last bit.
 */
#include "beads/dipoles.h"

#include <math.h>
#include <string.h>

enum { TILE = 128, SUMS = 8 };

/* Dipoles of a tile: what they are, what they feel of all, and what another one feels of each. */
typedef struct tile {
    int from, count;
    double in[BEADS_DIPOLE_IN][TILE], out[BEADS_DIPOLE_OUT][TILE], felt[BEADS_DIPOLE_OUT][TILE];
} tile;

/* Dipole i meets those of the tile from `first` on. */
static inline __attribute__((always_inline)) void meet(const beads_dipoles *all, int i, int first, tile *t)
{
    const beads_vector place = {all->in[0][i], all->in[1][i], all->in[2][i]};
    const beads_vector n = {all->in[3][i], all->in[4][i], all->in[5][i]};
    const double own = all->in[6][i];
    for (int k = first; k < t->count; ++k) {
        const beads_vector d = {t->in[0][k] - place.x, t->in[1][k] - place.y, t->in[2][k] - place.z};
        const beads_vector m = {t->in[3][k], t->in[4][k], t->in[5][k]};
        const double nearness = 1.0 / sqrt(beads_inner(d, d));
        const beads_vector u = {d.x * nearness, d.y * nearness, d.z * nearness};
        beads_vector force, on_n, on_m;
        beads_dipole_pair(n, m, u, nearness, own * t->in[6][k], &force, &on_n, &on_m);
        t->out[0][k] += force.x;
        t->out[1][k] += force.y;
        t->out[2][k] += force.z;
        t->out[3][k] += on_m.x;
        t->out[4][k] += on_m.y;
        t->out[5][k] += on_m.z;
        t->felt[0][k] = -force.x;
        t->felt[1][k] = -force.y;
        t->felt[2][k] = -force.z;
        t->felt[3][k] = on_n.x;
        t->felt[4][k] = on_n.y;
        t->felt[5][k] = on_n.z;
    }
}

static inline __attribute__((always_inline)) double sum_of(const double *felt, int count)
{
    double sums[SUMS] = {0.0};
    int k = 0;
    for (; k + SUMS <= count; k += SUMS)
        for (int s = 0; s < SUMS; ++s)
            sums[s] += felt[k + s];
    for (int s = 0; k < count; ++k, ++s)
        sums[s] += felt[k];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

static inline __attribute__((always_inline)) void sum_all(const beads_dipoles *all)
{
    tile t;
    for (int q = 0; q < BEADS_DIPOLE_OUT; ++q)
        memset(all->out[q], 0, (size_t)all->count * sizeof *all->out[q]);
    for (t.from = 0; t.from < all->count; t.from += TILE) {
        t.count = all->count - t.from < TILE ? all->count - t.from : TILE;
        for (int q = 0; q < BEADS_DIPOLE_IN; ++q)
            memcpy(t.in[q], all->in[q] + t.from, (size_t)t.count * sizeof *t.in[q]);
        memset(t.out, 0, sizeof t.out);
        for (int i = 0; i < t.from + t.count; ++i) {
            const int first = i < t.from ? 0 : i + 1 - t.from;
            meet(all, i, first, &t);
            for (int q = 0; q < BEADS_DIPOLE_OUT; ++q)
                all->out[q][i] += sum_of(t.felt[q] + first, t.count - first);
        }
        for (int q = 0; q < BEADS_DIPOLE_OUT; ++q)
            for (int k = 0; k < t.count; ++k)
                all->out[q][t.from + k] += t.out[q][k];
    }
}

static void sum_anywhere(const beads_dipoles *all)
{
    sum_all(all);
}

/* The same operations in wider registers. */
#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) static void sum_wide(const beads_dipoles *all)
{
    sum_all(all);
}

void beads_sum_dipoles(const beads_dipoles *dipoles)
{
    __builtin_cpu_init();
    (__builtin_cpu_supports("avx2") ? sum_wide : sum_anywhere)(dipoles);
}
#else
void beads_sum_dipoles(const beads_dipoles *dipoles)
{
    sum_anywhere(dipoles);
}
#endif
