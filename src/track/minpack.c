/* minpack.c - loading the module that calls cminpack. */
#include "track/minpack.h"

#include <string.h>

#include "base/error.h"
#include "host/module.h"

fst_status fst_minpack_load(const fst_minpack **minpack, fst_error *error)
{
    int found = 0;
    *minpack = fst_module_table(FST_MINPACK_MODULE, FST_MINPACK_MODULE_SYMBOL, &found);
    if (!*minpack)
        return fst_fail(
            error, FST_UNAVAILABLE, FST_MINPACK_MODULE,
            "this festoon has no cminpack, which fits parameters: install libcminpack-dev and build festoon "
            "again");
    if (strcmp((*minpack)->version, fst_version()) != 0)
        return fst_fail(error, FST_UNAVAILABLE, FST_MINPACK_MODULE,
                        "%s belongs to festoon %s, not to %s: install festoon again", FST_MINPACK_MODULE,
                        (*minpack)->version, fst_version());
    return FST_OK;
}
