/* nearest.c - the valid name that is nearest to a wrong one, for "did you mean". */
#include <festoon/festoon.h>

#include <stdio.h>
#include <string.h>

/* Longer words are compared by their first 63 letters: every valid name is shorter. */
#define LONGEST 63

/* Costs are counted in halves: a wrong letter costs 2, a letter in the wrong case 1. */
#define EDIT_COST 2U
#define CASE_COST 1U

static unsigned char lower(unsigned char letter)
{
    return letter >= 'A' && letter <= 'Z' ? (unsigned char)(letter - 'A' + 'a') : letter;
}

static unsigned least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

static unsigned replacing(char a, char b)
{
    if (a == b)
        return 0;
    return lower((unsigned char)a) == lower((unsigned char)b) ? CASE_COST : EDIT_COST;
}

/* The edit distance in halves.  A letter left out, put in or replaced costs one edit, and so do two neighbours
 * exchanged.  It is the usual table of dynamic programming, of which three rows are kept. */
static unsigned distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    unsigned rows[3][LONGEST + 1];
    unsigned *two_up = rows[0], *up = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_length; ++j)
        up[j] = (unsigned)j * EDIT_COST;
    for (size_t i = 1; i <= a_length; ++i) {
        row[0] = (unsigned)i * EDIT_COST;
        for (size_t j = 1; j <= b_length; ++j) {
            unsigned cost = up[j - 1] + replacing(a[i - 1], b[j - 1]);
            cost = least(cost, least(up[j], row[j - 1]) + EDIT_COST);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost = least(cost, two_up[j - 2] + EDIT_COST);
            row[j] = cost;
        }
        unsigned *recycled = two_up;
        two_up = up;
        up = row;
        row = recycled;
    }
    return up[b_length];
}

/* Whether `name` goes on where `word` ends, which is at least two letters long: a word that was cut short. */
static int goes_on(const char *word, size_t word_length, const char *name, size_t name_length)
{
    return word_length > 1 && word_length < name_length && memcmp(word, name, word_length) == 0;
}

int fst_nearest_name(const char *word, const char *names, char *nearest, size_t size)
{
    size_t word_length = strlen(word);
    if (word_length > LONGEST)
        word_length = LONGEST;
    unsigned best = 0;
    int best_goes_on = 0;
    const char *best_name = NULL;
    size_t best_length = 0;
    for (const char *name = names; *name; name += strspn(name, "|")) {
        size_t length = strcspn(name, "|");
        unsigned cost = distance(word, word_length, name, length < LONGEST ? length : LONGEST);
        /* A name that is cut short is preferred to any other, save one that is a single edit away. */
        const int cut = cost > EDIT_COST && goes_on(word, word_length, name, length);
        if (!best_name || (cut == best_goes_on ? cost < best : cut ? best > EDIT_COST : cost <= EDIT_COST)) {
            best = cost;
            best_goes_on = cut;
            best_name = name;
            best_length = length;
        }
        name += length;
    }
    if (size)
        (void)snprintf(nearest, size, "%.*s", (int)best_length, best_name ? best_name : "");
    return best_name ? (int)((best + 1) / 2) : -1;
}
