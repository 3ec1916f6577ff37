/* listed.h - the name of a value by its row of lists.def. */
#ifndef FST_BASE_LISTED_H
#define FST_BASE_LISTED_H

/* The body of a function that returns the name of `value` in a list, or `otherwise` where no row has this
 * number. */
#define FST_NAME_IN(LIST, value, otherwise)                                                                    \
    static const char *const names[] = {LIST(FST_ROW_NAME)};                                                   \
    return (unsigned)(value) < sizeof names / sizeof *names ? names[value] : (otherwise)

#endif
