/* error.c - filling the caller's error, the texts of the statuses, and the version. */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"

fst_status fst_fail(fst_error *error, fst_status code, const char *where, const char *format, ...)
{
    if (!error)
        return code;
    char sentence[sizeof error->sentence];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    /* The arguments may point into the old error, so both fields are replaced only now. */
    char place[sizeof error->where];
    (void)snprintf(place, sizeof place, "%s", where ? where : "");
    /* Both may quote a file's name or contents, and both go to a terminal. */
    fst_text_tame(place);
    fst_text_tame(sentence);
    error->code = code;
    memcpy(error->where, place, sizeof place);
    memcpy(error->sentence, sentence, sizeof sentence);
    return code;
}

const char *fst_status_text(fst_status status)
{
    switch (status) {
#define TEXT_CASE(name, text)                                                                                  \
    case name:                                                                                                 \
        return text;
        FST_STATUS_LIST(TEXT_CASE)
#undef TEXT_CASE
    }
    return "unknown status";
}

const char *fst_version(void)
{
    return FST_VERSION_STRING;
}
