/* text.h - text from outside, made fit for a message, a figure or a terminal. */
#ifndef FST_BASE_TEXT_H
#define FST_BASE_TEXT_H

#include <stddef.h>

#include <festoon/festoon.h> /* fst_text_tame() */

/* The most room that fst_quote() needs. */
#define FST_QUOTE_SIZE 80

/* Copy `text` between double quotes, tamed, with "..." where a long text is cut.  Returns `quoted`. */
const char *fst_quote(const char *text, char quoted[FST_QUOTE_SIZE]);

/* Strip white space from both ends of `text`: returns where the rest begins, and stores its length. */
const char *fst_trim(const char *text, size_t *length);

/* A letter of ASCII in lower case, in every locale. */
static inline int fst_lower(char letter)
{
    return letter >= 'A' && letter <= 'Z' ? letter - 'A' + 'a' : letter;
}

/* Whether a file's name has this ending, and more before it. */
int fst_ends_in(const char *name, const char *ending);

#endif
