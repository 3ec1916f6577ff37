/* module.c - loading a module, and finding out whether it could be loaded. */
/* dladdr() is an extension of the C library. */
#define _GNU_SOURCE
#include "host/module.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Where modules lie relative to this library: in the build tree, and installed. */
static const char *const places[] = {"/", "/festoon/"};

const void *fst_module_table(const char *file, const char *symbol, int *found)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const void *table = library ? dlsym(library, symbol) : NULL;
    *found = library != NULL;
    if (library)
        (void)dlclose(library);
    return table;
}

int fst_module_present(const char *file)
{
    Dl_info here;
    char path[4096];
    if (!dladdr((void *)&places, &here) || !here.dli_fname)
        return 0;
    const char *slash = strrchr(here.dli_fname, '/');
    int directory = slash ? (int)(slash - here.dli_fname) : 1;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; ++i) {
        int length =
            snprintf(path, sizeof path, "%.*s%s%s", directory, slash ? here.dli_fname : ".", places[i], file);
        if (length > 0 && (size_t)length < sizeof path && access(path, R_OK) == 0)
            return 1;
    }
    return 0;
}

int fst_module_usable(const char *file, char *lacks, size_t size)
{
    void *library = dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    const char *said = library ? "" : dlerror(); /* "libmpi.so.40: cannot open shared object file: ..." */
    lacks[0] = '\0';
    if (!library && fst_module_present(file))
        (void)snprintf(lacks, size, "%.*s", said ? (int)strcspn(said, ":") : 0, said ? said : "");
    if (library)
        (void)dlclose(library);
    return library != NULL;
}
