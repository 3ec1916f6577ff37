/* module.h - modules: shared objects beside this library, loaded only when a command needs them.  A heavy
 * library such as HDF5 is linked to a module, because linking it to festoon would slow down every start of the
 * program. */
#ifndef FST_HOST_MODULE_H
#define FST_HOST_MODULE_H

/* The files of the modules. festoon-lapack.so is not here: libfestoon loads it itself (orbit/lapack.c). */
#define FST_CAIRO_MODULE "festoon-cairo.so"
#define FST_HDF5_MODULE "festoon-hdf5.so"
#define FST_MPI_MODULE "festoon-mpi.so"
#define FST_MINPACK_MODULE "festoon-minpack.so"

/* The table called `symbol` of the module `file`, which is found along the RUNPATH of this library and stays
 * loaded.  NULL: the module cannot be loaded (*found is 0) or has no such table (*found is 1). */
const void *fst_module_table(const char *file, const char *symbol, int *found);

/* Whether the module would be found.  It is not loaded, because loading takes time. */
int fst_module_present(const char *file);

#endif
