/* beads_sentence.c - what several beads do, in one line. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <festoon/bead_files.h>

#include "base/constants.h"

static const double SAME_RATE = 0.02; /* rates that differ by less, over omega, are the same */
static const double OPPOSITE = 10.0;  /* degrees by which two beads may depart from being opposite */

/* "two", "17" */
static const char *number_word(int number, char text[16])
{
    static const char *const words[] = {"no", "one", "two", "three", "four", "five", "six", "seven", "eight"};
    if (number >= 0 && number < (int)(sizeof words / sizeof *words))
        return words[number];
    (void)snprintf(text, 16, "%d", number);
    return text;
}

static void add(char *text, size_t size, const char *more)
{
    const size_t used = strlen(text);
    (void)snprintf(text + used, size - used, "%s", more);
}

/* Which way the beads apart go: 1 all against the magnet, 2 all with it, 3 both ways. */
static int ways_of_singles(const fst_beads_result *result)
{
    int ways = 0;
    for (int g = 0; g < result->group_count; ++g)
        if (result->groups[g].kind == FST_BEAD_GROUP_SINGLE)
            ways |= result->beads[result->groups[g].members[0]].mean_alpha_dot < 0 ? 1 : 2;
    return ways;
}

static int are_opposite(const fst_beads_result *result)
{
    const double *one = result->beads[0].final_state, *two = result->beads[1].final_state;
    const double angle = atan2(one[0] * two[1] - one[1] * two[0], one[0] * two[0] + one[1] * two[1]);
    const double slow = fabs(result->beads[0].mean_alpha_dot - result->beads[1].mean_alpha_dot);
    return fabs(fabs(angle) * 180.0 / FST_PI - 180.0) < OPPOSITE && slow < SAME_RATE * result->omega;
}

/* No two beads stay together. */
static void tell_apart(const fst_beads_result *result, char *text, size_t size)
{
    static const char *const ways[] = {"", ", against the magnet", ", with the magnet",
                                       ", some with the magnet and some against it"};
    char word[16];
    add(text, size, number_word(result->count, word));
    if (result->count == 1)
        add(text, size, " bead circles");
    else
        add(text, size,
            result->count == 2 && are_opposite(result) ? " beads circle opposite each other"
                                                       : " beads circle apart");
    add(text, size, ways[ways_of_singles(result)]);
}

/* "a chain of four" */
static void tell_name(const fst_bead_group *group, char *text, size_t size)
{
    char word[16], name[64];
    if (group->kind == FST_BEAD_GROUP_PAIR)
        (void)snprintf(name, sizeof name, "a pair");
    else
        (void)snprintf(name, sizeof name, "a %s of %s", fst_bead_group_name(group->kind),
                       number_word(group->count, word));
    add(text, size, name);
}

/* " turns with the magnet, and its centre circles against it" */
static void tell_motion(const fst_bead_group *group, double omega, char *text, size_t size)
{
    char phrase[128];
    if (isnan(group->axis_rate)) {
        add(text, size, " whose motion has not settled");
        return;
    }
    if (fabs(group->axis_rate - omega) < SAME_RATE * omega)
        add(text, size, " turns with the magnet");
    else {
        (void)snprintf(phrase, sizeof phrase, " turns at %.3g of the magnet's rate", group->axis_rate / omega);
        add(text, size, phrase);
    }
    if (isnan(group->centre_rate))
        add(text, size, " about the axis");
    else if (fabs(group->centre_rate - omega) > SAME_RATE * omega)
        add(text, size,
            group->centre_rate < 0 ? ", and its centre walks against it" : ", and its centre walks with it");
}

static int is_gone(const fst_bead_result *bead)
{
    return bead->regime == FST_REGIME_EJECTED || bead->regime == FST_REGIME_TOUCHED ||
           bead->regime == FST_REGIME_LOST;
}

/* Append what the groups do: first the largest group of touching beads, and last the beads that left the plate. */
static void tell_groups(const fst_beads_result *result, char *text, size_t size)
{
    int apart = 0, gone = 0, ejected = 0, told = 0;
    char word[16], phrase[64];
    for (int count = result->count; count > 1; --count)
        for (int g = 0; g < result->group_count; ++g) {
            const fst_bead_group *group = &result->groups[g];
            if (group->count != count)
                continue;
            add(text, size, told++ ? ", " : "");
            tell_name(group, text, size);
            tell_motion(group, result->omega, text, size);
        }
    for (int i = 0; i < result->count; ++i) {
        gone += is_gone(&result->beads[i]);
        ejected += result->beads[i].regime == FST_REGIME_EJECTED;
    }
    for (int g = 0; g < result->group_count; ++g)
        apart += result->groups[g].count == 1;
    if (apart) {
        (void)snprintf(phrase, sizeof phrase, "%s%s bead%s apart", told ? ", " : "", number_word(apart, word),
                       apart == 1 ? "" : "s");
        add(text, size, phrase);
    }
    if (gone) {
        (void)snprintf(phrase, sizeof phrase, "%s%s bead%s %s", told || apart ? ", " : "",
                       number_word(gone, word), gone == 1 ? "" : "s", ejected == gone ? "ejected" : "gone");
        add(text, size, phrase);
    }
}

void fst_beads_sentence(const fst_beads_result *result, char *text, size_t size)
{
    int singles = 1;
    for (int i = 0; i < result->count; ++i)
        singles &= !is_gone(&result->beads[i]);
    for (int g = 0; g < result->group_count; ++g)
        singles &= result->groups[g].count == 1;
    text[0] = '\0';
    if (singles)
        tell_apart(result, text, size);
    else
        tell_groups(result, text, size);
    if (result->outcome == FST_BEADS_UNDECIDED)
        add(text, size, ": undecided");
}
