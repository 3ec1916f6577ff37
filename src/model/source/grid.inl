/* grid.inl - the source `grid`: a measured field, by B-splines of degree 7, over REAL.
 *
 * The components on one plane, that of the bead's centre, are splines through the samples of a map
 * (model/field_map.h).  The plane was chosen by the height of a bead on the plate (kinds.plane), and no other
 * is known: a height z other than the plane's never comes here, because a bead beside a map may not fly. In a
 * cell a component is the sum of 8 x 8 coefficients, each times a weight of x and one of y.  Degree 7 keeps the
 * fifth derivative of the forces continuous, so that steps of order 8 need not know where the cells end.
 *
 * The samples have a curl, because each component has its own errors; see local_field.inl.
 */
typedef struct FN(grid) {
    REAL first[2];          /* place of the first sample, in l */
    REAL cells_per_unit[2]; /* cells in a length of l */
    REAL strength;          /* 1 T in B0 */
} FN(grid);

static inline FN(grid) FN(make_grid)(const fst_params *params, const fst_groups *g)
{
    const fst_map_plane *plane = fst_map_plane_at(params->magnet_map, g->h * g->length_unit);
    FN(grid) grid;
    for (int axis = 0; axis < 2; ++axis) {
        grid.first[axis] = REAL_OF(plane->first[axis]) / REAL_OF(g->length_unit);
        grid.cells_per_unit[axis] = REAL_OF(g->length_unit) / REAL_OF(plane->spacing[axis]);
    }
    grid.strength = R(1.0) / REAL_OF(g->field_unit);
    return grid;
}

/* ------------------------------------------------------------------ cells */

/* The number of the cell at u, counted in cells.  Beyond the samples it is the last one, whose polynomial goes
 * on: a step that leaves the map looks there before the run ends at the map's edge. */
#define GRID_CELL(u, count) ((u) >= 0 ? (u) < (count) ? (int)(u) : (count)-1 : 0)

/* Where the coefficients of the cell at (u, v) begin, and the place within the cell.  Each lane has its own. */
#ifdef REAL_IS_SCALAR
typedef const double *FN(grid_cell);
#define GRID_COEFFICIENT(cell, at) REAL_OF((cell)[at])

static inline FN(grid_cell) FN(find_cell)(const fst_map_plane *plane, REAL place[2])
{
    const int i = GRID_CELL(place[0], plane->cells[0]), j = GRID_CELL(place[1], plane->cells[1]);
    place[0] = place[0] - REAL_OF(i);
    place[1] = place[1] - REAL_OF(j);
    return plane->coefficients + ((size_t)j * (size_t)plane->stride + (size_t)i) * FST_MAP_COMPONENTS;
}
#else
typedef struct FN(grid_cell) {
    const double *of[FST_LANES];
} FN(grid_cell);
#define GRID_COEFFICIENT(cell, at) FN(gather)(&(cell), at)

static inline __attribute__((always_inline)) REAL FN(gather)(const FN(grid_cell) * cell, size_t at)
{
    REAL all = R(0.0);
    for (int lane = 0; lane < FST_LANES; ++lane)
        all[lane] = cell->of[lane][at];
    return all;
}

static inline FN(grid_cell) FN(find_cell)(const fst_map_plane *plane, REAL place[2])
{
    FN(grid_cell) cell;
    for (int lane = 0; lane < FST_LANES; ++lane) {
        const int i = GRID_CELL(place[0][lane], plane->cells[0]);
        const int j = GRID_CELL(place[1][lane], plane->cells[1]);
        place[0][lane] = place[0][lane] - (double)i;
        place[1][lane] = place[1][lane] - (double)j;
        cell.of[lane] =
            plane->coefficients + ((size_t)j * (size_t)plane->stride + (size_t)i) * FST_MAP_COMPONENTS;
    }
    return cell;
}
#endif

/* ------------------------------------------------------------------ weights */

/* The eight splines at t in a cell, and their first and second derivatives by the cell's length, times 7!, 6!
 * and 5!.  With w^p_k = p! M_p(t + p - k), M_p the B-spline of degree p on the nodes 0 to p + 1,
 *
 *     w^p_k = (t + p - k) w^(p-1)_(k-1) + (k + 1 - t) w^(p-1)_k,      M_p'(x) = M_(p-1)(x) - M_(p-1)(x - 1)
 *
 * (de Boor, A Practical Guide to Splines, chapter IX). */
typedef struct FN(grid_weights) {
    REAL value[FST_SPLINE_NODES], slope[FST_SPLINE_NODES], bend[FST_SPLINE_NODES];
} FN(grid_weights);

/* to[k] = from[k - 1] - from[k], where from has `count` numbers, and none beyond. */
static inline __attribute__((always_inline)) void FN(differences)(int count, const REAL *from, REAL *to)
{
    to[0] = -from[0];
    for (int k = 1; k < count; ++k)
        to[k] = from[k - 1] - from[k];
    to[count] = from[count - 1];
}

static inline __attribute__((always_inline)) void FN(weigh_nodes)(REAL t, FN(grid_weights) * w)
{
    REAL *v = w->value, first_difference[FST_SPLINE_DEGREE];
    v[0] = R(1.0);
    for (int p = 1; p <= FST_SPLINE_DEGREE; ++p) {
        if (p == FST_SPLINE_DEGREE) /* v has degree 6 */
            FN(differences)(p, v, w->slope);
        if (p == FST_SPLINE_DEGREE - 1) { /* v has degree 5 */
            FN(differences)(p, v, first_difference);
            FN(differences)(p + 1, first_difference, w->bend);
        }
        v[p] = t * v[p - 1];
        for (int k = p - 1; k > 0; --k)
            v[k] = REAL_MULADD(t + REAL_OF(p - k), v[k - 1], (REAL_OF(k + 1) - t) * v[k]);
        v[0] = (R(1.0) - t) * v[0];
    }
}

/* ------------------------------------------------------------------ the field */

/* A component's sums over the 8 x 8 coefficients: x and y say by which axes it is differentiated. */
typedef struct FN(grid_sums) {
    REAL b, x, y, xx, xy, yy;
} FN(grid_sums);

static inline __attribute__((always_inline)) FN(grid_sums)
    FN(add_up)(FN(grid_cell) cell, const FN(grid_weights) * along_x, const FN(grid_weights) * along_y,
               int stride, int component)
{
    const REAL zero = R(0.0);
    FN(grid_sums) sum = {zero, zero, zero, zero, zero, zero};
    for (int l = 0; l < FST_SPLINE_NODES; ++l) {
        REAL value = zero, slope = zero, bend = zero;
        for (int k = 0; k < FST_SPLINE_NODES; ++k) {
            const size_t at = ((size_t)l * (size_t)stride + (size_t)k) * FST_MAP_COMPONENTS + (size_t)component;
            const REAL c = GRID_COEFFICIENT(cell, at);
            value = REAL_MULADD(along_x->value[k], c, value);
            slope = REAL_MULADD(along_x->slope[k], c, slope);
            bend = REAL_MULADD(along_x->bend[k], c, bend);
        }
        sum.b = REAL_MULADD(along_y->value[l], value, sum.b);
        sum.x = REAL_MULADD(along_y->value[l], slope, sum.x);
        sum.y = REAL_MULADD(along_y->slope[l], value, sum.y);
        sum.xx = REAL_MULADD(along_y->value[l], bend, sum.xx);
        sum.xy = REAL_MULADD(along_y->slope[l], slope, sum.xy);
        sum.yy = REAL_MULADD(along_y->bend[l], value, sum.yy);
    }
    return sum;
}

static inline __attribute__((always_inline)) void FN(grid_look)(const FN(grid) * grid, const fst_kinds *kinds,
                                                                REAL x, REAL y, REAL z, FN(local_field) * at)
{
    (void)z;
    REAL place[2] = {(x - grid->first[0]) * grid->cells_per_unit[0],
                     (y - grid->first[1]) * grid->cells_per_unit[1]};
    const FN(grid_cell) cell = FN(find_cell)(kinds->plane, place);
    FN(grid_weights) along_x, along_y;
    FN(weigh_nodes)(place[0], &along_x);
    FN(weigh_nodes)(place[1], &along_y);
    /* 7! = 5040, 6! = 720, 5! = 120 */
    const REAL px = grid->cells_per_unit[0], py = grid->cells_per_unit[1], f = grid->strength;
    const REAL of_value = f / R(25401600.0), of_slope = f / R(3628800.0);
    const REAL by_x = px * of_slope, by_y = py * of_slope;
    const REAL by_xx = px * px * (f / R(604800.0)), by_yy = py * py * (f / R(604800.0));
    const REAL by_xy = px * py * (f / R(518400.0));
    FN(gradient) *g = &at->gradient;
    FN(bend) *t = &at->bend;
    const FN(grid_sums) bx = FN(add_up)(cell, &along_x, &along_y, kinds->plane->stride, 0);
    const FN(grid_sums) by = FN(add_up)(cell, &along_x, &along_y, kinds->plane->stride, 1);
    const FN(grid_sums) bz = FN(add_up)(cell, &along_x, &along_y, kinds->plane->stride, 2);
    at->b[0] = of_value * bx.b;
    at->b[1] = of_value * by.b;
    at->b[2] = of_value * bz.b;
    g->xx = by_x * bx.x;
    g->xy = by_y * bx.y;
    g->yx = by_x * by.x;
    g->yy = by_y * by.y;
    g->xz = by_x * bz.x;
    g->yz = by_y * bz.y;
    t->scale = t->vertical = R(1.0);
    t->xxx = by_xx * bx.xx;
    t->xxy = by_xy * bx.xy;
    t->xyy = by_yy * bx.yy;
    t->yxx = by_xx * by.xx;
    t->yxy = by_xy * by.xy;
    t->yyy = by_yy * by.yy;
    t->xxz = by_xx * bz.xx;
    t->xyz = by_xy * bz.xy;
    t->yyz = by_yy * bz.yy;
}

SOURCE_FIELD_BY_LOOK(grid)

/* As SOURCE_ALONG_BY_FIELD(), of a field with curl. */
static inline void FN(grid_along)(const FN(grid) * grid, const fst_kinds *kinds, REAL x, REAL y, REAL z,
                                  const REAL u[3], REAL b[3], REAL gu[3])
{
    FN(gradient) g;
    FN(grid_field)(grid, kinds, x, y, z, b, &g);
    FN(times_gradient)(&g, u, gu);
}

#undef GRID_CELL
#undef GRID_COEFFICIENT
