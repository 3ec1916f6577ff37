/* surroundings.h - everything that makes a field, at any time, on the laboratory's axes: the moving magnet, what stands
 * still (parts, coils, a uniform field), and the travelling wave. */
#ifndef FST_MODEL_SURROUNDINGS_H
#define FST_MODEL_SURROUNDINGS_H

#include "model/model.h"
#include "model/waveform.h"

typedef struct fst_loop {
    fst_part_double part; /* source/loop.inl; its j[2] is that of a current of 1 A */
    int turned;           /* its axis is not that of the laboratory */
    double current, ac, rate, phase;
} fst_loop;

typedef struct fst_surroundings {
    const fst_model *model; /* the moving magnet is its source; borrowed */
    fst_waveform drive;
    int laboratory; /* the axes stand still; else they turn with the magnet */
    fst_kinds fixed_kinds;
    fst_parts_double fixed;
    double uniform[3];
    int loop_count;
    fst_loop loops[FST_COILS_MAX];
    double wave_number, forward, backward, wave_height;
} fst_surroundings;

/* Those of a model's parameters; the model must outlive them.  FST_BAD_INPUT: a number contradicts another, or
 * world.frame: turning is asked for where something stands still. */
fst_status fst_make_surroundings(const fst_model *model, fst_surroundings *s, fst_error *error);

/* B and G at the time t and the place x (z over the magnet's reference plane), and dB/dt there, on the axes of the
 * frame; dB/dt is that at a place that stands still in the laboratory. */
void fst_surroundings_field(const fst_surroundings *s, double t, const double x[3], double b[3],
                            fst_gradient_double *g, double change[3]);

/* How far a place is from the nearest wire of a coil, in l; infinite without coils. */
double fst_distance_to_wire(const fst_surroundings *s, const double x[3]);

/* A place on the axes of the frame as one on those of the magnet. */
void fst_place_on_magnet(const fst_surroundings *s, double t, const double x[3], double own[3]);

/* By how much the axes of the frame have turned since the time 0, in radians. */
double fst_frame_angle(const fst_surroundings *s, double t);

/* The turns of the magnet since the time 0. */
double fst_magnet_turns(const fst_surroundings *s, double t);

/* The rate at which the axes of the frame turn. */
double fst_frame_rate(const fst_surroundings *s, double t);

#endif
