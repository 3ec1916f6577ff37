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
    {FST_UNIT_TIME, "s", 0, 1, 1},           {FST_UNIT_TIME, "ms", -3, 1, 1},
    {FST_UNIT_TIME, "us", -6, 1, 1},         {FST_UNIT_FORCE, "N", 0, 1, 1},
    {FST_UNIT_FORCE, "mN", -3, 1, 1},        {FST_UNIT_FORCE, "uN", -6, 1, 1},
    {FST_UNIT_ENERGY, "J", 0, 1, 1},         {FST_UNIT_ENERGY, "mJ", -3, 1, 1},
    {FST_UNIT_ENERGY, "uJ", -6, 1, 1},       {FST_UNIT_POWER, "W", 0, 1, 1},
    {FST_UNIT_POWER, "mW", -3, 1, 1},        {FST_UNIT_POWER, "uW", -6, 1, 1},
    {FST_UNIT_VISCOSITY, "Pa s", 0, 1, 1},   {FST_UNIT_VISCOSITY, "mPa s", -3, 1, 1},
    {FST_UNIT_PER_LENGTH, "1/m", 0, 1, 1},   {FST_UNIT_PER_LENGTH, "1/cm", 2, 1, 1},
    {FST_UNIT_PER_LENGTH, "1/mm", 3, 1, 1},  {FST_UNIT_CURRENT, "A", 0, 1, 1},
    {FST_UNIT_CURRENT, "mA", -3, 1, 1},      {FST_UNIT_CURRENT, "kA", 3, 1, 1},
};
static const size_t unit_row_count = sizeof unit_rows / sizeof unit_rows[0];

typedef struct unit_kind {
    const char *name, *accepted, *customary;
    int power;
} unit_kind;

#define KIND(NAME, name, accepted, customary, power) {name, accepted, customary, power},
static const unit_kind kinds[] = {FST_UNITS(KIND)};
#undef KIND

const char *fst_unit_name(fst_unit unit)
{
    return kinds[unit].name;
}

const char *fst_unit_accepted(fst_unit unit)
{
    return kinds[unit].accepted;
}

const char *fst_unit_customary(fst_unit unit, int *power)
{
    *power = kinds[unit].power;
    return *power ? kinds[unit].customary : kinds[unit].name;
}

/* Different spellings of one character or sign; the longest come first. */
static const struct {
    const char *found, *plain;
} spellings[] = {
    {"^2", "2"},         {"^-1", "-1"},       {"\xC2\xB2", "2"}, /* superscript two */
    {"^3", "3"},         {"\xC2\xB3", "3"},                      /* superscript three */
    {"\xC2\xB5", "u"},   {"\xCE\xBC", "u"},                      /* micro sign, Greek mu */
    {"\xC2\xB0", "deg"},                                         /* degree sign */
    {"\xC2\xB7", " "},   {"*", " "},          {".", " "},        /* products */
    {"U/min", "1/min"},  {"tr/min", "1/min"},                    /* turns, in German and in French */
};

/* Bring a unit to the spelling of the table: "µm" to "um", "A.m^2" and "A*m²" to "A m2", runs of white space to
 * one space.  A unit that is too long is cut: it is unknown in any case. */
static void plain_unit(const char *text, size_t length, char *plain, size_t size)
{
    size_t out = 0;
    for (size_t at = 0; at < length && out + 4 < size;) {
        const char *piece = text + at;
        size_t taken = 1, put = 1;
        for (size_t i = 0; i < sizeof spellings / sizeof spellings[0]; ++i) {
            const size_t found = strlen(spellings[i].found);
            if (found <= length - at && memcmp(text + at, spellings[i].found, found) == 0) {
                piece = spellings[i].plain;
                taken = found;
                put = strlen(piece);
                break;
            }
        }
        if (!strchr(" \t\r\n", *piece)) {
            memcpy(plain + out, piece, put);
            out += put;
        } else if (out && plain[out - 1] != ' ') {
            plain[out++] = ' ';
        }
        at += taken;
    }
    plain[out] = '\0';
}

static int same_but_for_case(const char *a, const char *b)
{
    while (*a && fst_lower(*a) == fst_lower(*b)) {
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

/* The sentence is the quoted text, and what is wrong with it. */
static fst_value_fault refuse(const char *text, const char *wrong, fst_value_fault fault, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    (void)fst_fail(error, FST_BAD_INPUT, "value", "%s %s", fst_quote(text, quoted), wrong);
    return fault;
}

static fst_value_fault wrong_unit(const char *text, fst_unit kind, const char *written, const char *plain,
                                  fst_error *error)
{
    char quoted[FST_QUOTE_SIZE], names[256] = "", wrong[FST_SUGGESTION_SIZE + FST_QUOTE_SIZE];
    char suggestion[FST_SUGGESTION_SIZE];
    fst_quote(written, quoted);
    for (size_t i = 0; i < unit_row_count; ++i)
        if (unit_rows[i].kind == kind) {
            size_t used = strlen(names);
            (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", unit_rows[i].name);
        }
    fst_suggest_name(plain, names, suggestion);
    const int is_near =
        strncmp(suggestion, "the nearest", strlen("the nearest")) == 0 && strchr(suggestion, '(');
    if (kind == FST_UNIT_NUMBER)
        (void)snprintf(wrong, sizeof wrong, "has the unit %s, but this value is a number without a unit",
                       quoted);
    else
        (void)snprintf(wrong, sizeof wrong, "has the unknown unit %s%s%.*s (units here: %s)", quoted,
                       is_near ? "; " : "", is_near ? (int)strcspn(suggestion, "(") - 1 : 0, suggestion,
                       kinds[kind].accepted);
    return refuse(text, wrong, FST_VALUE_WRONG_UNIT, error);
}

/* The number of `text` breaks off at a comma with a digit behind it.  The sentence shows the value with a point
 * where the comma can only be a decimal one. */
static fst_value_fault decimal_comma(const char *text, fst_error *error)
{
    char corrected[64], quoted[FST_QUOTE_SIZE], wrong[160];
    const size_t comma = strcspn(text, ",");
    const char next = text[comma + 1 + strspn(text + comma + 1, "0123456789")];
    if (memchr(text, '.', comma) || next == ',' || next == '.')
        return refuse(text,
                      "has a comma in the number: write a decimal point, and nothing between thousands, as in "
                      "1234.5",
                      FST_VALUE_COMMA, error);
    (void)snprintf(corrected, sizeof corrected, "%s", text);
    if (comma < strlen(corrected))
        corrected[comma] = '.';
    (void)snprintf(wrong, sizeof wrong, "has a decimal comma: write %s, with a point",
                   fst_quote(corrected, quoted));
    return refuse(text, wrong, FST_VALUE_COMMA, error);
}

fst_value_fault fst_value_read(const char *text, fst_unit unit, double *value, fst_error *error)
{
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    if (length == 0) {
        (void)fst_fail(error, FST_BAD_INPUT, "value", "the value is missing");
        return FST_VALUE_MISSING;
    }
    const size_t number = fst_number_length(trimmed), gap = number + strspn(trimmed + number, " \t\r\n");
    const char *behind = trimmed + number;
    if (number > 0 && behind[0] == ',' && behind[1] >= '0' && behind[1] <= '9')
        return decimal_comma(trimmed, error);

    char written[64] = "", plain[32];
    if (gap < length)
        (void)snprintf(written, sizeof written, "%.*s", (int)(length - gap), trimmed + gap);
    plain_unit(written, strlen(written), plain, sizeof plain);
    static const unit_row bare = {FST_UNIT_NUMBER, "", 0, 1, 1};
    const unit_row *row = written[0] ? find_unit(unit, plain) : &bare;
    /* "0x10" begins with a number, the zero, so the complaint would be about the unit "x10": say what is really
     * wrong. */
    if (number == 0 || (!row && (written[0] == 'x' || written[0] == 'X')))
        return refuse(text, "is not a decimal number", FST_VALUE_NO_NUMBER, error);
    if (!row)
        return wrong_unit(text, unit, written, plain, error);

    const double result = fst_number_read(trimmed, number, row->shift) * row->times / row->over;
    if (!isfinite(result))
        return refuse(text, "is too large for a number", FST_VALUE_TOO_LARGE, error);
    *value = result;
    return FST_VALUE_READ;
}

fst_status fst_parse_value(const char *text, fst_unit unit, double *value, fst_error *error)
{
    return fst_value_read(text, unit, value, error) == FST_VALUE_READ ? FST_OK : FST_BAD_INPUT;
}

const char *fst_unit_meant(fst_unit unit, double number, double usual)
{
    const char *meant = NULL;
    double least = fabs(log(fabs(number / usual)));
    for (const unit_row *row = unit_rows; row < unit_rows + unit_row_count; ++row) {
        const double there = number * pow(10, row->shift) * row->times / row->over;
        const double distance = fabs(log(fabs(there / usual)));
        if (row->kind == unit && distance < least) {
            least = distance;
            meant = row->name;
        }
    }
    return meant;
}

int fst_value_write(char *text, size_t size, double value, fst_unit unit)
{
    char number[40], candidate[64];
    const char *customary = kinds[unit].customary;
    (void)fst_number_write(number, sizeof number, value);
    if (!customary[0])
        return snprintf(text, size, "%s", number);
    /* The customary units are powers of ten of the SI unit: shift the digits instead of computing with the
     * value. */
    const double shifted = fst_number_read(number, fst_number_length(number), kinds[unit].power);
    double back;
    (void)fst_number_write(number, sizeof number, shifted);
    (void)snprintf(candidate, sizeof candidate, "%s %s", number, customary);
    if (fst_parse_value(candidate, unit, &back, NULL) == FST_OK && memcmp(&back, &value, sizeof value) == 0)
        return snprintf(text, size, "%s", candidate);
    (void)fst_number_write(number, sizeof number, value);
    return snprintf(text, size, "%s %s", number, kinds[unit].name);
}
