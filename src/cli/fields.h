/* fields.h - the library's names in its errors, and what a person types for them. */
#ifndef FST_CLI_FIELDS_H
#define FST_CLI_FIELDS_H

#include <stddef.h>

/* The library says where a fault lies by the field, "fst_sweep_options.lanes"; a person typed --lanes.  The
 * option of a field, which may be written to `text`; "" for the name of a function; any other text comes back as it
 * is. */
enum { FIELD_SIZE = 64 };
const char *option_of_field(const char *field, char text[FIELD_SIZE]);

/* The library says what would help by the function, "fst_locked_find() lists the states"; a person types
 * festoon locked.  The sentence with the commands in the place of their functions; `size` is at least 1. */
void name_commands(const char *sentence, char *text, size_t size);

#endif
