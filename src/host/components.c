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

const char *fst_tools_components(void)
{
    static const char *const texts[2][2][2][2][2][2][2] = {
#define GNUPLOT(yes_or_no)                                                                                     \
    {HDF5(yes_or_no ", hdf5 no (install libhdf5-dev and build again)"), HDF5(yes_or_no ", hdf5 yes")}
#define HDF5(before)                                                                                           \
    {                                                                                                          \
        CAIRO(before ", cairo no (install libcairo2-dev and build again)"), CAIRO(before ", cairo yes")        \
    }
#define CAIRO(before)                                                                                          \
    {                                                                                                          \
        MPI(before ", mpi no (install libopenmpi-dev and build again)"), MPI(before ", mpi yes")               \
    }
#define MPI(before)                                                                                            \
    {                                                                                                          \
        LAPACK(before ", lapack no (install liblapacke-dev and build again)"), LAPACK(before ", lapack yes")   \
    }
#define LAPACK(before)                                                                                         \
    {                                                                                                          \
        CMINPACK(before ", cminpack no (install libcminpack-dev and build again)"),                            \
            CMINPACK(before ", cminpack yes")                                                                  \
    }
#define CMINPACK(before)                                                                                       \
    {                                                                                                          \
        before ", ffmpeg no (install ffmpeg)", before ", ffmpeg yes"                                           \
    }
        GNUPLOT("gnuplot no (install gnuplot-nox)"), GNUPLOT("gnuplot yes")
#undef GNUPLOT
#undef HDF5
#undef CAIRO
#undef MPI
#undef LAPACK
#undef CMINPACK
    };
    const int gnuplot = program_present("gnuplot"), ffmpeg = program_present("ffmpeg");
    const int hdf5 = fst_module_present(FST_HDF5_MODULE), cairo = fst_module_present(FST_CAIRO_MODULE);
    const int mpi = fst_module_present(FST_MPI_MODULE);
    const int cminpack = fst_module_present(FST_MINPACK_MODULE);
    return texts[gnuplot][hdf5][cairo][mpi][fst_lapack_present()][cminpack][ffmpeg];
}
