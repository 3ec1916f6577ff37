/* json_writer.h - the one way to make JSON.
 *
 * A document is written from its beginning to its end, with a member per call:
 *
 *     fst_json json = fst_json_begin('{');
 *     fst_json_real(&json, "omega", omega);
 *     fst_json_open(&json, "points", '[');
 *     fst_json_real(&json, NULL, value);         an element of a list has no key
 *     fst_json_close(&json);
 *     return fst_json_end(&json, JSON_INDENT(2));
 *
 * What fails on the way (memory) is remembered, and fst_json_end() then returns NULL: a document is whole or
 * there is none, and no caller looks at a single member.
 */
#ifndef FST_IO_JSON_WRITER_H
#define FST_IO_JSON_WRITER_H

#include <jansson.h>

#include <festoon/festoon.h>

enum { FST_JSON_DEPTH = 8 };

typedef struct fst_json {
    json_t *open[FST_JSON_DEPTH]; /* the objects and lists that are open, the document first */
    int depth;                    /* how many */
    int failed;
} fst_json;

/* Begin a document: '{' an object, '[' a list. */
fst_json fst_json_begin(char bracket);

/* Begin an object or a list in the open one, and end it. */
void fst_json_open(fst_json *json, const char *key, char bracket);
void fst_json_close(fst_json *json);

/* The text of the document with a newline at its end; free() it.  NULL: out of memory. */
char *fst_json_end(fst_json *json, size_t flags);

/* A value of jansson's; the reference is taken.  NULL: making it failed. */
void fst_json_put(fst_json *json, const char *key, json_t *value);
json_t *fst_json_number(double value);
json_t *fst_json_text_value(const char *text);

/* A number; null where it is not finite, because JSON has no NaN and no infinity. */
void fst_json_real(fst_json *json, const char *key, double value);
void fst_json_reals(fst_json *json, const char *key, const double *values, int count);
/* Pairs, as complex numbers are written: [[re, im], ...]. */
void fst_json_pairs(fst_json *json, const char *key, const double *re, const double *im, int count);
void fst_json_integer(fst_json *json, const char *key, int64_t value);
/* A place in a list; null where it is negative: there is none. */
void fst_json_place(fst_json *json, const char *key, int place);
void fst_json_flag(fst_json *json, const char *key, int value);
/* A text; null where it is NULL.  What is not UTF-8 is tamed. */
void fst_json_text(fst_json *json, const char *key, const char *text);
/* The name at a place of a '|'-separated list. */
void fst_json_name(fst_json *json, const char *key, const char *names, int place);

#endif
