/* error.c - filling the caller's error, the texts of the statuses, and the version. */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/text.h"

fst_status fst_fail(fst_error *error, fst_status code, const char *where, const char *format, ...)
{
    if (!error)
        return code;
    fst_error made = {code, "", ""}; /* the arguments may point into the old one */
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(made.sentence, sizeof made.sentence, format, arguments);
    va_end(arguments);
    (void)snprintf(made.where, sizeof made.where, "%s", where ? where : "");
    /* Both may quote a file's name or contents, and both go to a terminal. */
    fst_text_tame(made.where);
    fst_text_tame(made.sentence);
    *error = made;
    return code;
}

const char *fst_status_text(fst_status status)
{
#define TEXT(name, text) text,
    static const char *const texts[] = {FST_STATUS_LIST(TEXT)};
#undef TEXT
    return (unsigned)status < FST_STATUS_COUNT ? texts[status] : "unknown status";
}

const char *fst_version(void)
{
    return FST_VERSION_STRING;
}
