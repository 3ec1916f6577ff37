/* lane_world.inl - a part of lanes.inl: the world and the modes of one run as a lane of a batch
 * has them.
 *
 * Runs come and go, and steps are set aside, so often that only the numbers of the source in use are copied.
 */

/* The world's REALs begin at `eps` in both, and follow each other in one order. */
enum { COEFFICIENTS = (sizeof(fst_world_double) - offsetof(fst_world_double, eps)) / sizeof(double) };
_Static_assert(sizeof(FN(world)) - offsetof(FN(world), eps) == COEFFICIENTS * sizeof(REAL),
               "the model's wide and scalar worlds have the same members");

/* A source has its own numbers at the beginning of a union: those behind them, up to the law's, mean nothing.
 */
enum {
    SOURCE_BEGINS = (offsetof(fst_world_double, source) - offsetof(fst_world_double, eps)) / sizeof(double),
    LAW_BEGINS = (offsetof(fst_world_double, law) - offsetof(fst_world_double, eps)) / sizeof(double)
};

static int source_ends(const fst_kinds *kinds)
{
    if (kinds->source == FST_MAGNET_PARTS)
        return SOURCE_BEGINS +
               (int)((offsetof(fst_parts_double, part) + (size_t)kinds->pieces * sizeof(fst_part_double)) /
                     sizeof(double));
    return kinds->source == FST_MAGNET_LINES ? SOURCE_BEGINS + (int)(sizeof(fst_lines_double) / sizeof(double))
                                             : LAW_BEGINS;
}

static void load_world(FN(world) * to, int lane, const fst_world_double *from)
{
    const double *numbers = (const double *)((const char *)from + offsetof(fst_world_double, eps));
    double *wide = (double *)((char *)to + offsetof(FN(world), eps));
    const int source_end = source_ends(&from->kinds);
    to->kinds = from->kinds;
    for (int i = 0; i < source_end; ++i)
        wide[i * FST_LANES + lane] = numbers[i];
    for (int i = LAW_BEGINS; i < COEFFICIENTS; ++i)
        wide[i * FST_LANES + lane] = numbers[i];
}

#if KNOWS_DRY
static void load_modes(FN(modes) * to, int lane, const fst_modes_double *from)
{
    const double *numbers = (const double *)from;
    double *wide = (double *)to;
    for (size_t i = 0; i < sizeof *from / sizeof *numbers; ++i)
        wide[i * FST_LANES + (size_t)lane] = numbers[i];
}
#endif

#ifdef FST_FUSED
/* From one lane to another, of another batch. */
static void move_world(FN(world) * to, int to_lane, const FN(world) * from, int lane)
{
    const double *numbers = (const double *)((const char *)from + offsetof(FN(world), eps));
    double *wide = (double *)((char *)to + offsetof(FN(world), eps));
    const int source_end = source_ends(&from->kinds);
    to->kinds = from->kinds;
    for (int i = 0; i < source_end; ++i)
        wide[i * FST_LANES + to_lane] = numbers[i * FST_LANES + lane];
    for (int i = LAW_BEGINS; i < COEFFICIENTS; ++i)
        wide[i * FST_LANES + to_lane] = numbers[i * FST_LANES + lane];
}

#if KNOWS_DRY
static void move_modes(FN(modes) * to, int to_lane, const FN(modes) * from, int lane)
{
    const double *numbers = (const double *)from;
    double *wide = (double *)to;
    for (size_t i = 0; i < sizeof *from / sizeof(REAL); ++i)
        wide[i * FST_LANES + (size_t)to_lane] = numbers[i * FST_LANES + (size_t)lane];
}
#endif
#endif
