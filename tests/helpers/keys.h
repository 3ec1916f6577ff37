/* keys.h - parameters of a test set by their keys. */
#ifndef FST_TESTS_KEYS_H
#define FST_TESTS_KEYS_H

#include "physics.h"

static inline void set(fst_params *params, const char *key, const char *value)
{
    fst_error error = {FST_OK, "", ""};
    if (fst_params_set(params, key, value, &error) != FST_OK)
        fail_msg("%s = %s: %s", key, value, error.sentence);
}

#endif
