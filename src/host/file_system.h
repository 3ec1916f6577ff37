/* file_system.h - what the file system of a file can do. */
#ifndef FST_HOST_FILE_SYSTEM_H
#define FST_HOST_FILE_SYSTEM_H

/* Whether `path` lies on a network file system.  There processes share no memory, so a write-ahead log of
 * SQLite is unsafe. */
int fst_on_network(const char *path);

#endif
