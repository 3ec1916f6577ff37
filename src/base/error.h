/* error.h - filling the caller's fst_error. */
#ifndef FST_BASE_ERROR_H
#define FST_BASE_ERROR_H

#include <festoon/festoon.h>

/* Write code, place and sentence into `error` (nothing where it is NULL) and return `code`, so that a failing
 * function can end with `return fst_fail(...)`.  `where` may be NULL. */
fst_status fst_fail(fst_error *error, fst_status code, const char *where, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
