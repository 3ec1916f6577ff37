/* surface.c - Newton's method on the surface of solutions over two parameters.
 *
 * Over one parameter solutions form a curve; with a second one, free too, they form a surface.  There are two
 * unknowns more than equations, so two rows close the linear system: the correction shall be perpendicular to
 * two given headings.
 *
 *       | rows of newton.c       f_second |  dx          gaps
 *       |                                 |  d first  =
 *       | <------- across[0] -----------> |  d second     0
 *       | <------- across[1] -----------> |               0
 *
 * Solved for the right-hand sides (0, 1, 0) and (0, 0, 1), the same matrix gives two vectors that span the
 * tangent plane.  Its shadow, the area of their parallelogram on the plane of the two parameters, vanishes
 * where the surface stands upright over that plane: at a fold.
 *
 * The column of the second parameter is taken from the same equations with the parameters exchanged.  It costs
 * as much as all other columns, so only the first iteration computes it; the later ones use the old one.
 */
#include "orbit/surface.h"

#include <string.h>

#include "base/error.h"
#include "model/params.h"
#include "orbit/newton.h"

enum { UNKNOWNS = FST_UNKNOWNS + 1, MOST_ITERATIONS = 12 };

double fst_heading_product(const fst_surface *surface, const fst_solution *of, const fst_heading *a,
                           const fst_heading *b)
{
    const double scale = surface->second.scale;
    return fst_direction_product(&surface->first, of, &a->d, &b->d) + a->second * b->second / (scale * scale);
}

void fst_heading_between(const fst_place *from, const fst_place *to, fst_heading *out)
{
    fst_direction_between(&from->s, &to->s, &out->d);
    out->second = to->second - from->second;
}

void fst_heading_combine(fst_heading *out, double a, const fst_heading *u, double b, const fst_heading *v)
{
    fst_direction_combine(&out->d, a, &u->d, b, &v->d);
    out->second = a * u->second + b * v->second;
}

void fst_place_move(fst_place *place, const fst_heading *heading, double length)
{
    fst_solution_move(&place->s, &heading->d, length);
    place->second += length * heading->second;
}

/* A family with another of its parameters, row `key`, at `value`. */
static fst_family with(const fst_family *family, int key, double value)
{
    fst_family out = *family;
    memcpy((char *)&out.params + fst_param_at(key)->offset, &value, sizeof value);
    return out;
}

fst_family fst_surface_first(const fst_surface *surface, double second)
{
    return with(&surface->first, surface->second.key, second);
}

/* The column of the second parameter: that of the same equations over it. */
static fst_status second_column(const fst_surface *surface, const fst_place *place, double *column,
                                fst_error *error)
{
    fst_newton_system l;
    fst_solution s = place->s;
    const fst_family family = with(&surface->second, surface->first.key, place->s.value);
    s.value = place->second;
    const fst_status status = fst_newton_equations(&family, &s, &l, error);
    for (int i = 0; status == FST_OK && i < l.rows; ++i)
        column[i] = l.a[i][l.size - 1];
    return status;
}

/* Solve for `columns` right-hand sides (n x columns by rows), the system closed by the two headings. */
static int solve_closed(const fst_surface *surface, const fst_place *place, fst_newton_system *l,
                        const double *second, const fst_heading across[2], int columns, double *b)
{
    const int n = l->size + 1;
    const double scale = surface->second.scale;
    double a[UNKNOWNS * UNKNOWNS];
    for (int i = 0; i < l->rows; ++i) {
        memcpy(a + i * n, l->a[i], (size_t)l->size * sizeof *a);
        a[i * n + n - 1] = second[i];
    }
    for (int i = 0; i < 2; ++i) {
        double *row = a + (l->rows + i) * n;
        memset(row, 0, (size_t)n * sizeof *row);
        fst_newton_row(&surface->first, &place->s, l, &across[i].d, row);
        row[n - 1] = across[i].second / (scale * scale);
    }
    return surface->first.lapack->solve(n, columns, a, b);
}

/* The basis dual to the two headings, its shadow, and an orthonormal one of the same orientation. */
static fst_status find_plane(const fst_surface *surface, fst_place *place, fst_newton_system *l,
                             const double *second, const fst_heading across[2], fst_error *error)
{
    const int n = l->size + 1;
    double b[2 * UNKNOWNS] = {0}, x[UNKNOWNS];
    b[2 * l->rows] = b[2 * (l->rows + 1) + 1] = 1.0;
    if (solve_closed(surface, place, l, second, across, 2, b) != 0)
        return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method", "its matrix is singular at %.10g, %.10g",
                        place->s.value, place->second);
    for (int c = 0; c < 2; ++c) {
        for (int i = 0; i < n; ++i)
            x[i] = b[2 * i + c];
        fst_newton_direction(&place->s, l, x, &place->plane[c].d);
        place->plane[c].second = x[n - 1];
    }
    fst_heading *u = &place->plane[0], *v = &place->plane[1];
    place->shadow =
        (u->d.value * v->second - v->d.value * u->second) / (surface->first.scale * surface->second.scale);
    const double length = sqrt(fst_heading_product(surface, &place->s, u, u));
    fst_heading_combine(u, 1.0 / length, u, 0.0, u);
    fst_heading_combine(v, 1.0, v, -fst_heading_product(surface, &place->s, u, v), u);
    const double across_length = sqrt(fst_heading_product(surface, &place->s, v, v));
    fst_heading_combine(v, 1.0 / across_length, v, 0.0, v);
    return FST_OK;
}

fst_status fst_place_correct(const fst_surface *surface, fst_place *place, const fst_heading across[2],
                             fst_error *error)
{
    fst_newton_system l;
    fst_solution *s = &place->s;
    double second[FST_UNKNOWNS], b[UNKNOWNS], before = INFINITY;
    for (place->iterations = 1; place->iterations <= MOST_ITERATIONS; ++place->iterations) {
        const fst_family family = fst_surface_first(surface, place->second);
        fst_status status = fst_newton_equations(&family, s, &l, error);
        /* The second parameter's column costs as much as all others; an old one costs hardly a digit. */
        if (status == FST_OK && place->iterations == 1)
            status = second_column(surface, place, second, error);
        if (status != FST_OK)
            return status;
        /* Tests along a special point's curve need all digits: only a held disc leaves fewer. */
        if (fst_newton_is_done(&family, s, before) &&
            (s->residual < family.residual || family.params.contact_patch == FST_PATCH_HERTZ)) {
            status = find_plane(surface, place, &l, second, across, error);
            return status == FST_OK ? fst_solution_spectrum(&family, s, error) : status;
        }
        if (!isfinite(s->residual) || (place->iterations > 4 && s->residual > before))
            break;
        before = s->residual;
        memcpy(b, l.b, (size_t)l.rows * sizeof *b);
        b[l.rows] = b[l.rows + 1] = 0.0;
        if (solve_closed(surface, place, &l, second, across, 1, b) != 0)
            break;
        fst_heading step;
        fst_newton_direction(s, &l, b, &step.d);
        step.second = b[l.size];
        const double size = sqrt(fst_heading_product(surface, s, &step, &step));
        if (!(size < 1.0))
            break;
        fst_place_move(place, &step, 1.0);
        if (s->segments > 0 && !(s->period > 1e-3 && s->period < 1e4))
            break;
    }
    return fst_fail(error, FST_NO_CONVERGENCE, "Newton's method",
                    "it did not converge at %.10g, %.10g: residual %.3g after %d iterations", s->value,
                    place->second, s->residual, place->iterations);
}
