/* dry_statements.c - which statements have a third column, and what measures it. */
#include "paper/measures.h"
#include "paper/statements.h"

#include <string.h>

static const struct {
    const char *id;
    fst_measure measure;
} rows[] = {
#define DRY(id, measure) {id, fst_measure_##measure},
#include "paper/dry_statements.def"
#undef DRY
};

fst_measure fst_statement_dry(const fst_statement *statement)
{
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        if (strcmp(rows[i].id, statement->id) == 0)
            return rows[i].measure;
    return NULL;
}
