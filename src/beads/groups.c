/* groups.c - which beads hang together: beads joined by bonds, and the shape that the bonds make.
 *
 *     bonds 0           bonds 1        bonds n - 1, at most 2 a bead    bonds n, 2 a bead      else
 *     single            pair           chain                           ring                   cluster
 */
#include "beads/groups.h"

#include <math.h>
#include <string.h>

static const double BOND = 0.1; /* greatest gap over the distance in touch */

static int is_bond(const beads_world *world, const int *gone, const double *y, int i, int j)
{
    double d[3];
    const double reach = world->body[i].radius + world->body[j].radius;
    if (gone[i] || gone[j])
        return 0;
    beads_way(world, y, i, j, d);
    return beads_dot(d, d) < reach * reach * ((1.0 + BOND) * (1.0 + BOND));
}

fst_status beads_find_bonds(const beads_world *world, const int *gone, const double *y, beads_two **bonds,
                            int *count, fst_error *error)
{
    double greatest = 0.0;
    for (int i = 0; i < world->count; ++i)
        greatest = fmax(greatest, world->body[i].radius);
    *bonds = NULL;
    const fst_status status = beads_find_near(world, gone, y, 2.0 * BOND * greatest, bonds, count, error);
    *count = status == FST_OK ? beads_keep_bonds(world, gone, y, *bonds, *count) : 0;
    return status;
}

int beads_keep_bonds(const beads_world *world, const int *gone, const double *y, beads_two *bonds, int count)
{
    int kept = 0;
    for (int k = 0; k < count; ++k)
        if (is_bond(world, gone, y, bonds[k].first, bonds[k].second))
            bonds[kept++] = bonds[k];
    return kept;
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
static void order_ends(fst_bead_group_kind kind, int count, int *members, const int *bonds_of)
{
    int place = 0;
    for (int i = 0; i < count && kind == FST_BEAD_GROUP_CHAIN; ++i)
        if (bonds_of[members[i]] == 1) {
            const int to = place ? count - 1 : 0, kept = members[to];
            members[to] = members[i];
            members[i] = kept;
            if (place++)
                return;
        }
}

/* Which beads hang together: equal labels; and how many bonds each has. */
static void join(int count, const beads_two *bonds, int bond_count, int *label_of, int *bonds_of)
{
    for (int i = 0; i < count; ++i) {
        label_of[i] = i;
        bonds_of[i] = 0;
    }
    for (int k = 0; k < bond_count; ++k) {
        const int from = label_of[bonds[k].second], to = label_of[bonds[k].first];
        ++bonds_of[bonds[k].first];
        ++bonds_of[bonds[k].second];
        for (int i = 0; i < count; ++i)
            label_of[i] = label_of[i] == from ? to : label_of[i];
    }
}

int beads_group(int count, const int *gone, const beads_two *bonds, int bond_count, fst_bead_group *groups,
                int *members)
{
    int label_of[FST_BEADS_MANY], bonds_of[FST_BEADS_MANY], found = 0;
    join(count, bonds, bond_count, label_of, bonds_of);
    for (int label = 0; label < count; ++label) {
        fst_bead_group group = {.count = 0};
        int sum = 0, most = 0;
        for (int i = 0; i < count; ++i)
            if (label_of[i] == label && !gone[i]) {
                members[group.count++] = i;
                sum += bonds_of[i];
                most = bonds_of[i] > most ? bonds_of[i] : most;
            }
        if (!group.count)
            continue;
        group.kind = shape_of(group.count, sum / 2, most);
        group.members = members;
        order_ends(group.kind, group.count, members, bonds_of);
        members += group.count;
        groups[found++] = group;
    }
    return found;
}
