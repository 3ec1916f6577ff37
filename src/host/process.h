/* process.h - the one way in which festoon starts other programs: without a shell, with default signals.
 *
 *        feed, or fst_process_write() --> its standard input
 *        its standard output          --> fst_process_read()
 *        its standard error           --> said
 *
 * While this side waits, the caller's progress is asked every 50 ms, so that a program that hangs can be left.
 */
#ifndef FST_HOST_PROCESS_H
#define FST_HOST_PROCESS_H

#include <festoon/festoon.h>

#include <stddef.h>
#include <sys/types.h>

enum { FST_INPUT_NONE = -1, FST_INPUT_FED = -2 };

/* What is to be started. */
typedef struct fst_program {
    const char *const *arguments;  /* the first is its name, which is looked for on PATH; NULL ends them */
    const char *directory;         /* the directory in which it runs; NULL: the present one */
    int input;                     /* its standard input: a descriptor, FST_INPUT_NONE or FST_INPUT_FED */
    int is_read;                   /* whether its standard output is read; else it goes nowhere */
    const char *purpose, *package; /* "films need ffmpeg", and the package that has it, for a sentence */
} fst_program;

/* A program at work. */
typedef struct fst_process {
    const char *where, *name, *purpose, *package; /* what messages are about; the others as in fst_program */
    pid_t pid;                                    /* 0: it was not started */
    int input, output, words;                     /* our ends of its three streams; -1: closed */
    char said[512];                               /* the beginning of what it said, on one line */
    size_t said_size;
    const unsigned char *pending; /* what it has not yet taken */
    size_t pending_size;
    /* These may be set before the start.  More bytes for its standard input: sets *bytes and *size, which is 0
     * at the end. */
    fst_status (*feed)(void *user, const unsigned char **bytes, size_t *size, fst_error *error);
    void *user;
    const fst_progress *progress;
    double fraction; /* told while waiting */
    int patience;    /* seconds after which it is ended; 0: as long as it takes */
    double deadline;
} fst_process;

/* Start a program; the texts that name it are kept, and `where`.  FST_UNAVAILABLE: it is not installed. */
fst_status fst_process_start(fst_process *process, const fst_program *program, const char *where,
                             fst_error *error);

/* Hand over bytes.  FST_IO: it takes no more; fst_process_end() tells why. */
fst_status fst_process_write(fst_process *process, const unsigned char *bytes, size_t size, fst_error *error);

/* Read up to `size` bytes of what it writes; *got is 0 at the end. */
fst_status fst_process_read(fst_process *process, void *bytes, size_t size, size_t *got, fst_error *error);

/* End its input and wait for it; with `abandon` it is ended at once, and nothing is asked of it.  Call it once
 * after each start that went well.  FST_IO: it failed, and the sentence quotes it. */
fst_status fst_process_end(fst_process *process, int abandon, fst_error *error);

/* Start a program that is left alone, without streams.  Returns 0, or an errno (ENOENT: there is no such
 * program). */
int fst_process_leave(const char *const *arguments);

#endif
