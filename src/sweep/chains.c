/* chains.c - chains: with carrying, the points that follow each other along the first axis.
 *
 * Each run of a chain starts from the end state of the run before it, so the runs of a chain are done one after
 * another.  Different chains are independent, and a chain is one task.  On a grid of 4 x 3 points the first
 * axis has 4 values, and carrying upwards makes 3 chains of 4 points:
 *
 *      second axis
 *      ^   o->o->o->o    chain 2
 *      |   o->o->o->o    chain 1
 *      |   o->o->o->o    chain 0
 *      +-------------->  first axis
 *
 * A shard of N has one of each N tasks that follow each other, another one each time: with 3 shards tasks 0, 5, 7, 9,
 * 14 ... are the first one's.  So its points lie all over the grid, also where an axis has N values, and shards take
 * about as long as each other.
 */
#include "sweep/sweep.h"

int64_t fst_chain_length(const fst_sweep_identity *identity)
{
    return fst_grid_axis_points(identity->grid, 0);
}

int64_t fst_chain_count(const fst_sweep_identity *identity)
{
    return fst_grid_points(identity->grid) / fst_chain_length(identity);
}

int64_t fst_chain_point(const fst_sweep_identity *identity, int64_t chain, int64_t place)
{
    const fst_grid *grid = identity->grid;
    const int64_t stride = fst_grid_axis_stride(grid, 0), count = fst_chain_length(identity);
    const int64_t first = chain / stride * (stride * count) + chain % stride;
    const int rises = fst_grid_value(grid, 0, first) <= fst_grid_value(grid, 0, first + (count - 1) * stride);
    const int forward = rises == (identity->carry == FST_CARRY_UP);
    return first + (forward ? place : count - 1 - place) * stride;
}

int64_t fst_chain_place(const fst_sweep_identity *identity, int64_t point, int64_t *chain)
{
    const int64_t stride = fst_grid_axis_stride(identity->grid, 0), count = fst_chain_length(identity);
    *chain = point / (stride * count) * stride + point % stride;
    const int64_t index = point / stride % count;
    return fst_chain_point(identity, *chain, index) == point ? index : count - 1 - index;
}

int fst_sweep_has_task(const fst_sweep_identity *identity, int64_t task)
{
    const int64_t shards = identity->shards;
    return (task % shards + task / shards % shards) % shards == identity->shard;
}

int64_t fst_sweep_task_count(const fst_sweep_identity *identity)
{
    const int64_t all =
        identity->carry == FST_CARRY_NO ? fst_grid_points(identity->grid) : fst_chain_count(identity);
    const int64_t shards = identity->shards, rounds = all / shards;
    const int64_t turn =
        (identity->shard + shards - rounds % shards) % shards; /* when it has one in the last round */
    return rounds + (turn < all % shards);
}

int64_t fst_sweep_point_count(const fst_sweep_identity *identity)
{
    return fst_sweep_task_count(identity) * (identity->carry == FST_CARRY_NO ? 1 : fst_chain_length(identity));
}

int fst_sweep_has_point(const fst_sweep_identity *identity, int64_t point)
{
    int64_t task = point;
    if (identity->carry != FST_CARRY_NO)
        (void)fst_chain_place(identity, point, &task);
    return fst_sweep_has_task(identity, task);
}
