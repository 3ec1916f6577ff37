/* spectrum.c - the power spectrum of a series with gaps, by a fast Fourier transform.
 *
 * The series is laid on its grid of frames, empty places become zero, and twice as many zeros follow, so that a
 * line never falls between two frequencies of the transform.  The strongest frequency is then refined on the
 * true times, by the sum of the series times a complex wave.
 */
#include "measure/spectrum.h"

#include <stdlib.h>

#include "base/constants.h"
#include "base/dot.h"
#include "base/error.h"

#define MOST_FRAMES ((size_t)1 << 22)

/* Radix 2, in place; `size` is a power of two. */
static void transform(double *re, double *im, size_t size)
{
    for (size_t i = 1, j = 0; i < size; ++i) {
        size_t bit = size >> 1;
        for (; j & bit; bit >>= 1)
            j ^= bit;
        j ^= bit;
        if (i < j) {
            const double a = re[i], b = im[i];
            re[i] = re[j];
            im[i] = im[j];
            re[j] = a;
            im[j] = b;
        }
    }
    for (size_t half = 1; half < size; half *= 2)
        for (size_t k = 0; k < half; ++k) {
            const double angle = -FST_PI * (double)k / (double)half, c = cos(angle), s = sin(angle);
            for (size_t i = k; i < size; i += 2 * half) {
                const size_t j = i + half;
                const double a = re[j] * c - im[j] * s, b = re[j] * s + im[j] * c;
                re[j] = re[i] - a;
                im[j] = im[i] - b;
                re[i] += a;
                im[i] += b;
            }
        }
}

void measure_wave(const measure_series *s, double frequency, double sum[2])
{
    sum[0] = sum[1] = 0.0;
    for (size_t i = 0; i < s->count; ++i) {
        const double angle = FST_TWO_PI * frequency * s->t[i], c = cos(angle), w = sin(angle);
        const double b = s->im ? s->im[i] : 0.0;
        sum[0] += s->re[i] * c + b * w;
        sum[1] += b * c - s->re[i] * w;
    }
}

static double power_at(const measure_series *s, double frequency)
{
    double sum[2];
    measure_wave(s, frequency, sum);
    return fst_dot(sum, sum, 2);
}

/* The greatest power between two frequencies, where it has one peak: golden section. */
static double refine(const measure_series *s, double low, double high)
{
    static const double golden = 0.61803398874989485;
    double one = high - golden * (high - low), other = low + golden * (high - low);
    double p = power_at(s, one), q = power_at(s, other);
    for (int i = 0; i < 30; ++i) {
        if (p > q) {
            high = other;
            other = one;
            q = p;
            one = high - golden * (high - low);
            p = power_at(s, one);
        } else {
            low = one;
            one = other;
            p = q;
            other = low + golden * (high - low);
            q = power_at(s, other);
        }
    }
    return 0.5 * (low + high);
}

/* Lay the series on its grid; returns the number of rows that found a place. */
static size_t lay(const measure_series *s, size_t size, double *re, double *im)
{
    size_t laid = 0;
    for (size_t i = 0; i < s->count; ++i) {
        const double at = round((s->t[i] - s->t[0]) * s->fps);
        if (at >= 0 && at < (double)size) {
            re[(size_t)at] = s->re[i];
            im[(size_t)at] = s->im ? s->im[i] : 0.0;
            ++laid;
        }
    }
    return laid;
}

fst_status measure_strongest_line(const measure_series *s, double least, measure_line *line, fst_error *error)
{
    const double frames = (s->t[s->count - 1] - s->t[0]) * s->fps + 1.0;
    size_t size = 4;
    while ((double)size < 2.0 * frames && size < 2 * MOST_FRAMES)
        size *= 2;
    double *re = calloc(2 * size, sizeof *re);
    if (!re)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for a spectrum of %zu frames", size);
    double *im = re + size;
    const size_t laid = lay(s, size, re, im);
    transform(re, im, size);
    const double step = s->fps / (double)size;
    double best = -1.0, sum = 0.0;
    size_t at = 0, counted = 0;
    for (size_t k = 0; k < size; ++k) {
        const double f = (k <= size / 2 ? (double)k : (double)k - (double)size) * step;
        const double power = re[k] * re[k] + im[k] * im[k];
        if (fabs(f) < least || (!s->im && f < 0))
            continue;
        sum += power;
        ++counted;
        if (power > best) {
            best = power;
            at = k;
        }
    }
    free(re);
    const double f = (at <= size / 2 ? (double)at : (double)at - (double)size) * step;
    const double wide = 1.5 * step;
    /* The mean without the line: its main lobe covers some four frequencies of the transform. */
    const double mean = counted > 16 ? (sum - 3.0 * best) / ((double)counted - 4.0) : 0.0;
    line->frequency = refine(s, f - wide, f + wide);
    line->power = mean > 0 ? best / mean : INFINITY;
    line->limit = log((double)laid) + 6.9;
    return FST_OK;
}
