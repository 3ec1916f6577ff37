/* lapack.c - loading the module that calls LAPACK. */
#include "orbit/lapack.h"

#include <dlfcn.h>
#include <string.h>

#include "base/error.h"

#define MODULE_FILE "festoon-lapack.so"

int fst_lapack_present(void)
{
    const fst_lapack *lapack;
    return fst_lapack_load(&lapack, NULL) == FST_OK;
}

/* The module is found along the RUNPATH of this library, and stays loaded. */
fst_status fst_lapack_load(const fst_lapack **lapack, fst_error *error)
{
    void *library = dlopen(MODULE_FILE, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const char *said = library ? NULL : dlerror(); /* what is missing: a file, or memory */
    *lapack = library ? dlsym(library, FST_LAPACK_MODULE_SYMBOL) : NULL;
    fst_status status = FST_OK;
    if (!*lapack)
        status = fst_fail(error, FST_UNAVAILABLE, MODULE_FILE,
                          "this festoon has no LAPACK (%s): install liblapacke-dev and build festoon again",
                          library ? MODULE_FILE " is not a module of festoon"
                          : said  ? said
                                  : MODULE_FILE " cannot be loaded");
    else if (strcmp((*lapack)->version, fst_version()) != 0)
        status = fst_fail(error, FST_UNAVAILABLE, MODULE_FILE,
                          "%s belongs to festoon %s, not to %s: install festoon again", MODULE_FILE,
                          (*lapack)->version, fst_version());
    if (library)
        (void)dlclose(library);
    return status;
}
