/* process.h - the one way in which festoon starts other programs: without a shell, with default signals. */
#ifndef FST_HOST_PROCESS_H
#define FST_HOST_PROCESS_H

#include <sys/types.h>

typedef struct fst_process {
    const char *program;      /* looked for on PATH */
    char *const *arguments;   /* the first is the program's name; NULL ends them */
    const char *directory;    /* the directory in which it runs; NULL: the present one */
    int input, output, words; /* its standard input, output and error; -1: /dev/null */
} fst_process;

/* Start the program.  Returns 0, or an errno (ENOENT: there is no such program). */
int fst_process_start(const fst_process *process, pid_t *child);

#endif
