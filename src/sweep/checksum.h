/* checksum.h - the checksum of what a sweep's database holds.
 *
 * A chain of 64-bit words: each step is a bijection of the sum so far, so that a change of a single word,
 * whatever it is, always changes the result; several changed words agree by chance once in 2^64.  It guards
 * against faults of disks and mixed-up files, not against forgery.
 */
#ifndef FST_SWEEP_CHECKSUM_H
#define FST_SWEEP_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t fst_checksum_word(uint64_t sum, uint64_t word)
{
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

/* The length, then the bytes by eights, lowest first, the last ones filled up with zeros. */
static inline uint64_t fst_checksum_bytes(uint64_t sum, const char *bytes, size_t size)
{
    sum = fst_checksum_word(sum, size);
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        for (size_t k = 0; k < 8 && i + k < size; ++k)
            word |= (uint64_t)(unsigned char)bytes[i + k] << (8 * k);
        sum = fst_checksum_word(sum, word);
    }
    return sum;
}

#endif
