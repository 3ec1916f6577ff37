/* waveform.c - how the magnet moves.
 *
 *     steady       angle = omega t                      oscillating   angle = amplitude sin(omega t)
 *     chirp        angle = omega t + chirp t^2/2        table         straight between the rows, at rest outside
 *     carried      angle = 0, place = velocity t        wave          no magnet: the field travels (surroundings.c)
 */
#include "model/waveform.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"

#define MOST_DEGREES 1e6 /* as many as drive.amplitude may have */

static fst_status bad_table(fst_error *error, const char *at)
{
    return fst_fail(
        error, FST_BAD_INPUT, "drive.table",
        "drive.table: \"%.40s\" is not a row of time (s) and angle (degrees), such as 0.5:90; rows are "
        "parted by spaces: 0:0 0.5:90 1:90",
        at);
}

static int read_number(const char **text, double *value)
{
    const size_t length = fst_number_length(*text);
    *value = length ? fst_number_read(*text, length, 0) : NAN;
    *text += length;
    return isfinite(*value);
}

static fst_status read_table(const char *text, double gamma, fst_waveform *wave, fst_error *error)
{
    for (;;) {
        while (isspace((unsigned char)*text))
            ++text;
        if (!*text)
            break;
        const char *row = text;
        double time, angle;
        if (!read_number(&text, &time) || *text++ != ':' || !read_number(&text, &angle) ||
            (*text && !isspace((unsigned char)*text)))
            return bad_table(error, row);
        if (fabs(angle) > MOST_DEGREES)
            return fst_fail(
                error, FST_BAD_INPUT, "drive.table",
                "drive.table turns too far in the row \"%.40s\": by %g degrees to either side at most", row,
                MOST_DEGREES);
        const int n = wave->count;
        if (n > 0 && !(time * gamma > wave->times[n - 1]))
            return fst_fail(
                error, FST_BAD_INPUT, "drive.table",
                "drive.table goes back in time: the row \"%.40s\" is not later than the one before it", row);
        wave->times[n] = time * gamma;
        wave->angles[n] = angle / 360.0 * FST_TWO_PI;
        ++wave->count;
    }
    if (wave->count < 2)
        return fst_fail(
            error, FST_BAD_INPUT, "drive.table",
            "drive.waveform: table needs drive.table with two rows of time (s) and angle (degrees) at "
            "least, such as 0:0 0.5:90 1:90");
    return FST_OK;
}

fst_status fst_make_waveform(const fst_params *params, const fst_groups *g, fst_waveform *wave,
                             fst_error *error)
{
    memset(wave, 0, sizeof *wave);
    wave->kind = params->drive_waveform;
    wave->omega = g->omega;
    wave->amplitude = params->drive_amplitude / 360.0 * FST_TWO_PI;
    wave->chirp = FST_TWO_PI * params->drive_chirp * g->time_unit * g->time_unit;
    for (int k = 0; k < 3; ++k)
        if (wave->kind == FST_WAVEFORM_CARRIED && !isnan(params->drive_velocity[k]))
            wave->velocity[k] = params->drive_velocity[k] * g->time_unit / g->length_unit;
    const fst_status status = wave->kind == FST_WAVEFORM_TABLE
                                  ? read_table(params->drive_table, 1.0 / g->time_unit, wave, error)
                                  : FST_OK;
    (void)fst_waveform_enter(wave, 0.0);
    return status;
}

int fst_waveform_enter(fst_waveform *wave, double t)
{
    const int before = wave->piece;
    wave->piece = wave->count - 1;
    while (wave->piece >= 0 && t < wave->times[wave->piece])
        --wave->piece;
    return wave->piece != before;
}

static double slope_of(const fst_waveform *wave)
{
    const int piece = wave->piece;
    if (piece < 0 || piece == wave->count - 1)
        return 0.0;
    return (wave->angles[piece + 1] - wave->angles[piece]) / (wave->times[piece + 1] - wave->times[piece]);
}

double fst_waveform_angle(const fst_waveform *wave, double t)
{
    const int piece = wave->piece;
    switch (wave->kind) {
    case FST_WAVEFORM_STEADY:
        return wave->omega * t;
    case FST_WAVEFORM_OSCILLATING:
        return wave->amplitude * sin(wave->omega * t);
    case FST_WAVEFORM_CHIRP:
        return wave->omega * t + 0.5 * wave->chirp * (t * t);
    case FST_WAVEFORM_TABLE:
        return piece < 0 ? wave->angles[0] : wave->angles[piece] + slope_of(wave) * (t - wave->times[piece]);
    default:
        return 0.0;
    }
}

double fst_waveform_rate(const fst_waveform *wave, double t)
{
    switch (wave->kind) {
    case FST_WAVEFORM_STEADY:
        return wave->omega;
    case FST_WAVEFORM_OSCILLATING:
        return wave->amplitude * wave->omega * cos(wave->omega * t);
    case FST_WAVEFORM_CHIRP:
        return wave->omega + wave->chirp * t;
    case FST_WAVEFORM_TABLE:
        return slope_of(wave);
    default:
        return 0.0;
    }
}

double fst_waveform_period(const fst_waveform *wave)
{
    const int periodic = wave->kind == FST_WAVEFORM_STEADY || wave->kind == FST_WAVEFORM_OSCILLATING ||
                         wave->kind == FST_WAVEFORM_WAVE;
    return periodic ? FST_TWO_PI / wave->omega : INFINITY;
}

double fst_waveform_jump(const fst_waveform *wave)
{
    return wave->piece + 1 < wave->count ? wave->times[wave->piece + 1] : INFINITY;
}
