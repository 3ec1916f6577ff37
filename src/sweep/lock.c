/* lock.c - one sweep at a time on a database, and which process it is, told by the positions of locked bytes.
 *
 *      2^48 + FST_LOCK_SWEEP          the lock itself
 *      2^48 + 2^32 + process number   who holds it: only the position of the byte counts
 *      2^48 + 2^33 + 512 i + letter   letter i of the host's name, likewise
 *
 * A second command that finds the first byte locked asks the kernel where the next locked bytes are, and so
 * learns process and host.  Nothing is written to the disk, and the kernel removes it all when the process
 * ends.
 */
#include "sweep/lock.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "host/file_lock.h"

/* More locked bytes: one whose position gives the number of the process, and one for each letter of the host's
 * name.  Places are counted as in host/file_lock.h. */
static const off_t PROCESS_PLACES = (off_t)1 << 32;
static const off_t HOST_PLACES = (off_t)1 << 33; /* letter i lies at i * HOST_STRIDE + its code */
enum { HOST_LETTERS = 64, HOST_STRIDE = 512 };   /* wide apart, because adjacent locks would merge */

fst_lock_state fst_lock_take(int descriptor)
{
    if (fst_lock_byte(descriptor, FST_LOCK_SWEEP, 0) != 0)
        return errno == EAGAIN || errno == EACCES ? FST_LOCK_TAKEN : FST_LOCK_IMPOSSIBLE;
    char host[HOST_LETTERS + 1] = "";
    (void)gethostname(host, sizeof host - 1);
    (void)fst_lock_byte(descriptor, PROCESS_PLACES + getpid(), 0);
    for (int i = 0; host[i]; ++i)
        (void)fst_lock_byte(descriptor, HOST_PLACES + (off_t)i * HOST_STRIDE + (unsigned char)host[i], 0);
    return FST_LOCK_MINE;
}

fst_lock_state fst_lock_look(int descriptor)
{
    return fst_locked_byte(descriptor, FST_LOCK_SWEEP, 1) < 0 ? FST_LOCK_FREE : FST_LOCK_TAKEN;
}

void fst_lock_owner(int descriptor, char owner[FST_LOCK_OWNER_SIZE])
{
    char host[HOST_LETTERS + 1] = "";
    for (int i = 0; i < HOST_LETTERS; ++i) {
        const off_t letter = fst_locked_byte(descriptor, HOST_PLACES + (off_t)i * HOST_STRIDE, 256);
        host[i] = letter > ' ' && letter < 127 ? (char)letter : '\0';
        if (!host[i])
            break;
    }
    const off_t process = fst_locked_byte(descriptor, PROCESS_PLACES, (off_t)1 << 31);
    if (process > 0)
        (void)snprintf(owner, FST_LOCK_OWNER_SIZE, "process %ld on %s", (long)process,
                       host[0] ? host : "another computer");
    else
        (void)snprintf(owner, FST_LOCK_OWNER_SIZE, "another command");
}

/* ------------------------------------------------------------------ a sweep of this process */

/* This process, in the words of fst_lock_owner(). */
static void name_of_this(char owner[FST_LOCK_OWNER_SIZE])
{
    char host[HOST_LETTERS + 1] = "";
    (void)gethostname(host, sizeof host - 1);
    (void)snprintf(owner, FST_LOCK_OWNER_SIZE, "process %ld on %s", (long)getpid(), host);
}

static int is_of_this_process(int descriptor)
{
    char owner[FST_LOCK_OWNER_SIZE], this[FST_LOCK_OWNER_SIZE];
    name_of_this(this);
    fst_lock_owner(descriptor, owner);
    return fst_lock_look(descriptor) == FST_LOCK_TAKEN && strcmp(owner, this) == 0;
}

static fst_status fail_own(const char *name, fst_error *error)
{
    return fst_fail(error, FST_IO, name,
                    "this process is itself at work on this sweep, in another call; nothing was changed: wait "
                    "until that call has ended, or read the file in another process");
}

fst_status fst_lock_check_own(const char *path, const char *name, fst_error *error)
{
    return fst_holds_lock(path, FST_LOCK_SWEEP) ? fail_own(name, error) : FST_OK;
}

/* The thread that has the lock may not have locked the bytes yet that say whose it is: wait for it. */
int fst_lock_is_own(int descriptor, const char *name, fst_error *error)
{
    enum { TRIES = 20 };
    const struct timespec moment = {0, 1000000};
    int own = is_of_this_process(descriptor);
    for (int i = 0; i < TRIES && !own && fst_locked_byte(descriptor, PROCESS_PLACES, (off_t)1 << 31) < 0; ++i) {
        (void)nanosleep(&moment, NULL);
        own = is_of_this_process(descriptor);
    }
    return own ? (fail_own(name, error), 1) : 0;
}

fst_status fst_lock_fail(int descriptor, const char *path, fst_error *error)
{
    char owner[FST_LOCK_OWNER_SIZE];
    fst_lock_owner(descriptor, owner);
    return fst_fail(error, FST_IO, path,
                    "%s is at work on this sweep; nothing was changed: wait for it, end it, or choose another "
                    "file",
                    owner);
}
