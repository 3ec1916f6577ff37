#define _GNU_SOURCE /* REG_RIP */
#include "instructions.h"

#if defined(__x86_64__) && defined(__linux__)
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <ucontext.h>

/* The processor's trap flag: after each instruction comes the signal SIGTRAP. */
#define SET_TRAP_FLAG "pushfq; orq $0x100, (%%rsp); popfq"
#define CLEAR_TRAP_FLAG "pushfq; andq $~0x100, (%%rsp); popfq"

extern const char __executable_start[], etext[];

static unsigned *times; /* at each byte of the program's code */
static size_t size;

static void count(int signal, siginfo_t *info, void *context)
{
    (void)signal, (void)info;
    const uintptr_t at = (uintptr_t)((ucontext_t *)context)->uc_mcontext.gregs[REG_RIP];
    const uintptr_t offset = at - (uintptr_t)__executable_start;
    if (offset < size)
        times[offset] += 1;
}

void instructions_print(void (*function)(void *user), void *user)
{
    struct sigaction action = {.sa_sigaction = count, .sa_flags = SA_SIGINFO}, before;
    size = (size_t)(etext - __executable_start);
    times = calloc(size, sizeof *times);
    if (!times || sigaction(SIGTRAP, &action, &before) != 0)
        return;
    /* What lies below the stack's pointer may be in use: pushfq must not write there. */
    __asm__ volatile("lea -128(%%rsp), %%rsp;" SET_TRAP_FLAG "; lea 128(%%rsp), %%rsp" : : : "memory", "cc");
    function(user);
    __asm__ volatile("lea -128(%%rsp), %%rsp;" CLEAR_TRAP_FLAG "; lea 128(%%rsp), %%rsp" : : : "memory", "cc");
    (void)sigaction(SIGTRAP, &before, NULL);
    for (size_t i = 0; i < size; ++i)
        if (times[i])
            printf("%zx %u\n", i, times[i]);
    free(times);
}
#else
void instructions_print(void (*function)(void *user), void *user)
{
    (void)function, (void)user;
}
#endif
