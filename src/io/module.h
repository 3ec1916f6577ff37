/* module.h - modules beside this library: heavy libraries that only some commands need are linked to a module,
 * which is loaded when one is met, for linking them would cost every start of the program their loading.
 */
#ifndef FST_IO_MODULE_H
#define FST_IO_MODULE_H

/* The table called `symbol` of the module `file`, found along the RUNPATH of this library; NULL if the module
 * cannot be loaded or has no such table (*found tells which).  It stays loaded. */
const void *fst_module_table(const char *file, const char *symbol, int *found);

/* Whether it would be found; it is not loaded. */
int fst_module_present(const char *file);

#endif
