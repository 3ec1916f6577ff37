/* number.c - decimal numbers to and from text, the same in every locale. */
#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The longest number that is read.  No double needs more than 770 digits, and nobody types 400. */
#define LONGEST 400

fst_c_locale fst_c_locale_enter(void)
{
    fst_c_locale entered = {newlocale(LC_ALL_MASK, "C", (locale_t)0), (locale_t)0};
    entered.before = uselocale(entered.plain);
    return entered;
}

void fst_c_locale_leave(fst_c_locale entered)
{
    uselocale(entered.before);
    if (entered.plain)
        freelocale(entered.plain);
}

static size_t digits_at(const char *text)
{
    return strspn(text, "0123456789");
}

size_t fst_number_length(const char *text)
{
    size_t at = text[0] == '+' || text[0] == '-';
    size_t whole = digits_at(text + at);
    at += whole;
    size_t fraction = 0;
    if (text[at] == '.') {
        fraction = digits_at(text + at + 1);
        at += 1 + fraction;
    }
    if (whole + fraction == 0)
        return 0;
    /* An 'e' without digits behind it is not an exponent; the caller then takes it for the beginning of a unit. */
    if (text[at] == 'e' || text[at] == 'E') {
        size_t sign = text[at + 1] == '+' || text[at + 1] == '-';
        size_t exponent = digits_at(text + at + 1 + sign);
        if (exponent)
            at += 1 + sign + exponent;
    }
    return at;
}

double fst_number_read(const char *text, size_t length, int shift)
{
    if (length > LONGEST)
        return INFINITY;
    size_t mantissa = 0;
    while (mantissa < length && text[mantissa] != 'e' && text[mantissa] != 'E')
        ++mantissa;
    long exponent = 0;
    if (mantissa < length)
        exponent = strtol(text + mantissa + 1, NULL, 10);
    /* Clamped far outside the range of a double, so that the sum below cannot overflow. */
    exponent = exponent > 100000 ? 100000 : exponent < -100000 ? -100000 : exponent;
    char shifted[LONGEST + 16];
    (void)snprintf(shifted, sizeof shifted, "%.*se%ld", (int)mantissa, text, exponent + shift);
    fst_c_locale locale = fst_c_locale_enter();
    double value = strtod(shifted, NULL);
    fst_c_locale_leave(locale);
    return value;
}

int fst_number_write(char *text, size_t size, double value)
{
    fst_c_locale locale = fst_c_locale_enter();
    char number[40] = "";
    int length = 0;
    for (int digits = 15; digits <= 17; ++digits) {
        length = snprintf(number, sizeof number, "%.*g", digits, value);
        if (!isfinite(value) || memcmp(&(double){strtod(number, NULL)}, &value, sizeof value) == 0)
            break;
    }
    fst_c_locale_leave(locale);
    if (size)
        (void)snprintf(text, size, "%s", number);
    return length;
}
