/* turn.h - rotations of a body: matrices whose columns are the body's axes in the laboratory. */
#ifndef FST_BASE_TURN_H
#define FST_BASE_TURN_H

#include <math.h>
#include <string.h>

/* Turn the columns by the rotation vector `angle` (Rodrigues' formula). */
static inline void fst_turn_by(double turn[3][3], const double angle[3])
{
    double size = sqrt(angle[0] * angle[0] + angle[1] * angle[1] + angle[2] * angle[2]);
    if (!(size > 0.0))
        return;
    double a[3] = {angle[0] / size, angle[1] / size, angle[2] / size}, c = cos(size), s = sin(size);
    for (int k = 0; k < 3; ++k) {
        double v[3] = {turn[0][k], turn[1][k], turn[2][k]}, along = a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
        for (int i = 0; i < 3; ++i) {
            int j = (i + 1) % 3, m = (i + 2) % 3;
            turn[i][k] = c * v[i] + s * (a[j] * v[m] - a[m] * v[j]) + (1.0 - c) * along * a[i];
        }
    }
}

/* The rotation vector, shorter than pi, that takes `from` to `to`. */
static inline void fst_turn_between(const double from[3][3], const double to[3][3], double angle[3])
{
    double m[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] = to[i][0] * from[j][0] + to[i][1] * from[j][1] + to[i][2] * from[j][2];
    const double v[3] = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]}; /* 2 sin times the axis */
    const double sine = 0.5 * sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double cosine = 0.5 * (m[0][0] + m[1][1] + m[2][2] - 1.0), size = atan2(sine, cosine);
    if (sine > 1e-6) {
        for (int i = 0; i < 3; ++i)
            angle[i] = 0.5 * v[i] * size / sine;
        return;
    }
    const int half = cosine < 0.0; /* half a turn: its axis a has a a^T = (m + 1)/2 */
    int k = m[1][1] > m[0][0] ? 1 : 0;
    k = m[2][2] > m[k][k] ? 2 : k;
    const double length = sqrt(fmax(0.0, 0.5 * (m[k][k] + 1.0)));
    for (int i = 0; i < 3; ++i)
        angle[i] = half ? size * 0.5 * (m[k][i] + (i == k)) / length : 0.5 * v[i];
}

#endif
