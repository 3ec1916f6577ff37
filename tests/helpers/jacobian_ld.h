/* jacobian_ld.h - the Jacobian of the equations of motion (model/dynamics.inl) once more, entry by entry: what
 * the library's own, the columns of which are tangents, is held against.
 *
 * A second writing of the physics, of the lines and of the laws `viscous` and `none`, by charges and indices.
 * The field enters with its second derivatives, T_ijk = dG_ij/dx_k = sum of s [ -3 (delta_ij d_k + delta_ik d_j
 * + delta_jk d_i)/d^5 + 15 d_i d_j d_k/d^7 ].
 */
#ifndef FST_TESTS_JACOBIAN_LD_H
#define FST_TESTS_JACOBIAN_LD_H

#include "physics_ld.h"

/* B, the full matrix G, and T restricted to k = x, y (the bead stays on the plate). */
typedef struct FN(field_derivatives) {
    REAL b[3], g[3][3], t[3][3][2];
} FN(field_derivatives);

static inline void FN(add_charge)(FN(field_derivatives) * out, REAL s, const REAL d[3])
{
    const REAL inverse2 = R(1.0) / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const REAL inverse3 = s * inverse2 * REAL_SQRT(inverse2);
    const REAL inverse5 = inverse3 * inverse2, inverse7 = inverse5 * inverse2;
    for (int i = 0; i < 3; ++i) {
        out->b[i] = out->b[i] + inverse3 * d[i];
        out->g[i][i] = out->g[i][i] + inverse3;
        for (int j = 0; j < 3; ++j) {
            out->g[i][j] = out->g[i][j] - R(3.0) * inverse5 * d[i] * d[j];
            for (int k = 0; k < 2; ++k) {
                REAL t = R(15.0) * inverse7 * d[i] * d[j] * d[k];
                if (i == j)
                    t = t - R(3.0) * inverse5 * d[k];
                if (i == k)
                    t = t - R(3.0) * inverse5 * d[j];
                if (j == k)
                    t = t - R(3.0) * inverse5 * d[i];
                out->t[i][j][k] = out->t[i][j][k] + t;
            }
        }
    }
}

static inline void FN(field_with_derivatives)(const FN(world) * c, REAL x, REAL y, FN(field_derivatives) * out)
{
    const REAL zero = x - x;
    for (int i = 0; i < 3; ++i) {
        out->b[i] = zero;
        for (int j = 0; j < 3; ++j)
            out->g[i][j] = out->t[i][j][0] = out->t[i][j][1] = zero;
    }
    const FN(lines) *lines = &c->source.lines;
    for (int line = 0; line < c->kinds.pieces; ++line) {
        const REAL dy = y - R(0.5) * REAL_OF(2 * line - c->kinds.pieces + 1) * lines->spacing;
        const REAL to_plus[3] = {x - R(1.0), dy, c->height}, to_minus[3] = {x + R(1.0), dy, c->height};
        FN(add_charge)(out, lines->strength, to_plus);
        FN(add_charge)(out, -lines->strength, to_minus);
    }
}

/* Derivatives of the magnetic force and of the torque's dW/dt by position (columns 0, 1) and by n. */
static inline void FN(magnetic_jacobian)(const FN(world) * c, const REAL *n, const FN(field_derivatives) * f,
                                         REAL j[FST_STATE_SIZE][FST_STATE_SIZE])
{
    const REAL n_dot_b = n[0] * f->b[0] + n[1] * f->b[1] + n[2] * f->b[2];
    const REAL s = c->hard + c->twice_b * n_dot_b;
    const REAL nxb[3] = {n[1] * f->b[2] - n[2] * f->b[1], n[2] * f->b[0] - n[0] * f->b[2],
                         n[0] * f->b[1] - n[1] * f->b[0]};
    REAL gn[3];
    for (int i = 0; i < 3; ++i)
        gn[i] = f->g[i][0] * n[0] + f->g[i][1] * n[1] + f->g[i][2] * n[2];
    for (int q = 0; q < 5; ++q) { /* q: X, Y, nX, nY, nZ */
        const int column = q < 2 ? FST_X + q : FST_NX + q - 2;
        REAL db[3], dn[3]; /* derivatives of B and n by q */
        for (int i = 0; i < 3; ++i) {
            db[i] = q < 2 ? f->g[i][q] : R(0.0);
            dn[i] = q - 2 == i ? R(1.0) : R(0.0);
        }
        REAL ds = R(0.0);
        for (int i = 0; i < 3; ++i)
            ds = ds + c->twice_b * (dn[i] * f->b[i] + n[i] * db[i]);
        for (int i = 0; i < 2; ++i) {
            REAL df = ds * gn[i];
            for (int k = 0; k < 3; ++k) {
                df = df + f->g[i][k] * (s * dn[k] + c->twice_a * db[k]);
                if (q < 2)
                    df = df + f->t[i][k][q] * (s * n[k] + c->twice_a * f->b[k]);
            }
            j[FST_VX + i][column] = df;
        }
        for (int i = 0; i < 3; ++i) {
            const int k = (i + 1) % 3, l = (i + 2) % 3;
            const REAL dnxb = dn[k] * f->b[l] + n[k] * db[l] - dn[l] * f->b[k] - n[l] * db[k];
            j[FST_WX + i][column] = c->torque * (s * dnxb + ds * nxb[i]);
        }
    }
}

/* farago2020: the derivatives of (W.n) W x n. */
static inline void FN(lost_term_jacobian)(const REAL *n, const REAL *w, REAL j[FST_STATE_SIZE][FST_STATE_SIZE])
{
    const REAL spin = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
    for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        const REAL wxn = w[k] * n[l] - w[l] * n[k];
        for (int q = 0; q < 3; ++q) {
            j[FST_WX + i][FST_NX + q] = j[FST_WX + i][FST_NX + q] + w[q] * wxn;
            j[FST_WX + i][FST_WX + q] = j[FST_WX + i][FST_WX + q] + n[q] * wxn;
        }
        j[FST_WX + i][FST_NX + l] = j[FST_WX + i][FST_NX + l] + spin * w[k];
        j[FST_WX + i][FST_NX + k] = j[FST_WX + i][FST_NX + k] - spin * w[l];
        j[FST_WX + i][FST_WX + k] = j[FST_WX + i][FST_WX + k] + spin * n[l];
        j[FST_WX + i][FST_WX + l] = j[FST_WX + i][FST_WX + l] - spin * n[k];
    }
}

/* jacobian[i][j] = d(y'_i)/d(y_j) at the drive `omega`. */
static inline void FN(jacobian_by_hand)(const FN(world) * c, REAL omega, const REAL *y,
                                        REAL j[FST_STATE_SIZE][FST_STATE_SIZE])
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            j[i][k] = R(0.0);
    const REAL *n = y + FST_NX, *w = y + FST_WX;
    FN(field_derivatives) f;
    FN(field_with_derivatives)(c, y[FST_X], y[FST_Y], &f);
    FN(magnetic_jacobian)(c, n, &f, j);
    for (int q = 0; q < 4; ++q) { /* -omega e x (.) of the four vectors */
        const int first = q == 0 ? FST_X : q == 1 ? FST_VX : q == 2 ? FST_NX : FST_WX;
        j[first][first + 1] = j[first][first + 1] + omega;
        j[first + 1][first] = j[first + 1][first] - omega;
    }
    j[FST_X][FST_VX] = j[FST_Y][FST_VY] = R(1.0);
    for (int i = 0; i < 3; ++i) { /* W x n */
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        j[FST_NX + i][FST_WX + k] = n[l];
        j[FST_NX + i][FST_WX + l] = -n[k];
        j[FST_NX + i][FST_NX + l] = j[FST_NX + i][FST_NX + l] + w[k];
        j[FST_NX + i][FST_NX + k] = j[FST_NX + i][FST_NX + k] - w[l];
    }
    const REAL friction = c->kinds.contact == FST_FRICTION_VISCOUS ? R(1.0) : R(0.0);
    /* Friction: f_x = vX - eps WY, f_y = vY + eps WX; v' = -f, W' = traction e x f. */
    j[FST_VX][FST_VX] = -friction;
    j[FST_VX][FST_WY] = friction * c->eps;
    j[FST_VY][FST_VY] = -friction;
    j[FST_VY][FST_WX] = -(friction * c->eps);
    j[FST_WX][FST_VY] = -(friction * c->traction);
    j[FST_WX][FST_WX] = -(friction * c->traction * c->eps);
    j[FST_WY][FST_VX] = friction * c->traction;
    j[FST_WY][FST_WY] = -(friction * c->traction * c->eps);
    if (c->kinds.gyroscopic_term_lost)
        FN(lost_term_jacobian)(n, w, j);
}

#endif
