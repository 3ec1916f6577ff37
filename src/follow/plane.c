/* plane.c - scales in words, homographies, ellipses. */
#include "follow/plane.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

static const char where[] = "fst_film_track_options.scale";

/* ------------------------------------------------------------------ words */

static fst_status no_scale(const char *text, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    return fst_fail(error, FST_BAD_INPUT, where,
                    "%s is not a scale: write \"bead 5 mm\" or \"plate 460 mm\" (diameters), "
                    "\"120,80:620,84=50mm\" (two pixels and their distance), or four corners of a rectangle "
                    "and its sides, \"X1,Y1:X2,Y2:X3,Y3:X4,Y4=80x60mm\"",
                    fst_quote(text, quoted));
}

/* A length in mm, more than 0. */
static fst_status read_length(const char *text, const char *whole, double *length, fst_error *error)
{
    double metres;
    size_t size;
    const char *number = fst_trim(text, &size);
    if (fst_number_length(number) == size) /* whether metres or millimetres are meant is not guessed */
        return fst_fail(error, FST_BAD_INPUT, where, "the length \"%.40s\" needs a unit: %s", number,
                        fst_unit_accepted(FST_UNIT_LENGTH));
    if (fst_parse_value(text, FST_UNIT_LENGTH, &metres, error) != FST_OK || !(metres > 0.0 && metres < 1e3))
        return no_scale(whole, error);
    *length = 1e3 * metres;
    return FST_OK;
}

/* "80mm", "80x60mm", "80 mm x 60 mm". */
static fst_status read_sides(const char *text, const char *whole, double length[2], fst_error *error)
{
    char first[64];
    const char *x = strchr(text, 'x');
    if (!x) {
        const fst_status status = read_length(text, whole, &length[0], error);
        length[1] = length[0];
        return status;
    }
    (void)snprintf(first, sizeof first, "%.*s", (int)(x - text < 40 ? x - text : 40), text);
    const char *last = first + strlen(first);
    while (last > first && last[-1] == ' ')
        --last;
    /* A side without a unit has that of the other. */
    if (last > first && last[-1] >= '0' && last[-1] <= '9') {
        const char *unit = x + 1 + strspn(x + 1, " ");
        unit += fst_number_length(unit);
        (void)snprintf(first + (last - first), sizeof first - (size_t)(last - first), "%.16s", unit);
    }
    const fst_status status = read_length(first, whole, &length[0], error);
    return status == FST_OK ? read_length(x + 1, whole, &length[1], error) : status;
}

/* "120,80": returns what follows, or NULL. */
static const char *read_point(const char *text, double point[2])
{
    for (int i = 0; i < 2; ++i) {
        text += strspn(text, " ");
        const size_t length = fst_number_length(text);
        if (length == 0)
            return NULL;
        point[i] = fst_number_read(text, length, 0);
        text += length;
        text += strspn(text, " ");
        if (i == 0 && *text++ != ',')
            return NULL;
    }
    return text;
}

static fst_status read_points(const char *text, follow_scale *scale, fst_error *error)
{
    const char *at = text;
    int count = 0;
    while (at && count < 4) {
        at = read_point(at, scale->points[count]);
        ++count;
        if (!at || *at != ':')
            break;
        ++at;
    }
    if (!at || *at != '=' || (count != 2 && count != 4))
        return no_scale(text, error);
    if (count == 4) {
        scale->kind = FOLLOW_SCALE_FOUR;
        return read_sides(at + 1, text, scale->length, error);
    }
    scale->kind = FOLLOW_SCALE_TWO;
    if (!(hypot(scale->points[1][0] - scale->points[0][0], scale->points[1][1] - scale->points[0][1]) >= 1.0))
        return fst_fail(error, FST_BAD_INPUT, where, "the two points of the scale are the same");
    return read_length(at + 1, text, &scale->length[0], error);
}

fst_status follow_scale_read(const char *text, follow_scale *scale, fst_error *error)
{
    *scale = (follow_scale){.kind = FOLLOW_SCALE_NONE};
    const char *begin = text + strspn(text, " ");
    if (strncmp(begin, "bead ", 5) == 0) {
        scale->kind = FOLLOW_SCALE_BEAD;
        return read_length(begin + 5, text, &scale->length[0], error);
    }
    if (strncmp(begin, "plate ", 6) == 0) {
        scale->kind = FOLLOW_SCALE_PLATE;
        return read_length(begin + 6, text, &scale->length[0], error);
    }
    return read_points(begin, scale, error);
}

fst_status follow_scales_read(const char *text, follow_scale scales[FST_FILM_SCALES],
                              fst_film_scale told[FST_FILM_SCALES], int *count, fst_error *error)
{
    char one[256];
    *count = 0;
    for (const char *at = text; at; ++*count) {
        const size_t length = strcspn(at, ";");
        if (*count == FST_FILM_SCALES || length >= sizeof one)
            return fst_fail(error, FST_BAD_INPUT, where, "there are more than %d scales, or one is too long",
                            FST_FILM_SCALES);
        (void)snprintf(one, sizeof one, "%.*s", (int)length, at);
        (void)snprintf(told[*count].text, sizeof told->text, "%.63s", one + strspn(one, " "));
        const fst_status status = follow_scale_read(one, &scales[*count], error);
        if (status != FST_OK)
            return status;
        at = at[length] ? at + length + 1 : NULL;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ maps */

void follow_plane_map(const follow_plane *plane, double column, double row, double *x, double *y)
{
    double out[3];
    for (int i = 0; i < 3; ++i)
        out[i] = plane->m[i][0] * column + plane->m[i][1] * row + plane->m[i][2];
    *x = out[0] / out[2];
    *y = out[1] / out[2];
}

/* How a place changes over a pixel of the columns, then of the rows. */
static void change_at(const follow_plane *plane, double column, double row, double change[2][2])
{
    static const double beside[4][2] = {{-0.5, 0.0}, {0.5, 0.0}, {0.0, -0.5}, {0.0, 0.5}};
    double x[4], y[4];
    for (int i = 0; i < 4; ++i) /* half a pixel to each side */
        follow_plane_map(plane, column + beside[i][0], row + beside[i][1], &x[i], &y[i]);
    for (int i = 0; i < 2; ++i) {
        change[i][0] = x[2 * i + 1] - x[2 * i];
        change[i][1] = y[2 * i + 1] - y[2 * i];
    }
}

double follow_plane_step(const follow_plane *plane, double column, double row)
{
    double c[2][2];
    change_at(plane, column, row, c);
    return sqrt(fabs(c[0][0] * c[1][1] - c[0][1] * c[1][0]));
}

double follow_plane_least_step(const follow_plane *plane, double column, double row)
{
    double c[2][2];
    change_at(plane, column, row, c);
    const double all = c[0][0] * c[0][0] + c[0][1] * c[0][1] + c[1][0] * c[1][0] + c[1][1] * c[1][1],
                 area = c[0][0] * c[1][1] - c[0][1] * c[1][0];
    return sqrt(0.5 * (all - sqrt(fmax(0.0, all * all - 4.0 * area * area))));
}

follow_plane follow_plane_even(double factor, double last_row)
{
    return (follow_plane){{{factor, 0.0, 0.0}, {0.0, -factor, factor * last_row}, {0.0, 0.0, 1.0}}};
}

/* out = a b; out may be one of them. */
static void multiply(double a[3][3], double b[3][3], double out[3][3])
{
    double product[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            product[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    memcpy(out, product, sizeof product);
}

/* Turn the plane about its origin so that x points to the right in the picture at a pixel. */
static void straighten(follow_plane *plane, double column, double row)
{
    double x[2], y[2];
    follow_plane_map(plane, column - 0.5, row, &x[0], &y[0]);
    follow_plane_map(plane, column + 0.5, row, &x[1], &y[1]);
    const double length = hypot(x[1] - x[0], y[1] - y[0]), c = (x[1] - x[0]) / length,
                 s = (y[1] - y[0]) / length;
    double turn[3][3] = {{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}};
    multiply(turn, plane->m, plane->m);
}

int follow_solve(double *a, double *b, int n)
{
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k]))
                pivot = i;
        if (!(fabs(a[pivot * n + k]) > 1e-13))
            return 0;
        for (int j = 0; j < n && pivot != k; ++j) {
            const double kept = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = kept;
        }
        const double kept = b[k];
        b[k] = b[pivot];
        b[pivot] = kept;
        for (int i = k + 1; i < n; ++i) {
            const double factor = a[i * n + k] / a[k * n + k];
            for (int j = k; j < n; ++j)
                a[i * n + j] -= factor * a[k * n + j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = n - 1; k >= 0; --k) {
        for (int j = k + 1; j < n; ++j)
            b[k] -= a[k * n + j] * b[j];
        b[k] /= a[k * n + k];
    }
    return 1;
}

/* Twice the area of the triangle of three points with y up: positive where they go round counter-clockwise. */
static double turn_of(const double a[2], const double b[2], const double c[2])
{
    return -((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

fst_status follow_plane_of_rectangle(const follow_scale *scale, follow_plane *plane, fst_error *error)
{
    double turns[4], middle[2] = {0.0, 0.0}, a[64] = {0.0}, b[8], spread = 1.0;
    for (int i = 0; i < 4; ++i) {
        turns[i] = turn_of(scale->points[i], scale->points[(i + 1) % 4], scale->points[(i + 2) % 4]);
        middle[0] += 0.25 * scale->points[i][0];
        middle[1] += 0.25 * scale->points[i][1];
    }
    for (int i = 0; i < 4; ++i)
        if (!(turns[i] * turns[0] > 0.0) || !(fabs(turns[i]) > 4.0))
            return fst_fail(
                error, FST_BAD_INPUT, where,
                "the four points must go round the rectangle, corner by corner, with no three in a line");
    for (int i = 0; i < 4; ++i)
        spread = fmax(spread, hypot(scale->points[i][0] - middle[0], scale->points[i][1] - middle[1]));
    const double side = turns[0] > 0.0 ? 1.0 : -1.0, half[2] = {0.5 * scale->length[0], 0.5 * scale->length[1]};
    static const int corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 4; ++i) { /* two equations a point; pixels about the middle, in units of the spread */
        const double u = (scale->points[i][0] - middle[0]) / spread,
                     v = (scale->points[i][1] - middle[1]) / spread;
        const double to[2] = {corner[i][0] * half[0], side * corner[i][1] * half[1]};
        for (int k = 0; k < 2; ++k) {
            double *row = a + 8 * (2 * i + k);
            row[3 * k] = u;
            row[3 * k + 1] = v;
            row[3 * k + 2] = 1.0;
            row[6] = -u * to[k];
            row[7] = -v * to[k];
            b[2 * i + k] = to[k];
        }
    }
    if (!follow_solve(a, b, 8))
        return fst_fail(error, FST_BAD_INPUT, where, "no rectangle has its corners at the four points");
    double centred[3][3] = {
        {1.0 / spread, 0.0, -middle[0] / spread}, {0.0, 1.0 / spread, -middle[1] / spread}, {0.0, 0.0, 1.0}};
    double found[3][3] = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}, {b[6], b[7], 1.0}};
    multiply(found, centred, plane->m);
    straighten(plane, middle[0], middle[1]);
    return FST_OK;
}

/* ------------------------------------------------------------------ ellipses */

int follow_ellipse_fit(const double *points, int count, follow_ellipse *ellipse)
{
    double middle[2] = {0.0, 0.0}, spread = 0.0, a[25] = {0.0}, b[5] = {0.0};
    if (count < 5)
        return 0;
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < 2; ++k)
            middle[k] += points[2 * i + k] / count;
    for (int i = 0; i < count; ++i)
        spread = fmax(spread, hypot(points[2 * i] - middle[0], points[2 * i + 1] - middle[1]));
    if (!(spread > 0.0))
        return 0;
    /* p x^2 + q x y + r y^2 + s x + t y = 1 */
    for (int i = 0; i < count; ++i) {
        const double x = (points[2 * i] - middle[0]) / spread, y = (points[2 * i + 1] - middle[1]) / spread;
        const double terms[5] = {x * x, x * y, y * y, x, y};
        for (int j = 0; j < 5; ++j) {
            b[j] += terms[j];
            for (int k = 0; k < 5; ++k)
                a[5 * j + k] += terms[j] * terms[k];
        }
    }
    if (!follow_solve(a, b, 5))
        return 0;
    const double determinant = b[0] * b[2] - 0.25 * b[1] * b[1];
    if (!(determinant > 0.0) || !(b[0] > 0.0))
        return 0;
    const double x = (0.25 * b[1] * b[4] - 0.5 * b[2] * b[3]) / determinant;
    const double y = (0.25 * b[1] * b[3] - 0.5 * b[0] * b[4]) / determinant;
    const double level = 1.0 + b[0] * x * x + b[1] * x * y + b[2] * y * y;
    const double half = 0.5 * (b[0] + b[2]), off = hypot(0.5 * (b[0] - b[2]), 0.5 * b[1]);
    if (!(level > 0.0) || !(half - off > 0.0))
        return 0;
    ellipse->centre[0] = middle[0] + spread * x;
    ellipse->centre[1] = middle[1] + spread * y;
    ellipse->axes[0] = spread * sqrt(level / (half - off));
    ellipse->axes[1] = spread * sqrt(level / (half + off));
    ellipse->angle = 0.5 * atan2(-b[1], b[2] - b[0]); /* the direction in which the form is least */
    return 1;
}

void follow_ellipse_point(const follow_ellipse *e, double turn, double point[2])
{
    const double p = e->axes[0] * cos(turn), q = e->axes[1] * sin(turn), c = cos(e->angle), s = sin(e->angle);
    point[0] = e->centre[0] + c * p - s * q;
    point[1] = e->centre[1] + s * p + c * q;
}

fst_status follow_plane_of_circle(const follow_ellipse *seen, const double horizon[2], double radius,
                                  follow_plane *plane, fst_error *error)
{
    enum { POINTS = 16 };
    /* First the perspective alone, which leaves an ellipse ... */
    follow_plane flat = {
        {{1.0, 0.0, -seen->centre[0]},
         {0.0, 1.0, -seen->centre[1]},
         {horizon[0], horizon[1], 1.0 - horizon[0] * seen->centre[0] - horizon[1] * seen->centre[1]}}};
    double points[2 * POINTS];
    follow_ellipse e;
    for (int i = 0; i < POINTS; ++i) {
        double point[2];
        follow_ellipse_point(seen, FST_TWO_PI * i / POINTS, point);
        follow_plane_map(&flat, point[0], point[1], &points[2 * i], &points[2 * i + 1]);
    }
    if (!follow_ellipse_fit(points, POINTS, &e))
        return fst_fail(error, FST_BAD_INPUT, where, "the edge of the plate is not an ellipse");
    /* ... then along its axes, each stretched to the radius, with y up. */
    const double c = cos(e.angle), s = sin(e.angle), p = radius / e.axes[0], q = radius / e.axes[1];
    double move[3][3] = {{1.0, 0.0, -e.centre[0]}, {0.0, 1.0, -e.centre[1]}, {0.0, 0.0, 1.0}};
    double stretch[3][3] = {{p * c, p * s, 0.0}, {q * s, -q * c, 0.0}, {0.0, 0.0, 1.0}};
    multiply(move, flat.m, plane->m);
    multiply(stretch, plane->m, plane->m);
    straighten(plane, seen->centre[0], seen->centre[1]);
    return FST_OK;
}
