/* lane_coefficients.inl - a part of lanes.inl: the coefficients of one run as a lane of a batch has them.
 *
 * Runs come and go, and steps are set aside, so often that only the numbers of the source in use are copied.
 */

/* The coefficients' REALs begin at `eps` in both, and follow each other in one order. */
enum {
    COEFFICIENTS = (sizeof(fst_coefficients_double) - offsetof(fst_coefficients_double, eps)) / sizeof(double)
};
_Static_assert(sizeof(FN(coefficients)) - offsetof(FN(coefficients), eps) == COEFFICIENTS * sizeof(REAL),
               "the model's wide and scalar coefficients have the same members");

/* A source has its own numbers at the beginning of a union: those behind them, up to the law's, mean nothing.
 */
enum {
    SOURCE_BEGINS =
        (offsetof(fst_coefficients_double, source) - offsetof(fst_coefficients_double, eps)) / sizeof(double),
    LAW_BEGINS =
        (offsetof(fst_coefficients_double, law) - offsetof(fst_coefficients_double, eps)) / sizeof(double)
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

static void load_coefficients(FN(coefficients) * to, int lane, const fst_coefficients_double *from)
{
    const double *numbers = (const double *)((const char *)from + offsetof(fst_coefficients_double, eps));
    double *wide = (double *)((char *)to + offsetof(FN(coefficients), eps));
    const int source_end = source_ends(&from->kinds);
    to->kinds = from->kinds;
    for (int i = 0; i < source_end; ++i)
        wide[i * FST_LANES + lane] = numbers[i];
    for (int i = LAW_BEGINS; i < COEFFICIENTS; ++i)
        wide[i * FST_LANES + lane] = numbers[i];
}

#ifdef FST_FUSED
/* From one lane to another, of another batch. */
static void move_coefficients(FN(coefficients) * to, int to_lane, const FN(coefficients) * from, int lane)
{
    const double *numbers = (const double *)((const char *)from + offsetof(FN(coefficients), eps));
    double *wide = (double *)((char *)to + offsetof(FN(coefficients), eps));
    const int source_end = source_ends(&from->kinds);
    to->kinds = from->kinds;
    for (int i = 0; i < source_end; ++i)
        wide[i * FST_LANES + to_lane] = numbers[i * FST_LANES + lane];
    for (int i = LAW_BEGINS; i < COEFFICIENTS; ++i)
        wide[i * FST_LANES + to_lane] = numbers[i * FST_LANES + lane];
}
#endif
