/* process.h - the one way in which programs are started: no shell, a clean slate of signals. */
#ifndef FST_HOST_PROCESS_H
#define FST_HOST_PROCESS_H

#include <sys/types.h>

typedef struct fst_process {
    const char *program;      /* looked for along PATH */
    char *const *arguments;   /* the first is the program's name, NULL ends them */
    const char *directory;    /* in which it runs; NULL: here */
    int input, output, words; /* its standard input, output and error; -1: /dev/null */
} fst_process;

/* Start it; 0, or an errno (ENOENT: there is no such program). */
int fst_process_start(const fst_process *process, pid_t *child);

#endif
