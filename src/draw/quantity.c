/* quantity.c - the words and units of axes. */
#include <festoon/festoon_tools.h>

#include "base/constants.h"
#include "draw/style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct word {
    const char *name, *words;
} word;

/* An underscore lowers the letter behind it. */
static const word parameters[] = {
    {"model.kappa", "magnetic strength κ"},
    {"model.eps", "bead's radius over ℓ, ε"},
    {"model.h", "height over the lines, h/ℓ"},
    {"model.lambda", "spacing of the lines, λ/ℓ"},
    {"friction.mu", "coefficient of friction μ"},
    {"friction.mu_static", "static coefficient of friction μ_s"},
    {"friction.gamma", "friction rate γ"},
    {"friction.rolling_resistance", "rolling resistance"},
    {"start.phi", "Φ at the start"},
    {"start.r", "r at the start"},
    {"bead.radius", "bead's radius"},
    {"bead.mass", "bead's mass"},
    {"bead.moment", "bead's magnetic moment"},
    {"bead.density", "bead's density"},
    {"bead.remanence", "bead's remanence"},
    {"magnet.depth", "magnet's depth"},
    {"magnet.width", "magnet's width"},
    {"magnet.half_length", "half length ℓ of the magnet's lines"},
    {"magnet.b0", "field unit B_0"},
};

static const word results[] = {
    {"outcome", "outcome"},
    {"centre_rate", "rate of the centre"},
    {"axis_rate", "rate of the axis"},
    {"mean_r", "mean radius ⟨r⟩"},
    {"std_r", "deviation δr"},
    {"min_r", "least r"},
    {"max_r", "greatest r"},
    {"mean_alpha_dot", "bead's circling ⟨α′⟩"},
    {"bead_frequency", "bead's frequency"},
    {"mean_phi_dot", "moment's turning ⟨φ′⟩"},
    {"mean_nz", "⟨n_z⟩"},
    {"festoons", "festoons N"},
    {"mean_height", "mean height"},
    {"mean_velocity", "mean velocity along the wave"},
    {"below", "Floating below the magnet"},
    {"above", "Floating above the magnet"},
    {"below_height_mm", "height below the magnet (mm)"},
    {"above_height_mm", "height above the magnet (mm)"},
    {"below_growth_per_s", "growth of disturbances below (1/s)"},
    {"above_growth_per_s", "growth of disturbances above (1/s)"},
    {"period", "period of Φ"},
    {"phi_deg", "Φ"},
    {"slip", "slip of the contact |V|"},
    {"relaxation_time", "relaxation time"},
    {"swing_ratio", "inequality p of two swings in a row"},
    {"max_angle_deg", "greatest angle of n and B"},
    {"mean_b", "⟨|B|⟩"},
    {"std_b", "deviation of |B|"},
    {"min_b", "least |B|"},
    {"max_b", "greatest |B|"},
    {"rms_slip", "slip of the contact, rms"},
    {"max_slip", "greatest slip"},
    {"tilt_deg", "tilt of n, or of its plane"},
    {"height_mm", "distance from the magnet (mm)"},
    {"circle_mm", "radius of the centre's circle (mm)"},
    {"gap_mm", "gap between bead and magnet (mm)"},
    {"sticking", "share of time that sticks"},
    {"effective_rate", "effective friction rate"},
    {"mean_load_weights", "mean load"},
    {"min_load_weights", "least load"},
    {"max_load_weights", "greatest load"},
    {"mean_friction_power", "power lost to friction"},
    {"mean_drive_power", "power of the drive"},
    {"largest_exponent", "largest Lyapunov exponent"},
    {"end_time", "time at the end"},
};

static const word columns[] = {
    {"t", "time"},
    {"drive_turns", "turns of the magnet"},
    {"omega", "drive ω"},
    {"Phi", "Φ"},
    {"alpha", "α"},
    {"n_alpha", "n_α"},
    {"B_alpha", "B_α"},
    {"V_alpha", "V_α"},
    {"w_x", "W_x"},
    {"w_y", "W_y"},
    {"w_z", "W_z"},
    {"B", "field |B|"},
    {"angle", "angle of n and B"},
    {"slip", "slip of the contact |V|"},
    {"spin", "spin W·n"},
    {"load", "load"},
    {"friction", "friction |f|"},
    {"friction_use", "|f| over what static friction could take"},
    {"sticking", "contact: 1 rolls, 0 slips"},
    {"z", "height over the plate"},
    {"friction_power", "power lost to friction"},
    {"drive_power", "power of the drive"},
};

/* The words for a name: those of the table, or the name with blanks for points and underscores. */
static void find_words(const word *table, size_t count, const char *name, int keep_marks, char *words,
                       size_t size)
{
    for (size_t i = 0; i < count; ++i)
        if (strcmp(table[i].name, name) == 0) {
            (void)snprintf(words, size, "%s", table[i].words);
            return;
        }
    (void)snprintf(words, size, "%s", name);
    for (char *c = words; *c && !keep_marks; ++c)
        if (*c == '.' || *c == '_')
            *c = ' ';
}

static fst_quantity labelled(double factor, const char *words, const char *unit)
{
    fst_quantity quantity = {.factor = factor};
    char symbols[32];
    fst_unit_symbols(unit, symbols, sizeof symbols);
    if (symbols[0] && strcmp(symbols, "1") != 0)
        (void)snprintf(quantity.label, sizeof quantity.label, "%.90s (%s)", words, symbols);
    else
        (void)snprintf(quantity.label, sizeof quantity.label, "%.90s", words);
    return quantity;
}

/* The drive is a frequency in Hz or the scaled angular velocity ω. */
static fst_quantity drive(int in_hertz, int to_hertz, double time)
{
    const double factor = in_hertz == to_hertz ? 1.0 : in_hertz ? FST_TWO_PI * time : 1.0 / (FST_TWO_PI * time);
    return to_hertz ? labelled(factor, "drive frequency", "Hz") : labelled(factor, "drive ω", "gamma");
}

static fst_quantity length(const char *words, int in_metres, fst_shown_units units, double unit)
{
    if (units == FST_SHOWN_AS_GIVEN)
        units = in_metres ? FST_SHOWN_LAB : FST_SHOWN_SCALED;
    if (units == FST_SHOWN_SCALED)
        return labelled(in_metres ? 1.0 / unit : 1.0, words, "l");
    int power = 0;
    const char *name =
        units == FST_SHOWN_LAB ? fst_unit_customary(FST_UNIT_LENGTH, &power) : fst_unit_name(FST_UNIT_LENGTH);
    return labelled((in_metres ? 1.0 : unit) * pow(10.0, power), words, name);
}

/* "remanence z of part 0"; a size by its number, since its meaning depends on the kind of part. */
static void part_words(const char *key, int part, char *words, size_t size)
{
    static const char *const turns[] = {"turn", "axis of turning, x", "axis of turning, y",
                                        "axis of turning, z"};
    const char *field = strrchr(key, '.') + 1, *bracket = strchr(field, '[');
    const int length = (int)strcspn(field, "["), k = bracket ? bracket[1] - '0' : 0;
    if (!bracket)
        (void)snprintf(words, size, "%s of part %d", field, part);
    else if (strncmp(field, "rotation", 8) == 0)
        (void)snprintf(words, size, "%s, of part %d", turns[k], part);
    else if (strncmp(field, "size", 4) == 0)
        (void)snprintf(words, size, "size[%d] of part %d", k, part);
    else
        (void)snprintf(words, size, "%.*s %c of part %d", length, field, 'x' + k, part);
}

fst_quantity fst_quantity_of_parameter(const char *key, fst_shown_units units, const fst_scales *scales)
{
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    char words[96];
    const int part = fst_param_part(fst_param_find(key));
    const int bead = fst_param_bead(fst_param_find(key));
    if (part >= 0)
        part_words(key, part, words, sizeof words);
    else if (bead >= 0)
        (void)snprintf(words, sizeof words, "%.60s of bead %d", strrchr(key, '.') + 1, bead + 1);
    else
        find_words(parameters, sizeof parameters / sizeof parameters[0], key, 0, words, sizeof words);
    if (strcmp(key, "drive.frequency") == 0)
        return drive(1, units != FST_SHOWN_SCALED, scales->time);
    if (strcmp(key, "drive.omega") == 0)
        return drive(0, units == FST_SHOWN_LAB || units == FST_SHOWN_SI, scales->time);
    if (info->unit == FST_UNIT_LENGTH || strcmp(key, "start.r") == 0)
        return length(words, info->unit == FST_UNIT_LENGTH, units, scales->length);
    if (info->kind != FST_KIND_REAL)
        return labelled(1.0, words, "");
    int power = 0;
    const char *unit =
        units == FST_SHOWN_SI ? fst_unit_name(info->unit) : fst_unit_customary(info->unit, &power);
    return labelled(pow(10.0, power), words, unit);
}

/* An angular velocity in gamma that is shown as turns a second. */
static void say_turns(const char *unit, const char *shown, char *words, size_t size)
{
    const size_t used = strlen(words);
    if (strcmp(unit, "gamma") == 0 && strcmp(shown, "Hz") == 0)
        (void)snprintf(words + used, size - used, "/2π");
}

fst_quantity fst_quantity_of_result(const char *key, const char *unit, fst_shown_units units,
                                    const fst_scales *scales)
{
    char words[96];
    const char *name;
    find_words(results, sizeof results / sizeof results[0], key, 0, words, sizeof words);
    const double factor = fst_number_shown(key, unit, units, scales, &name);
    say_turns(unit, name, words, sizeof words);
    return labelled(factor, words, name);
}

fst_quantity fst_quantity_of_column(const fst_column_info *column, fst_shown_units units,
                                    const fst_params *params)
{
    const fst_scales scales = fst_scales_of(params);
    char words[96];
    const char *name;
    find_words(columns, sizeof columns / sizeof columns[0], column->name, 1, words, sizeof words);
    const double factor = fst_column_shown(column, units, &scales, &name);
    if (strcmp(column->name, "load") == 0 && params->plate_gravity > 0.0)
        return labelled(scales.length / (scales.time * scales.time * params->plate_gravity), words,
                        "weights of the bead");
    if (strcmp(column->name, "omega") == 0 && strcmp(name, "Hz") == 0)
        return labelled(factor, "drive frequency", name);
    say_turns(column->unit, name, words, sizeof words);
    return labelled(factor, words, name);
}

fst_shown_units fst_units_over(const char *const *keys, int count)
{
    fst_shown_units units = FST_SHOWN_SCALED;
    for (int i = 0; i < count; ++i) {
        const fst_param_info *info = fst_param_at(fst_param_find(keys[i]));
        if (strcmp(keys[i], "friction.gamma") == 0 || strcmp(keys[i], "magnet.half_length") == 0)
            return FST_SHOWN_AS_GIVEN;
        if (info->kind == FST_KIND_REAL && info->unit != FST_UNIT_NUMBER && info->unit != FST_UNIT_ANGLE)
            units = FST_SHOWN_LAB;
    }
    return units;
}
