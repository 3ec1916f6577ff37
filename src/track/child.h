/* child.h - ffmpeg or ffprobe at work: what it writes is read here, and what it says is kept.
 *
 *        feed (or a film's descriptor) --> its standard input
 *        its standard output           --> track_child_read()
 *        its standard error            --> said
 *
 * While this side waits, the caller's progress is asked every 50 ms, so that a process that hangs can be left.
 */
#ifndef FST_TRACK_CHILD_H
#define FST_TRACK_CHILD_H

#include <festoon/festoon.h>

#include <stddef.h>
#include <sys/types.h>

typedef struct track_child {
    pid_t pid;
    int input, output, words; /* -1: closed */
    char said[512];           /* the beginning of what it said, on one line */
    size_t said_size;
    /* More bytes for its standard input: sets *bytes and *size, which is 0 at the end.  NULL: none. */
    fst_status (*feed)(void *user, const unsigned char **bytes, size_t *size, fst_error *error);
    void *user;
    const unsigned char *pending;
    size_t pending_size;
    const fst_progress *progress;
    double fraction; /* told while waiting */
} track_child;

/* Start a program (arguments[0], the list ends with NULL).  `input` is its standard input, -1 for nothing;
 * where the child has `feed`, it is a pipe from there instead.  The other members of `child` are set by the
 * caller: feed, user, progress.  FST_UNAVAILABLE: it is not installed. */
fst_status track_child_start(track_child *child, const char *const *arguments, int input, fst_error *error);

/* Read up to `size` bytes of what it writes; *got is 0 at the end. */
fst_status track_child_read(track_child *child, void *bytes, size_t size, size_t *got, fst_error *error);

/* End it: wait for it, or kill it where its work is not wanted any more.  Returns whether it ended well. */
int track_child_end(track_child *child, int abandon);

#endif
