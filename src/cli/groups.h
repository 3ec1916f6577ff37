/* groups.h - the scaled groups of a model, in words. */
#ifndef FST_CLI_GROUPS_H
#define FST_CLI_GROUPS_H

#include <stdio.h>

#include <festoon/festoon.h>

#define TWO_PI 6.283185307179586476925287

/* Print the groups, and the units in which everything else is scaled. */
void print_groups(FILE *out, const fst_groups *groups);

#endif
