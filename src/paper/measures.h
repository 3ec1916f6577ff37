/* measures.h - the numbers of the statements, measured on the runs: a function for each. */
#ifndef FST_PAPER_MEASURES_H
#define FST_PAPER_MEASURES_H

#include "paper/state.h"

/* Each has the signature of fst_statement.measure. */
#define FST_MEASURE(name)                                                                                      \
    double fst_measure_##name(const fst_paper_state *paper, fst_dynamics dynamics, char *note, size_t size);

FST_MEASURE(maxima_distance) /* between the field's maxima, mm */
FST_MEASURE(field_maximum)   /* radius at which the field is greatest */
FST_MEASURE(fold4_festoons)  /* omega = 0.215: number of festoons */
FST_MEASURE(fold4_angle)     /* greatest angle of n and B, degrees */
FST_MEASURE(fold4_nz)        /* |<n_z>| */
FST_MEASURE(fold4_field)     /* greatest deviation of |B| from its mean, % */
FST_MEASURE(fold15_festoons) /* at omega = 0.4: the number of festoons, and the angle */
FST_MEASURE(fold15_angle)
FST_MEASURE(fold15_tilt)         /* of the best-fit plane of n against the vertical, degrees */
FST_MEASURE(fold15_roundness)    /* ratio of the two widths of the path of n in that plane */
FST_MEASURE(fold15_symmetry)     /* 1: S1, 2: S2, NAN: n is not closed */
FST_MEASURE(least_radius)        /* omega = 0.4: least r */
FST_MEASURE(least_radius_phi)    /* where in Phi, modulo half a turn, degrees from alignment */
FST_MEASURE(greatest_radius_phi) /* where r is greatest, degrees */
FST_MEASURE(halving)             /* omega of the period halving */
FST_MEASURE(halving_branch)      /* 1: supercritical, -1: subcritical */
FST_MEASURE(two_poles)           /* stable locked states at the slowest drive */
FST_MEASURE(onset)               /* lowest frequency of counter-rotation, Hz */
FST_MEASURE(corotation)          /* greatest frequency at which a bead from rest is locked, Hz */
FST_MEASURE(irregular)           /* share of irregular runs between 7 and 10 Hz, % */
FST_MEASURE(bell)                /* frequency of least |alpha'|, Hz */
FST_MEASURE(bell_shape)     /* runs at which |alpha'| does not fall to the bell's top, or not grow after it */
FST_MEASURE(inversion)      /* runs from 10 Hz on that do not counter-rotate */
FST_MEASURE(fitted_length)  /* half length of the lines with the maxima 41 mm apart, mm */
FST_MEASURE(damping)        /* damping ratio of the least damped swing at a small kappa */
FST_MEASURE(slowness)       /* omega/|alpha'|, mean over the counter-rotating range */
FST_MEASURE(rolling_alpha)  /* greatest deviation of <alpha'> from free rolling, omega from 0.5, % */
FST_MEASURE(rolling_phi)    /* the same for <phi'> */
FST_MEASURE(friction_share) /* omega = 0.4: |<V_r>| over the magnetic term of Eq. (12), % */
FST_MEASURE(energy)         /* |<drive power> - <f.V>| over the latter, greatest over Table 1 */

/* measures_dry.c: of a bead that rubs dry, where the other columns rest on branches of the viscous law */
FST_MEASURE(dry_corotation) /* greatest frequency at which a bead from rest goes with the magnet, Hz */
FST_MEASURE(dry_irregular)  /* share of irregular runs between 7 and 10 Hz, % */

/* measures_motion.c */
FST_MEASURE(turning_times)  /* share of the loss in the quarter of the time next to the turning points, % */
FST_MEASURE(turning_points) /* and in the lossiest quarter, as far as it is in the half next to them */
FST_MEASURE(friction_follows_angle) /* squared correlation of |V| with the angle of n and B */
FST_MEASURE(corner_nz)              /* |n_z| where r is greatest */
FST_MEASURE(conjugate)              /* <n_z> from the conjugate start over <n_z> */
FST_MEASURE(fluctuation)            /* by how much delta r falls from omega = 0.215 to 0.4, % */
FST_MEASURE(circling_estimate)      /* |alpha'| <r>/(eps omega) */
FST_MEASURE(strict_corotation)      /* alpha'/omega at the slowest drive */
FST_MEASURE(phase_lock)             /* chi = phi + Phi, degrees */
FST_MEASURE(frequency_lock)         /* (<phi'> + <alpha'>)/omega */
FST_MEASURE(rolling_on_average)     /* <V_alpha> over r alpha', % */
FST_MEASURE(spin_share)             /* the spin's part of <V_r>, % */
FST_MEASURE(dropped_part)           /* error of the printed magnetic term of Eq. (12), % */
FST_MEASURE(asymptotic_rolling)     /* deviation from free rolling far beyond, % */
FST_MEASURE(asymptotic_frequency)   /* Hz from which friction is under a tenth */
FST_MEASURE(asymptotic_first)       /* Hz at which it is so for the first time */
FST_MEASURE(trochoid)               /* share of the second circular motion in the path */
FST_MEASURE(cusps)                  /* ratio of the speeds of both */
FST_MEASURE(rare_moments)           /* share of the time with over half of the greatest angle, % */
FST_MEASURE(turning_rate)           /* <phi'>/omega */
FST_MEASURE(slip_formula)           /* <V_alpha> less r alpha' + eps phi', over r alpha', % */
FST_MEASURE(third_balance)          /* error of Eq. (14), % */
FST_MEASURE(rolling_below)          /* greatest deviation from free rolling in the experiment's range, % */
FST_MEASURE(halving_nz)             /* exponents at the period halving */
FST_MEASURE(halving_p)
FST_MEASURE(halving_relaxation)

/* measures_theory.c */
FST_MEASURE(line_length) /* l/l_m */
FST_MEASURE(line_spacing)
FST_MEASURE(bead_radius)
FST_MEASURE(orthoradial)         /* B_r over |B| near the maximum, % */
FST_MEASURE(estimate_energy)     /* mu B0, 1e-4 J */
FST_MEASURE(estimate_corotation) /* omega_c/2 pi, Hz */
FST_MEASURE(estimate_moment)     /* A m^2 */
FST_MEASURE(estimate_field)      /* T */
FST_MEASURE(dry_friction_weight) /* 1/s */
FST_MEASURE(dry_friction_pull)
FST_MEASURE(corotation_beads) /* beads that stay on the corotating motion, % */
FST_MEASURE(corotation_force) /* its mean radial force over the counter-rotating one */
FST_MEASURE(paramagnet_counter)
FST_MEASURE(tondu) /* residuals of the identities */
FST_MEASURE(friction_moment)
FST_MEASURE(friction_on_centre)
FST_MEASURE(friction_moment_sign)
FST_MEASURE(rolling_identity)
FST_MEASURE(counter_force)           /* radii at which the counter-rotating ansatz is not pulled inwards */
FST_MEASURE(friction_on_centre_sign) /* motions in which friction drives the centre */
FST_MEASURE(splitting)               /* <r' V_r + r alpha' V_alpha> over <alpha'> <r V_alpha> */
FST_MEASURE(paramagnet_torque)
FST_MEASURE(anisotropy) /* beads without remanence that do not counter-rotate */
FST_MEASURE(remanence)  /* kappa that a steel bead needs, % of the neodymium bead's */

/* measures_field.c */
FST_MEASURE(ball_mean)     /* change of B by averaging over the ball */
FST_MEASURE(slow_pole)     /* distance of the slowest bead from the field's maximum */
FST_MEASURE(slow_parallel) /* its greatest angle of n and B, degrees */
FST_MEASURE(slow_friction) /* friction's power in the middle one of the locked runs over that at 10.7 Hz, % */
FST_MEASURE(most_slow_friction) /* and in the one that loses most */
FST_MEASURE(slow_drag)          /* slip over the bead's speed in the slowest run, % */
FST_MEASURE(unlocking)          /* -d ln(omega_c)/d ln(gamma) */
FST_MEASURE(locked_again)       /* runs under 7 Hz that do not go with the magnet */
FST_MEASURE(not_at_rest)        /* runs that are not locked, too */
FST_MEASURE(sine_law)           /* the part of the averages beside sin(chi) and cos(chi) */
FST_MEASURE(least_energy)       /* mean magnetic energy at chi = pi over that at 0 */
FST_MEASURE(theta)              /* rms of n_r at omega = 0.4 */
FST_MEASURE(steady_radius)      /* delta r/<r> at omega = 0.4 */
FST_MEASURE(modulation)         /* squared correlation of r and the radial force */
FST_MEASURE(friction_outside)   /* friction's share of the forces near the maxima of r, % */

FST_MEASURE(resonance)       /* mean radial force for phi at other rates than Phi's, over that of -1 */
FST_MEASURE(field_structure) /* share of the appendix's orthoradial field in the whole one */
FST_MEASURE(line_of_dipoles) /* a line of dipoles against its two charges */
FST_MEASURE(force_at_ends)   /* magnet's force at its ends over that at its middle, less 1, % */
FST_MEASURE(pull_weakens)    /* by how much the pull inwards falls from the ends to the middle, % */

/* measures_equations.c: by how much the computed motions miss the printed equations, relative */
FST_MEASURE(centre_equations)
FST_MEASURE(turning_equations)
FST_MEASURE(euler_equation)
FST_MEASURE(appendix_slip)
FST_MEASURE(appendix_theta)
FST_MEASURE(appendix_phi)
FST_MEASURE(appendix_psi)
FST_MEASURE(second_balance) /* Eq. (13), % */

/* measures_text.c: sentences of the text about paths, symmetry and order */
FST_MEASURE(shortcuts)        /* by how much a revolution is shorter than the circle of the mean radius, % */
FST_MEASURE(shortcuts_within) /* and than the circle through the turning points */
FST_MEASURE(drifting)         /* share of the runs whose pattern does not close, % */
FST_MEASURE(suddenness)       /* width of the range of drives between co- and counter-rotation, % */
FST_MEASURE(s2_in_the_frame)  /* error of S2 for vectors in the magnet's frame */
FST_MEASURE(s2_in_components) /* and for components along e_r, e_alpha, e_z */
FST_MEASURE(kappa_ratio)      /* square of the two frequencies' ratio over kappa */

/* measures_reading.c: second readings */
FST_MEASURE(field_deviation)     /* standard deviation of |B| over its mean, % */
FST_MEASURE(half_of_the_angle)   /* time that holds half of the mean square of the angle, % */
FST_MEASURE(whole_force_at_ends) /* force at the magnet's ends over that at its middle, upright part and all,
                                    less 1, % */
FST_MEASURE(orthoradial_energy)  /* B_r^2 over B^2 near the maximum, % */
FST_MEASURE(
    force_beyond_own_maximum) /* radii beyond the maximum of the appendix' field without a pull inwards */

#undef FST_MEASURE

#endif
