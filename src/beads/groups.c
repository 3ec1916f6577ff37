/* groups.c - which beads hang together: beads joined by bonds, and the shape that the bonds make.
 *
 *     bonds 0           bonds 1        bonds n - 1, at most 2 a bead    bonds n, 2 a bead      else
 *     single            pair           chain                           ring                   cluster
 */
#include "beads/groups.h"

#include <string.h>

static const double BOND = 0.1; /* greatest gap over the distance in touch */

int beads_pair_number(const beads_world *world, int one, int other)
{
    const int first = one < other ? one : other, second = one + other - first;
    for (int k = world->count; k < world->contacts; ++k)
        if (world->contact[k].first == first && world->contact[k].second == second)
            return k;
    return -1;
}

static int is_bond(const beads_flow *flow, int k)
{
    const beads_contact *c = &flow->world.contact[k];
    return c->second >= 0 && beads_can_meet(&flow->world, &flow->modes, k) && flow->widest[k] < BOND * c->reach;
}

static fst_bead_group_kind shape_of(int count, int bonds, int most)
{
    if (count < 3)
        return count == 1 ? FST_BEAD_GROUP_SINGLE : FST_BEAD_GROUP_PAIR;
    if (most > 2)
        return FST_BEAD_GROUP_CLUSTER;
    return bonds == count ? FST_BEAD_GROUP_RING : FST_BEAD_GROUP_CHAIN;
}

/* Put the ends of a chain first and last. */
static void order_ends(fst_bead_group *group, const int *bonds_of)
{
    int place = 0;
    for (int i = 0; i < group->count && group->kind == FST_BEAD_GROUP_CHAIN; ++i)
        if (bonds_of[group->members[i]] == 1) {
            const int to = place ? group->count - 1 : 0, kept = group->members[to];
            group->members[to] = group->members[i];
            group->members[i] = kept;
            if (place++)
                return;
        }
}

int beads_group(const beads_flow *flow, fst_bead_group groups[FST_BEADS_MOST])
{
    int of[FST_BEADS_MOST], bonds_of[FST_BEADS_MOST] = {0}, count = 0;
    for (int i = 0; i < flow->world.count; ++i)
        of[i] = i;
    for (int k = 0; k < flow->world.contacts; ++k) {
        if (!is_bond(flow, k))
            continue;
        const int a = flow->world.contact[k].first, b = flow->world.contact[k].second, from = of[b], to = of[a];
        ++bonds_of[a];
        ++bonds_of[b];
        for (int i = 0; i < flow->world.count; ++i)
            of[i] = of[i] == from ? to : of[i];
    }
    memset(groups, 0, FST_BEADS_MOST * sizeof *groups);
    for (int label = 0; label < flow->world.count; ++label) {
        fst_bead_group *group = &groups[count];
        int bonds = 0, most = 0;
        for (int i = 0; i < flow->world.count; ++i)
            if (of[i] == label && !flow->modes.gone[i]) {
                group->members[group->count++] = i;
                bonds += bonds_of[i];
                most = bonds_of[i] > most ? bonds_of[i] : most;
            }
        if (!group->count)
            continue;
        group->kind = shape_of(group->count, bonds / 2, most);
        order_ends(group, bonds_of);
        ++count;
    }
    return count;
}
