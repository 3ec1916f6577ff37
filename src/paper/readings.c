/* readings.c - the second readings of statements. */
#include "paper/measures.h"
#include "paper/statements.h"

#include <string.h>

/* A name with "#2", which is no id of a statement, belongs to dry_statements.def alone. */
static const fst_reading readings[] = {
#define READING(of, first, words, chosen, said_, published_, scale_, unit_, digits_, rule_, measure_)          \
    {of,                                                                                                       \
     first,                                                                                                    \
     words,                                                                                                    \
     chosen,                                                                                                   \
     {.id = of "#2",                                                                                           \
      .said = said_,                                                                                           \
      .published = published_,                                                                                 \
      .scale = scale_,                                                                                         \
      .unit = unit_,                                                                                           \
      .digits = digits_,                                                                                       \
      .rule = FST_RULE_##rule_,                                                                                \
      .measure = fst_measure_##measure_}},
#include "paper/readings.def"
#undef READING
};
enum { COUNT = sizeof readings / sizeof readings[0] };

const fst_reading *fst_statement_reading(const fst_statement *statement)
{
    for (int i = 0; i < COUNT; ++i)
        if (strcmp(readings[i].id, statement->id) == 0)
            return &readings[i];
    return NULL;
}
