/* module.h - modules: shared objects beside this library, loaded only when a command needs them.  A heavy
 * library such as HDF5 is linked to a module, because linking it to festoon would slow down every start of the
 * program. */
#ifndef FST_HOST_MODULE_H
#define FST_HOST_MODULE_H

#include <stddef.h>

/* The files of the modules. libfestoon itself loads that of LAPACK (orbit/lapack.c). */
#define FST_LAPACK_MODULE "festoon-lapack.so"
#define FST_CAIRO_MODULE "festoon-cairo.so"
#define FST_HDF5_MODULE "festoon-hdf5.so"
#define FST_MPI_MODULE "festoon-mpi.so"
#define FST_MINPACK_MODULE "festoon-minpack.so"

/* The table called `symbol` of the module `file`, which is found along the RUNPATH of this library and stays
 * loaded.  NULL: the module cannot be loaded (*found is 0) or has no such table (*found is 1). */
const void *fst_module_table(const char *file, const char *symbol, int *found);

/* Whether the module lies where modules do.  It is not loaded, because loading takes time. */
int fst_module_present(const char *file);

/* Whether the module can be loaded.  If not, `lacks` names the library that it needs and that is missing; "": the
 * module itself is missing. */
int fst_module_usable(const char *file, char *lacks, size_t size);

#endif
