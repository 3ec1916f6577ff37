/* nearest.c - the valid name that is nearest to a wrong one, for "did you mean". */
#include <stdio.h>
#include <string.h>

#include "base/text.h"

/* Longer words are compared by their first 63 letters: every valid name is shorter. */
#define LONGEST 63

/* Costs are counted in halves: a wrong letter costs 2, a letter in the wrong case 1. */
#define EDIT_COST 2U
#define CASE_COST 1U

static unsigned least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

static unsigned replacing(char a, char b)
{
    if (a == b)
        return 0;
    return fst_lower(a) == fst_lower(b) ? CASE_COST : EDIT_COST;
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

/* What people call some of the names.  A name counts only where it is among those there are. */
static const char *const synonyms[][2] = {
    {"dry", "coulomb"},
    {"solid", "coulomb"},
    {"damping", "viscous"},
    {"drag", "viscous"},
    {"wet", "viscous"},
    {"fluid", "viscous"},
    {"linear", "viscous"},
    {"stokes", "viscous"},
    {"frictionless", "none"},
    {"off", "none"},
    {"no", "none"},
    {"exact", "rigid"},
    {"paper", "farago2020"},
    {"printed", "farago2020"},
    {"permanent", "hard"},
    {"neodymium", "hard"},
    {"ferromagnetic", "hard"},
    {"soft", "paramagnetic"},
    {"still", "rest"},
    {"box", "cuboid"},
    {"block", "cuboid"},
    {"cube", "cuboid"},
    {"ball", "sphere"},
    {"disc", "cylinder"},
    {"disk", "cylinder"},
    {"rod", "cylinder"},
    {"map", "grid"},
    {"file", "grid"},
    {"hertz", "Hz"},
    {"millimetre", "mm"},
    {"millimeter", "mm"},
    {"gram", "g"},
    {"tesla", "T"},
    {"degree", "deg"},
    {"simulate", "run"},
    {"draw", "plot"},
    {"figure", "plot"},
    {"film", "movie"},
    {"video", "movie"},
    {"scan", "sweep"},
    {"bifurcation", "branch"},
    {"continue", "branch"},
    {"equilibria", "locked"},
    {"validate", "check"},
    {"parameters", "schema"},
    {"metric", "si"},
    {"laboratory", "lab"},
};

static const char *synonym_of(const char *word, const char *names)
{
    for (size_t i = 0; i < sizeof synonyms / sizeof *synonyms; ++i) {
        const char *a = word, *b = synonyms[i][0];
        while (*a && fst_lower(*a) == *b) {
            ++a;
            ++b;
        }
        if (!*a && !*b && fst_name_place(synonyms[i][1], names) >= 0)
            return synonyms[i][1];
    }
    return NULL;
}

/* Whether a person can have meant `name`, `edits` away from `word`: one begins with the other, or at most a third of
 * the letters differ. */
static int is_near(const char *word, const char *name, int edits)
{
    const size_t length = strlen(word), name_length = strlen(name);
    const size_t shorter = length < name_length ? length : name_length;
    const int allowed = length < 6 ? 1 : (int)(length / 3);
    return edits <= allowed || (shorter > 1 && strncmp(word, name, shorter) == 0);
}

/* "mean_r" for "r": the first name that ends with the word, copied to `nearest`; 0: there is none. */
static int ends_so(const char *word, const char *names, char *nearest, size_t size)
{
    const size_t length = strlen(word);
    for (const char *name = names; *name; name += strspn(name, "|")) {
        const size_t whole = strcspn(name, "|");
        if (length && whole > length + 1 && name[whole - length - 1] == '_' &&
            memcmp(name + whole - length, word, length) == 0) {
            (void)snprintf(nearest, size, "%.*s", (int)whole, name);
            return 1;
        }
        name += whole;
    }
    return 0;
}

/* "drive_power" for "power_drive": the first name of the word's parts in another order, those before one of its
 * underscores last. */
static int is_swapped(const char *word, const char *names, char *nearest, size_t size)
{
    char turned[LONGEST + 1];
    for (const char *at = strchr(word, '_'); at; at = strchr(at + 1, '_')) {
        (void)snprintf(turned, sizeof turned, "%s_%.*s", at + 1, (int)(at - word), word);
        if (fst_name_place(turned, names) >= 0) {
            (void)snprintf(nearest, size, "%s", turned);
            return 1;
        }
    }
    return 0;
}

/* "one, two, three" of "one|two|three". */
static void write_list(const char *names, char *text)
{
    for (; *names; ++names) {
        *text++ = *names == '|' ? ',' : *names;
        if (*names == '|')
            *text++ = ' ';
    }
    *text = '\0';
}

const char *fst_suggest_name(const char *word, const char *names, char text[FST_SUGGESTION_SIZE])
{
    enum { LIST_BESIDE = 100, LIST_ALONE = 400 }; /* lists of so many letters are read to their ends */
    char nearest[LONGEST + 1] = "", list[2 * LIST_ALONE + 1];
    const size_t length = strlen(names);
    const char *meant = synonym_of(word, names);
    const int edits = fst_nearest_name(word, names, nearest, sizeof nearest);
    const int near = meant || !strchr(names, '|') || is_swapped(word, names, nearest, sizeof nearest) ||
                     is_near(word, nearest, edits) || ends_so(word, names, nearest, sizeof nearest);
    if (length <= LIST_ALONE)
        write_list(names, list);
    if (!near)
        (void)snprintf(text, FST_SUGGESTION_SIZE,
                       length <= LIST_ALONE ? "choose one of %.500s" : "no name is like it", list);
    else if (length <= LIST_BESIDE && strchr(names, '|'))
        (void)snprintf(text, FST_SUGGESTION_SIZE, "the nearest is %s (choices: %.250s)",
                       meant ? meant : nearest, list);
    else
        (void)snprintf(text, FST_SUGGESTION_SIZE, "the nearest is %s", meant ? meant : nearest);
    return text;
}

int fst_name_place(const char *name, const char *names)
{
    const size_t length = strlen(name);
    for (int place = 0; *names; ++place) {
        const size_t here = strcspn(names, "|");
        if (here == length && memcmp(names, name, length) == 0)
            return place;
        names += here + (names[here] == '|');
    }
    return -1;
}
