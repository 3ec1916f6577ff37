/* components.c - the optional parts of festoon, as `festoon --version` lists them. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "io/hdf5_present.h"

/* Whether a program is found along PATH. */
static int program_present(const char *name)
{
    const char *path = getenv("PATH");
    char candidate[4096];
    while (path && *path) {
        size_t length = strcspn(path, ":");
        int size = snprintf(candidate, sizeof candidate, "%.*s/%s", (int)length, path, name);
        if (size > 0 && (size_t)size < sizeof candidate && access(candidate, X_OK) == 0)
            return 1;
        path += length;
        path += *path == ':';
    }
    return 0;
}

const char *fst_tools_components(void)
{
    static const char *const texts[2][2] = {
        {"gnuplot no (install gnuplot-nox), hdf5 no (install libhdf5-dev and build again)",
         "gnuplot no (install gnuplot-nox), hdf5 yes"},
        {"gnuplot yes, hdf5 no (install libhdf5-dev and build again)", "gnuplot yes, hdf5 yes"},
    };
    return texts[program_present("gnuplot")][fst_hdf5_present()];
}
