/* checksum.h - the checksum of maps of a field, and of rows, images and the identity in a sweep's database.
 *
 * It is a chain of 64-bit words.  Each step is a bijection of the sum so far, so a change of a single word
 * always changes the result; a change of several words is missed once in 2^64.  The checksum guards against
 * faults of disks and against mixed-up files, not against forgery.
 */
#ifndef FST_BASE_CHECKSUM_H
#define FST_BASE_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t fst_checksum_word(uint64_t sum, uint64_t word)
{
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    return sum ^ sum >> 32;
}

/* Add the length, then the bytes in groups of eight, lowest byte first, the last group filled up with zeros. */
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
