/* components.c - which optional parts of festoon this build and machine have, as `festoon --version` lists
 * them. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host/module.h"

/* Whether a program is found on PATH. */
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

#ifdef FESTOON_HAVE_EXPAT
enum { HAVE_EXPAT = 1 };
#else
enum { HAVE_EXPAT = 0 };
#endif

/* Append ", NAME yes", or NAME no with what helps. */
static void append(char *text, const char *name, int usable, const char *what_helps)
{
    const size_t used = strlen(text);
    (void)snprintf(text + used, FST_COMPONENTS_SIZE - used, "%s%s %s%s%s%s", used ? ", " : "", name,
                   usable ? "yes" : "no", usable ? "" : " (", usable ? "" : what_helps, usable ? "" : ")");
}

/* A module may have been built, and lack the library that it calls: then it is told which. */
static void append_module(char *text, const char *name, const char *file, const char *package)
{
    char lacks[128], what_helps[256];
    const int usable = fst_module_usable(file, lacks, sizeof lacks);
    if (lacks[0])
        (void)snprintf(what_helps, sizeof what_helps,
                       "%s is not on this machine: install the package that has it", lacks);
    else
        (void)snprintf(what_helps, sizeof what_helps, "install %s and build again", package);
    append(text, name, usable, what_helps);
}

const char *fst_tools_components(char text[FST_COMPONENTS_SIZE])
{
    text[0] = '\0';
    append(text, "gnuplot", program_present("gnuplot"), "install gnuplot-nox");
    append_module(text, "hdf5", FST_HDF5_MODULE, "libhdf5-dev");
    append_module(text, "cairo", FST_CAIRO_MODULE, "libcairo2-dev");
    append_module(text, "mpi", FST_MPI_MODULE, "libopenmpi-dev");
    append_module(text, "lapack", FST_LAPACK_MODULE, "liblapacke-dev");
    append_module(text, "cminpack", FST_MINPACK_MODULE, "libcminpack-dev");
    append(text, "expat", HAVE_EXPAT, "install libexpat1-dev and build again");
    append(text, "ffmpeg", program_present("ffmpeg"), "install ffmpeg");
    return text;
}
