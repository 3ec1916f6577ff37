#include "row_errors.h"

#include <math.h>
#include <string.h>

static int begins(const char *name, const char *beginning)
{
    return strncmp(name, beginning, strlen(beginning)) == 0;
}

static int is_mean(const char *name)
{
    const size_t length = strlen(name);
    if (length > 6 && strcmp(name + length - 6, "_error") == 0)
        return 0;
    return begins(name, "mean_") || begins(name, "std_") || begins(name, "rms_") || begins(name, "eq2");
}

static int is_extreme(const char *name)
{
    return begins(name, "min_") || begins(name, "max_");
}

static double difference(double number, double reference)
{
    if (isnan(number) && isnan(reference))
        return 0.0;
    const double apart = fabs(number - reference) / fmax(1.0, fabs(reference));
    return isnan(apart) ? INFINITY : apart;
}

static double number_of(const fst_run_result *row, const fst_result_info *key)
{
    double number;
    memcpy(&number, (const char *)row + key->offset, sizeof number);
    return number;
}

row_errors row_errors_of(const fst_run_result *rows, const fst_run_result *references, int count)
{
    row_errors worst = {.worst_mean = "", .worst_extreme = ""};
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            worst.states = fmax(worst.states, fabs(rows[i].final_state[k] - references[i].final_state[k]));
        for (int k = 0; k < fst_result_count(); ++k) {
            const fst_result_info *key = fst_result_at(k);
            const double error = difference(number_of(&rows[i], key), number_of(&references[i], key));
            if (is_mean(key->name) && error > worst.means) {
                worst.means = error;
                worst.worst_mean = key->name;
            }
            if (is_extreme(key->name) && error > worst.extremes) {
                worst.extremes = error;
                worst.worst_extreme = key->name;
            }
        }
        worst.period = fmax(worst.period, difference(rows[i].period, references[i].period));
        worst.regimes += rows[i].regime != references[i].regime;
    }
    return worst;
}
