#include "results.h"

#include <stdio.h>
#include <stdlib.h>

void result_put(const char *table, const char *row, const char *column, const char *format, double value)
{
    const char *path = getenv("PERFORMANCE_TSV");
    FILE *out = path ? fopen(path, "a") : NULL;
    if (!out) {
        if (path)
            perror(path);
        return;
    }
    (void)fprintf(out, "%s\t%s\t%s\t", table, row, column);
    (void)fprintf(out, format, value);
    (void)fputc('\n', out);
    if (fclose(out) != 0)
        perror(path);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double result_median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[count / 2];
}
