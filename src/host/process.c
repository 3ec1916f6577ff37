/* process.c - starting a program by posix_spawn(). */
#define _GNU_SOURCE /* posix_spawn_file_actions_addchdir_np */

#include "host/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stddef.h>
#include <unistd.h>

extern char **environ;

static int add_stream(posix_spawn_file_actions_t *actions, int from, int to, int flags)
{
    return from < 0 ? posix_spawn_file_actions_addopen(actions, to, "/dev/null", flags, 0)
                    : posix_spawn_file_actions_adddup2(actions, from, to);
}

static int add_actions(posix_spawn_file_actions_t *actions, const fst_process *process)
{
    int failed = add_stream(actions, process->input, STDIN_FILENO, O_RDONLY);
    if (!failed)
        failed = add_stream(actions, process->output, STDOUT_FILENO, O_WRONLY);
    if (!failed)
        failed = add_stream(actions, process->words, STDERR_FILENO, O_WRONLY);
    if (!failed && process->directory)
        failed = posix_spawn_file_actions_addchdir_np(actions, process->directory);
    return failed;
}

int fst_process_start(const fst_process *process, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int failed = posix_spawn_file_actions_init(&actions);
    if (failed)
        return failed;
    failed = posix_spawnattr_init(&attributes);
    if (failed) {
        (void)posix_spawn_file_actions_destroy(&actions);
        return failed;
    }
    /* The caller's thread may have blocked or ignored signals; the program must not inherit that. */
    sigset_t none, restored;
    (void)sigemptyset(&none);
    (void)sigemptyset(&restored);
    (void)sigaddset(&restored, SIGPIPE);
    (void)sigaddset(&restored, SIGXFSZ); /* a helper that ignores it could go on after its file was cut off at
                                            the limit of ulimit -f */
    (void)posix_spawnattr_setsigmask(&attributes, &none);
    (void)posix_spawnattr_setsigdefault(&attributes, &restored);
    (void)posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    failed = add_actions(&actions, process);
    if (!failed)
        failed = posix_spawnp(child, process->program, &actions, &attributes, process->arguments, environ);
    (void)posix_spawnattr_destroy(&attributes);
    (void)posix_spawn_file_actions_destroy(&actions);
    return failed;
}
