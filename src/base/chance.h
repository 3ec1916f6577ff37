/* chance.h - numbers by chance, the same on every machine. */
#ifndef FST_BASE_CHANCE_H
#define FST_BASE_CHANCE_H

#include <stdint.h>

/* The next of a sequence of 64 random bits that depends on where it began alone (splitmix64, by Steele, Lea and
 * Flood, 2014). */
static inline uint64_t fst_draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ z >> 27) * 0x94d049bb133111ebULL;
    return z ^ z >> 31;
}

#endif
