/* bench_parts.c - what the field of a real magnet costs: B and G u of a block, of a dipole, of a disc and of
 * the paper's five lines, in every form of lanes and for single runs, and of a block by the textbook's sums
 * over its corners with the C library's logarithm and arctangent. */
#include <stdio.h>
#include <time.h>

#include "model/model.h"
#include "parts_field.h"

enum { ROUNDS = 2000, PLACES = 4096 };

double parts_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ------------------------------------------------------------------ the textbook's way */

/* B and G of a block of remanence j at d from its centre, corner by corner. */
static void textbook(const double half[3], const double j[3], const double d[3], double b[3], double g[3][3])
{
    double n[3][3] = {{0}}, t[3][3][3] = {{{0}}};
    for (int corner = 0; corner < 8; ++corner) {
        double u[3];
        int sign = 1;
        for (int i = 0; i < 3; ++i) {
            const int upper = corner >> i & 1;
            u[i] = d[i] + (upper ? -half[i] : half[i]);
            sign = upper ? -sign : sign;
        }
        const double r = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        t[0][1][2] += sign / r;
        for (int a = 0; a < 3; ++a) {
            const int v = (a + 1) % 3, w = (a + 2) % 3;
            n[a][a] -= sign * atan(u[v] * u[w] / (u[a] * r));
            n[v][w] += sign * log(r + u[a]);
            t[v][v][w] += sign * u[v] / (r * (r + u[a]));
            t[v][w][w] += sign * u[w] / (r * (r + u[a]));
        }
    }
    for (int a = 0; a < 3; ++a) {
        const int v = (a + 1) % 3, w = (a + 2) % 3;
        n[w][v] = n[v][w];
        t[a][a][a] = -(t[a][v][v] + t[w][a][a]);
    }
    const double third[3][3][3] = {{{t[0][0][0], t[0][0][1], t[2][0][0]},
                                    {t[0][0][1], t[0][1][1], t[0][1][2]},
                                    {t[2][0][0], t[0][1][2], t[2][2][0]}},
                                   {{t[0][0][1], t[0][1][1], t[0][1][2]},
                                    {t[0][1][1], t[1][1][1], t[1][1][2]},
                                    {t[0][1][2], t[1][1][2], t[1][2][2]}},
                                   {{t[2][0][0], t[0][1][2], t[2][2][0]},
                                    {t[0][1][2], t[1][1][2], t[1][2][2]},
                                    {t[2][2][0], t[1][2][2], t[2][2][2]}}};
    for (int a = 0; a < 3; ++a) {
        b[a] = (n[a][0] * j[0] + n[a][1] * j[1] + n[a][2] * j[2]) / (2 * FST_TWO_PI);
        for (int c = 0; c < 3; ++c)
            g[a][c] =
                (third[a][c][0] * j[0] + third[a][c][1] * j[1] + third[a][c][2] * j[2]) / (2 * FST_TWO_PI);
    }
}

static void place_of(int n, double *x, double *y)
{
    *x = -1.5 + 3.0 * ((n * 0.61803398874989485) - (int)(n * 0.61803398874989485));
    *y = -1.5 + 3.0 * ((n * 0.41421356237309505) - (int)(n * 0.41421356237309505));
}

static double seconds_of_textbook(const fst_world_double *c)
{
    const fst_part_double *part = &c->source.parts.part[0];
    const double u[3] = {0.6, -0.48, 0.64};
    double least = 1e300;
    volatile double seen;
    for (int round = 0; round < 20; ++round) {
        double sum = 0;
        const double began = parts_now();
        for (int i = 0; i < PLACES; ++i) {
            double d[3], b[3], g[3][3];
            place_of(i, &d[0], &d[1]);
            d[2] = c->height;
            textbook(part->half, part->j, d, b, g);
            for (int k = 0; k < 3; ++k)
                sum += b[k] + g[k][0] * u[0] + g[k][1] * u[1] + g[k][2] * u[2];
        }
        const double seconds = (parts_now() - began) / PLACES;
        least = seconds < least ? seconds : least;
        seen = sum;
    }
    (void)seen;
    return least;
}

/* ------------------------------------------------------------------ ours */

static double seconds_of_single(const fst_world_double *c)
{
    const double u[3] = {0.6, -0.48, 0.64};
    double least = 1e300;
    volatile double seen;
    for (int round = 0; round < 20; ++round) {
        double sum = 0;
        const double began = parts_now();
        for (int i = 0; i < PLACES; ++i) {
            double x, y, b[3], gu[3];
            place_of(i, &x, &y);
            fst_field_along_double(c, x, y, c->height, u, b, gu);
            sum += b[0] + b[1] + b[2] + gu[0] + gu[1] + gu[2];
        }
        const double seconds = (parts_now() - began) / PLACES;
        least = seconds < least ? seconds : least;
        seen = sum;
    }
    (void)seen;
    return least;
}

enum { LINES, BLOCK, DIPOLE, DISC, MAGNETS };

static fst_params magnet(int which)
{
    fst_params p = fst_default_params();
    if (which == LINES)
        return p;
    p.magnet_shape = FST_MAGNET_PARTS;
    p.magnet_part_count = 1;
    p.magnet_parts[0] = (fst_magnet_part){.kind = FST_PART_CUBOID, .size = {56e-3, 40e-3, 9e-3}};
    p.magnet_parts[0].remanence[0] = 1.2;
    if (which == DIPOLE)
        p.magnet_parts[0] = (fst_magnet_part){.kind = FST_PART_DIPOLE, .moment = {19.0}};
    if (which == DISC)
        p.magnet_parts[0] =
            (fst_magnet_part){.kind = FST_PART_CYLINDER, .size = {40e-3, 9e-3}, .remanence = {1.2, 0.0, 0.3}};
    return p;
}

static void print_row(const char *name, const double seconds[MAGNETS])
{
    (void)printf("%-22s %8.2f %8.2f %8.2f %8.2f ns      over lines: block %5.2f   dipole %5.2f   disc %5.2f\n",
                 name, 1e9 * seconds[LINES], 1e9 * seconds[BLOCK], 1e9 * seconds[DIPOLE], 1e9 * seconds[DISC],
                 seconds[BLOCK] / seconds[LINES], seconds[DIPOLE] / seconds[LINES],
                 seconds[DISC] / seconds[LINES]);
}

int main(void)
{
    fst_params params[MAGNETS];
    fst_groups groups[MAGNETS];
    fst_world_double single[MAGNETS];
    double seconds[MAGNETS];
    for (int i = 0; i < MAGNETS; ++i) {
        fst_error error;
        fst_model *model;
        params[i] = magnet(i);
        if (fst_model_new(&params[i], &model, &error) != FST_OK)
            return puts(error.sentence), 1;
        groups[i] = fst_model_groups(model);
        single[i] = model->world;
        fst_model_free(model);
    }
    (void)printf("B and G u at a place       lines    block   dipole     disc\n");
#ifdef PARTS_FIELD_LANES
#define PRINT(name, instructions)                                                                              \
    if (__builtin_cpu_supports(instructions)) {                                                                \
        for (int i = 0; i < MAGNETS; ++i)                                                                      \
            seconds[i] = parts_field_##name(&params[i], &groups[i], ROUNDS);                                   \
        print_row("lanes " #name, seconds);                                                                    \
    }
    PARTS_FIELD_FORMS(PRINT)
#undef PRINT
#endif
    for (int i = 0; i < MAGNETS; ++i)
        seconds[i] = seconds_of_single(&single[i]);
    print_row("single", seconds);
    const double by_corners = seconds_of_textbook(&single[BLOCK]);
    (void)printf("%-31s %8.2f                   ns      textbook/single %5.2f\n", "corner by corner, libm",
                 1e9 * by_corners, by_corners / seconds[BLOCK]);
    return 0;
}
