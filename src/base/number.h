/* number.h - decimal numbers in text, the same in every locale. */
#ifndef FST_BASE_NUMBER_H
#define FST_BASE_NUMBER_H

#include <locale.h>
#include <stddef.h>

/* The process may run in a locale whose decimal point is a comma.  Between these two calls the calling thread,
 * and no other, reads and writes numbers as the C locale does. */
typedef struct fst_c_locale {
    locale_t plain, before;
} fst_c_locale;
fst_c_locale fst_c_locale_enter(void);
void fst_c_locale_leave(fst_c_locale entered);

/* The length of the decimal number that `text` begins with ("-2.5e3"), or 0 if it begins with none.
 * Hexadecimal numbers, "inf" and "nan" do not count as numbers. */
size_t fst_number_length(const char *text);

/* The number in text[0..length), as fst_number_length() found it, times ten to the power `shift`.  The power is
 * added to the decimal exponent before the one rounding, so that "16.2" shifted by -3 has the same bits as
 * 0.0162.  Overflow, or more than 400 characters, gives an infinity. */
double fst_number_read(const char *text, size_t length, int shift);

/* Write the number with the fewest of 15, 16 or 17 significant digits that reads back to the same bits; "nan",
 * "inf".  Returns the length, as snprintf does. */
int fst_number_write(char *text, size_t size, double value);

#endif
