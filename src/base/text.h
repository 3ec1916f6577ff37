/* text.h - text from outside, made fit for a message, a figure or a terminal. */
#ifndef FST_BASE_TEXT_H
#define FST_BASE_TEXT_H

#include <stddef.h>

#include <festoon/festoon.h> /* fst_text_tame() */

/* Room that fst_quote() needs at most. */
#define FST_QUOTE_SIZE 80

/* Copy `text` between double quotes, tamed, long text cut with "..."; returns `quoted`. */
const char *fst_quote(const char *text, char quoted[FST_QUOTE_SIZE]);

/* `text` without white space at both ends: returns its beginning and stores its length. */
const char *fst_trim(const char *text, size_t *length);

#endif
