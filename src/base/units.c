/* units.c - the units that values may carry: reading "2.5 mm", and writing values in the units that
 * people use. */
#include "base/units.h"

#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

/* One unit: the value in SI is number * 10^shift * times / over.  The power of ten goes into the decimal text
 * before it is read, so that "2.5 mm" is the double nearest to 0.0025. */
typedef struct unit_row {
    fst_unit kind;
    const char *name; /* in the plain spelling that plain_unit() makes */
    int shift;
    double times, over;
} unit_row;

static const unit_row unit_rows[] = {
    {FST_UNIT_LENGTH, "m", 0, 1, 1},         {FST_UNIT_LENGTH, "cm", -2, 1, 1},
    {FST_UNIT_LENGTH, "mm", -3, 1, 1},       {FST_UNIT_LENGTH, "um", -6, 1, 1},
    {FST_UNIT_MASS, "kg", 0, 1, 1},          {FST_UNIT_MASS, "g", -3, 1, 1},
    {FST_UNIT_MASS, "mg", -6, 1, 1},         {FST_UNIT_MOMENT, "A m2", 0, 1, 1},
    {FST_UNIT_MOMENT, "mA m2", -3, 1, 1},    {FST_UNIT_FIELD, "T", 0, 1, 1},
    {FST_UNIT_FIELD, "mT", -3, 1, 1},        {FST_UNIT_FIELD, "uT", -6, 1, 1},
    {FST_UNIT_FIELD, "G", -4, 1, 1},         {FST_UNIT_FREQUENCY, "Hz", 0, 1, 1},
    {FST_UNIT_FREQUENCY, "kHz", 3, 1, 1},    {FST_UNIT_FREQUENCY, "rpm", 0, 1, 60},
    {FST_UNIT_FREQUENCY, "1/min", 0, 1, 60}, {FST_UNIT_FREQUENCY, "rad/s", 0, 1, 2 * FST_PI},
    {FST_UNIT_RATE, "1/s", 0, 1, 1},         {FST_UNIT_RATE, "s-1", 0, 1, 1},
    {FST_UNIT_RATE, "1/ms", 3, 1, 1},        {FST_UNIT_ACCELERATION, "m/s2", 0, 1, 1},
    {FST_UNIT_SPEED, "m/s", 0, 1, 1},        {FST_UNIT_SPEED, "cm/s", -2, 1, 1},
    {FST_UNIT_SPEED, "mm/s", -3, 1, 1},      {FST_UNIT_PRESSURE, "Pa", 0, 1, 1},
    {FST_UNIT_PRESSURE, "kPa", 3, 1, 1},     {FST_UNIT_PRESSURE, "MPa", 6, 1, 1},
    {FST_UNIT_PRESSURE, "GPa", 9, 1, 1},     {FST_UNIT_ANGLE, "deg", 0, 1, 1},
    {FST_UNIT_ANGLE, "rad", 0, 180, FST_PI}, {FST_UNIT_ANGLE, "turn", 0, 360, 1},
    {FST_UNIT_DENSITY, "kg/m3", 0, 1, 1},    {FST_UNIT_DENSITY, "g/cm3", 3, 1, 1},
};
static const size_t unit_row_count = sizeof unit_rows / sizeof unit_rows[0];

/* For each kind: the SI unit, the list for messages, and the row of the unit in which people like to read
 * values. */
static const struct {
    const char *name, *accepted, *customary;
} kinds[] = {
    [FST_UNIT_NUMBER] = {"1", "", NULL},
    [FST_UNIT_LENGTH] = {"m", "um mm cm m", "mm"},
    [FST_UNIT_MASS] = {"kg", "mg g kg", "g"},
    [FST_UNIT_MOMENT] = {"A m^2", "\"A m^2\" \"mA m^2\"", "A m2"},
    [FST_UNIT_FIELD] = {"T", "uT mT T G", "mT"},
    [FST_UNIT_FREQUENCY] = {"Hz", "Hz kHz rpm 1/min rad/s", "Hz"},
    [FST_UNIT_RATE] = {"1/s", "1/s s-1 1/ms", "1/s"},
    [FST_UNIT_ACCELERATION] = {"m/s^2", "m/s^2", "m/s2"},
    [FST_UNIT_SPEED] = {"m/s", "mm/s cm/s m/s", "mm/s"},
    [FST_UNIT_PRESSURE] = {"Pa", "Pa kPa MPa GPa", "GPa"},
    [FST_UNIT_ANGLE] = {"deg", "deg rad turn", "deg"},
    [FST_UNIT_DENSITY] = {"kg/m^3", "kg/m^3 g/cm^3", "kg/m3"},
};

const char *fst_unit_name(fst_unit unit)
{
    return kinds[unit].name;
}

const char *fst_unit_accepted(fst_unit unit)
{
    return kinds[unit].accepted;
}

/* Different spellings of one character or sign; the longest come first. */
static const struct {
    const char *found, *plain;
} spellings[] = {
    {"^2", "2"},         {"^-1", "-1"},     {"\xC2\xB2", "2"}, /* superscript two */
    {"^3", "3"},         {"\xC2\xB3", "3"},                    /* superscript three */
    {"\xC2\xB5", "u"},   {"\xCE\xBC", "u"},                    /* micro sign, Greek mu */
    {"\xC2\xB0", "deg"},                                       /* degree sign */
    {"\xC2\xB7", " "},   {"*", " "},        {".", " "},        /* products */
};

/* Bring a unit to the spelling of the table: "µm" to "um", "A.m^2" and "A*m²" to "A m2", runs of white space to
 * one space.  A unit that is too long is cut: it is unknown in any case. */
static void plain_unit(const char *text, size_t length, char *plain, size_t size)
{
    size_t out = 0;
    for (size_t at = 0; at < length && out + 4 < size;) {
        const char *piece = NULL;
        size_t taken = 1;
        for (size_t i = 0; i < sizeof spellings / sizeof spellings[0] && !piece; ++i) {
            size_t found = strlen(spellings[i].found);
            if (found <= length - at && memcmp(text + at, spellings[i].found, found) == 0) {
                piece = spellings[i].plain;
                taken = found;
            }
        }
        char letter = piece ? piece[0] : text[at];
        if (strchr(" \t\r\n", letter)) {
            if (out && plain[out - 1] != ' ')
                plain[out++] = ' ';
        } else if (piece) {
            memcpy(plain + out, piece, strlen(piece));
            out += strlen(piece);
        } else {
            plain[out++] = letter;
        }
        at += taken;
    }
    plain[out] = '\0';
}

static int lower(char letter)
{
    return letter >= 'A' && letter <= 'Z' ? letter - 'A' + 'a' : letter;
}

static int same_but_for_case(const char *a, const char *b)
{
    while (*a && lower(*a) == lower(*b)) {
        ++a;
        ++b;
    }
    return *a == *b;
}

/* Units of frequency are also read in capitals, because stirrers say "RPM".  In other kinds the case tells mT
 * from MT, and mPa from MPa. */
static const unit_row *find_unit(fst_unit kind, const char *plain)
{
    for (size_t i = 0; i < unit_row_count; ++i) {
        const unit_row *row = &unit_rows[i];
        if (row->kind == kind && (strcmp(row->name, plain) == 0 ||
                                  (kind == FST_UNIT_FREQUENCY && same_but_for_case(row->name, plain))))
            return row;
    }
    return NULL;
}

static void wrong_unit(const char *text, fst_unit kind, const char *written, const char *plain,
                       fst_error *error)
{
    char quoted_text[FST_QUOTE_SIZE], quoted[FST_QUOTE_SIZE];
    fst_quote(text, quoted_text);
    fst_quote(written, quoted);
    if (kind == FST_UNIT_NUMBER) {
        (void)fst_fail(error, FST_BAD_INPUT, "value",
                       "%s has the unit %s, but this value is a number without a unit", quoted_text, quoted);
        return;
    }
    char names[256] = "", nearest[16];
    for (size_t i = 0; i < unit_row_count; ++i)
        if (unit_rows[i].kind == kind) {
            size_t used = strlen(names);
            (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", unit_rows[i].name);
        }
    fst_nearest_name(plain, names, nearest, sizeof nearest);
    (void)fst_fail(error, FST_BAD_INPUT, "value",
                   "%s has the unknown unit %s; the nearest is %s (units here: %s)", quoted_text, quoted,
                   nearest, kinds[kind].accepted);
}

static fst_value_fault no_number(const char *text, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    (void)fst_fail(error, FST_BAD_INPUT, "value", "%s is no decimal number", fst_quote(text, quoted));
    return FST_VALUE_NO_NUMBER;
}

/* The number of `text` breaks off at a comma with a digit behind it.  The sentence shows the value with a point
 * where the comma can only be a decimal one. */
static fst_value_fault decimal_comma(const char *text, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    const char *comma = strchr(text, ',');
    const char next = comma[1 + strspn(comma + 1, "0123456789")];
    if (memchr(text, '.', (size_t)(comma - text)) || next == ',' || next == '.') {
        (void)fst_fail(
            error, FST_BAD_INPUT, "value",
            "%s has a comma in the number: write a decimal point, and nothing between thousands, as in "
            "1234.5",
            fst_quote(text, quoted));
        return FST_VALUE_COMMA;
    }
    char corrected[64];
    (void)snprintf(corrected, sizeof corrected, "%s", text);
    if (strcspn(corrected, ",") < strlen(corrected))
        corrected[strcspn(corrected, ",")] = '.';
    char quoted_corrected[FST_QUOTE_SIZE];
    (void)fst_fail(error, FST_BAD_INPUT, "value", "%s has a decimal comma: write %s, with a point",
                   fst_quote(text, quoted), fst_quote(corrected, quoted_corrected));
    return FST_VALUE_COMMA;
}

fst_value_fault fst_value_read(const char *text, fst_unit unit, double *value, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    if (length == 0) {
        (void)fst_fail(error, FST_BAD_INPUT, "value", "the value is missing");
        return FST_VALUE_MISSING;
    }
    size_t number = fst_number_length(trimmed);
    if (number == 0)
        return no_number(text, error);

    if (trimmed[number] == ',' && trimmed[number + 1] >= '0' && trimmed[number + 1] <= '9')
        return decimal_comma(trimmed, error);

    size_t gap = number + strspn(trimmed + number, " \t\r\n");
    char written[64] = "", plain[32];
    if (gap < length)
        (void)snprintf(written, sizeof written, "%.*s", (int)(length - gap), trimmed + gap);
    plain_unit(written, strlen(written), plain, sizeof plain);
    static const unit_row bare = {FST_UNIT_NUMBER, "", 0, 1, 1};
    const unit_row *row = written[0] ? find_unit(unit, plain) : &bare;
    /* "0x10" begins with a number, the zero, so the complaint would be about the unit "x10": say what is really
     * wrong. */
    if (!row && (written[0] == 'x' || written[0] == 'X'))
        return no_number(text, error);
    if (!row) {
        wrong_unit(text, unit, written, plain, error);
        return FST_VALUE_WRONG_UNIT;
    }

    double result = fst_number_read(trimmed, number, row->shift) * row->times / row->over;
    if (!isfinite(result)) {
        (void)fst_fail(error, FST_BAD_INPUT, "value", "%s is too large for a number", fst_quote(text, quoted));
        return FST_VALUE_TOO_LARGE;
    }
    *value = result;
    return FST_VALUE_READ;
}

fst_status fst_parse_value(const char *text, fst_unit unit, double *value, fst_error *error)
{
    return fst_value_read(text, unit, value, error) == FST_VALUE_READ ? FST_OK : FST_BAD_INPUT;
}

int fst_value_write(char *text, size_t size, double value, fst_unit unit)
{
    char number[40], candidate[64];
    const char *customary = kinds[unit].customary;
    if (!customary) {
        (void)fst_number_write(number, sizeof number, value);
        return snprintf(text, size, "%s", number);
    }
    /* The customary units are powers of ten of the SI unit: shift the digits instead of computing with the
     * value. */
    const unit_row *row = find_unit(unit, customary);
    (void)fst_number_write(number, sizeof number, value);
    double shifted = fst_number_read(number, fst_number_length(number), -row->shift);
    double back;
    (void)fst_number_write(number, sizeof number, shifted);
    (void)snprintf(candidate, sizeof candidate, "%s %s", number, customary);
    if (fst_parse_value(candidate, unit, &back, NULL) == FST_OK && memcmp(&back, &value, sizeof value) == 0)
        return snprintf(text, size, "%s", candidate);
    (void)fst_number_write(number, sizeof number, value);
    return snprintf(text, size, "%s %s", number, kinds[unit].name);
}
