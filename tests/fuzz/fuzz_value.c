/* fuzz_value.c - one setting, "KEY" or "KEY=VALUE": a refusal has a sentence, and an accepted number lies
 * within the limits of its key and reads back from its own text as the same bits. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/units.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_TEXT = 256 };

/* A number with a unit, read as each kind of quantity. */
static void check_units(const char *text)
{
    for (int unit = FST_UNIT_NUMBER; unit <= FST_UNIT_ANGLE; ++unit) {
        double value = NAN, again = NAN;
        char written[64];
        fst_error error = {FST_OK, "", ""};
        if (fst_parse_value(text, (fst_unit)unit, &value, &error) != FST_OK) {
            if (error.code != FST_BAD_INPUT || !error.sentence[0])
                abort();
            continue;
        }
        const int length = fst_value_write(written, sizeof written, value, (fst_unit)unit);
        if (!isfinite(value) || length < 1 || length >= (int)sizeof written ||
            fst_parse_value(written, (fst_unit)unit, &again, NULL) != FST_OK || again != value)
            abort();
    }
}

static void check_setting(const char *key, const char *text)
{
    fst_params params = fst_default_params();
    fst_error error = {FST_OK, "", ""};
    if (fst_params_set(&params, key, text, &error) != FST_OK) {
        if (error.code == FST_OK || !error.sentence[0])
            abort();
        return;
    }
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    double value;
    if (!info)
        abort();
    if (info->kind != FST_KIND_REAL)
        return;
    memcpy(&value, (const char *)&params + info->offset, sizeof value);
    if (!(value >= info->least && value <= info->greatest))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char text[MOST_TEXT + 1], nearest[16];
    if (size > MOST_TEXT)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    (void)fst_nearest_name(text, "radius|mass|moment|frequency", nearest, sizeof nearest);
    char *equals = strchr(text, '=');
    if (equals)
        *equals = '\0';
    check_setting(text, equals ? equals + 1 : "");
    check_units(equals ? equals + 1 : text);
    return 0;
}
