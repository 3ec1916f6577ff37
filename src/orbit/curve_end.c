/* curve_end.c - why a curve of solutions ends: an enum for programs, a sentence for people. */
#include "orbit/curve_end.h"

#include <stdarg.h>
#include <stdio.h>

const char *fst_end_name(fst_end_type type)
{
    static const char *const names[] = {
        [FST_END_NONE] = "none",
        [FST_END_RANGE] = "range",
        [FST_END_CLOSED] = "closed",
        [FST_END_SYMMETRIC_ORBIT] = "symmetric-orbit",
        [FST_END_EQUILIBRIUM] = "equilibrium",
        [FST_END_HIGHER_SYMMETRY] = "higher-symmetry",
        [FST_END_OTHER_BRANCH] = "other-branch",
        [FST_END_PERIOD] = "period",
        [FST_END_RADIUS] = "radius",
        [FST_END_SPIN] = "spin",
        [FST_END_REAL_AXIS] = "real-axis",
        [FST_END_NOT_BEGUN] = "not-begun",
        [FST_END_COUNT_LIMIT] = "count-limit",
        [FST_END_ROLLS] = "rolls",
        [FST_END_LIFTED] = "lifted",
        [FST_END_LOST] = "lost",
    };
    return (unsigned)type < sizeof names / sizeof *names ? names[type] : "unknown";
}

void fst_curve_end_set(fst_curve_end *end, fst_end_type type, const char *format, ...)
{
    va_list arguments;
    end->type = type;
    va_start(arguments, format);
    (void)vsnprintf(end->reason, sizeof end->reason, format, arguments);
    va_end(arguments);
}
