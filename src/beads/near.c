/* near.c - which beads are near each other, by cells.
 *
 * Space is cut into cubes as wide as the distance within which beads are near, so that a bead's neighbours are in its own
 * cube and the 26 around it.  Cubes are found by a table of as many lists as there are beads, or more; cubes that share a
 * list are told apart by their numbers.
 */
#include "beads/near.h"

#include <math.h>

#include "base/error.h"
#include "base/grow.h"

enum { LISTS = 1024 };

typedef struct cells {
    double width;
    int head[LISTS], next[FST_BEADS_MANY];
    double cube[FST_BEADS_MANY][3]; /* whole numbers */
} cells;

/* Any number that depends on all three and spreads cubes that lie side by side. */
static unsigned list_of(const double cube[3])
{
    const double mixed = cube[0] * 73.0 + cube[1] * 1009.0 + cube[2] * 9973.0;
    return (unsigned)(mixed - LISTS * floor(mixed / LISTS)) % LISTS;
}

static void fill(cells *c, const beads_world *world, const int *gone, const double *y)
{
    for (int l = 0; l < LISTS; ++l)
        c->head[l] = -1;
    for (int i = world->count - 1; i >= 0; --i) {
        if (gone[i])
            continue;
        for (int k = 0; k < 3; ++k)
            c->cube[i][k] = floor(y[FST_BEAD_NUMBERS * i + k] / c->width);
        const unsigned list = list_of(c->cube[i]);
        c->next[i] = c->head[list];
        c->head[list] = i;
    }
}

/* Put the pair in its place among those of its first bead, which begin at `from`. */
static void insert(beads_two *pairs, int from, int count, beads_two pair)
{
    int at = count;
    for (; at > from && pairs[at - 1].second > pair.second; --at)
        pairs[at] = pairs[at - 1];
    pairs[at] = pair;
}

static int same(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* The beads behind i in a cube that are near it. */
static int add_from_cube(const cells *c, const beads_world *world, const double *y, double within, int i,
                         const double cube[3], beads_two **pairs, int from, int *count)
{
    for (int j = c->head[list_of(cube)]; j >= 0; j = c->next[j]) {
        double d[3];
        const double least = world->body[i].radius + world->body[j].radius + within;
        if (j <= i || !same(cube, c->cube[j]))
            continue;
        beads_way(world, y, i, j, d);
        if (!(beads_dot(d, d) < least * least))
            continue;
        if (!fst_grow(pairs, (size_t)*count, sizeof **pairs))
            return 0;
        insert(*pairs, from, (*count)++, (beads_two){i, j});
    }
    return 1;
}

fst_status beads_find_near(const beads_world *world, const int *gone, const double *y, double within,
                           beads_two **pairs, int *count, fst_error *error)
{
    cells c;
    double greatest = 0.0;
    for (int i = 0; i < world->count; ++i)
        greatest = fmax(greatest, world->body[i].radius);
    c.width = 3.0 * greatest + within; /* the third radius: places differ by radii from heights */
    fill(&c, world, gone, y);
    *count = 0;
    for (int i = 0; i < world->count; ++i) {
        const int from = *count;
        for (int around = 0; around < 27 && !gone[i]; ++around) {
            const double cube[3] = {c.cube[i][0] + (around % 3 - 1), c.cube[i][1] + (around / 3 % 3 - 1),
                                    c.cube[i][2] + (around / 9 - 1)};
            if (!add_from_cube(&c, world, y, within, i, cube, pairs, from, count))
                return fst_fail(error, FST_NO_MEMORY, "beads", "out of memory for the pairs of beads");
        }
    }
    return FST_OK;
}
