/* file_system.h - what the file system under a file can do. */
#ifndef FST_HOST_FILE_SYSTEM_H
#define FST_HOST_FILE_SYSTEM_H

/* Whether `path` lies on a network file system, where processes share no memory and a write-ahead log of SQLite
 * is not safe. */
int fst_on_network(const char *path);

#endif
