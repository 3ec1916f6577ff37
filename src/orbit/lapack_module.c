/* lapack_module.c - festoon-lapack.so: the few calls of LAPACK, by LAPACKE, in memory of our own: what LAPACKE
 * cannot allocate it would tell by the status of a matrix that has no solution. */
#include "orbit/lapack.h"

#include <lapacke.h>
#include <math.h>

enum {
    LARGEST = 98,       /* eight beads have 88 directions, with a period and a parameter */
    WORK = LARGEST * 96 /* dgeev() and dgelss() ask for less: blocks of 32 or 64 columns */
};

/* Rows become columns: `to` has `columns` rows.  0 where an element is not a number. */
static int turn(int rows, int columns, const double *from, double *to)
{
    int numbers = 1;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            to[j * rows + i] = from[i * columns + j];
            numbers = numbers && !isnan(from[i * columns + j]);
        }
    return numbers;
}

static int solve(int n, int columns, double *a, double *b)
{
    lapack_int pivots[LARGEST];
    double left[LARGEST * LARGEST], right[LARGEST * LARGEST];
    if (n > LARGEST || columns > LARGEST || !turn(n, n, a, left) || !turn(n, columns, b, right))
        return -1;
    const lapack_int singular = LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, columns, left, n, pivots, right, n);
    (void)turn(n, n, left, a);
    (void)turn(columns, n, right, b);
    return (int)singular;
}

static int shortest(int n, double *a, double *b, double least, int *rank)
{
    double turned[LARGEST * LARGEST], singular[LARGEST], work[WORK], size;
    lapack_int found = 0;
    if (n > LARGEST || !turn(n, n, a, turned))
        return -1;
    lapack_int failed =
        LAPACKE_dgelss_work(LAPACK_COL_MAJOR, n, n, 1, turned, n, b, n, singular, least, &found, &size, -1);
    if (failed || size > WORK)
        return -1;
    failed = LAPACKE_dgelss_work(LAPACK_COL_MAJOR, n, n, 1, turned, n, b, n, singular, least, &found, work,
                                 (lapack_int)size);
    *rank = (int)found;
    return (int)failed;
}

static int eigen(int n, double *a, double *re, double *im, double *vectors)
{
    double turned[LARGEST * LARGEST], found[LARGEST * LARGEST], work[WORK], size;
    const char wanted = vectors ? 'V' : 'N';
    if (n > LARGEST || !turn(n, n, a, turned))
        return -1;
    lapack_int failed =
        LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', wanted, n, turned, n, re, im, NULL, n, found, n, &size, -1);
    if (failed || size > WORK)
        return -1;
    failed = LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', wanted, n, turned, n, re, im, NULL, n, found, n, work,
                                (lapack_int)size);
    if (vectors)
        (void)turn(n, n, found, vectors);
    return (int)failed;
}

FST_API extern const fst_lapack fst_lapack_module;
const fst_lapack fst_lapack_module = {
    .version = FST_VERSION_STRING,
    .solve = solve,
    .shortest = shortest,
    .eigen = eigen,
};
