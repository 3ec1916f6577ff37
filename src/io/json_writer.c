/* json_writer.c - the one way to make JSON: a tree of jansson's that remembers the first failure. */
#include <festoon/festoon_tools.h>

#include "io/json_writer.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

fst_json fst_json_begin(char bracket)
{
    fst_json json = {.open = {bracket == '{' ? json_object() : json_array()}, .depth = 1};
    json.failed = !json.open[0];
    return json;
}

void fst_json_put(fst_json *json, const char *key, json_t *value)
{
    json_t *into = json->open[json->depth - 1];
    const int failed = key ? json_object_set_new(into, key, value) : json_array_append_new(into, value);
    json->failed = json->failed || failed;
}

void fst_json_open(fst_json *json, const char *key, char bracket)
{
    assert(json->depth < FST_JSON_DEPTH);
    json_t *inner = bracket == '{' ? json_object() : json_array();
    json_t *into = json->open[json->depth - 1];
    /* The document may refuse the new one and free it: what is written then must not go into it. */
    const int failed = key ? json_object_set_new(into, key, inner) : json_array_append_new(into, inner);
    json->open[json->depth++] = failed ? NULL : inner;
    json->failed = json->failed || failed;
}

void fst_json_close(fst_json *json)
{
    assert(json->depth > 1);
    --json->depth;
}

static int put_down(const char *letters, size_t size, void *out)
{
    (void)fwrite(letters, 1, size, out); /* the stream remembers a failure */
    return 0;
}

char *fst_json_end(fst_json *json, size_t flags)
{
    assert(json->depth == 1);
    fst_printed printed;
    FILE *out = fst_print_begin(&printed);
    /* json_dumps() would forget that it could not put a letter down. */
    if (out && !json->failed)
        json->failed = json_dump_callback(json->open[0], put_down, out, flags | JSON_REAL_PRECISION(17)) != 0;
    if (out)
        (void)fputc('\n', out);
    json_decref(json->open[0]);
    printed.failed |= json->failed;
    return fst_print_end(&printed);
}

json_t *fst_json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

void fst_json_real(fst_json *json, const char *key, double value)
{
    fst_json_put(json, key, fst_json_number(value));
}

void fst_json_reals(fst_json *json, const char *key, const double *values, int count)
{
    fst_json_open(json, key, '[');
    for (int i = 0; i < count; ++i)
        fst_json_put(json, NULL, fst_json_number(values[i]));
    fst_json_close(json);
}

void fst_json_pairs(fst_json *json, const char *key, const double *re, const double *im, int count)
{
    fst_json_open(json, key, '[');
    for (int i = 0; i < count; ++i)
        fst_json_reals(json, NULL, (const double[]){re[i], im[i]}, 2);
    fst_json_close(json);
}

void fst_json_integer(fst_json *json, const char *key, int64_t value)
{
    fst_json_put(json, key, json_integer((json_int_t)value));
}

void fst_json_place(fst_json *json, const char *key, int place)
{
    fst_json_put(json, key, place >= 0 ? json_integer(place) : json_null());
}

void fst_json_flag(fst_json *json, const char *key, int value)
{
    fst_json_put(json, key, json_boolean(value));
}

json_t *fst_json_text_value(const char *text)
{
    if (!text)
        return json_null();
    json_t *value = json_string(text);
    char *tame = value ? NULL : strdup(text);
    if (tame) {
        fst_text_tame(tame);
        value = json_string(tame);
        free(tame);
    }
    return value;
}

void fst_json_text(fst_json *json, const char *key, const char *text)
{
    fst_json_put(json, key, fst_json_text_value(text));
}

void fst_json_name(fst_json *json, const char *key, const char *names, int place)
{
    size_t length;
    const char *name = fst_name_at(names, place, &length);
    fst_json_put(json, key, json_stringn(name, length));
}
