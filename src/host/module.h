/* module.h - modules beside this library: heavy libraries that only some commands need are linked to a module,
 * which is loaded when one is met, for linking them would cost every start of the program their loading.
 */
#ifndef FST_HOST_MODULE_H
#define FST_HOST_MODULE_H

/* Their files.  festoon-lapack.so is not among them: libfestoon loads that one itself (orbit/lapack.c). */
#define FST_CAIRO_MODULE "festoon-cairo.so"
#define FST_HDF5_MODULE "festoon-hdf5.so"
#define FST_MPI_MODULE "festoon-mpi.so"

/* The table called `symbol` of the module `file`, found along the RUNPATH of this library; NULL if the module
 * cannot be loaded or has no such table (*found tells which).  It stays loaded. */
const void *fst_module_table(const char *file, const char *symbol, int *found);

/* Whether it would be found; it is not loaded, for asking must not cost the time of loading. */
int fst_module_present(const char *file);

#endif
