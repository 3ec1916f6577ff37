/* instructions.h - which instructions a function executes, and how often. */
#ifndef FST_BENCH_INSTRUCTIONS_H
#define FST_BENCH_INSTRUCTIONS_H

/* Call the function, stopping after each instruction, and print a line OFFSET TIMES, the offset in hexadecimal
 * from the beginning of this program, for each of those that lie in it.  Nothing is printed on other
 * processors. */
void instructions_print(void (*function)(void *user), void *user);

#endif
